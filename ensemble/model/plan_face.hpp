#pragma once
/// Faces seen from above: discs and rectangles along x and z, and what two of them have in common.

namespace stylobate {

/// A horizontal face in plan.
struct PlanFace {
    bool round = true;
    double x_m = 0;      ///< its middle
    double z_m = 0;      ///< its middle
    double half_x_m = 0; ///< of a disc its radius
    double half_z_m = 0; ///< of a disc its radius

    double area_m2() const;
};

/// How far a point lies outside a face [m]; below 0: inside.
double outside_m(const PlanFace& face, double x_m, double z_m);

/// Distance of two faces [m]; below 0: they overlap, and one of them moved by so much would just touch the other (of
/// two rectangles, and of two discs exactly; of a disc on a rectangle no less than that).
double gap_m(const PlanFace& a, const PlanFace& b);

/// Area that two faces have in common [m2], in closed form.
double common_area_m2(const PlanFace& a, const PlanFace& b);

/// The rectangle that the outlines of two faces have in common, as a face; a half size of 0: they have none.
PlanFace common_rectangle(const PlanFace& a, const PlanFace& b);

} // namespace stylobate
