#pragma once
/// What is kept of a realization from check to check, and those parts of a check that are arithmetic alone: they have
/// the same bits on the processor, whose `LaneSet` decides by them, and on a device, which asks by them whether a check
/// would change anything.

#include "kernels/bundle.hpp"
#include "kernels/neighbours.hpp"
#include "kernels/rows.hpp"
#include "kernels/trig.hpp"

#include <cstdint>

namespace stylobate {

/// What the energy balance may lack before a realization is set aside, over the energy that went through it.
inline constexpr double energy_bound = 0.25;
/// Steps between two checks of a realization: a chunk; of the rigid form, whose steps are long, a part of one, so that
/// a fall is decided as closely in time.
constexpr int check_steps(const Topology& topology)
{
    return topology.model.rigid() ? chunk_steps / 4 : chunk_steps;
}
/// Chunks between two audits: they cost as much as several steps.
inline constexpr std::uint64_t audit_chunks = 16;

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

/// Displacement of a block's geometric centre.
/// @param moved of what the kernel moves: of the centre of mass, in an extended model
STYLOBATE_INLINE Planar<double> centre_of(const Topology& topology, const Bundle& b, int block, int lane,
                                          Planar<double> moved)
{
    if (topology.model.extended()) {
        const Angle<double> a = angle(moved.theta);
        const double e = b.at(OfBlockExtension::eccentricity, block, lane);
        moved.x += e * a.versine;
        moved.y -= e * a.sine;
    }
    return moved;
}

STYLOBATE_INLINE Planar<double> centre_of(const Topology& topology, const Bundle& b, int block, int lane)
{
    return centre_of(topology, b, block, lane,
                     {b.at(OfBlock::x, block, lane), b.at(OfBlock::y, block, lane), b.at(OfBlock::theta, block, lane)});
}

/// Whether all that the next steps depend on is a number: what is not spreads to the energy or to a position at once.
STYLOBATE_INLINE bool is_finite(const Topology& topology, const Bundle& b, int lane)
{
    double sum = 0.5 * b.at(OfRealization::kinetic, lane);
    for (int k = topology.fixed; k < topology.blocks; ++k)
        sum += b.at(OfBlock::x, k, lane) + b.at(OfBlock::y, k, lane) + b.at(OfBlock::theta, k, lane);
    return abs_of(sum) <= 0x1.fffffffffffffp+1023;
}

/// Of dowels and of what strengthens the structure.
STYLOBATE_INLINE double dowel_energy(const Topology& topology, const Bundle& b, int lane)
{
    double energy = 0;
    if (topology.model.extended())
        for (int j = 0; j < topology.beds(); ++j) {
            const double force = b.at(OfJointExtension::dowel_force, j, lane);
            energy += 0.5 * force * force * b.at(OfJointExtension::per_dowel_stiffness, j, lane);
        }
    if (topology.model.reinforced) {
        for (int j = 0; j < topology.beds(); ++j)
            energy += b.at(OfJointReinforcement::held, j, lane);
        for (int i = 0; i < topology.blocks; ++i)
            energy += b.at(OfBlockReinforcement::held, i, lane);
    }
    return energy;
}

/// Of the tangential springs.
STYLOBATE_INLINE double spring_energy(const Topology& topology, const Bundle& b, int lane)
{
    double energy = 0;
    for (int j = 0; j < topology.joints; ++j) {
        const double spring = b.at(OfJoint::spring, j, lane);
        energy += 0.5 * spring * spring * b.at(OfJoint::per_K_t, j, lane);
    }
    return energy;
}

/// [J], against the start but for the kinetic one.
struct EnergyBalance {
    double kinetic, potential, spring, friction, damping, base_work;
    double residual; ///< what the balance lacks, over its scale
};

/// After the last step of a chunk.
STYLOBATE_INLINE EnergyBalance energy_balance(const Topology& topology, const Bundle& b, int lane, const Watch& w)
{
    const double per_dt2 = 1 / (w.step_s * w.step_s);
    double normal = 0;
    for (int j = 0; j < topology.joints; ++j)
        normal += b.at(OfJoint::elastic, j, lane);
    const double tangential = spring_energy(topology, b, lane);
    EnergyBalance o;
    o.kinetic = 0.5 * b.at(OfRealization::kinetic, lane) * per_dt2;
    o.potential = b.at(OfRealization::potential, lane) * per_dt2 - w.start_potential_j;
    o.spring = normal + tangential - w.start_spring_j;
    o.friction = b.at(OfRealization::friction_energy, lane);
    o.damping = 0.5 * b.at(OfRealization::dashpot_energy, lane) + 0.5 * b.at(OfRealization::shear_energy, lane) -
                (tangential - w.start_shear_j) - o.friction;
    if (topology.model.extended()) {
        const double held = dowel_energy(topology, b, lane) - w.start_dowel_j;
        o.spring += held;
        o.damping += 0.5 * b.at(OfRealizationExtension::joint_energy, lane) - held +
                     0.5 * b.at(OfRealizationExtension::drag_energy, lane) * per_dt2;
    }
    o.base_work = 0.5 * b.at(OfRealization::base_energy, lane) * per_dt2;
    const double lacks = o.kinetic + o.potential + o.spring + o.friction + o.damping - o.base_work;
    o.residual = lacks / (w.barrier_j + abs_of(o.friction) + abs_of(o.damping));
    return o;
}

/// Whether this check's audit, if one is due, finds the balance out of bounds.
STYLOBATE_INLINE bool unbalanced(const Topology& topology, const Bundle& b, int lane, const Watch& w)
{
    // (what was handed over does not begin with a whole chunk)
    return w.steps % (audit_chunks * chunk_steps) < static_cast<std::uint64_t>(check_steps(topology)) &&
           !(abs_of(energy_balance(topology, b, lane, w).residual) < energy_bound);
}

/// Whether blocks of the rigid form, whose contacts are beds, may meet otherwise before the next check or soon after
/// it: the faces of a bed have turned far against each other or have hardly a common part left, or a watched pair is
/// close.
STYLOBATE_INLINE bool leaves_beds(const Topology& topology, const Bundle& b, int lane, const Watch& w)
{
    if (w.beds_alone == 0)
        return false;
    constexpr double most_turn_rad = 1; // against each other
    const double ahead = 2.0 * check_steps(topology);
    for (int j = 0; j < topology.beds(); ++j) {
        const auto [lower, upper] = topology.joint[j];
        const double common = b.at(OfRigidJoint::right_x, j, lane) - b.at(OfRigidJoint::left_x, j, lane);
        if (abs_of(b.at(OfBlock::theta, upper, lane) - b.at(OfBlock::theta, lower, lane)) > most_turn_rad ||
            !(common > ahead * abs_of(b.at(OfRigidJoint::sliding, j, lane))))
            return true;
    }
    for (int j = topology.beds(); j < topology.joints; ++j) {
        const int lower = topology.joint[j].lower, upper = topology.joint[j].upper;
        const auto box = [&](int i) {
            return TurnedBox<double>{b.at(OfBlock::half_width, i, lane), b.at(OfBlock::half_height, i, lane),
                                     abs_of(b.at(OfBlock::sine, i, lane)), abs_of(1 - b.at(OfBlock::versine, i, lane))};
        };
        const auto turns_by = [&](int i) { // the path of its corners
            return (b.at(OfBlock::half_width, i, lane) + b.at(OfBlock::half_height, i, lane)) *
                   abs_of(b.at(OfBlock::dtheta, i, lane));
        };
        const auto difference = [&](OfBlock::Field f) { return b.at(f, upper, lane) - b.at(f, lower, lane); };
        const BoxGap<double> gap =
            box_gap(abs_of(b.at(OfJoint::reference_x, j, lane) + difference(OfBlock::x)),
                    abs_of(b.at(OfJoint::height, j, lane) + difference(OfBlock::y)), box(lower), box(upper));
        const double margin = 1e-3 * b.at(OfRealization::skin, lane) + ahead * (turns_by(lower) + turns_by(upper));
        if (gap.x < margin + ahead * abs_of(difference(OfBlock::dx)) &&
            gap.y < margin + ahead * abs_of(difference(OfBlock::dy)))
            return true;
    }
    return false;
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
/// @return whether it has for so long, or is out of time, that it is over
STYLOBATE_INLINE bool watch_rest(const Topology& topology, const Bundle& b, int lane, bool undecided, Watch& w)
{
    const double kinetic = 0.5 * b.at(OfRealization::kinetic, lane) / (w.step_s * w.step_s);
    const double potential = b.at(OfRealization::potential, lane) / (w.step_s * w.step_s) - w.start_potential_j;
    const double time = static_cast<double>(w.steps) * w.step_s;
    const double slip = b.at(OfRealization::slip, lane) - w.slip_m;
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
        w.quiet_top_m += centre_of(topology, b, topology.top, lane).x;
        ++w.quiet_checks;
    } else {
        w.quiet = 0;
    }
    return (w.may_rest != 0 && at_rest(w)) || w.steps >= w.last_step;
}

} // namespace stylobate
