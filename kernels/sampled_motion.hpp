#pragma once
/// Base motion along samples of an acceleration that is linear between them (`ensemble/model/motion.hpp`): of one
/// realization, on the host and on a device.

#include "kernels/real.hpp"
#include "kernels/row_list.hpp"

#include <cmath>

namespace stylobate {

/// The samples, and how a realization goes along them.
struct SampledMotion {
    const double* sample = nullptr; ///< (last + 1) acceleration [m/s2]; 0 before the first and after the last one
    double last = -1;               ///< index of the last one
    double ratio = 0;               ///< length of a step, in spaces between samples
    double dt2 = 0;                 ///< square of the step, times the scale of the acceleration [s2]

    STYLOBATE_INLINE double at(double i) const { return i < 0 || i > last ? 0.0 : sample[static_cast<long>(i)]; }
};

/// Second difference of the displacement [m] at a time.
///
/// That of a displacement with piecewise linear acceleration is dt2 times the acceleration, plus what the bend at each
/// sample within one step adds: (change of slope) x (dt - distance)^3 / 6.
/// @param position the time, in spaces between samples from the first one on
STYLOBATE_INLINE double sampled_difference(const SampledMotion& m, double position)
{
    if (position - m.ratio > m.last + 1) // the motion ends one sample after its last, at rest
        return 0;
    const double i = std::floor(position);
    const double a0 = m.at(i), a1 = m.at(i + 1);
    double difference = m.dt2 * fma(position - i, a1 - a0, a0);
    for (double knot = std::ceil(position - m.ratio); knot < position + m.ratio; ++knot) {
        const double reach = m.ratio - abs_of(position - knot);
        const double bend = m.at(knot + 1) - 2 * m.at(knot) + m.at(knot - 1);
        difference += m.dt2 * bend * reach * reach * reach / (6 * m.ratio * m.ratio);
    }
    return difference;
}

/// Second differences for `chunk_steps` steps from `first` on, into table[k * stride].
STYLOBATE_INLINE void fill_sampled_rows(const SampledMotion& m, double first, double* table, int stride)
{
    for (int k = 0; k < chunk_steps; ++k)
        table[k * stride] = sampled_difference(m, (first + k) * m.ratio);
}

} // namespace stylobate
