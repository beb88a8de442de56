#pragma once
/// The virtual specimen on its table, and its state: planar rigid rectangles that touch at the ends of their beds.
/// Lengths in m; y up; angles counter-clockwise; the frame of the laboratory.

#include "tests/hidden/effects.hpp"

#include <array>
#include <cstdint>

namespace stylobate::hidden {

/// The two healthy contact laws. Neither is the kernel's, whose bed is an area.
enum class Law {
    nonsmooth, ///< A: unilateral corners, restitution, Coulomb's law on velocities; Moreau's time stepping
    compliant  ///< B: Hunt and Crossley's corners, friction by bristles; Runge and Kutta's fourth order
};

/// A rigid rectangle.
struct Body {
    double half_width_m = 0;
    double half_height_m = 0;
    double mass_kg = 0;
    double inertia_kg_m2 = 0; ///< about the centre of mass
    double rest_x_m = 0;      ///< geometric centre where it is meant to stand, from the middle of the table
};

/// Two bodies that lie on each other.
struct Bed {
    int lower = -1; ///< -1: the table, or the block that is fixed to it
    int upper = 0;
    double friction = 0;
};

/// Parameters of the laws.
struct LawParameters {
    double restitution = 0;    ///< A: of a corner
    double stiffness_n_m = 0;  ///< B: force K d^1.5 of a corner at depth d [N/m^1.5]
    double reference_m = 1e-6; ///< B: the depth at which another exponent gives the same force
    double damping_s_m = 0;    ///< B: Hunt and Crossley's lambda
    double bristle_m = 1e-6;   ///< B: deflection of the bristles at which they slip
    double bristle_time_s = 0; ///< B: their damping over their stiffness
    bool operator==(const LawParameters&) const = default;
};

struct Model {
    Law law = Law::nonsmooth;
    LawParameters parameters;
    double gravity_m_s2 = 9.81;
    double step_s = 1e-4;
    int body_count = 0;
    int bed_count = 0;
    std::array<Body, max_bodies> bodies;
    std::array<Bed, max_beds> beds;
    double base_half_width_m = 10; ///< of what the lowest bodies stand on
    double base_top_m = 0;
    Effects effects;
};

/// A body that is prescribed: the table about the middle of its top.
struct BaseState {
    double x = 0, y = 0, theta = 0;
    double vx = 0, vy = 0, omega = 0;
};

struct BodyState {
    double x = 0, y = 0, theta = 0; ///< centre of mass
    double vx = 0, vy = 0, omega = 0;
    double slosh_m = 0, slosh_m_s = 0; ///< of the mass inside, against the body
};

/// What a bed remembers.
struct BedState {
    double slip_m = 0;             ///< path slipped
    double heat_j = 0;             ///< of sliding, what is left of it
    double turned_rad = 0;         ///< path of the relative rotation
    double dowel_at_m = 0;         ///< where the dowel stands free
    bool slipped = false;          ///< the adhesion is gone
    double bristle[2] = {0, 0};    ///< B: deflection at the left and right end
    double normal_n_s[2] = {0, 0}; ///< A: impulses of the last step
    double shear_n_s[2] = {0, 0};
    double gap_shift_m[2] = {0, 0}; ///< added to the gaps: see `Replica`
    double width_m = 0;             ///< of the bed, as of the last step
    double width_at_rest_m = 0;
};

struct State {
    long step = 0; ///< time = step * Model::step_s
    std::array<BodyState, max_bodies> bodies;
    std::array<BedState, max_beds> beds;
};

} // namespace stylobate::hidden
