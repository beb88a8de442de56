#pragma once
/// The motion of the ground as an engine gets it: the same formulas as the project's own
/// (`ensemble/motion/base_motion.hpp`).

#include "ensemble/motion/base_motion.hpp"

namespace stylobate::peers {

/// Second difference of the ground's displacement about the begin of step n, over the step squared [m/s2]: what a
/// scheme that takes velocities first and places after makes of a ground that is moved along its path.
inline double mean_acceleration(const BaseMotion& base, int n, double step_s)
{
    const auto at = [&](int k) { return base.displacement_m(k * step_s); };
    return ((at(n + 1) - at(n)) - (at(n) - at(n - 1))) / (step_s * step_s);
}

} // namespace stylobate::peers
