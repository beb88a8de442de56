#pragma once
/// What an effect changes in the virtual laboratory: parameters whose defaults are neutral. Plain data, SI units.

#include <array>

namespace stylobate::hidden {

inline constexpr int max_bodies = 8; ///< of a specimen
inline constexpr int max_beds = 8;

/// Of a bed: the contact of two bodies that lie on each other.
struct BedEffect {
    double friction_ratio = 1;    ///< joint_friction
    double dynamic_ratio = 1;     ///< stribeck: dynamic over static friction
    double stribeck_m_s = 1;      ///< stribeck: over which velocity it falls
    double wear_per_m = 0;        ///< friction_wear: mu (1 - k S), S the path slipped
    double adhesion_n_m = 0;      ///< adhesion: shear held per contact length until the first slip
    double tension_n_m = 0;       ///< adhesion: and tension, until an end opens or the bed slips
    double dowel_n_m = 0;         ///< dowel: stiffness
    double dowel_yield_n = 0;     ///< dowel: the force at which it yields
    double dowel_gap_m = 0;       ///< dowel: free play to either side
    double exponent_change = 0;   ///< hertz: added to the exponent of the compliant law
    double rate_factor = 1;       ///< rate_damping: on the compliant law's damping
    double end_dashpot_n_s_m = 0; ///< face_damping: a dashpot at each end of the compliant bed
    double chip_left_m = 0;       ///< corner_loss
    double chip_right_m = 0;      ///< corner_loss
    double corner_wear_m_rad = 0; ///< corner_wear: loss at both ends per path of the relative rotation
    double wedge_rad = 0;         ///< wedge: the lower face is turned by this
    double heat_per_j = 0;        ///< outside: friction mu (1 - k E), E the heat of sliding that is still there
    double heat_time_s = 1;       ///< outside: in which that heat leaves
    double direction = 0;         ///< outside: friction mu (1 + d) to the right, mu (1 - d) to the left
    double patch_drop = 0;        ///< outside: friction lower by this ratio at one position of the upper body
    double patch_at_m = 0;        ///< outside: that position, of the upper body against the lower one
    double patch_width_m = 1;     ///< outside: and its width
    bool operator==(const BedEffect&) const = default;
};

/// Of a body.
struct BodyEffect {
    double drag_kg_m = 0;      ///< drag: F = -c |v| v
    double eccentricity_m = 0; ///< eccentricity: centre of mass from the geometric centre, along the width
    double offset_m = 0;       ///< drum_offset: from where it is meant to stand, in every run
    double coriolis_per_s = 0; ///< outside: force m w (v_y, -v_x)
    double magnet_n = 0;       ///< outside: greatest pull towards a point of the table
    double magnet_at_m = 0;    ///< outside: that point, from the body's place at rest
    double magnet_range_m = 1; ///< outside: distance at which the pull is greatest
    double draught_n = 0;      ///< outside: horizontal force from one time to another
    double draught_from_s = 0;
    double draught_to_s = 0;
    double slosh_ratio = 0; ///< outside: part of the mass that swings inside on a spring
    double slosh_hz = 1;
    double spin_n_m_s = 0; ///< outside: moment against the body's own rotation
    bool operator==(const BodyEffect&) const = default;
};

/// Of the table, and of what is known of it.
struct BaseEffect {
    double pitch_rad_s2_m = 0; ///< table_pitch: rotation about the middle of its top, per acceleration
    double vertical_ratio = 0; ///< vertical_motion: vertical over horizontal motion
    double vertical_m_s2 = 0;  ///< vertical_motion of its own frequency: peak
    double vertical_hz = 1;
    int distortion_order = 2;    ///< harmonic_distortion: 2 or 3
    double distortion_ratio = 0; ///< amplitude of that harmonic over the first one's, in acceleration
    double time_offset_s = 0;    ///< time_offset: the table moves at t as the file says for t + tau
    double gain = 1;             ///< sensor_gain: true motion over the one in the file
    bool operator==(const BaseEffect&) const = default;
};

struct Effects {
    std::array<BedEffect, max_beds> beds;
    std::array<BodyEffect, max_bodies> bodies;
    BaseEffect base;
    bool persists = false; ///< wear goes on from run to run
    bool operator==(const Effects&) const = default;
};

} // namespace stylobate::hidden
