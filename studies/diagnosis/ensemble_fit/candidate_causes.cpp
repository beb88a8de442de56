#include "studies/diagnosis/ensemble_fit/candidate_causes.hpp"

#include "studies/diagnosis/laws/law_samples.hpp"

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

double CandidateCause::z_of(double size) const
{
    return ratio ? std::log(size) / std::log(at_one) : size / at_one;
}

std::vector<CandidateCause> candidate_causes(const Specimen& specimen, const TrackScales& scales,
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
    all.push_back(
        {{"drag", "all", "coefficient_n_s2_m2", "N s2/m2"},
         drag_at_one * mass * specimen.gravity_m_s2 / std::pow(std::max(paths.speed_m_s, least_speed * speed), 2)});
    for (int b = 0; b < specimen.blocks(); ++b) {
        CandidateCause centre{at_block("eccentricity", b, "offset_m", "m"),
                              largest_eccentricity * 2 * specimen.half_width_m[static_cast<std::size_t>(b)]};
        centre.least = -1;
        all.push_back(centre);
    }
    add_ties(specimen, paths, speed, all);
    return all;
}

} // namespace stylobate
