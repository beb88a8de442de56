#include "studies/diagnosis/window_evidence.hpp"

#include "ensemble/input_error.hpp"
#include "ensemble/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace stylobate {

namespace {

// The smallest sizes tried beyond those of the list are between two neighbours of the best one.
constexpr int refined = 8; ///< causes whose size is looked at more closely

struct FormName {
    ContactForm form;
    const char* name;
};
constexpr FormName forms[] = {
    {ContactForm::area, "area"}, {ContactForm::two_corner, "two_corner"}, {ContactForm::points, "points"}};

Study with_contacts(const Study& start, ContactForm form, double stiffness, double damping, double friction)
{
    Study study = start;
    study.contact.form = form;
    study.contact.normal_stiffness_n_m2 *= stiffness;
    study.contact.tangential_stiffness_n_m *= stiffness;
    study.contact.normal_damping_ratio = damping;
    study.contact.tangential_damping_ratio = damping;
    study.contact.normal_damping_n_s_m.reset();
    study.contact.tangential_damping_n_s_m.reset();
    // a dashpot at the centroid damps no rocking: no healthy contact is like that
    study.contact.damping = DampingAt::ends;
    study.contact.friction *= friction;
    return study;
}

class Windows {
public:
    Windows(const Campaign& campaign, const std::vector<SizedCause>& given, const RunOptions& options,
            Observer& observer)
        : built_(build_specimen(campaign.specimen)), comparison_(campaign, {}), given_(given), options_(options),
          observer_(observer)
    {
    }

    bool empty() const { return comparison_.windows().empty(); }
    const WindowComparison& comparison() const { return comparison_; }

    ModelVariant variant(const Study& study, const SizedCause* tried) const
    {
        ModelVariant v;
        v.study = study;
        std::vector<SizedCause> causes = given_;
        if (tried)
            causes.push_back(*tried);
        v.change = [causes, this](Realization& r, std::size_t) {
            for (const SizedCause& cause : causes)
                apply_cause(cause, built_, r);
        };
        return v;
    }

    /// (variants x windows) log scores, each by its own scales; empty if stopped.
    std::vector<std::vector<double>> scores(const std::vector<ModelVariant>& variants)
    {
        std::vector<std::vector<double>> out;
        const std::vector<WindowResiduals> residuals = comparison_.residuals(variants, options_, observer_);
        for (const WindowResiduals& z : residuals)
            out.push_back(comparison_.scores(z, comparison_.fit_scales(z)));
        return out;
    }

private:
    SpecimenStructure built_;
    WindowComparison comparison_;
    const std::vector<SizedCause>& given_;
    const RunOptions& options_;
    Observer& observer_;
};

double sum(const std::vector<double>& v)
{
    return std::accumulate(v.begin(), v.end(), 0.0);
}

/// Size and its standard deviation from the scores of several sizes: a parabola through the best and its neighbours.
void size_of(const std::map<double, double>& score, CauseFit& fit)
{
    auto best = score.begin();
    for (auto it = score.begin(); it != score.end(); ++it)
        if (it->second > best->second)
            best = it;
    fit.size = best->first;
    const bool first = best == score.begin(), last = std::next(best) == score.end();
    if (first || last) {
        const auto other = first ? std::next(best) : std::prev(best);
        fit.sd = other == score.end() ? std::fabs(best->first) : std::fabs(other->first - best->first) / 2;
        return;
    }
    const auto [x0, y0] = *std::prev(best);
    const auto [x1, y1] = *best;
    const auto [x2, y2] = *std::next(best);
    const double left = (y1 - y0) / (x1 - x0), right = (y2 - y1) / (x2 - x1);
    const double curvature = 2 * (right - left) / (x2 - x0);
    const double widest = (x2 - x0) / 2;
    if (curvature < 0) {
        fit.size = std::clamp((x0 + x1) / 2 - left / curvature, x0, x2);
        fit.sd = std::min(std::sqrt(-1 / curvature), widest);
    } else {
        fit.sd = widest;
    }
    // windows are not quite independent, and the model is not quite right
    fit.sd = std::max(fit.sd, widest / 4);
}

} // namespace

std::vector<TriedCause> window_causes(const Specimen& specimen, const TrackScales& scales, double friction)
{
    const double height = scales.time_s * scales.time_s * specimen.gravity_m_s2, speed = height / scales.time_s;
    double weight = 0, width = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < specimen.mass_kg.size(); ++b) {
        weight += specimen.mass_kg[b] * specimen.gravity_m_s2;
        width = std::min(width, specimen.half_width_m[b]);
    }
    std::vector<TriedCause> tried;
    const auto of_joint = [](const char* mechanism, int joint, const char* parameter, const char* unit,
                             double neutral) {
        Cause cause{mechanism, joint < 0 ? "all joints" : fmt::format("joint {}", joint), parameter, unit, neutral};
        cause.joint = joint;
        return cause;
    };
    const int joints = static_cast<int>(specimen.joints.size());
    for (int j = 0; j < joints; ++j)
        tried.push_back({of_joint("joint_friction", j, "ratio", "", 1), {0.45, 0.6, 0.75, 0.87, 1.15, 1.35}});
    for (const double part : {0.01, 0.04}) {
        Cause stribeck = of_joint("stribeck", -1, "dynamic_ratio", "", 1);
        stribeck.fixed = part * speed;
        tried.push_back({stribeck, {0.5, 0.7, 0.85}});
    }
    tried.push_back({of_joint("friction_wear", -1, "wear_per_m", "1/m", 0), {0.5 / height, 1.5 / height, 5 / height}});
    tried.push_back({of_joint("adhesion", -1, "force_n_m", "N/m", 0),
                     {0.1 * friction * weight / width, 0.3 * friction * weight / width}});
    for (int j = 0; j < joints; ++j) {
        Cause dowel = of_joint("dowel", j, "stiffness_n_m", "N/m", 0);
        dowel.fixed = 0.0025 * height;
        tried.push_back({dowel, {30 * weight / height, 300 * weight / height}});
        tried.push_back({of_joint("corner_loss", j, "loss_m", "m", 0), {0.04 * width, 0.1 * width, 0.2 * width}});
    }
    Cause drag{"drag", "all blocks", "coefficient_n_s2_m2", "N s2/m2", 0};
    const double unit = specimen.mass_kg.front() / height; // a force of g at a speed of sqrt(g height)
    tried.push_back({drag, {0.3 * unit, unit, 3 * unit}});
    for (int b = 0; b < specimen.blocks(); ++b) {
        Cause centre{"eccentricity", fmt::format("block {}", b), "offset_m", "m", 0};
        centre.block = b;
        tried.push_back({centre, {-0.1 * width, -0.04 * width, 0.04 * width, 0.1 * width}});
    }
    return tried;
}

WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const TrackScales& scales,
                               const std::vector<SizedCause>& given, bool other_forms, const RunOptions& options,
                               Observer& observer)
{
    WindowEvidence out;
    Windows windows(campaign, given, options, observer);
    if (windows.empty()) {
        out.why_not = "No run has both a base motion and a history of the blocks that a simulation could follow.";
        out.complete = true;
        return out;
    }
    const auto count = [&] {
        out.simulations = windows.comparison().simulations();
        out.window_simulations = windows.comparison().window_simulations();
        out.block_steps = windows.comparison().block_steps();
    };
    // the baseline gets a search of its own: form, stiffness and damping first, then friction about the best
    std::vector<ModelVariant> variants;
    std::vector<WindowBaseline> tried;
    const auto add = [&](const FormName& form, double stiffness, double damping, double friction) {
        WindowBaseline baseline{
            fmt::format("{}, K_N x {:g}, damping {:g}, friction x {:g}", form.name, stiffness, damping, friction),
            with_contacts(start, form.form, stiffness, damping, friction)};
        variants.push_back(windows.variant(baseline.study, nullptr));
        tried.push_back(std::move(baseline));
    };
    for (const FormName& form : forms)
        for (const double stiffness : {0.1, 0.3, 1.0})
            for (const double damping : {0.05, 0.2, 0.5})
                add(form, stiffness, damping, 1);
    std::vector<std::vector<double>> scores = windows.scores(variants);
    if (scores.empty())
        return out;
    for (std::size_t k = 0; k < tried.size(); ++k)
        tried[k].score = sum(scores[k]);
    for (const FormName& form : forms) {
        const WindowBaseline* best = nullptr;
        for (const WindowBaseline& b : tried)
            if (b.study.contact.form == form.form && (!best || b.score > best->score))
                best = &b;
        out.baselines.push_back(*best);
    }
    variants.clear();
    std::vector<WindowBaseline> frictions;
    for (const WindowBaseline& b : out.baselines)
        for (const double friction : {0.9, 0.95, 1.05, 1.1}) {
            WindowBaseline other = b;
            other.study.contact.friction *= friction;
            other.contacts += fmt::format(" x {:g}", friction);
            variants.push_back(windows.variant(other.study, nullptr));
            frictions.push_back(std::move(other));
        }
    scores = windows.scores(variants);
    if (scores.empty())
        return out;
    for (std::size_t k = 0; k < frictions.size(); ++k) {
        frictions[k].score = sum(scores[k]);
        WindowBaseline& best = out.baselines[k / 4];
        if (frictions[k].score > best.score)
            best = frictions[k];
    }
    std::sort(out.baselines.begin(), out.baselines.end(),
              [](const WindowBaseline& a, const WindowBaseline& b) { return a.score > b.score; });

    // every cause, beside the best baseline
    const double friction = campaign.specimen.friction_nominal.value_or(0.7);
    const std::vector<TriedCause> causes = window_causes(campaign.specimen, scales, friction);
    const Study& best = out.baselines.front().study;
    const auto try_all = [&](const Study& study, const std::vector<SizedCause>& list) {
        variants.clear();
        variants.push_back(windows.variant(study, nullptr));
        for (const SizedCause& cause : list)
            variants.push_back(windows.variant(study, &cause));
        return windows.scores(variants);
    };
    std::vector<SizedCause> list;
    for (const TriedCause& t : causes)
        for (const double size : t.sizes)
            list.push_back({t.cause, size});
    scores = try_all(best, list);
    if (scores.empty())
        return out;
    const std::vector<double> base = scores.front();
    const double base_sum = sum(base);
    const std::vector<WindowPlace>& places = windows.comparison().windows();
    struct Found {
        CauseFit fit;
        std::map<double, double> score;
    };
    std::vector<Found> found;
    std::size_t k = 1;
    const auto take = [&](Found& f, double size, const std::vector<double>& by_window) {
        f.score[size] = sum(by_window);
        if (f.score[size] - base_sum <= f.fit.gain)
            return;
        f.fit.gain = f.score[size] - base_sum;
        f.fit.gain_by_run.assign(campaign.runs.size(), 0);
        for (std::size_t w = 0; w < places.size(); ++w)
            f.fit.gain_by_run[places[w].run] += by_window[w] - base[w];
    };
    for (const TriedCause& t : causes) {
        Found f;
        f.fit.cause = t.cause;
        f.fit.size = t.cause.neutral;
        f.fit.gain_by_run.assign(campaign.runs.size(), 0);
        f.score[t.cause.neutral] = base_sum;
        for (const double size : t.sizes)
            take(f, size, scores[k++]);
        found.push_back(std::move(f));
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.fit.gain > b.fit.gain; });
    list.clear();
    std::vector<std::size_t> of;
    for (std::size_t f = 0; f < found.size() && f < refined && found[f].fit.gain > 0; ++f) {
        const std::map<double, double>& score = found[f].score;
        auto top = std::max_element(score.begin(), score.end(),
                                    [](const auto& a, const auto& b) { return a.second < b.second; });
        if (top != score.begin()) {
            list.push_back({found[f].fit.cause, (top->first + std::prev(top)->first) / 2});
            of.push_back(f);
        }
        if (std::next(top) != score.end()) {
            list.push_back({found[f].fit.cause, (top->first + std::next(top)->first) / 2});
            of.push_back(f);
        }
    }
    if (!list.empty()) {
        scores = try_all(best, list);
        if (scores.empty())
            return out;
        for (std::size_t i = 0; i < list.size(); ++i)
            take(found[of[i]], list[i].size, scores[i + 1]);
    }
    std::vector<CauseFit> fits;
    for (Found& f : found) {
        if (f.fit.gain > 0)
            size_of(f.score, f.fit);
        fits.push_back(f.fit);
    }
    out.causes = fits;
    std::stable_sort(out.causes.begin(), out.causes.end(),
                     [](const CauseFit& a, const CauseFit& b) { return a.gain > b.gain; });
    // one for each mechanism and place
    std::vector<CauseFit> kept;
    for (CauseFit& fit : out.causes)
        if (std::none_of(kept.begin(), kept.end(), [&](const CauseFit& other) {
                return other.cause.mechanism == fit.cause.mechanism && other.cause.place == fit.cause.place;
            }))
            kept.push_back(std::move(fit));
    out.causes = std::move(kept);

    out.gain_in_others.assign(out.causes.size(), {});
    if (other_forms)
        for (std::size_t b = 1; b < out.baselines.size(); ++b) {
            list.clear();
            for (std::size_t c = 0; c < out.causes.size() && c < refined; ++c)
                list.push_back({out.causes[c].cause, out.causes[c].size});
            scores = try_all(out.baselines[b].study, list);
            if (scores.empty())
                return out;
            for (std::size_t c = 0; c < list.size(); ++c)
                out.gain_in_others[c].push_back(sum(scores[c + 1]) - sum(scores.front()));
        }
    count();
    out.complete = true;
    return out;
}

} // namespace stylobate
