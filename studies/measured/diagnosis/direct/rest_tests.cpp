/// What lies askew before the shaking: wedges and offsets of drums.

#include "ensemble/numerics/interval.hpp"
#include "io/measured/measured_check.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace stylobate {

namespace {

/// Mean of the differences over the runs, and its standard deviation by the scatter of the runs.
void judge(const std::vector<double>& upper, const std::vector<double>* lower, double& mean, double& sd)
{
    std::vector<double> d;
    for (std::size_t r = 0; r < upper.size(); ++r) {
        const double difference = upper[r] - (lower ? (*lower)[r] : 0);
        if (std::isfinite(difference))
            d.push_back(difference);
    }
    mean = d.empty() ? 0 : std::accumulate(d.begin(), d.end(), 0.0) / static_cast<double>(d.size());
    double squares = 0;
    for (const double v : d)
        squares += (v - mean) * (v - mean);
    sd = d.size() < 2 ? std::numeric_limits<double>::infinity()
                      : std::sqrt(squares / static_cast<double>(d.size() - 1) / static_cast<double>(d.size()));
}

/// Every block is put down with the tolerance, each time anew: what stays in the mean over the runs is an offset. Where
/// the cameras see the table, offsets count from it; else the cameras' zero and the place of the table are not known,
/// and they count from where the others lie. The one that is farthest off is reported first, and is no measure for the
/// others.
///
/// @param place (blocks)(runs) from where it should be
/// @param samples of which each of these is the mean (harmonic mean over the runs)
void test_places(const Specimen& s, bool table, const CampaignScales& scales, const DirectThresholds& limits,
                 const std::vector<std::vector<double>>& place, double samples, DirectResult& out)
{
    const std::size_t n = place.size(), runs = place.front().size();
    if (n < 2 && !table)
        return;
    const double most = -normal_quantile(limits.placed_by_chance / (2 * static_cast<double>(n)));
    struct Placed {
        double mean = 0, sd = 1;
        double in_sds() const { return std::fabs(mean) / sd; }
    };
    std::vector<char> off(n, 0);
    std::vector<DataTest> tests(n);
    const auto placed = [&](std::size_t b) {
        std::vector<double> offset;
        double measures = 0; // how many blocks it is held against, on the mean
        for (std::size_t r = 0; r < runs; ++r) {
            double sum = 0, others = 0;
            for (std::size_t other = 0; other < n && !table; ++other)
                if (other != b && !off[other] && std::isfinite(place[other][r])) {
                    sum += place[other][r];
                    ++others;
                }
            const bool held = table || others > 0;
            offset.push_back(held ? place[b][r] - (table ? 0 : sum / others)
                                  : std::numeric_limits<double>::quiet_NaN());
            measures += others / static_cast<double>(runs);
        }
        Placed p;
        judge(offset, nullptr, p.mean, p.sd);
        const double alike = 1 + (table ? 0 : 1 / std::max(measures, 1.0));
        const double tolerance = s.placement_tolerance_m * std::sqrt(alike / static_cast<double>(runs));
        const double noise = scales.noise_m * std::sqrt(2 / (samples * static_cast<double>(runs)));
        p.sd = std::max({std::isfinite(p.sd) ? p.sd : 0, tolerance, noise});
        return p;
    };
    for (std::size_t told_off = 0; told_off < n; ++told_off) {
        std::size_t farthest = n;
        Placed its;
        for (std::size_t b = 0; b < n; ++b) {
            if (off[b])
                continue;
            const Placed p = placed(b);
            tests[b] =
                told("drum_offset", fmt::format("block {}", b), p.mean, p.sd, most * p.sd, "m", false,
                     fmt::format("On average block {} lies {:.2g} mm to the {} of its nominal position relative to {}.",
                                 b, 1e3 * std::fabs(p.mean), p.mean < 0 ? "left" : "right",
                                 table ? "the table" : "the others"));
            if (farthest == n || p.in_sds() > its.in_sds()) {
                farthest = b;
                its = p;
            }
        }
        // the last two cannot be distinguished: the one that is left is the measure
        const bool alone = !table && std::count(off.begin(), off.end(), 0) < 2;
        if (farthest == n || alone || its.in_sds() <= most)
            break;
        off[farthest] = 1;
        tests[farthest].outcome = TestOutcome::failed;
        out.found.push_back(cause_of("drum_offset", tests[farthest].place, "offset_m", "m", 0, its.mean, its.sd,
                                     0.5 * its.in_sds() * its.in_sds()));
        out.found.back().cause.block = static_cast<int>(farthest);
    }
    out.sensor_tests.insert(out.sensor_tests.end(), tests.begin(), tests.end());
}

} // namespace

bool sees_table(const Campaign& campaign)
{
    return std::all_of(campaign.runs.begin(), campaign.runs.end(),
                       [](const MeasuredRun& run) { return !run.table.x_m.empty(); });
}

void test_rest(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits,
               DirectResult& out)
{
    const Specimen& s = campaign.specimen;
    const auto n = static_cast<std::size_t>(s.blocks());
    const auto fewest = static_cast<std::size_t>(std::max(20, 2 * scales.rates.half_width()));
    std::vector<std::vector<double>> angle(n), place(n);
    double variance = 0; // of the sum of the runs' means, for noise of 1
    for (const MeasuredRun& run : campaign.runs) {
        if (run.blocks.theta_rad.empty() || run.blocks.x_m.empty() || run.time_s.size() < fewest)
            continue;
        const std::size_t rest = std::max(fewest, samples_at_rest(run));
        variance += 1 / static_cast<double>(rest);
        const std::vector<double> seen = places_at_rest(s, run, rest);
        for (std::size_t b = 0; b < n; ++b) {
            angle[b].push_back(mean_seen(run.blocks.theta_rad.values, rest, b, n));
            place[b].push_back(seen[b]);
        }
    }
    if (angle.front().empty()) {
        DataTest test = cannot("wedge", "Rotations and places of the blocks at rest were not measured.");
        test.place = "joints";
        out.sensor_tests.push_back(test);
        return;
    }
    const auto runs = static_cast<double>(angle.front().size());
    // Runs are few, so that each joint's scatter is known badly: half of it is what all joints show over their noise.
    std::vector<double> tilt(s.joints.size()), noise(s.joints.size()), scatter(s.joints.size());
    double common = 0;
    for (std::size_t j = 0; j < s.joints.size(); ++j) {
        const auto [lower, upper] = s.joints[j];
        double sd = 0;
        judge(angle[static_cast<std::size_t>(upper)], lower < 0 ? nullptr : &angle[static_cast<std::size_t>(lower)],
              tilt[j], sd);
        noise[j] = std::max(scales.noise_rad, 1e-12) * std::sqrt((lower < 0 ? 1 : 2) * variance) / runs;
        scatter[j] = std::isfinite(sd) ? std::pow(sd / noise[j], 2) : 1;
        common += scatter[j] / static_cast<double>(s.joints.size());
    }
    // A block on two seats leans by what either of them is askew: the one over which it leans more is reported.
    std::vector<std::optional<CauseFit>> wedges(n);
    for (std::size_t j = 0; j < s.joints.size(); ++j) {
        const auto [lower, upper] = s.joints[j];
        const auto u = static_cast<std::size_t>(upper);
        const double mean = tilt[j], sd = noise[j] * std::sqrt(std::max(1.0, (scatter[j] + common) / 2));
        const std::string joint = fmt::format("joint {}", j);
        const bool found = beyond(mean, sd, limits.wedge_rad, limits.sds);
        out.sensor_tests.push_back(
            told("wedge", joint, mean, sd, limits.wedge_rad, "rad", found,
                 fmt::format("At rest block {} is tilted by {:.2e} rad relative to {}.", upper, mean,
                             lower < 0 ? "the horizontal" : fmt::format("block {}", lower))));
        if (!found || (wedges[u] && std::fabs(wedges[u]->size) >= std::fabs(mean)))
            continue;
        wedges[u] = cause_of("wedge", joint, "angle_rad", "rad", 0, mean, sd, 0.5 * std::pow(mean / sd, 2));
        wedges[u]->cause.joint = static_cast<int>(j);
    }
    for (const std::optional<CauseFit>& wedge : wedges)
        if (wedge)
            out.found.push_back(*wedge);

    test_places(campaign.specimen, sees_table(campaign), scales, limits, place, runs / variance, out);
}

} // namespace stylobate
