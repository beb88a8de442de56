#include "ensemble/planar/limit_states.hpp"

#include "kernels/planar/bundle.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

double face_offset(const Block& lower, const BlockMotion& l, const Block& upper, const BlockMotion& u)
{
    const double x = upper.x_m - lower.x_m + (u.x_m - l.x_m) + upper.half_height_m * std::sin(u.theta_rad);
    const double y = upper.y_m - lower.y_m + (u.y_m - l.y_m) - upper.half_height_m * std::cos(u.theta_rad);
    return x * std::cos(l.theta_rad) + y * std::sin(l.theta_rad);
}

LimitStates::LimitStates(const Realization& r, const OutcomeSpec& outcome, double base_top_m, std::uint64_t fall_steps)
    : height_fraction_(outcome.collapse_height_fraction), base_top_m_(base_top_m), fall_steps_(fall_steps),
      seen_since_(r.blocks.size(), never), turned_since_(r.blocks.size(), never), fallen_since_(r.blocks.size(), never)
{
    for (const Block& block : r.blocks)
        turn_limit_rad_.push_back(std::atan(block.half_width_m / block.half_height_m));
}

void LimitStates::unseat(std::size_t block, std::uint64_t check)
{
    const int epistyle = static_cast<int>(block);
    if (check < unseated_since_)
        unseated_block_ = epistyle;
    else if (check == unseated_since_ && unseated_block_ != epistyle)
        unseated_block_ = several_blocks;
    unseated_since_ = std::min(unseated_since_, check);
}

void LimitStates::fall(const Realization& r, std::size_t block, std::uint64_t since)
{
    fallen_since_[block] = since;
    ++fallen_blocks_;
    if (r.blocks[block].role == BlockRole::epistyle)
        unseat(block, seen_since_[block]);
    // total when every column and every epistyle has fallen: at the latest of their first falls
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        const Block& part = r.blocks[i];
        if (part.fixed || part.role == BlockRole::ground)
            continue;
        std::uint64_t first = fallen_since_[i];
        if (part.role == BlockRole::drum)
            for (std::size_t k = 0; k < r.blocks.size(); ++k)
                if (r.blocks[k].role == BlockRole::drum && r.blocks[k].column == part.column)
                    first = std::min(first, fallen_since_[k]);
        total = std::max(total, first);
    }
    total_since_ = total;
}

void LimitStates::check(const Realization& r, std::uint64_t steps, const std::vector<BlockMotion>& moved,
                        const std::vector<int>& inside, int done)
{
    undecided_ = false;
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        if (r.blocks[i].fixed || fallen_since_[i] != never)
            continue;
        const double rest = r.blocks[i].y_m - base_top_m_;
        const bool low = rest + moved[i].y_m < height_fraction_ * rest;
        const bool turned = std::fabs(moved[i].theta_rad) > turn_limit_rad_[i];
        if (!low && !turned) {
            seen_since_[i] = turned_since_[i] = never;
            continue;
        }
        if (seen_since_[i] == never) {
            seen_since_[i] = steps;
            // (by the rounding of a limit the steps may still have it inside: then it is the last one)
            const int left = std::min(inside[i] + 1, done - 1);
            turned_since_[i] = steps - static_cast<std::uint64_t>(done - 1 - left);
        }
        if (low || steps - seen_since_[i] >= fall_steps_)
            fall(r, i, turned_since_[i]);
        else
            undecided_ = true;
    }
    for (int j = 0; j < r.beds() && unseated_since_ >= steps; ++j) {
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

void LimitStates::shorten_steps(std::uint64_t times, std::uint64_t fall_steps)
{
    fall_steps_ = fall_steps;
    const auto shorten = [times](std::uint64_t& step) { step = step == never ? never : step * times; };
    for (auto* steps : {&seen_since_, &turned_since_, &fallen_since_})
        std::for_each(steps->begin(), steps->end(), shorten);
    shorten(unseated_since_);
    shorten(total_since_);
}

void LimitStates::conclude(const Realization& r)
{
    for (std::size_t i = 0; i < r.blocks.size(); ++i)
        if (fallen_since_[i] == never && turned_since_[i] != never)
            fall(r, i, turned_since_[i]);
    undecided_ = false;
}

void LimitStates::write(const Realization& r, Outcome& o) const
{
    const auto time = [&](std::uint64_t since) { return since == never ? -1 : static_cast<double>(since) * r.step_s; };
    o.fall_time_s.assign(static_cast<std::size_t>(r.drums), -1);
    o.fallen_blocks = fallen_blocks_;
    std::uint64_t first = never;
    for (std::size_t i = 0; i < o.fall_time_s.size(); ++i) {
        o.fall_time_s[i] = time(fallen_since_[i]);
        if (fallen_since_[i] < first) {
            first = fallen_since_[i];
            o.first_collapse_block = static_cast<std::int32_t>(i);
        } else if (first != never && fallen_since_[i] == first) {
            o.first_collapse_block = several_blocks;
        }
    }
    o.collapse_time_s = time(first);
    o.unseated_block = unseated_block_;
    o.unseating_time_s = time(unseated_since_);
    o.total_collapse_time_s = time(total_since_);
}

} // namespace stylobate
