#pragma once
/// What a file such as `step_avx2.cpp` makes of the templates: one table. Nothing else may be in such a file: code
/// compiled for one instruction set must not leak into functions that others share.

#include "kernels/isa.hpp"
#include "kernels/planar/rigid/rigid_step.hpp"
#include "kernels/planar/step.hpp"
#include "kernels/spatial/step.hpp"

#include <type_traits>

namespace stylobate {

/// `count` multiply-adds on registers.
template <class Real>
STYLOBATE_INLINE Real multiply_adds(long count)
{
    // enough independent chains to hide the latency of the multiply-add
    constexpr int chains = 12;
    Real sums[chains];
    for (int i = 0; i < chains; ++i)
        sums[i] = Real(1.0 + i);
    const Real factor(0.999999), term(1e-6);
    for (long k = 0; k < count; k += 4 * chains) // several rounds at a time: the loop itself takes room, too
        for (int round = 0; round < 4; ++round)
            for (int i = 0; i < chains; ++i)
                sums[i] = fma(sums[i], factor, term);
    Real total(0.0);
    for (int i = 0; i < chains; ++i)
        total = total + sums[i];
    return total;
}

template <class Real, class Here>
double peak_fma(long count)
{
    alignas(64) double out[Lanes<Real>::count];
    Lanes<Real>::store(out, multiply_adds<Real>(count));
    return out[0];
}

/// A model as a type of the file that `Here` is of.
template <class Here, class Mechanism>
struct OfFile : Mechanism {
};

template <class Real, class Here, ContactForm form>
void run_form(const Topology& topology, const Bundle& bundle, int first, int last)
{
    if (topology.model.mechanisms)
        run_steps<Real, OfFile<Here, Mechanisms<form>>>(topology, bundle, first, last);
    else
        run_steps<Real, OfFile<Here, Plain<form>>>(topology, bundle, first, last);
}

/// Runs the step that the bundle's model asks for.
template <class Real, class Here>
void run_model(const Topology& topology, const Bundle& bundle, int first, int last)
{
    switch (topology.model.form) {
    case ContactForm::area:
        return run_form<Real, Here, ContactForm::area>(topology, bundle, first, last);
    case ContactForm::two_corner:
        return run_form<Real, Here, ContactForm::two_corner>(topology, bundle, first, last);
    case ContactForm::points:
        return run_form<Real, Here, ContactForm::points>(topology, bundle, first, last);
    case ContactForm::rigid:
        return run_rigid<Real, Here>(topology, bundle, first, last);
    }
}

/// Runs the steps in single precision, which has the paper's model and rigid blocks.
template <class Single, class Here>
void run_single_model(const Topology& topology, const BundleOf<float>& bundle, int first, int last)
{
    if (topology.model.rigid())
        run_rigid<Single, Here>(topology, bundle, first, last);
    else
        run_steps<Single, OfFile<Here, Baseline>>(topology, bundle, first, last);
}

/// Steps a stack of the paper's model without watched pairs.
template <class Real, class Here>
void run_stack(const Topology& topology, const Bundle& bundle, int first, int last)
{
    Stepper<Real, OfFile<Here, Baseline>, false, true>(topology, bundle).run(first, last);
}

/// Fills the table of base motion of two registers, one after the other.
template <class Real, class Here>
void fill_twice(MotionFormula formula, const FormulaParameters& p, const double* first_step, double* table)
{
    constexpr int lanes = Lanes<Real>::count;
    alignas(64) double one[chunk_steps * lanes];
    for (int at = 0; at < 2 * lanes; at += lanes) {
        fill_base_table<Real, Here>(formula, p.of_lane(at), first_step + at, one);
        for (int step = 0; step < chunk_steps; ++step)
            for (int lane = 0; lane < lanes; ++lane)
                table[2 * step * lanes + at + lane] = one[step * lanes + lane];
    }
}

/// @tparam Single the register of `Real`'s instruction set in single precision
/// @tparam Here a type in the unnamed namespace of the file, which makes all these functions its own
/// @tparam Two two registers at a time (`Twice<Real>`); void: none
/// @param twice_blocks largest number of free blocks for which `Two` is faster (`docs/performance.md`)
template <class Real, class Single, class Here, class Two = void>
constexpr KernelTable kernel_table(Isa isa, int twice_blocks = 0)
{
    KernelTable table{isa,
                      Lanes<Real>::count,
                      Lanes<Single>::count,
                      fill_base_table<Real, Here>,
                      fill_single_base_table<Real, Single, Here>,
                      peak_fma<Real, Here>,
                      {run_model<Real, Here>, run_single_model<Single, Here>},
                      {spatial::run_steps<Real, Here>}};
    if constexpr (!std::is_void_v<Two>) {
        table.planar.twice_blocks = twice_blocks;
        table.planar.run_twice = run_stack<Two, Here>;
        table.fill_twice = fill_twice<Real, Here>;
    }
    return table;
}

} // namespace stylobate
