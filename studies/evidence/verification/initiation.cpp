#include "studies/evidence/verification/initiation.hpp"

#include <algorithm>
#include <stdexcept>

namespace stylobate::verification {

const char* to_string(Regime regime)
{
    switch (regime) {
    case Regime::rest:
        return "rest";
    case Regime::slide:
        return "slide";
    case Regime::rock:
        return "rock";
    default:
        return "slide and rock";
    }
}

double rock_friction(double a, double slenderness)
{
    const double B = slenderness;
    return (a * (1 + 4 * B * B) + 3 * B) / (4 + B * B + 3 * a * B);
}

Regime shenton(double a, double mu, double slenderness)
{
    if (a <= std::min(mu, slenderness))
        return Regime::rest;
    if (mu < slenderness)
        return Regime::slide;
    return mu >= rock_friction(a, slenderness) ? Regime::rock : Regime::slide_rock;
}

Start two_block_start(const TwoBlocks& k, double a)
{
    // Inertia forces point to +x, and a turn that way (clockwise) is positive: the lower block turns about its corner
    // at (b1, 0), the upper one against it about the corner of its foot at corner x b2. Lagrange's equations
    // M (lower, upper)'' = Q of that pair of hinges:
    struct Pair {
        double M11, M12, M22, Q1, Q2;
    };
    const double g = k.gravity;
    const auto pair = [&](double corner) {
        const double c = corner * k.b2, d = k.b1 - c; // lifts of the upper centre per turn of the upper and lower block
        const double I1 = k.m1 * (k.b1 * k.b1 + k.h1 * k.h1) / 3, I2 = k.m2 * (k.b2 * k.b2 + k.h2 * k.h2) / 3;
        return Pair{I1 + k.m1 * (k.b1 * k.b1 + k.h1 * k.h1) + k.m2 * (4 * k.h1 * k.h1 + d * d),
                    k.m2 * (2 * k.h1 * k.h2 + d * c), I2 + k.m2 * (k.h2 * k.h2 + c * c),
                    k.m1 * (a * k.h1 - g * k.b1) + k.m2 * (2 * a * k.h1 - g * d), k.m2 * (a * k.h2 - g * c)};
    };
    const auto both = [](const Pair& p) {
        const double det = p.M11 * p.M22 - p.M12 * p.M12;
        return Start{(p.M22 * p.Q1 - p.M12 * p.Q2) / det, (p.M11 * p.Q2 - p.M12 * p.Q1) / det};
    };
    const Pair front = pair(1), back = pair(-1);

    if (front.Q2 <= 0 && front.Q1 + front.Q2 <= 0)
        return {};
    const double upper = front.Q2 / front.M22;
    if (upper > 0 && front.Q1 - front.M12 * upper <= 0)
        return {0, upper};
    const double one = (front.Q1 + front.Q2) / (front.M11 + 2 * front.M12 + front.M22);
    if (one > 0 && front.Q2 - (front.M12 + front.M22) * one <= 0 && back.Q2 - (back.M12 + back.M22) * one >= 0)
        return {one, one};
    // where two patterns meet they are the same, and rounding may refuse both: so not too strict
    const double slack = 1e-9 * g / (k.h1 + k.h2);
    const Start same = both(front);
    if (same.lower > -slack && same.upper > same.lower - slack)
        return same;
    const Start opposite = both(back);
    if (opposite.lower > 0 && opposite.upper < opposite.lower + slack)
        return opposite;
    throw std::logic_error("no pattern of two blocks fits this acceleration");
}

} // namespace stylobate::verification
