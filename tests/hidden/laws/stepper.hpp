#pragma once
/// One step of either law.

#include "tests/hidden/laws/bed_ends.hpp"
#include "tests/hidden/shaking.hpp"

namespace stylobate::hidden {

/// The table as a twin sees it: it may start from another place and velocity than the motion has there.
struct Table {
    const TableMotion* motion = nullptr;
    long since = 0;  ///< half step
    BaseState shift; ///< added from then on: places and velocities, the places growing with these
    double half_step_s = 0;

    BaseState at(long half_step) const
    {
        BaseState state = motion->at(half_step);
        const double t = static_cast<double>(half_step - since) * half_step_s;
        state.x += shift.x + shift.vx * t;
        state.y += shift.y + shift.vy * t;
        state.theta += shift.theta + shift.omega * t;
        state.vx += shift.vx;
        state.vy += shift.vy;
        state.omega += shift.omega;
        return state;
    }
};

/// Law A. Moreau's time stepping (the velocities jump; contacts are sought at the middle of the step), Newton's
/// restitution at every corner, Coulomb's law on the velocities, solved by projected Gauss-Seidel from the impulses
/// of the step before. J. J. Moreau, "Numerical aspects of the sweeping process" (1999).
void step_nonsmooth(const Model& model, const Table& table, State& state);

/// Law B. Corners with F = K d^p (1 + lambda d'), Hunt and Crossley (1975), and bristles, whose deflection z follows
/// the sliding until they slip: z' = v (1 - |z / z_s|^4) where v pushes them further; F_t = F_n mu (z + tau z') / z_s.
/// Classical Runge-Kutta of the fourth order.
void step_compliant(const Model& model, const Table& table, State& state);

inline void step(const Model& model, const Table& table, State& state)
{
    model.law == Law::nonsmooth ? step_nonsmooth(model, table, state) : step_compliant(model, table, state);
}

/// Depth at which a corner of law B has a force, and the force at a depth, at rest.
double compliant_force(const Model& model, int bed, double depth);
double compliant_depth(const Model& model, int bed, double force);

} // namespace stylobate::hidden
