#pragma once
/// What is kept of a realization from check to check, and those parts of a check that are arithmetic alone: they have
/// the same bits on the processor, whose lanes decide by them, and on a device, which asks by them whether a check
/// would change anything.
///
/// The templates serve every model. A model has, for its topology T and bundle B,
///   check_steps(T)                       steps between two checks
///   energy_balance(T, B, lane, watch)    after the last step of a chunk
///   rest_signs(T, B, lane)               what a check of rest reads

#include "kernels/real.hpp"
#include "kernels/row_list.hpp"

#include <cstdint>

namespace stylobate {

/// What the energy balance may lack before a realization is set aside, over the energy that went through it.
inline constexpr double energy_bound = 0.25;
/// Chunks between two audits: they cost as much as several steps.
inline constexpr std::uint64_t audit_chunks = 16;

/// A realization has come to rest when, after the shaking, its kinetic energy stays below this part of what it takes to
/// topple the weakest part of it, for as long as 2 / p. (A resting stack keeps a small rocking vibration that the
/// dashpots at the centroids hardly damp; its residual displacement is the mean over that time.)
inline constexpr double rest_energy = 1e-2;
/// Nor may it slip faster than this part of its width in a time of 1 / p.
inline constexpr double rest_slip = 1e-4;
inline constexpr double rest_time = 2;
/// A block that has turned beyond its slenderness angle has fallen unless it comes back within 1 / p.
inline constexpr double fall_time = 1;
/// What lies higher than at the start by this part of the barrier may hover, and rests only after so many times as
/// long.
inline constexpr double raised_energy = 0.1;
inline constexpr std::uint64_t raised_times = 8;

/// Plain numbers of eight bytes each: a column of a device's memory holds them as they are.
struct Watch {
    // fixed at the start
    double step_s = 0;
    double shaking_end_s = 0; ///< no realization is at rest before; 0 where nothing shakes
    double barrier_j = 0;     ///< scale of the energy balance
    double rest_energy_j = 0; ///< at rest it has less kinetic energy than this,
    double rest_slip_m = 0;   ///< and slips less than this in a chunk
    double start_potential_j = 0, start_spring_j = 0, start_shear_j = 0, start_dowel_j = 0;
    std::uint64_t may_rest = 0;   ///< 1: it ends when it has come to rest
    std::uint64_t beds_alone = 0; ///< 1: it is handed over before blocks meet otherwise than at beds (`leaves_beds`)
    std::uint64_t last_step = 0;  ///< a multiple of chunk_steps
    std::uint64_t rest_steps = 0; ///< needed in a row
    // from check to check
    std::uint64_t steps = 0;
    std::uint64_t quiet = 0;       ///< 1: at the last check it seemed at rest,
    std::uint64_t quiet_since = 0; ///< and has since this step
    std::uint64_t quiet_checks = 0;
    std::uint64_t raised = 0; ///< 1: at the last check its potential energy was above that of the start
    double quiet_top_m = 0;   ///< sum over the checks since then
    double slip_m = 0;        ///< at the last check
    // what a device has to know of the limit states
    std::uint64_t undecided = 0; ///< 1: a block has turned too far, and may come back
    std::uint64_t seated = 0;    ///< 1: epistyles are watched, and none has lost a seat yet
};

/// [J], against the start but for the kinetic one.
struct EnergyBalance {
    double kinetic, potential, spring, friction, damping, base_work;
    double residual; ///< what the balance lacks, over its scale
};

/// What a check of rest reads of a bundle.
struct RestSigns {
    double kinetic_2dt2;  ///< 2 dt2 x the kinetic energy relative to the base [J s2]
    double potential_dt2; ///< dt2 x the potential energy [J s2]
    double slip_m;        ///< sum over beds and time of the slip
    double top_x_m;       ///< displacement of the top block's centre
};

/// Whether this check's audit, if one is due, finds the balance out of bounds.
template <class Topology, class Bundle>
STYLOBATE_INLINE bool unbalanced(const Topology& topology, const Bundle& b, int lane, const Watch& w)
{
    // (what was handed over does not begin with a whole chunk)
    return w.steps % (audit_chunks * chunk_steps) < static_cast<std::uint64_t>(check_steps(topology)) &&
           !(abs_of(energy_balance(topology, b, lane, w).residual) < energy_bound);
}

/// The criterion of rest, for the end of a realization and for `Outcome::at_rest`: after the shaking, at every check of
/// the last `rest_steps`, the kinetic energy relative to the base was below `rest_energy_j`, no more than `rest_slip_m`
/// had slipped since the check before, and no block was about to fall. A block that hovers near its balance has little
/// kinetic energy, too, but its potential energy is above that of the start. Clamps may hold a block there for good; so
/// what lies so high has to lie still for `raised_times` as long, in which the distance from a balance that nothing
/// holds grows by exp(16).
STYLOBATE_INLINE bool at_rest(const Watch& w)
{
    return w.quiet != 0 && w.steps - w.quiet_since >= w.rest_steps * (w.raised != 0 ? raised_times : 1);
}

/// Sees whether the realization lies still.
/// @param now after the last step of a chunk
/// @return whether it has for so long, or is out of time, that it is over
STYLOBATE_INLINE bool watch_rest(const RestSigns& now, bool undecided, Watch& w)
{
    const double kinetic = 0.5 * now.kinetic_2dt2 / (w.step_s * w.step_s);
    const double potential = now.potential_dt2 / (w.step_s * w.step_s) - w.start_potential_j;
    const double time = static_cast<double>(w.steps) * w.step_s;
    const double slip = now.slip_m - w.slip_m;
    w.slip_m += slip;
    const bool slips = slip > w.rest_slip_m;
    w.raised = potential > raised_energy * w.barrier_j ? 1 : 0;
    if (time >= w.shaking_end_s && !undecided && !slips && abs_of(kinetic) < w.rest_energy_j) {
        if (w.quiet == 0) {
            w.quiet_since = w.steps;
            w.quiet_top_m = 0;
            w.quiet_checks = 0;
        }
        w.quiet = 1;
        w.quiet_top_m += now.top_x_m;
        ++w.quiet_checks;
    } else {
        w.quiet = 0;
    }
    return (w.may_rest != 0 && at_rest(w)) || w.steps >= w.last_step;
}

template <class Topology, class Bundle>
STYLOBATE_INLINE bool watch_rest(const Topology& topology, const Bundle& b, int lane, bool undecided, Watch& w)
{
    return watch_rest(rest_signs(topology, b, lane), undecided, w);
}

} // namespace stylobate
