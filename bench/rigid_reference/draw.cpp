#include "bench/rigid_reference/draw.hpp"

#include "ensemble/statics/scales.hpp"

#include <cmath>
#include <utility>

namespace stylobate::reference {

namespace {

constexpr int check_steps = 16;

Bodies bodies_of(const Realization& r)
{
    Bodies bodies;
    for (const Block& b : r.blocks)
        bodies.push_back(
            {b.half_width_m, b.half_height_m, b.fixed ? 0 : 1 / b.mass_kg, b.fixed ? 0 : 1 / b.inertia_kg_m2, 0});
    for (const Joint& j : r.joints)
        if (j.lower + 1 == j.upper)
            bodies[static_cast<std::size_t>(j.upper)].friction = j.friction;
    return bodies;
}

Twists places_of(const Realization& r)
{
    Twists places;
    for (const Block& b : r.blocks)
        places.push_back({b.x_m, b.y_m, 0});
    return places;
}

LimitStates limits_of(const Study& study, const Realization& r, double step_s)
{
    const Block& below = r.blocks[static_cast<std::size_t>(r.joints.front().lower)];
    return {r, study.outcome, below.y_m + below.half_height_m,
            static_cast<std::uint64_t>(std::ceil(1 / scales_of(r).p_rad_s / step_s))};
}

} // namespace

Draw::Draw(const Study& study, Realization realization, const Impacts& impacts, double step_s)
    : realization_(std::move(realization)), step_s_(step_s), base_(study.excitation, realization_, nullptr),
      end_s_(base_.duration_s() + study.excitation.tail_s.value_or(0)),
      column_(bodies_of(realization_), places_of(realization_), impacts), start_(places_of(realization_)),
      limits_(limits_of(study, realization_, step_s)), moved_(realization_.blocks.size()),
      inside_(realization_.blocks.size(), -1)
{
}

/// Mean over a step of the second difference of the displacement.
double Draw::base_acceleration(int step) const
{
    if (step * step_s_ >= base_.duration_s())
        return 0;
    const auto at = [&](int k) { return base_.displacement_m(k * step_s_); };
    return ((at(step + 2) - at(step + 1)) - (at(step) - at(step - 1))) / (2 * step_s_ * step_s_);
}

void Draw::step()
{
    const double g = realization_.gravity_m_s2, lean = realization_.base_tilt_rad;
    column_.step(step_s_, g * std::sin(lean) - base_acceleration(steps_), -g * std::cos(lean));
    ++steps_;
    for (std::size_t i = 0; i < moved_.size(); ++i) {
        const Twist& at = column_.places()[i];
        moved_[i] = {at.x - start_[i].x, at.y - start_[i].y, at.theta - start_[i].theta};
    }
    if (steps_ % check_steps == 0)
        limits_.check(realization_, static_cast<std::uint64_t>(steps_), moved_, inside_, check_steps);
}

bool Draw::conclude()
{
    limits_.conclude(realization_);
    return fallen();
}

} // namespace stylobate::reference
