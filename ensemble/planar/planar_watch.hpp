#pragma once
/// What the planar model computes for a check (`ensemble/engine/watch.hpp`): energies, centres, numbers that are
/// finite, and whether rigid blocks are about to meet otherwise than at beds. On the processor and on a device, with
/// equal bits.

#include "ensemble/engine/watch.hpp"
#include "kernels/planar/bundle.hpp"
#include "kernels/planar/neighbours.hpp"
#include "kernels/planar/rows.hpp"
#include "kernels/trig.hpp"

namespace stylobate {

/// Steps between two checks of a realization: a chunk; of the rigid form, whose steps are long, a part of one, so that
/// a fall is decided as closely in time.
constexpr int check_steps(const Topology& topology)
{
    return topology.model.rigid() ? chunk_steps / 4 : chunk_steps;
}
/// Displacement of a block's geometric centre.
/// @param moved of what the kernel moves: of the centre of mass, in a model with mechanisms
STYLOBATE_INLINE Planar<double> centre_of(const Topology& topology, const Bundle& b, int block, int lane,
                                          Planar<double> moved)
{
    if (topology.model.has_mechanism_rows()) {
        const Angle<double> a = angle(moved.theta);
        const double e = b.at(OfBlockMechanisms::eccentricity, block, lane);
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
    if (topology.model.has_mechanism_rows())
        for (int j = 0; j < topology.beds(); ++j) {
            const double force = b.at(OfJointMechanisms::dowel_force, j, lane);
            energy += 0.5 * force * force * b.at(OfJointMechanisms::per_dowel_stiffness, j, lane);
        }
    if (topology.model.strengthened) {
        for (int j = 0; j < topology.beds(); ++j)
            energy += b.at(OfJointStrengthening::held, j, lane);
        for (int i = 0; i < topology.blocks; ++i)
            energy += b.at(OfBlockStrengthening::held, i, lane);
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
    if (topology.model.has_mechanism_rows()) {
        const double held = dowel_energy(topology, b, lane) - w.start_dowel_j;
        o.spring += held;
        o.damping += 0.5 * b.at(OfRealizationMechanisms::joint_energy, lane) - held +
                     0.5 * b.at(OfRealizationMechanisms::drag_energy, lane) * per_dt2;
    }
    o.base_work = 0.5 * b.at(OfRealization::base_energy, lane) * per_dt2;
    const double lacks = o.kinetic + o.potential + o.spring + o.friction + o.damping - o.base_work;
    o.residual = lacks / (w.barrier_j + abs_of(o.friction) + abs_of(o.damping));
    return o;
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

STYLOBATE_INLINE RestSigns rest_signs(const Topology& topology, const Bundle& b, int lane)
{
    return {b.at(OfRealization::kinetic, lane), b.at(OfRealization::potential, lane), b.at(OfRealization::slip, lane),
            centre_of(topology, b, topology.top, lane).x};
}

} // namespace stylobate
