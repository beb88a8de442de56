#pragma once
/// The mechanisms that a study can name: one table defines them, from which studies are read, written, perturbed
/// and explained. The equations are in `kernels/planar/mechanisms/` and, for the base, in `base_motion.hpp`.

#include "ensemble/model/realization.hpp"
#include "ensemble/model/structure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace stylobate {

/// A physical effect that the baseline leaves out. A number never changes (`Stream`): a new mechanism takes the next.
enum class Mechanism : std::uint8_t {
    stribeck,
    joint_friction,
    drag,
    corner_loss,
    hertz,
    rate_damping,
    face_damping,
    friction_wear,
    corner_wear,
    table_pitch,
    vertical_motion,
    harmonic_distortion,
    time_offset,
    sensor_gain,
    dowel,
    adhesion,
    eccentricity,
    wedge,
    drum_offset,
    tie,
    tendon,
    bearing,
    mortar,
    clamp,
    pull_out,
    rod,
    table_tilt,
    count
};
const char* to_string(Mechanism mechanism);

/// Where a mechanism acts.
enum class MechanismPlace {
    joint, ///< a bed, counted as in `Layout::beds`
    block, ///< a free one, counted as in `Layout::blocks`
    base
};

/// Where it acts when a study names no places.
enum class UsualPlaces {
    all,       ///< every bed, or every free block
    tops,      ///< the uppermost drum of each column
    feet,      ///< the lowest bed of each column
    neighbours ///< every epistyle beside another one, which is at its right
};

/// Which models have a mechanism, or a parameter of one.
enum class MechanismModels : std::uint8_t { both, planar, spatial };

/// What a parameter is to its mechanism.
enum class ParameterRole {
    acting, ///< at its neutral value the mechanism does nothing by it; at least one of these is given
    needed, ///< defines how the mechanism acts, and must be given
    detail, ///< defines how the mechanism acts; has a default
    extra   ///< the same; a study's text has it only where it is not the default
};

/// What the mechanisms (`kernels/planar/mechanisms/`) make of a joint. Every default is neutral.
struct JointMechanisms {
    double dynamic_ratio = 1;         ///< stribeck: mu_d / mu
    double stribeck_velocity_m_s = 1; ///< stribeck: v_s
    double wear_per_m = 0;            ///< friction_wear: mu (1 - k S), S the slip of the joint so far
    double adhesion_n_m = 0;          ///< adhesion: c, force per contact length, until the joint first slips
    double dowel_stiffness_n_m = 0;   ///< dowel: k_d
    double dowel_yield_n = 0;         ///< dowel: F_d
    double dowel_gap_m = 0;           ///< dowel: free play to either side
    double force_exponent = 1;        ///< hertz: q in F = K A^q, scaled to the force at the reference overlap
    double reference_overlap_m2 = 1;  ///< hertz: where the law has the force of the linear one
    double rate_s_m = 0;              ///< rate_damping: Hunt and Crossley's lambda
    double face_damping = 0;          ///< share of the normal dashpot that acts at the ends of the contact
    double chip_left_m = 0;           ///< corner_loss: contact face lost at its left end
    double chip_right_m = 0;          ///< corner_loss: at its right end
    double corner_wear_m_rad = 0;     ///< corner_wear: further loss at both ends per path of the relative rotation
    double wedge_rad = 0;             ///< wedge: the lower block's face is turned by this, counter-clockwise
    double wedge_x_rad = 0;           ///< wedge, in space: the same about x; `wedge_rad` is about z
    double adhesion_tension_n_m = 0;  ///< adhesion: force per contact length that it holds against opening
    double adhesion_pa = 0;           ///< adhesion, in space: force per area of the bed, until the joint first slips
    friend bool operator==(const JointMechanisms&, const JointMechanisms&) = default;
};

/// What the mechanisms make of a block. Every default is neutral.
struct BlockMechanisms {
    double drag_n_s2_m2 = 0;     ///< drag: F = -(c |v| + d) v, v the centre's velocity in the laboratory
    double drag_n_s_m = 0;       ///< drag: d
    double eccentricity_m = 0;   ///< eccentricity: centre of mass from the geometric centre, along the width
    double eccentricity_z_m = 0; ///< the same along z, in space
    double tie_n_m = 0;          ///< tie: k in F = f - k x - c x', horizontally, against the base; may be negative
    double tie_n_s_m = 0;        ///< tie: c
    double tie_n = 0;            ///< tie: f
    double tie_n_m_s = 0;        ///< tie: moment against the rotation, per rate of rotation
    double rod_right_n_m = 0;    ///< rod: k where it pushes to the right
    double rod_left_n_m = 0;     ///< rod: k where it pushes to the left
    double rod_height_m = 0;     ///< rod: its point above the lower face of the block
    double rod_speed_m_s = 0;    ///< rod: velocity of its end, to the right
    double rod_start_s = 0;      ///< rod: when the end begins to move
    double rod_travel_m = 0;     ///< rod: path of the end
    double rod_laboratory = 0;   ///< rod: 1: its end is in the laboratory, 0: on the base
    bool has_rod() const { return rod_right_n_m != 0 || rod_left_n_m != 0; }
    /// When the end of the rod has stopped.
    double rod_end_s() const
    {
        return has_rod() && rod_speed_m_s != 0 ? rod_start_s + rod_travel_m / std::abs(rod_speed_m_s) : 0;
    }
    /// How far the end of the rod is from where it began, in the frame of the base [m].
    /// @param time_s since the start   @param base_m displacement of the base [m]
    double rod_end_m(double time_s, double base_m) const
    {
        const double path = std::clamp(std::abs(rod_speed_m_s) * (time_s - rod_start_s), 0.0, rod_travel_m);
        return std::copysign(path, rod_speed_m_s) - rod_laboratory * base_m;
    }
    friend bool operator==(const BlockMechanisms&, const BlockMechanisms&) = default;
};

/// What strengthens a joint (`kernels/planar/mechanisms/strengthening.hpp`). Every default is neutral. All of it was
/// put in when the structure was at rest.
struct JointStrengthening {
    double bearing_n_m = 0;        ///< bearing: k
    double bearing_n_s_m = 0;      ///< bearing: c
    double bearing_per_m = 0;      ///< bearing: 1 / R, the curvature of its dish
    double bond_tension_n_m = 0;   ///< mortar: tensile strength times depth, f_t D
    double bond_cohesion_n_m = 0;  ///< mortar: cohesion times depth, c D
    double hold_n = 0;             ///< pull_out: F_a of one dowel
    double hold_stiffness_n_m = 0; ///< pull_out: axial stiffness of one dowel
    double hold_length_m = 0;      ///< pull_out: opening at which a dowel is out
    double hold_spread_m = 0;      ///< pull_out: of the two dowels from the middle of the upper face
    friend bool operator==(const JointStrengthening&, const JointStrengthening&) = default;
};

/// What strengthens a block, as `JointStrengthening` a joint.
struct BlockStrengthening {
    double tendon_n_m = 0;         ///< tendon: k, from the middle of the block's top face down to the fixed ground
    double tendon_prestress_n = 0; ///< tendon: T0, at rest
    double tendon_yield_n = 1e12;  ///< tendon: T_y
    double clamp_n_m = 0;          ///< clamp: k, to the block `clamp_to`
    double clamp_strength_n = 0;   ///< clamp: F_y
    double clamp_gap_m = 0;        ///< clamp: free play to either side
    double clamp_compression = 1;  ///< clamp: its stiffness in compression over that in tension
    double clamp_height_m = 0;     ///< clamp: above the middle of this block
    double clamp_break_m = 10;     ///< clamp: elongation at which it breaks
    int clamp_to = -1;             ///< the block beside it at the right; -1: no clamp
    friend bool operator==(const BlockStrengthening&, const BlockStrengthening&) = default;
};

/// What the mechanisms make of the base, beside what changes its horizontal motion alone (`BaseChange`).
struct BaseMechanisms {
    double pitch_rad_s2_m = 0;  ///< table_pitch: rotation of the table about the middle of the base, per acceleration
    double vertical_ratio = 0;  ///< vertical_motion: vertical over horizontal acceleration of the base
    double tilt_rad = 0;        ///< table_tilt: to which it is turned, counter-clockwise
    double tilt_rate_rad_s = 1; ///< table_tilt: how fast
    double tilt_start_s = 0;    ///< table_tilt: when that begins
    friend bool operator==(const BaseMechanisms&, const BaseMechanisms&) = default;
};

struct MechanismParameter {
    const char* name;
    const char* suffix; ///< of its key in a study file: its unit
    const char* unit;   ///< as people write it; "" of a ratio
    double low, high;   ///< what it may be
    bool open;          ///< `low` itself is outside
    ParameterRole role;
    double neutral; ///< of an acting one; of the others the default
    /// The member that it is in a realization; none where the sampler does something else with it.
    std::variant<std::monostate, double JointMechanisms::*, double BlockMechanisms::*, double BaseMechanisms::*,
                 double BaseChange::*, double JointStrengthening::*, double BlockStrengthening::*>
        member;
    const char* says;
    MechanismModels models = MechanismModels::both;

    std::string key() const { return std::string(name) + suffix; }
};

struct MechanismRule {
    Mechanism mechanism;
    const char* name; ///< in study files
    MechanismPlace place;
    const char* says;
    std::span<const MechanismParameter> parameters;
    UsualPlaces usual = UsualPlaces::all;
    MechanismModels models = MechanismModels::planar;
};

/// All of them, in the order of the enumeration.
std::span<const MechanismRule> mechanism_rules();
const MechanismRule& rule_of(Mechanism mechanism);

inline constexpr std::size_t most_parameters = 7;

/// A mechanism with the same values at one or several places.
struct MechanismSpec {
    Mechanism mechanism = Mechanism::stribeck;
    std::vector<int> places;                      ///< joints or blocks, ascending; empty: all of them, or the base
    std::array<double, most_parameters> values{}; ///< in the order of the rule's parameters
    friend bool operator==(const MechanismSpec&, const MechanismSpec&) = default;
};

/// A spec with no parameter but neutral values and defaults.
/// @param friction of [contact]: the neutral dynamic friction of `stribeck`
MechanismSpec neutral_spec(Mechanism mechanism, double friction);

/// Whether any of its values is not neutral.
bool acts(const MechanismSpec& spec, double friction);

/// The beds or blocks of a structure at which a mechanism acts when none are named, ascending.
std::vector<int> usual_places(const MechanismRule& rule, const Layout& layout);

/// Why a mechanism cannot act at a place of a structure; nullopt if it can.
/// @pre the place is one of the structure's, and not a fixed block
std::optional<std::string> why_not(const MechanismRule& rule, const Layout& layout, int place);

/// What of a mechanism's values contradicts itself; nullopt if nothing does.
/// @param values in the order of the rule's parameters
std::optional<std::string> contradiction(const MechanismRule& rule, std::span<const double> values);

/// Shear that the stone carries at a rigid dowel, embedded as deep in both blocks, when it is crushed along the whole
/// dowel: (sqrt 2 - 1) f d l. Source: K. W. Johansen, "Theory of timber connections", IABSE Publications 9 (1949)
/// 249-262, as EN 1995-1-1 (8.6c) for equal members.
double stone_carries_n(double strength_pa, double diameter_m, double embedment_m);

/// "stribeck_velocity": of the values that were drawn, in results.
std::string input_name(Mechanism mechanism, const MechanismParameter& parameter);

} // namespace stylobate
