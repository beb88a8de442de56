#pragma once
/// A structure in space: drums and prisms with plane faces, and the beds between them. Plain data, SI units.
///
/// Axes: x and y as in the plane, y up; z towards the viewer. In the reference state the bodies stand upright, their
/// axes along these, and the faces of a joint just touch.

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/structure.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace stylobate {

/// A plane face: a disc, or a rectangle. Of a bed its sizes are along x and z; of a butt joint along the two axes of
/// the face, y and z (normal x) or x and y (normal z).
struct Face {
    bool round = true;
    double half_x_m = 0; ///< half size along the first one; of a disc the radius
    double half_z_m = 0; ///< along the second one; of a disc the radius
};

/// A rigid body: a drum (a frustum of a cone), a prism (a frustum of a pyramid), or a capital, whose bottom may be a
/// disc and whose top a rectangle; upright in the reference state.
struct Solid {
    Face bottom, top;
    double height_m = 0;
    double mass_kg = 0;
    std::array<double, 3> inertia_kg_m2{};  ///< about x, y, z through the centre of mass
    std::array<double, 3> centre_m{};       ///< centre of mass in the reference state, y above the base
    double centre_height_m = 0;             ///< of the centre of mass above the bottom face
    std::array<double, 2> eccentricity_m{}; ///< of the centre of mass from the axis of the body, along x and z
    bool fixed = false;                     ///< moves with the base
    BlockRole role = BlockRole::drum;
    int column = 0; ///< of a drum, from the left; -1 for all else
    BlockMechanisms mechanisms{};

    /// From the centre of mass to the middle of a face, in the body's frame.
    std::array<double, 3> to_bottom() const { return {-eccentricity_m[0], -centre_height_m, -eccentricity_m[1]}; }
    std::array<double, 3> to_top() const
    {
        return {-eccentricity_m[0], height_m - centre_height_m, -eccentricity_m[1]};
    }
    /// Its middle, half way up its axis, in the reference state.
    std::array<double, 3> middle_m() const
    {
        return {centre_m[0] - eccentricity_m[0], centre_m[1] - centre_height_m + height_m / 2,
                centre_m[2] - eccentricity_m[1]};
    }
};

/// The normal of a joint's faces, from the lower to the upper body.
enum class Normal : std::uint8_t { x, y, z };

/// The bed between two bodies, or a butt joint between two beams.
struct SolidJoint {
    int lower = 0; ///< index of the lower body (the left or back one of a butt joint)
    int upper = 0;
    Normal normal = Normal::y;
    std::array<double, 3> point_m{}; ///< where the anchors of both faces meet in the reference state
    double gap_m = 0;                ///< of a butt joint: between its faces in the reference state
    /// The faces, and their middles from `point_m` along the two axes that follow the normal cyclically. Of the faces
    /// of a butt joint, the half size along the normal is that along y. The face of the ground is wide, and of the
    /// shape of what stands on it.
    Face lower_face, upper_face;
    std::array<double, 2> lower_middle_m{}, upper_middle_m{};
    double inner_ratio = 0; ///< hollow bed (anathyrosis): inner over outer size; 0: the whole face bears

    double area_m2 = 0;                   ///< of the whole bed, by which its stiffness and dashpots are spread
    double normal_stiffness_n_m3 = 0;     ///< k: per area of the bed
    double tangential_stiffness_n_m = 0;  ///< of the whole joint
    double normal_damping_n_s_m3 = 0;     ///< per area
    double tangential_damping_n_s_m3 = 0; ///< per area
    double friction = 0;
    JointMechanisms mechanisms{};
};

struct SpatialStructure {
    std::vector<Solid> solids; ///< column by column from the bottom, then the epistyles, then the ground where needed
    std::vector<SolidJoint> joints;
    int drums = 0;                         ///< solids without the ground
    std::array<double, 2> base_tilt_rad{}; ///< base out of level: about z (as in the plane), and about x
    double initial_tilt_rad = 0;           ///< leaned about the rim of the bottom face of `initial_tilt_block`
    double initial_tilt_direction_rad = 0; ///< azimuth towards which it leans, from x towards z
    int initial_tilt_block = 0;            ///< of each column, from the bottom: it and what stands on it lean
    bool with_mechanisms =
        false; ///< run by the step with mechanisms even where every one is neutral (`model_in_space`)

    /// Bodies that are stepped.
    std::uint64_t free_solids() const
    {
        std::uint64_t count = 0;
        for (const Solid& solid : solids)
            count += !solid.fixed;
        return count;
    }
};

} // namespace stylobate
