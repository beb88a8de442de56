#pragma once
/// The conditions of plastic contact with Coulomb's friction at many points of a column together, and their solution.
///
///   v = v_free + M^-1 J^T p,   0 <= u_n + b_n, p_n >= 0, one of them 0,   |p_t| <= mu p_n, against the sliding u_t +
///   b_t
///
/// Point by point, each exactly, over and over (block Gauss and Seidel: Jean 1999). From time to time the equations are
/// solved directly with the points that carry, hold and slip as they have been found so far; what comes out is taken
/// only if every condition is verified with it.

#include "bench/rigid_reference/contact_point.hpp"

#include <string>
#include <vector>

namespace stylobate::reference {

enum class Grip : signed char { slips_back = -1, holds = 0, slips_forth = 1, open = 2 };

struct Contact {
    int lower = 0; ///< body; the upper one is the next
    Corner corner{};
    double gap = 0; ///< at the time of the rows
    ContactRows rows;
    double add_normal = 0, add_along = 0; ///< b_n, b_t [m/s]
    double normal = 0, along = 0;         ///< p_n, p_t [N s]
    Grip grip = Grip::holds;              ///< in: a guess

    int upper() const { return lower + 1; }
    std::size_t key() const { return static_cast<std::size_t>(corners_of_bed * lower + static_cast<int>(corner)); }
};
using Contacts = std::vector<Contact>;

/// u_n and u_t of a point, without b.
double normal_rate(const Contact& c, const Twists& velocity);
double along_rate(const Contact& c, const Twists& velocity);
/// Adds an impulse to the velocities.
void push(const Bodies& bodies, const Contact& c, double normal, double along, Twists& velocity);

/// What a point's impulses change of its own rates.
struct Response {
    double normal, both, along;
};
Response response(const Bodies& bodies, const Contact& c);

/// Impulses of one point with which its own conditions hold, the rates without them being given.
struct Impulse {
    double normal = 0, along = 0;
    Grip grip = Grip::open;
};
Impulse single_point(const Response& r, double normal_rate, double along_rate, double mu);

struct Solved {
    int sweeps = 0;     ///< 0: the guess was right
    bool exact = false; ///< every condition is verified to the tolerance
};
/// @param velocity in: without the impulses; out: with them
/// @param tolerance of rates [m/s]
Solved solve_together(const Bodies& bodies, Contacts& contacts, Twists& velocity, double tolerance);

// What an impact makes of the velocities of a column: laws that agree for one point, and differ for several.

enum class ImpactLaw {
    together,   ///< all points at once, plastic (Moreau)
    sequential, ///< the fastest closing point alone, plastic; then the next one, until none closes
    viscous,    ///< dashpots of one coefficient at all points, without springs, until none closes
    compliant   ///< springs and dashpots at all points, stepped through until none carries: stiff contacts of a given
                ///< damping ratio in the limit of any stiffness, where an impact takes no time and weight is nothing
};

struct Impacts {
    ImpactLaw law = ImpactLaw::together;
    double along_ratio = 0.57735; ///< viscous: coefficient along the face over that across it (two corners: sqrt(1/3))
    double damping_ratio = 1;     ///< compliant: of one block on two points; along the face a third of the springs
    double fineness = 0.1; ///< viscous: part of a point's closing speed that its own dashpot takes in an increment
};

/// Slowest closing that is an impact [m/s].
inline constexpr double still_m_s = 1e-8;

/// @param contacts all points that touch, the closing ones and the others   @return whether all conditions are verified
/// (of `together`), nothing closes any more (`sequential`, `viscous`), or nothing carries any more (`compliant`)
bool strike(const Bodies& bodies, const Impacts& impacts, Contacts& contacts, Twists& velocity);

double kinetic_energy(const Bodies& bodies, const Twists& velocity);

} // namespace stylobate::reference
