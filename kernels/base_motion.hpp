#pragma once
/// Base motion by formula: harmonic and pulses, for all realizations of a bundle at once.
///
/// A motion is a displacement U(t) that is 0 for t <= 0. What drives the structure is its second difference
/// U(n+1) - 2 U(n) + U(n-1): with that, stepping in the frame of the base is the same, to rounding, as moving the base.

#include "kernels/row_list.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

/// Which formula; c is the time in cycles of the sine.
enum class MotionFormula {
    still,    ///< U = 0
    harmonic, ///< U = A s(c / ramp) s((cycles - c) / ramp) (sin(2 pi c + phase) - sin_phase), s = 10x3 - 15x4 + 6x5
    pulse     ///< U = A (2 pi c - sin 2 pi c) up to the end, then at the velocity reached: U'' = a sin(w t)
};

/// Parameters, each (lanes).
struct FormulaParameters {
    double* cycles_per_step;       ///< f dt
    double* amplitude_m;           ///< A = a / w2
    double* cycles;                ///< in all
    double* phase_cycles;          ///< harmonic: phase / 2 pi, in [-1/2, 1/2]
    double* offset;                ///< harmonic with an abrupt start: sin(phase); else 0
    double* start_ramps_per_cycle; ///< 1 / ramp; 1e300 for an abrupt start
    double* end_ramps_per_cycle;   ///< 1 / ramp; 1e300 for an abrupt end, which holds the last displacement
    double* end_velocity;          ///< pulse: velocity after it, over A w: 2 for half a sine, 0 for a full one

    /// From a later lane on.
    constexpr FormulaParameters of_lane(int lane) const
    {
        return {cycles_per_step + lane,     amplitude_m + lane, cycles + lane,
                phase_cycles + lane,        offset + lane,      start_ramps_per_cycle + lane,
                end_ramps_per_cycle + lane, end_velocity + lane};
    }
};

template <class Real>
STYLOBATE_INLINE Real smooth_ramp(Real x)
{
    const Real t = clamp(x, Real(0.0), Real(1.0));
    return t * t * t * fma(t, fma(t, Real(6.0), Real(-15.0)), Real(10.0));
}

/// U at step n (an integer) [m].
template <class Real>
STYLOBATE_INLINE Real base_displacement(MotionFormula formula, const FormulaParameters& p, Real n)
{
    using L = Lanes<Real>;
    const Real zero(0.0);
    if (formula == MotionFormula::still)
        return zero;
    const Real rate = L::load(p.cycles_per_step), cycles = L::load(p.cycles);
    // time in cycles, as a rounded product and its rounding error: the phase keeps its digits late in the motion
    const Real product = n * rate;
    const Real error = fma(n, rate, zero - product);
    const Real c = clamp(product, zero, cycles);
    const Real rest = select(c != product, zero, error);
    const Real whole = round_of(c);
    if (formula == MotionFormula::pulse) {
        const Real two_pi(0x1.921fb54442d18p+2);
        const Real sine = sine_of_cycles((c - whole) + rest);
        const Real after = L::load(p.end_velocity) * max_of(product - cycles, zero);
        return L::load(p.amplitude_m) * (fma(two_pi, c + after, zero - sine));
    }
    Real turn = (c - whole) + rest + L::load(p.phase_cycles);
    turn = turn - round_of(turn);
    // between the ramps both factors are 1, to the bit
    const Real up = c * L::load(p.start_ramps_per_cycle), down = (cycles - c) * L::load(p.end_ramps_per_cycle);
    Real ramp(1.0);
    if (any((up < Real(1.0)) | (down < Real(1.0))))
        ramp =
            smooth_ramp(up) * select(c >= cycles, select(L::load(p.end_ramps_per_cycle) > Real(1e299), Real(1.0), zero),
                                     smooth_ramp(down));
    return L::load(p.amplitude_m) * ramp * (sine_of_cycles(turn) - L::load(p.offset));
}

/// The step at which the motion is over. @return of a base at rest 0
template <class Real>
STYLOBATE_INLINE Real motion_end(MotionFormula formula, const FormulaParameters& p)
{
    using L = Lanes<Real>;
    return formula == MotionFormula::still ? Real(0.0) : L::load(p.cycles) / L::load(p.cycles_per_step);
}

/// U(n+1) - 2 U(n) + U(n-1) [m]. Once the motion is over for the whole of a step's reach, nothing but rounding is left
/// of the difference, and it is 0.
/// @param n the step;  @param end what `motion_end` gives
template <class Real>
STYLOBATE_INLINE Real second_difference(Real before, Real now, Real next, Real n, Real end)
{
    return select(n - Real(1.0) >= end, Real(0.0), (next - now) - (now - before));
}

/// Second differences for `chunk_steps` steps from `first` on, into table[k * stride].
template <class Real>
STYLOBATE_INLINE void fill_base_rows(MotionFormula formula, const FormulaParameters& p, Real first, double* table,
                                     int stride)
{
    using L = Lanes<Real>;
    Real before = base_displacement(formula, p, first - Real(1.0));
    Real now = base_displacement(formula, p, first);
    const Real end = motion_end<Real>(formula, p);
    for (int k = 0; k < chunk_steps; ++k) {
        const Real n = first + Real(static_cast<double>(k));
        const Real next = base_displacement(formula, p, n + Real(1.0));
        L::store(table + k * stride, second_difference(before, now, next, n, end));
        before = now;
        now = next;
    }
}

/// Fills the table for the chunk that begins at each realization's step `first_step` (lanes).
/// @tparam Here see `kernel_table`
template <class Real, class Here = void>
void fill_base_table(MotionFormula formula, const FormulaParameters& p, const double* first_step, double* table)
{
    fill_base_rows(formula, p, Lanes<Real>::load(first_step), table, Lanes<Real>::count);
}

namespace detail {

/// Fills the rows to within 1e-9 of the peak, which suffices for single precision, by a fast recurrence (addition
/// theorem): between the ramps of a harmonic the second difference is a sine itself, -4 A sin2(pi f dt) sin(2 pi c +
/// phase), with s(n+1) - 2 s(n) + s(n-1) = -4 sin2(pi f dt) s(n); after the motion it is 0.
template <class Real, class Here>
STYLOBATE_INLINE void fill_base_rows_fast(MotionFormula formula, const FormulaParameters& p, Real first, double* table,
                                          int stride)
{
    using L = Lanes<Real>;
    const Real zero(0.0), one(1.0);
    const Real rate = L::load(p.cycles_per_step), cycles = L::load(p.cycles);
    // from one step before the chunk to one after it
    const Real begin = (first - one) * rate, end = (first + Real(static_cast<double>(chunk_steps))) * rate;
    const auto between =
        (begin * L::load(p.start_ramps_per_cycle) > one) & ((cycles - end) * L::load(p.end_ramps_per_cycle) > one);
    const auto over = begin >= cycles;
    const bool harmonic = formula == MotionFormula::harmonic;
    const Real known = select(over, one, harmonic ? select(between, one, zero) : zero);
    const bool full = any(known < one);
    if (full)
        fill_base_rows<Real>(formula, p, first, table, stride);
    if (!any(known > zero))
        return;
    const auto sine = [&](Real n) {
        const Real product = n * rate;
        const Real turn = (product - round_of(product)) + fma(n, rate, zero - product) + L::load(p.phase_cycles);
        return sine_of_cycles(turn - round_of(turn));
    };
    const Real half = sine_of_cycles(select(between, rate * Real(0.5), zero));
    const Real square = Real(4.0) * half * half;
    const Real size = select(over, zero, zero - L::load(p.amplitude_m) * square);
    Real now = sine(first), step = now - sine(first - one);
    for (int k = 0; k < chunk_steps; ++k) {
        double* const to = table + k * stride;
        L::store(to, select(known > zero, size * now, full ? L::load(to) : zero));
        step = fnma(square, now, step);
        now = now + step;
    }
}

} // namespace detail

/// Fills the table of a bundle in single precision: computed in double, one half of the register after the other.
/// @tparam Single `Real`'s register in single precision
template <class Real, class Single, class Here = void>
void fill_single_base_table(MotionFormula formula, const FormulaParameters& p, const double* first_step, float* table)
{
    constexpr int lanes = Lanes<Single>::count, group = Lanes<Real>::count;
    alignas(64) double values[chunk_steps * group];
    for (int from = 0; from < lanes; from += group) {
        detail::fill_base_rows_fast<Real, Here>(formula, p.of_lane(from), Lanes<Real>::load(first_step + from), values,
                                                group);
        for (int step = 0; step < chunk_steps; ++step)
            for (int lane = 0; lane < group; ++lane)
                table[step * lanes + from + lane] = static_cast<float>(values[step * group + lane]);
    }
}

} // namespace stylobate
