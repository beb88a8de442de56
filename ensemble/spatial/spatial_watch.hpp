#pragma once
/// What the spatial model computes for a check (`ensemble/engine/watch.hpp`): energies, and numbers that are finite.

#include "ensemble/engine/watch.hpp"
#include "kernels/real.hpp"
#include "kernels/spatial/bundle.hpp"
#include "kernels/spatial/friction.hpp"

namespace stylobate::spatial {

/// Steps between two checks of a realization.
constexpr int check_steps(const Topology&)
{
    return chunk_steps;
}

/// Whether all that the next steps depend on is a number: what is not spreads to the energy or to a position at once.
inline bool is_finite(const Topology& topology, const Bundle& b, int lane)
{
    double sum = 0.5 * b.at(OfRealization::kinetic, lane);
    for (int k = topology.fixed; k < topology.bodies; ++k)
        sum +=
            b.at(OfBody::x, k, lane) + b.at(OfBody::y, k, lane) + b.at(OfBody::z, k, lane) + b.at(OfBody::q_w, k, lane);
    return abs_of(sum) <= 0x1.fffffffffffffp+1023;
}

/// Of the springs of friction and of its torque.
inline double spring_energy(const Topology& topology, const Bundle& b, int lane)
{
    double energy = 0;
    for (int j = 0; j < topology.joints; ++j) {
        const double s1 = b.at(OfJoint::spring_1, j, lane), s2 = b.at(OfJoint::spring_2, j, lane),
                     twist = b.at(OfJoint::spring_twist, j, lane);
        energy += 0.5 * (s1 * s1 + s2 * s2 + twist * twist / torsion_ratio<double>()) * b.at(OfJoint::per_K_t, j, lane);
    }
    return energy;
}

/// Of dowels.
inline double dowel_energy(const Topology& topology, const Bundle& b, int lane)
{
    using J = OfJointMechanisms;
    double energy = 0;
    for (int j = 0; topology.model.mechanisms && j < topology.joints; ++j) {
        const double x = b.at(J::dowel_force, j, lane), y = b.at(static_cast<J::Field>(J::dowel_force + 1), j, lane);
        energy += 0.5 * (x * x + y * y) * b.at(J::per_dowel_stiffness, j, lane);
    }
    return energy;
}

/// Of the beds, after the last step of a chunk.
inline double bed_energy(const Topology& topology, const Bundle& b, int lane)
{
    double energy = 0;
    for (int j = 0; j < topology.joints; ++j)
        energy += b.at(OfJoint::elastic, j, lane);
    return energy;
}

/// After the last step of a chunk.
inline EnergyBalance energy_balance(const Topology& topology, const Bundle& b, int lane, const Watch& w)
{
    const double per_dt2 = 1 / (w.step_s * w.step_s);
    EnergyBalance o;
    o.kinetic = 0.5 * b.at(OfRealization::kinetic, lane) * per_dt2;
    o.potential = b.at(OfRealization::potential, lane) * per_dt2 - w.start_potential_j;
    o.spring = bed_energy(topology, b, lane) + spring_energy(topology, b, lane) - w.start_spring_j;
    o.friction = b.at(OfRealization::friction_energy, lane);
    o.damping = b.at(OfRealization::dashpot_energy, lane);
    if (topology.model.mechanisms) {
        using M = OfRealizationMechanisms;
        const double held = dowel_energy(topology, b, lane) - w.start_dowel_j;
        o.spring += held;
        o.damping += 0.5 * (b.at(M::joint_energy, lane) + b.at(M::tie_energy, lane) * per_dt2) - held;
    }
    o.base_work = 0.5 * b.at(OfRealization::base_energy, lane) * per_dt2;
    const double lacks = o.kinetic + o.potential + o.spring + o.friction + o.damping - o.base_work;
    o.residual = lacks / (w.barrier_j + abs_of(o.friction) + abs_of(o.damping));
    return o;
}

inline RestSigns rest_signs(const Topology& topology, const Bundle& b, int lane)
{
    return {b.at(OfRealization::kinetic, lane), b.at(OfRealization::potential, lane), b.at(OfRealization::slip, lane),
            b.at(OfBody::x, topology.top, lane)};
}

} // namespace stylobate::spatial
