#include "studies/measured/diagnosis/campaigns/candidate_causes.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/evidence/law_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

// What is strong: z = 1.
constexpr double less_friction_at_one = 0.5, more_friction_at_one = 1.5; // of a joint, over that of the others
constexpr double dynamic_at_one = 0.5;                                   // dynamic over static friction
// Over sqrt(g H): slow slip is of the middle one's order; a joint that slides fast shows another one.
constexpr double stribeck_speeds[] = {0.005, 0.02, 0.08};
constexpr double worn_at_one = 0.6;    // of the friction, after the path of a whole run
constexpr double most_wear = 3;        // z: nothing is left of the friction after half of a run's path
constexpr double chip_at_one = 0.15;   // over the width of the face
constexpr double drag_at_one = 0.3;    // of the weight, at the largest speeds of the campaign
constexpr double hold_at_one = 1.0;    // of a dowel or of adhesion, over the friction of the joint at rest
constexpr double dowel_slip = 0.005;   // at which a dowel yields, over the width
constexpr double rate_at_one = 10;     // Hunt and Crossley's lambda, over the velocity 0.1 sqrt(g H) of impacts
constexpr double dashpot_at_one = 0.5; // of critical damping, of the block on the joint
constexpr double tie_at_one = 0.3;     // of the block's weight, at the largest displacements or speeds of the campaign
// Paths shorter than these would make wear of any size possible.
constexpr double least_slip = 0.02;     // over the width
constexpr double least_rotation = 0.02; // rad
constexpr double least_speed = 0.01;    // over sqrt(g H): likewise of drag and of dashpots
constexpr double least_reach = 0.01;    // over the width: likewise of springs

Cause at_joint(const char* mechanism, int joint, const char* parameter, const char* unit, double neutral = 0)
{
    Cause cause{mechanism, fmt::format("joint {}", joint), parameter, unit, neutral};
    cause.joint = joint;
    return cause;
}

Cause at_block(const char* mechanism, int block, const char* parameter, const char* unit)
{
    Cause cause{mechanism, fmt::format("block {}", block), parameter, unit};
    cause.block = block;
    return cause;
}

/// Forces on a block that stand for those of no known kind: each depends on one thing. A spring that holds a block and
/// one that drives it away shift the statistics in different ways. A constant force is left out: to the data it is the
/// same as a shifted centre of mass, and fewer of the labelled campaigns are named rightly beside it.
void add_ties(const Specimen& specimen, const JointPaths& paths, double speed, std::vector<CandidateCause>& all)
{
    for (int b = 0; b < specimen.blocks(); ++b) {
        const auto k = static_cast<std::size_t>(b);
        const double weight = specimen.mass_kg[k] * specimen.gravity_m_s2, half_width = specimen.half_width_m[k];
        const double reach = std::max(paths.reach_m[k], 2 * least_reach * half_width);
        for (const double toward : {1.0, -1.0})
            all.push_back({at_block("tie", b, "stiffness_n_m", "N/m"), toward * tie_at_one * weight / reach});
        all.push_back({at_block("tie", b, "dashpot_n_s_m", "N s/m"),
                       tie_at_one * weight / std::max(paths.leaving_m_s[k], least_speed * speed)});
        all.push_back(
            {at_block("tie", b, "turning_dashpot_n_m_s", "N m s"),
             tie_at_one * weight * half_width / std::max(paths.turning_rad_s[k], least_speed * speed / half_width)});
    }
}

} // namespace

double CandidateCause::size_of(double z) const
{
    return ratio ? std::pow(at_one, z) : at_one * z;
}

std::vector<CandidateCause> candidate_causes(const Specimen& specimen, const CampaignScales& scales,
                                             const JointPaths& paths, double friction, double stiffness_n_m2)
{
    const double speed = scales.time_s * specimen.gravity_m_s2; // sqrt(g H)
    const std::vector<double> weight = rest_weights(specimen);
    const double going_on = std::sqrt(static_cast<double>(std::max<std::size_t>(paths.before.size(), 1)));
    std::vector<CandidateCause> all;
    for (const double part : stribeck_speeds) {
        CandidateCause stribeck{{"stribeck", "all", "dynamic_ratio", "", 1}, dynamic_at_one, true, 0, 1.25};
        stribeck.cause.fixed = part * speed;
        all.push_back(stribeck);
    }
    for (int j = 0; j < static_cast<int>(specimen.joints.size()); ++j) {
        const auto k = static_cast<std::size_t>(j);
        const auto [lower, upper] = specimen.joints[k];
        double width = 2 * specimen.half_width_m[static_cast<std::size_t>(upper)];
        if (lower >= 0)
            width = std::min(width, 2 * specimen.half_width_m[static_cast<std::size_t>(lower)]);
        const double held = hold_at_one * friction * weight[k];
        // less friction makes a joint slide, more friction does not make it stand stiller: each has a shift of its own
        for (const double at_one : {less_friction_at_one, more_friction_at_one})
            all.push_back({at_joint("joint_friction", j, "ratio", "", 1), at_one, true, 0, 1.25});
        // wear of one run, and wear that goes on: over the path of several runs
        for (const bool persists : {false, true}) {
            const double longer = persists ? going_on : 1;
            CandidateCause wear{at_joint("friction_wear", j, "wear_per_m", "1/m"),
                                worn_at_one / (longer * std::max(paths.mean.slip_m[k], least_slip * width)), false, 0,
                                most_wear};
            CandidateCause corners{at_joint("corner_wear", j, "wear_m_rad", "m/rad"),
                                   chip_at_one * width /
                                       (longer * std::max(paths.mean.rotation_rad[k], least_rotation))};
            wear.cause.persists = corners.cause.persists = persists;
            all.push_back(wear);
            all.push_back(corners);
        }
        for (const char* side : {"left", "right"}) {
            CandidateCause chip{at_joint("corner_loss", j, "loss_m", "m"), chip_at_one * width};
            chip.cause.side = side;
            all.push_back(chip);
        }
        CandidateCause dowel{at_joint("dowel", j, "yield_n", "N"), held};
        dowel.cause.fixed = dowel_slip * width;
        all.push_back(dowel);
        all.push_back({at_joint("adhesion", j, "adhesion_n_m", "N/m"), held / width});
        all.push_back({at_joint("rate_damping", j, "rate_s_m", "s/m"), rate_at_one / (0.1 * speed)});
        const double mass = specimen.mass_kg[static_cast<std::size_t>(upper)];
        all.push_back({at_joint("face_damping", j, "dashpot_n_s_m", "N s/m"),
                       dashpot_at_one * 2 * std::sqrt(stiffness_n_m2 * width * mass)});
    }
    const double mass = [&] {
        double sum = 0;
        for (const double m : specimen.mass_kg)
            sum += m;
        return sum / static_cast<double>(specimen.mass_kg.size());
    }();
    const double drag = drag_at_one * mass * specimen.gravity_m_s2,
                 fast = std::max(paths.speed_m_s, least_speed * speed);
    all.push_back({{"drag", "all", "coefficient_n_s2_m2", "N s2/m2"}, drag / (fast * fast)});
    all.push_back({{"drag", "all", "linear_n_s_m", "N s/m"}, drag / fast});
    for (int b = 0; b < specimen.blocks(); ++b) {
        CandidateCause centre{at_block("eccentricity", b, "offset_m", "m"),
                              largest_eccentricity * 2 * specimen.half_width_m[static_cast<std::size_t>(b)]};
        centre.least = -1;
        all.push_back(centre);
    }
    add_ties(specimen, paths, speed, all);
    return all;
}

namespace {

JointPath still(std::size_t joints)
{
    return {std::vector<double>(joints, 0), std::vector<double>(joints, 0)};
}

/// Paths of the joints in one run.
JointPath path_of(const Specimen& specimen, const CampaignScales& scales, const SmoothedRun& track)
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

JointPaths joint_paths(const Campaign& campaign, const CampaignScales& scales,
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
        const SmoothedRun track(specimen, campaign.runs[r], scales, base_m[r]);
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
