#include "studies/measured/windows/window_comparison.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "io/measured/measured_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace stylobate {

/// The run as a variant is to track it, through all of its windows.
TrackingJob WindowComparison::job_of(const Run& run, const ModelVariant& variant) const
{
    TrackingJob job;
    job.realization = nominal_realization(variant.study, structure_);
    Realization& r = job.realization;
    for (std::size_t i = 0; i < plan_x_m_.size(); ++i)
        if (std::isfinite(run.seen.standing_x_m[i]) && !r.blocks[i].fixed)
            r.blocks[i].x_m += run.seen.standing_x_m[i];
    r.motion = run.base;
    if (variant.change)
        variant.change(r, run.index);
    job.targets = run.targets;
    job.nudge_rad_s = scales_.nudge_rad_s;
    job.windows = run.windows;
    return job;
}

/// The selected windows of a run, or all.
std::vector<SeenWindow> WindowComparison::windows_in(const Run& run, const WindowOptions& options) const
{
    if (options.places.empty())
        return windows_of(run.seen, scales_.window_s);
    std::vector<SeenWindow> windows;
    for (const WindowPlace& place : options.places)
        if (place.run == run.index)
            if (std::optional<SeenWindow> window = window_at(run.seen, place.free_s, scales_.window_s))
                windows.push_back(std::move(*window));
    return windows;
}

/// A window as it was measured; no model yet.
/// @param read the same window, to be read at every sample
WindowCurve WindowComparison::measured_curve(const Run& run, std::size_t window, const std::vector<std::size_t>& chosen,
                                             FreeWindow& read) const
{
    const FreeWindow& free = (*run.windows)[window - run.first];
    const SeenRun& seen = run.seen;
    const double clock_s = places_[window].start_s - free.start_s;
    read.start_s = free.start_s;
    WindowCurve curve;
    curve.noise_sd = seen.noise_sd;
    for (std::size_t row = 0; row < seen.time_s.size(); ++row) {
        if (!(seen.time_s[row] > free.start_s && seen.time_s[row] <= free.times_s.back()))
            continue;
        read.times_s.push_back(seen.time_s[row]);
        curve.time_s.push_back(seen.time_s[row] + clock_s);
        curve.base_m.push_back(seen.base_m[row]);
        for (std::size_t c = 0; c < coordinate_count; ++c)
            for (const std::size_t block : chosen)
                curve.seen[c].push_back(seen.seen[c][row * seen.blocks + block]);
    }
    for (const std::size_t block : chosen) {
        const double moved = seen.standing_x_m[block];
        curve.stood_x_m.push_back(plan_x_m_[block] + (std::isfinite(moved) ? moved : 0));
    }
    return curve;
}

TrackingReport WindowComparison::tracked(const std::vector<TrackingJob>& jobs, const RunOptions& options,
                                         Observer& observer)
{
    TrackingReport report = track(jobs, options, observer);
    cost_ += {jobs.size(), report.windows, report.block_steps};
    return report;
}

Realization nominal_realization(const Study& variant, const StructureSpec& structure)
{
    Study study = variant.as_single(1);
    study.perturbations.clear();
    study.structure = structure;
    study.excitation = ExcitationSpec{};
    study.excitation.duration_s = 1;
    study.initial = InitialSpec{};
    return Sampler(study, nullptr).realization(0);
}

WindowComparison::WindowComparison(const Campaign& campaign, const WindowOptions& options)
{
    const SpecimenStructure specimen = build_specimen(campaign.specimen);
    structure_ = specimen.structure;
    const Layout layout = lay_out(structure_);
    double width = 0;
    std::size_t drums = 0;
    for (const PlacedBlock& block : layout.blocks) {
        plan_x_m_.push_back(block.x_m() + specimen.origin_x_m);
        if (!block.fixed && block.role == BlockRole::drum) {
            width += block.width_m;
            ++drums;
        }
    }
    scales_ =
        tracking_scales(width / static_cast<double>(std::max<std::size_t>(drums, 1)), campaign.specimen.gravity_m_s2);
    if (options.window_s > 0)
        scales_.window_s = options.window_s;
    for (std::size_t i = 0; i < campaign.runs.size(); ++i) {
        if (!options.runs.empty() && std::find(options.runs.begin(), options.runs.end(), i) == options.runs.end())
            continue;
        const MeasuredRun& measured = campaign.runs[i];
        if (!measured.has_base())
            continue;
        Run run;
        run.index = i;
        run.base = std::make_shared<Motion>(base_motion_of(measured));
        run.seen = seen_run(measured, *run.base, specimen.block, plan_x_m_, scales_.smoothing_s);
        if (run.seen.blocks == 0)
            continue;
        const std::vector<SeenWindow> windows = windows_in(run, options);
        if (windows.empty())
            continue;
        run.targets = std::make_shared<Targets>(targets_of(run.seen));
        auto list = std::make_shared<std::vector<FreeWindow>>();
        run.first = places_.size();
        for (std::vector<SeenValue>& values : seen_values(run.seen, windows, scales_.lag_s))
            values_.push_back(std::move(values));
        for (const SeenWindow& window : windows) {
            list->push_back(window.window);
            places_.push_back({i, window.window.start_s + measured.time_s.front(),
                               window.window.times_s.back() + measured.time_s.front(), window.window.start_s});
        }
        run.windows = list;
        runs_.push_back(std::move(run));
    }
}

std::vector<WindowResiduals> WindowComparison::residuals(const std::vector<ModelVariant>& variants,
                                                         const RunOptions& options, Observer& observer)
{
    std::vector<TrackingJob> jobs;
    std::vector<std::vector<double>> rest_y; // (jobs x blocks)
    for (const ModelVariant& variant : variants) {
        for (const Run& run : runs_) {
            jobs.push_back(job_of(run, variant));
            rest_y.push_back(static_state(jobs.back().realization).y_m);
        }
    }
    const TrackingReport report = tracked(jobs, options, observer);
    std::vector<WindowResiduals> all;
    if (!report.complete)
        return all;
    std::size_t job = 0;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        WindowResiduals z(places_.size());
        for (const Run& run : runs_) {
            const TrackingResult& result = report.results[job];
            const std::size_t read = jobs[job].realization.blocks.size(); // the ground among them, where it can be met
            for (std::size_t w = 0; w < result.windows.size(); ++w)
                z[run.first + w] = stylobate::residuals(values_[run.first + w], result.windows[w], read, rest_y[job]);
            ++job;
        }
        all.push_back(std::move(z));
    }
    return all;
}

std::vector<WindowCurve> WindowComparison::curves(const ModelVariant& variant, const std::vector<std::size_t>& windows,
                                                  const std::vector<std::size_t>& blocks, const RunOptions& options,
                                                  Observer& observer)
{
    std::vector<WindowCurve> curves;
    std::vector<TrackingJob> jobs;
    for (const Run& run : runs_) {
        auto dense = std::make_shared<std::vector<FreeWindow>>();
        for (const std::size_t w : windows) {
            if (w < run.first || w >= run.first + run.windows->size())
                continue;
            curves.push_back(measured_curve(run, w, blocks, dense->emplace_back()));
        }
        if (dense->empty())
            continue;
        jobs.push_back(job_of(run, variant));
        jobs.back().windows = dense;
    }
    const TrackingReport report = tracked(jobs, options, observer);
    if (!report.complete)
        return {};
    auto curve = curves.begin();
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        const std::size_t all = jobs[j].realization.blocks.size(); // the ground may be one of them
        const std::vector<double> rest_y_m = static_state(jobs[j].realization).y_m;
        for (const Readings& readings : report.results[j].windows) {
            for (std::size_t k = 0; k < curve->time_s.size(); ++k)
                for (const std::size_t block : blocks) {
                    const std::size_t i = k * all + block;
                    curve->model[0].push_back(readings.x_m[i]);
                    curve->model[1].push_back(readings.y_m[i] - rest_y_m[block]);
                    curve->model[2].push_back(readings.theta_rad[i]);
                }
            ++curve;
        }
    }
    return curves;
}

ResidualScales WindowComparison::fit_scales(const WindowResiduals& residuals,
                                            const std::vector<std::size_t>& runs) const
{
    ResidualScales scales(residual_kinds(plan_x_m_.size()));
    for (std::size_t w = 0; w < places_.size(); ++w)
        if (runs.empty() || std::find(runs.begin(), runs.end(), places_[w].run) != runs.end())
            scales.add(values_[w], residuals[w]);
    scales.fit();
    return scales;
}

std::vector<double> WindowComparison::scores(const WindowResiduals& residuals, const ResidualScales& scales) const
{
    std::vector<double> scores;
    for (std::size_t w = 0; w < residuals.size(); ++w)
        scores.push_back(scales.score(values_[w], residuals[w]));
    return scores;
}

PairedGain paired_gain(const std::vector<double>& score_a, const std::vector<double>& score_b,
                       const std::vector<std::size_t>& group)
{
    std::map<std::size_t, double> sums;
    PairedGain gain;
    for (std::size_t w = 0; w < score_a.size(); ++w) {
        sums[group[w]] += score_b[w] - score_a[w];
        gain.total += score_b[w] - score_a[w];
    }
    std::vector<double> parts;
    if (sums.size() >= 4)
        for (const auto& [key, sum] : sums)
            parts.push_back(sum);
    else
        for (std::size_t w = 0; w < score_a.size(); ++w)
            parts.push_back(score_b[w] - score_a[w]);
    gain.groups = parts.size();
    const double n = static_cast<double>(parts.size());
    if (parts.size() < 2) {
        gain.low = -std::numeric_limits<double>::infinity();
        gain.high = std::numeric_limits<double>::infinity();
        return gain;
    }
    double square = 0;
    for (const double part : parts)
        square += (part - gain.total / n) * (part - gain.total / n);
    const double half = student_quantile(0.975, n - 1) * std::sqrt(square * n / (n - 1));
    gain.low = gain.total - half;
    gain.high = gain.total + half;
    return gain;
}

} // namespace stylobate
