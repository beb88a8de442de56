#pragma once
/// Rectangles in a plane for the reference of rigid blocks: full trigonometry, double precision, no code of the
/// kernels.

#include <cmath>
#include <vector>

namespace stylobate::reference {

/// A velocity (of the centre [m/s], and of rotation [rad/s], counter-clockwise), a place, an impulse, or the row of a
/// condition.
struct Twist {
    double x = 0, y = 0, theta = 0;

    Twist& operator+=(const Twist& o)
    {
        x += o.x;
        y += o.y;
        theta += o.theta;
        return *this;
    }
};
inline Twist operator*(double s, const Twist& p)
{
    return {s * p.x, s * p.y, s * p.theta};
}
inline Twist operator+(Twist a, const Twist& b)
{
    return a += b;
}
inline double dot(const Twist& a, const Twist& b)
{
    return a.x * b.x + a.y * b.y + a.theta * b.theta;
}

struct Body {
    double half_width_m = 0, half_height_m = 0;
    double per_mass = 0, per_inertia = 0; ///< 1 / m, 1 / I; 0: fixed
    double friction = 0;                  ///< mu of the bed below it
};
/// A column from the bottom; each body lies on the one before it.
using Bodies = std::vector<Body>;
using Twists = std::vector<Twist>; ///< (bodies)

/// What an impulse changes of a body's velocity.
inline Twist moved(const Body& body, const Twist& impulse)
{
    return {body.per_mass * impulse.x, body.per_mass * impulse.y, body.per_inertia * impulse.theta};
}

} // namespace stylobate::reference
