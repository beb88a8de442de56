#pragma once
/// How long a time step may be, from the linear vibrations of the stack.
///
/// The scheme is the central difference with the dashpots at the velocity of the step before (Eqs. 1, 2, 4 to 6):
///
///   M (u[n+1] - 2 u[n] + u[n-1]) = -dt2 K u[n] - dt C (u[n] - u[n-1])
///
/// With u[n] = v lambda^n and the quotients m, c, k of v it is stable while 4 m - 2 dt c - dt2 k > 0 for every v, so
/// while 4 M - 2 dt C - dt2 K is positive definite; instability begins at lambda = -1.
///
/// Source: Belytschko, Liu, Moran & Elkhodary, "Nonlinear Finite Elements for Continua and Structures", 2nd edition
/// (2014), section 6.2; the bounds by blocks and at an edge are own derivations (`kernels/THEORY.md`, section 6).

#include "ensemble/realization/realization.hpp"

#include <limits>
#include <vector>

namespace stylobate {

/// What sets the bound.
enum class StepLimit {
    stiffness,    ///< full contacts, no dashpot in the structure
    dashpot,      ///< full contacts with their dashpots
    edge_dashpot, ///< a dashpot that keeps its coefficient while only an edge of the contact is left
    flat_fall     ///< a lone block that is followed until it lies on its long face
};

/// "stiffness of the contacts" and so on, for messages.
const char* to_string(StepLimit limit);

struct StepBound {
    double dt_s = 0;        ///< the safe bound: the smallest of what follows
    double stiffness_s = 0; ///< full contacts without dashpots: 2 / w
    double dashpot_s = 0;   ///< full contacts with dashpots: (2 / w) (sqrt(1 + z2) - z)
    double edge_s = 0;      ///< dashpots at an edge; infinity where there are none
    double flat_s = std::numeric_limits<double>::infinity(); ///< of `step_bound_to_rest`: a long face
    StepLimit governed_by = StepLimit::stiffness;
    int block = 0; ///< that sets w
};

/// A step that is safe for every state of the contacts between the blocks, from the realization's own parameters.
///
/// Full contacts: w2 = 2 max over the free blocks of eig(M^-1 sum K_bb), K_bb the 3 x 3 stiffness of a block from
/// each of its joints. It bounds the whole stack's because a joint's energy is at most twice the sum of what each of
/// its two blocks would store with the other one held. A partial contact is a part of the full one and softer.
///
/// With dashpots: C <= beta K in each joint with beta = max(C_N / k_n, C_T / K_T), so z = beta w / 2 = C w / (2 k),
/// the largest over the joints. For equal drums it is xi w / sqrt(min(k_n, K_T) / m), and the same holds for given
/// coefficients.
///
/// Edge: a dashpot with a constant coefficient (`damping_chord_m` == 0) stays as it is when the contact has shrunk to
/// an edge, where the stiffness has gone and the effective mass is smaller, 1 / G with G = 1/m + b2/I for the normal
/// direction. A block's rebound does not change sign in one step while dt times the largest eigenvalue of G diag(C_N,
/// C_T) is below 1 (G: 2 x 2, both blocks, at the corner where it is largest). A block that is held at edges by two
/// joints at once then has at most 2, which is where the scheme becomes unstable.
///
/// Watched pairs (the last `watched` joints): a falling block can be caught between two others on its long faces, so it
/// counts as held by full contacts of the pair's stiffness on both of them. Their dashpots are proportional to the
/// length of the contact, at most the shorter of the two blocks' long faces.
///
/// With mechanisms, or in another form than `area`, each bed has the tangent stiffness of its form and exponent,
/// two_corner thrice the rotational one, and the dashpots of its form; stiffness and damping that grow with the load
/// are taken at 10 times the load at rest, the stiffness of `points` at 100 times (a softening bed, q < 1, at a
/// hundredth of it). A stiffness may vanish while its dashpots stay, so these are bounded by themselves: with
/// c = 2 max over the blocks of eig(M^-1 sum C_bb), 4 - 2 dt c - dt2 w2 > 0.
///
/// @pre at least one bed; stiffnesses, sizes and masses above 0; watched pairs have `damping_chord_m` > 0
StepBound step_bound(const Realization& realization);

/// `step_bound` of a realization that is followed until what has fallen lies. A block that stands alone has no watched
/// pair, yet comes down on its bed with the whole of a long face at once: K_N times its height. Let w be the face's own
/// circular frequency. Of 288 such falls (1 m wide, 2.5 to 9 m high, damping ratios of 0.01 to 0.5) 27 broke their
/// energy bound with steps of 0.9 / w, one of 1440 did with 0.45 / w; of 96 faster ones one did with 0.3 / w and none
/// with 0.15 / w, whose largest residual was 0.026. So the bound is 1 / (6 w).
StepBound step_bound_to_rest(const Realization& realization);

/// A longer step that is safe too: of the whole structure instead of its blocks one by one. The largest one for which
/// 4 M - 2 dt C - dt2 K of all beds at full contact is positive definite (K without gravity, which only softens), to
/// 1e-4 on the safe side, by Cholesky factors. `step_bound` takes twice the worst block, and adds the worst ones of C
/// and K; for stacks of drums it asks for about 1.3 times the steps (`docs/work_precision.md`).
///
/// Every other state of the contacts must have a part of this K and C. Dashpots at the ends have: of a part s of the
/// face, s / 2 (f1 + f2) of the squares at its ends is at most the half of those at the ends of the face, since s (2 -
/// s) <= 1. A dashpot at the centroid has not (at an edge it works on the rotation too, which it leaves alone at full
/// contact), and one that keeps its coefficient there still less. So this is for `damping = "ends"` and for no normal
/// damping; else the bound stays as it is. So do what catches a block between others, and the long face of a lone one.
///
/// @param by_block what `step_bound` or `step_bound_to_rest` says
StepBound structure_step_bound(const Realization& realization, StepBound by_block);

/// The linear vibrations of the whole structure about its static equilibrium, all contacts full, no slip.
struct LinearResponse {
    std::vector<double> frequency_hz; ///< undamped natural frequencies, ascending (3 x free blocks); 0 for a shape in
                                      ///< which the structure buckles under its weight
    double undamped_step_s = 0;       ///< critical step without dashpots: 2 / w_max
    double step_s = 0;                ///< critical step of the scheme with its dashpots
};

/// Exact where `step_bound` is a bound, in the realization's own model with its beds about their loads at rest; cost
/// grows with the cube of the number of blocks. Gravity enters through the
/// weight N that each joint carries: each of its blocks leans on the joint from half its height above or below, which
/// takes N H / 2 from its rotational stiffness.
///
/// @pre as of `step_bound`, and every free block is connected to a fixed one by beds; watched pairs are left out
LinearResponse linear_response(const Realization& realization);

/// The lowest vibration of a structure about its static equilibrium, all contacts full, no slip.
struct FirstMode {
    double frequency_hz = 0;  ///< undamped; 0: the structure buckles under its own weight
    double damping_ratio = 0; ///< of critical: v C v / (2 w v M v) of the undamped shape v
};

/// Frequency and damping of `linear_response`'s first shape alone, for structures of any size (subspace iteration of
/// K v = w2 M v, Bathe, "Finite Element Procedures" (1996), section 11.6; one Cholesky factor).
/// @pre as of `linear_response`
FirstMode first_mode(const Realization& realization);
/// `first_mode` of a realization with the paper's beds, whatever its form and its mechanisms.
FirstMode first_mode_of_paper(const Realization& realization);

} // namespace stylobate
