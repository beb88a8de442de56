#pragma once
/// How rigid blocks begin to move from rest: the oracles of initiation, in closed form.

namespace stylobate::verification {

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
