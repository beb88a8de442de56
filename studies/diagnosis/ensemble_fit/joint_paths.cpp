#include "studies/diagnosis/ensemble_fit/joint_paths.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

JointPath still(std::size_t joints)
{
    return {std::vector<double>(joints, 0), std::vector<double>(joints, 0)};
}

/// Paths of the joints in one run.
JointPath path_of(const Specimen& specimen, const TrackScales& scales, const Track& track)
{
    JointPath path = still(specimen.joints.size());
    for (std::size_t j = 0; j < specimen.joints.size(); ++j) {
        const auto [lower, upper] = specimen.joints[j];
        for (std::size_t i = 1; i < track.samples(); ++i) {
            if (!track.usable(i, 1))
                continue;
            const auto relative = [&, lower = lower, upper = upper](Component c) {
                const double below = lower >= 0 ? track.now(1, c, lower, i) : c == in_x ? track.base(1, i) : 0;
                return track.now(1, c, upper, i) - below;
            };
            const double dt = track.time_s(i) - track.time_s(i - 1);
            if (std::fabs(relative(in_x)) > scales.slip_m_s)
                path.slip_m[j] += std::fabs(relative(in_x)) * dt;
            path.rotation_rad[j] += std::fabs(relative(in_theta)) * dt;
        }
    }
    return path;
}

/// Adds a part of a path.
void add(JointPath& sum, const JointPath& path, double part)
{
    for (std::size_t j = 0; j < sum.slip_m.size(); ++j) {
        sum.slip_m[j] += part * path.slip_m[j];
        sum.rotation_rad[j] += part * path.rotation_rad[j];
    }
}

double largest(std::vector<double>& values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : sorted_quantile(values, 0.99, QuantileDefinition::linear);
}

} // namespace

JointPaths joint_paths(const Campaign& campaign, const TrackScales& scales,
                       const std::vector<std::vector<double>>& base_m)
{
    const Specimen& specimen = campaign.specimen;
    const auto blocks = static_cast<std::size_t>(specimen.blocks());
    const double runs = static_cast<double>(campaign.runs.size());
    JointPaths paths;
    paths.mean = still(specimen.joints.size());
    JointPath so_far = paths.mean;
    std::vector<double> speeds;
    std::vector<std::vector<double>> reach(blocks), leaving(blocks), turning(blocks);
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        paths.before.push_back(so_far);
        if (base_m[r].empty())
            continue; // not shaken, or not seen
        const Track track(specimen, campaign.runs[r], scales, base_m[r]);
        for (std::size_t i = 0; i < track.samples(); ++i)
            for (std::size_t b = 0; b < blocks && track.usable(i, 1); ++b) {
                const int block = static_cast<int>(b);
                speeds.push_back(std::fabs(track.now(1, in_x, block, i)));
                reach[b].push_back(std::fabs(track.now(0, in_x, block, i) - specimen.rest_x_m[b] - track.base(0, i)));
                leaving[b].push_back(std::fabs(track.now(1, in_x, block, i) - track.base(1, i)));
                turning[b].push_back(std::fabs(track.now(1, in_theta, block, i)));
            }
        const JointPath path = path_of(specimen, scales, track);
        add(so_far, path, 1);
        add(paths.mean, path, 1 / runs);
    }
    paths.speed_m_s = largest(speeds);
    for (std::size_t b = 0; b < blocks; ++b) {
        paths.reach_m.push_back(largest(reach[b]));
        paths.leaving_m_s.push_back(largest(leaving[b]));
        paths.turning_rad_s.push_back(largest(turning[b]));
    }
    return paths;
}

} // namespace stylobate
