#pragma once
/// Rigid blocks on a rigid base: the oracles of rocking and overturning, of sliding, and of the start of motion.
///
/// Rocking is Housner's, integrated in extended precision:
///
///   theta'' = -p2 [sin(+-alpha - theta) + (u''/g) cos(+-alpha - theta)],  + for theta > 0, - for theta < 0
///
/// An impact at theta = 0 takes the angular velocity times e. A frame of equal columns with a cap obeys the same
/// equation with another p (Makris and Vassiliou), as long as its cap keeps its seats.

namespace stylobate::verification {

struct RigidBlock {
    long double alpha = 0; ///< slenderness [rad]
    long double p = 0;     ///< frequency parameter [rad/s]
};

/// A block of full width and height [m].
RigidBlock rigid_block(long double width, long double height, long double gravity = 9.81L);

/// A frame of N equal columns of full width and height under a cap; gamma = cap mass / (N column mass).
RigidBlock rigid_frame(long double width, long double height, long double gamma, long double gravity = 9.81L);

/// Ratio of the angular velocities after and before an impact: Housner's by conserving the moment of momentum about
/// the new corner; of a frame with that of its cap (gamma = 0: a single block).
long double housner_restitution(long double alpha, long double gamma = 0);

/// Time from rest at `start` < alpha to upright [s]: the integral of d theta / theta' by Simpson's rule, with the root
/// at the start taken out by theta = start - s2.
long double quarter_period(const RigidBlock& block, long double start);

/// How a block ends that rests until a pulse a sin(w t) of half a cycle or a full one sets it rocking.
struct PulseEnd {
    bool overturned = false;
    int impacts = 0;
    double least_pressure = 1; ///< on the base, over the weight; below 0 a block would leave it, which this one cannot
};

/// Fourth-order Runge and Kutta with 600 steps a cycle; impacts are found by halving the step.
/// @param eta a / (g tan alpha);  @param rate w / p;  @param cycles 0.5 or 1;  @param restitution e
PulseEnd respond(const RigidBlock& block, long double eta, long double rate, long double cycles,
                 long double restitution);

/// Least eta that overturns under half a sine (no impact can happen before it).
double half_sine_edge(const RigidBlock& block, double rate);

/// Edges of overturning under a full sine.
struct FullSineEdges {
    bool after_impact = false;  ///< whether it can overturn after an impact
    double low = 0, high = 0;   ///< if so, between these, after one
    double direct = 0;          ///< and from here on without one
    double direct_pressure = 1; ///< least one on the base in that motion, see `PulseEnd`
};
FullSineEdges full_sine_edges(const RigidBlock& block, double rate, double restitution);

/// A rigid block that can only slide on its base, with Coulomb friction, in units in which mu g = 1 and w = 1: the
/// acceleration of the base is eta sin t, slip is in mu g / w2. The velocity r of the base against the block obeys
/// r' = eta sin t - sgn r while it slides; it sticks where r = 0 and |eta sin t| <= 1.
///
/// Slip, and the base's way less the block's.
struct Slip {
    double total = 0, net = 0;
};

/// Under `cycles` (0.5 or 1) of the sine; the base then keeps its velocity.
Slip pulse_slip(double eta, double cycles);

/// Slip path over the base's path in the steady state under a harmonic without end.
double steady_slip_ratio(double eta);

/// Shenton's regimes of one block on a base that is accelerated at once.
enum class Regime { rest, slide, rock, slide_rock };
const char* to_string(Regime regime);

/// @param a base acceleration over g;  @param mu friction;  @param slenderness b / h
Regime shenton(double a, double mu, double slenderness);

/// Friction below which a block that rocks slides as well (a > slenderness).
double rock_friction(double a, double slenderness);

/// Two rectangles, one on the other, each centred: half widths and heights [m], masses [kg].
struct TwoBlocks {
    double b1 = 0, h1 = 0, m1 = 0, b2 = 0, h2 = 0, m2 = 0;
    double gravity = 9.81;
};

/// Angular accelerations at the start, positive in the sense in which the inertia forces topple [rad/s2].
struct Start {
    double lower = 0, upper = 0;
};

/// Of the pattern that the acceleration sets going (no slip): rest, the upper block alone, both as one, both in the
/// same sense with a gap between them, or the upper one back over its other corner while the lower one tips. Each
/// pattern is solved as if it were so; the one is right whose gaps open and whose joints press within their faces.
/// @throws std::logic_error if none is
Start two_block_start(const TwoBlocks& blocks, double acceleration_m_s2);

} // namespace stylobate::verification
