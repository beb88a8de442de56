#include "studies/diagnosis/rest_tests.hpp"

#include "studies/diagnosis/direct_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stylobate {

void test_rest(const Campaign& campaign, const TrackScales& scales, const DirectThresholds& limits, DirectResult& out)
{
    const Specimen& s = campaign.specimen;
    const auto n = static_cast<std::size_t>(s.blocks());
    const auto first = static_cast<std::size_t>(std::max(20, 2 * scales.rates.half_width()));
    std::vector<std::vector<double>> angle(n), place(n);
    for (const MeasuredRun& run : campaign.runs) {
        if (run.blocks.theta_rad.empty() || run.blocks.x_m.empty() || run.time_s.size() < first)
            continue;
        for (std::size_t b = 0; b < n; ++b) {
            double turned = 0, moved = 0;
            for (std::size_t i = 0; i < first; ++i) {
                turned += run.blocks.theta_rad.values[i * n + b];
                moved += run.blocks.x_m.values[i * n + b] - s.rest_x_m[b];
            }
            angle[b].push_back(turned / static_cast<double>(first));
            place[b].push_back(moved / static_cast<double>(first));
        }
    }
    if (angle.front().empty()) {
        DataTest test = cannot("wedge", "Rotations and places of the blocks at rest were not measured.");
        test.place = "joints";
        out.sensor_tests.push_back(test);
        return;
    }
    const auto runs = static_cast<double>(angle.front().size());
    const auto judge = [&](const std::vector<double>& upper, const std::vector<double>* lower, double& mean,
                           double& sd) {
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
    };
    // A block on two seats leans by what either of them is askew: the one over which it leans more is told.
    std::vector<CauseFit> wedges(n);
    for (std::size_t j = 0; j < s.joints.size(); ++j) {
        const auto [lower, upper] = s.joints[j];
        const auto u = static_cast<std::size_t>(upper);
        const bool table = lower < 0;
        double mean = 0, sd = 0;
        judge(angle[u], table ? nullptr : &angle[static_cast<std::size_t>(lower)], mean, sd);
        const double noise = scales.noise_rad * std::sqrt((table ? 1 : 2) / (static_cast<double>(first) * runs));
        sd = std::isfinite(sd) ? std::max(sd, noise) : noise;
        const std::string joint = fmt::format("joint {}", j);
        const bool found = beyond(mean, sd, limits.wedge_rad, limits.sds);
        out.sensor_tests.push_back(told("wedge", joint, mean, sd, limits.wedge_rad, "rad", found,
                                        fmt::format("At rest block {} leans by {:.2e} rad against {}.", upper, mean,
                                                    table ? "the horizontal" : fmt::format("block {}", lower))));
        if (!found || (!wedges[u].cause.mechanism.empty() && std::fabs(wedges[u].size) >= std::fabs(mean)))
            continue;
        wedges[u] = cause_of("wedge", joint, "angle_rad", "rad", 0, mean, sd, 0.5 * std::pow(mean / sd, 2));
        wedges[u].cause.joint = static_cast<int>(j);
    }
    for (const CauseFit& wedge : wedges)
        if (!wedge.cause.mechanism.empty())
            out.found.push_back(wedge);

    // Offsets count from where most of the blocks are: the cameras' zero and the place of the table are not known.
    // Every block was put down with the tolerance, each time anew.
    std::vector<std::vector<double>> offset(n);
    for (std::size_t r = 0; r < place.front().size(); ++r) {
        std::vector<double> all;
        for (std::size_t b = 0; b < n; ++b)
            all.push_back(place[b][r]);
        std::erase_if(all, [](double v) { return !std::isfinite(v); }); // not seen at first
        if (all.empty())
            continue;
        std::sort(all.begin(), all.end());
        const double middle = (all[(all.size() - 1) / 2] + all[all.size() / 2]) / 2;
        for (std::size_t b = 0; b < n; ++b)
            offset[b].push_back(place[b][r] - middle);
    }
    for (std::size_t b = 0; b < n && n > 1; ++b) {
        double mean = 0, sd = 0;
        judge(offset[b], nullptr, mean, sd);
        const double tolerance = std::sqrt(1.5) * s.placement_tolerance_m / std::sqrt(runs);
        const double noise_m = scales.noise_m * std::sqrt(2 / (static_cast<double>(first) * runs));
        sd = std::max({std::isfinite(sd) ? sd : 0, tolerance, noise_m});
        const double threshold = limits.offset_in_tolerances * sd;
        const bool off = std::fabs(mean) > threshold && std::fabs(mean) > 1.5 * s.placement_tolerance_m;
        const std::string block = fmt::format("block {}", b);
        out.sensor_tests.push_back(told(
            "drum_offset", block, mean, sd, threshold, "m", off,
            fmt::format("On the mean block {} lies {:.2e} m to the right of where it should, seen from the others.", b,
                        mean)));
        if (off) {
            out.found.push_back(
                cause_of("drum_offset", block, "offset_m", "m", 0, mean, sd, 0.5 * std::pow(mean / sd, 2)));
            out.found.back().cause.block = static_cast<int>(b);
        }
    }
}

} // namespace stylobate
