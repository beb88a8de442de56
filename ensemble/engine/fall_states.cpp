#include "ensemble/engine/fall_states.hpp"

#include <algorithm>
#include <utility>

namespace stylobate {

FallStates::FallStates(std::vector<Body> bodies, std::uint64_t fall_steps)
    : bodies_(std::move(bodies)), fall_steps_(fall_steps), seen_since_(bodies_.size(), never),
      outside_since_(bodies_.size(), never), fallen_since_(bodies_.size(), never)
{
}

void FallStates::see(std::size_t body, std::uint64_t steps, bool low, bool turned, int inside, int done)
{
    if (!low && !turned) {
        seen_since_[body] = outside_since_[body] = never;
        return;
    }
    if (seen_since_[body] == never) {
        seen_since_[body] = steps;
        // (by the rounding of a limit the steps may still have it inside: then it is the last one)
        const int left = std::min(inside + 1, done - 1);
        outside_since_[body] = steps - static_cast<std::uint64_t>(done - 1 - left);
    }
    if (low || steps - seen_since_[body] >= fall_steps_)
        fall(body, outside_since_[body]);
    else
        undecided_ = true;
}

void FallStates::unseat(std::size_t body, std::uint64_t check)
{
    const int epistyle = static_cast<int>(body);
    if (check < unseated_since_)
        unseated_body_ = epistyle;
    else if (check == unseated_since_ && unseated_body_ != epistyle)
        unseated_body_ = several_blocks;
    unseated_since_ = std::min(unseated_since_, check);
}

void FallStates::fall(std::size_t body, std::uint64_t since)
{
    fallen_since_[body] = since;
    ++fallen_bodies_;
    if (bodies_[body].role == BlockRole::epistyle)
        unseat(body, seen_since_[body]);
    // total when every column and every epistyle has fallen: at the latest of their first falls
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& part = bodies_[i];
        if (part.fixed || part.role == BlockRole::ground)
            continue;
        std::uint64_t first = fallen_since_[i];
        if (part.role == BlockRole::drum)
            for (std::size_t k = 0; k < bodies_.size(); ++k)
                if (bodies_[k].role == BlockRole::drum && bodies_[k].column == part.column)
                    first = std::min(first, fallen_since_[k]);
        total = std::max(total, first);
    }
    total_since_ = total;
}

bool FallStates::fell_first(std::size_t body) const
{
    return fallen(body) && fallen_since_[body] == *std::min_element(fallen_since_.begin(), fallen_since_.end());
}

void FallStates::shorten_steps(std::uint64_t times, std::uint64_t fall_steps)
{
    fall_steps_ = fall_steps;
    const auto shorten = [times](std::uint64_t& step) { step = step == never ? never : step * times; };
    for (auto* steps : {&seen_since_, &outside_since_, &fallen_since_})
        std::for_each(steps->begin(), steps->end(), shorten);
    shorten(unseated_since_);
    shorten(total_since_);
}

void FallStates::conclude()
{
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (fallen_since_[i] == never && outside_since_[i] != never)
            fall(i, outside_since_[i]);
    undecided_ = false;
}

void FallStates::write(double step_s, int listed, Outcome& o) const
{
    const auto time = [&](std::uint64_t since) { return since == never ? -1 : static_cast<double>(since) * step_s; };
    o.fall_time_s.assign(static_cast<std::size_t>(listed), -1);
    o.fallen_blocks = fallen_bodies_;
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
    o.unseated_block = unseated_body_;
    o.unseating_time_s = time(unseated_since_);
    o.total_collapse_time_s = time(total_since_);
}

} // namespace stylobate
