#pragma once
/// The virtual specimen on its table, and its state: planar rigid rectangles that touch at the ends of their beds.
/// Lengths in m; y up; angles counter-clockwise; the frame of the laboratory.

#include "tests/hidden/effects.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stylobate::hidden {

/// The two healthy contact laws. Neither is the kernel's, whose bed is an area.
enum class Law {
    nonsmooth, ///< A: unilateral corners, restitution, Coulomb's law on velocities; Moreau's time stepping
    compliant  ///< B: Hunt and Crossley's corners, friction by bristles; Runge and Kutta's fourth order
};

/// Carriers of a body that does not move by itself, beside the indices of other bodies.
inline constexpr int its_own = -3;  ///< it moves by itself
inline constexpr int away = -2;     ///< it is not there
inline constexpr int on_table = -1; ///< it is clamped to the table

/// A rigid rectangle.
struct Body {
    double half_width_m = 0;
    double half_height_m = 0;
    double mass_kg = 0;
    double inertia_kg_m2 = 0; ///< about the centre of mass
    double rest_x_m = 0;      ///< geometric centre where it is meant to stand, from the middle of the table
    double mass_x_m = 0;      ///< centre of mass from the geometric centre, where the body carries others; an
    double mass_y_m = 0;      ///< eccentricity of its effects is added
    int carrier = its_own;    ///< what it is rigid with
    double held_x_m = 0;      ///< its centre of mass in the frame of its carrier: about the carrier's centre of mass,
    double held_y_m = 0;      ///< or the middle of the table's top
    double held_rad = 0;
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

/// A rod with a spring between a point on the middle line of a body and a point of the laboratory or the table. Its
/// force on the body is horizontal, in the frame of the other end.
struct Rod {
    int body = 0;
    double height_m = 0; ///< of the point above the body's lower face
    bool to_table = false;
    double side = 0; ///< 0: it pulls and pushes; 1 or -1: it only pushes, to the right or to the left
    double stiffness_n_m = 0;
    double damping_n_s_m = 0;
    double end_m = 0;     ///< where the other end is at first
    double speed_m_s = 0; ///< of it, from `from_s` to `to_s`
    double from_s = 0, to_s = 0;
};

inline constexpr int max_rods = 2;

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
    int rod_count = 0;
    std::array<Rod, max_rods> rods;
    Effects effects;
};

/// The body that moves with a given one (itself, or its carrier), `on_table` or `away`.
/// @param body on_table: the table
inline int mover(const Model& model, int body)
{
    if (body < 0)
        return on_table;
    const int carrier = model.bodies[static_cast<std::size_t>(body)].carrier;
    return carrier == its_own ? body : carrier;
}

/// True if the two bodies of a bed are there and can move against each other.
inline bool can_move(const Model& model, const Bed& bed)
{
    const int lower = mover(model, bed.lower), upper = mover(model, bed.upper);
    return lower != away && upper >= 0 && lower != upper;
}

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
    double slip_m = 0;               ///< path slipped
    double heat_j = 0;               ///< of sliding, what is left of it
    double turned_rad = 0;           ///< path of the relative rotation
    double dowel_at_m = 0;           ///< where the dowel stands free
    bool slipped = false;            ///< the adhesion is gone
    bool opened[2] = {false, false}; ///< and at the left or right end alone, where it held tension
    double bristle[2] = {0, 0};      ///< B: deflection at the left and right end
    double normal_n_s[2] = {0, 0};   ///< A: impulses of the last step
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
