#include "ensemble/planar/limit_states.hpp"

#include <cmath>

namespace stylobate {

namespace {

std::vector<FallStates::Body> bodies_of(const Realization& r)
{
    std::vector<FallStates::Body> bodies;
    for (const Block& block : r.blocks)
        bodies.push_back({block.role, block.column, block.fixed});
    return bodies;
}

} // namespace

double face_offset(const Block& lower, const BlockMotion& l, const Block& upper, const BlockMotion& u)
{
    const double x = upper.x_m - lower.x_m + (u.x_m - l.x_m) + upper.half_height_m * std::sin(u.theta_rad);
    const double y = upper.y_m - lower.y_m + (u.y_m - l.y_m) - upper.half_height_m * std::cos(u.theta_rad);
    return x * std::cos(l.theta_rad) + y * std::sin(l.theta_rad);
}

LimitStates::LimitStates(const Realization& r, const OutcomeSpec& outcome, double base_top_m, std::uint64_t fall_steps)
    : FallStates(bodies_of(r), fall_steps), height_fraction_(outcome.collapse_height_fraction), base_top_m_(base_top_m)
{
    for (const Block& block : r.blocks)
        turn_limit_rad_.push_back(std::atan(block.half_width_m / block.half_height_m));
}

void LimitStates::check(const Realization& r, std::uint64_t steps, const std::vector<BlockMotion>& moved,
                        const std::vector<int>& inside, int done)
{
    begin_check();
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        if (!watches(i))
            continue;
        const double rest = r.blocks[i].y_m - base_top_m_;
        const bool low = rest + moved[i].y_m < height_fraction_ * rest;
        const bool turned = std::fabs(moved[i].theta_rad) > turn_limit_rad_[i];
        see(i, steps, low, turned, inside[i], done);
    }
    for (int j = 0; j < r.beds() && may_unseat(steps); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
        if (r.blocks[u].role != BlockRole::epistyle)
            continue;
        const double turn = moved[u].theta_rad - moved[l].theta_rad;
        const double reach = r.blocks[l].half_width_m + r.blocks[u].half_width_m * std::fabs(std::cos(turn));
        if (std::fabs(face_offset(r.blocks[l], moved[l], r.blocks[u], moved[u])) > reach)
            unseat(u, steps);
    }
}

} // namespace stylobate
