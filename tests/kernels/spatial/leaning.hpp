#pragma once
/// A block that leans over its rim, edge or corner, on a fixed body: where rocking and rolling begin.

#include "tests/kernels/spatial/scene.hpp"

namespace stylobate::spatial {

/// A lean by `angle` towards a horizontal unit vector, over a point of the foot that is `reach` from its middle, of a
/// block that stands on the plane y = 0 in the reference state.
struct Lean {
    Vec towards;
    double angle;
    double reach, half_height; ///< [m]

    Vec axis() const { return {towards.z, 0, 0 - towards.x}; }
    /// Of the centre, while the pivot stays where it is.
    Vec displacement() const
    {
        const double sine = std::sin(angle), cosine = std::cos(angle);
        const double along = reach * (1 - cosine) + half_height * sine;
        return {along * towards.x, reach * sine - half_height * (1 - cosine), along * towards.z};
    }
    /// From the centre to the pivot.
    Vec to_pivot() const
    {
        const double sine = std::sin(angle), cosine = std::cos(angle);
        const double along = reach * cosine - half_height * sine;
        return {along * towards.x, 0 - half_height * cosine - reach * sine, along * towards.z};
    }
};

/// Places body i so, as deep in the body under it that joint j carries `force`.
inline void place(Scene& s, int i, int j, const Lean& lean, double force)
{
    s.set_attitude(i, lean.axis(), lean.angle);
    double low = 0, high = 0.01 * lean.reach; // how deep
    for (int n = 0; n < 60; ++n) {
        const double sink = 0.5 * (low + high);
        s.set_vector(OfBody::x, i, lean.displacement() - Vec{0, sink, 0});
        (s.normal_force(j) < force ? low : high) = sink;
    }
}

/// How far body i leans in that direction [rad].
inline double lean_of(Scene& s, int i, const Lean& lean)
{
    return 2 * std::asin(dot(s.vector(OfBody::q_x, i), lean.axis()));
}

/// Time from the start at rest until the lean of body i has gone [s]; -1: not within a second.
inline double quarter_period(Scene& s, int i, const Lean& lean)
{
    s.start_from_rest();
    for (double before = lean_of(s, i, lean); s.time_s() < 3;) {
        s.run(1);
        const double now = lean_of(s, i, lean);
        if (now <= 0)
            return s.time_s() - s.step_s() * (0 - now) / (before - now);
        before = now;
    }
    return -1;
}

} // namespace stylobate::spatial
