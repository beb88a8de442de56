#pragma once
/// Homogeneous drums and prisms: frusta of cones and pyramids, upright, in closed form.
///
/// Every horizontal section is the bottom face times s(y) = 1 + (t - 1) y / h, t the ratio of the top face to the
/// bottom one. Its area is A0 s^2 and its second moments are I0 s^4, so that all integrals over the height are of
/// polynomials in y.

#include <array>
#include <cstdint>

namespace stylobate {

/// The outline of a block seen from above.
enum class Shape : std::uint8_t { round, square, rectangle };

/// A frustum of a cone (round) or of a pyramid; of a capital it may stand on an echinus: a frustum of a cone whose
/// upper circle touches the sides of the bottom face.
struct Frustum {
    Shape shape = Shape::round;
    double width_m = 0; ///< of the bottom face along x; of a round one its diameter
    double depth_m = 0; ///< of the bottom face along z; of a round one the same
    double height_m = 0;
    double top_ratio = 1;     ///< t: top face over bottom face, along x and z alike; > 0
    double echinus_part = 0;  ///< of the height, at the bottom: the echinus; 0: there is none
    double echinus_ratio = 0; ///< diameter of its bottom over `width_m`

    double volume_m3() const;
    /// Of the centre of mass above the bottom face.
    double centre_height_m() const;
    /// Moments of inertia over the mass, about x, y (the axis) and z through the centre of mass [m2].
    std::array<double, 3> inertia_per_mass_m2() const;
};

} // namespace stylobate
