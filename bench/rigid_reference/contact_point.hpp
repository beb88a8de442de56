#pragma once
/// Where two blocks of a column may touch: the corners of each against the face of the other one.

#include <cmath>
#include <vector>

namespace stylobate::reference {

// Rectangles in a plane for the reference of rigid blocks: full trigonometry, double precision, no code of the
// kernels.

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

/// The lower corners of the upper block against the upper face of the lower one, and the upper corners of the lower
/// block against the lower face of the upper one.
enum class Corner { upper_left, upper_right, lower_left, lower_right };
inline constexpr int corners_of_bed = 4;

/// A corner and the face of the other block.
struct Meeting {
    double gap = 0;       ///< from the face to the corner [m]
    double along = 0;     ///< place of the upper block along the face, up to a constant [m]
    bool on_face = false; ///< the corner is beside the face, not beyond its ends
};
Meeting meeting(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner);

/// Changes of gap and sliding with the velocities of the blocks: dot(normal_lower, v_lower) + dot(normal_upper,
/// v_upper). An impulse p at the point moves the blocks with the same rows.
struct ContactRows {
    Twist normal_lower, normal_upper, along_lower, along_upper;
};
ContactRows rows(const Body& lower, const Body& upper, const Twist& at_lower, const Twist& at_upper, Corner corner);

} // namespace stylobate::reference
