#pragma once
/// Attitudes for tests of the spatial kernels, computed with the standard library's sine and cosine.

#include "kernels/spatial/rotation.hpp"

#include <cmath>

namespace stylobate {

/// Rotation by a vector (angle times axis).
template <class Real>
spatial::Quaternion<Real> rotation_by(long double x, long double y, long double z)
{
    const long double angle = std::sqrt(x * x + y * y + z * z);
    const long double s = angle > 0 ? std::sin(angle / 2) / angle : 0.5L;
    const auto real = [](long double v) { return Real(static_cast<typename Lanes<Real>::Number>(v)); };
    return {real(std::cos(angle / 2)), real(s * x), real(s * y), real(s * z)};
}

/// Hamilton's product: first b, then a.
template <class Real>
spatial::Quaternion<Real> product(const spatial::Quaternion<Real>& a, const spatial::Quaternion<Real>& b)
{
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Angle of the rotation between two attitudes [rad].
inline double angle_between(const spatial::Quaternion<double>& a, const spatial::Quaternion<double>& b)
{
    const spatial::Quaternion<double> d = product({a.w, -a.x, -a.y, -a.z}, b);
    return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

} // namespace stylobate
