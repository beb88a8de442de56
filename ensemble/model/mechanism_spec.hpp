#pragma once
/// The mechanisms that a study can name: one table defines them, from which studies are read, written, perturbed
/// and explained. The equations are in `kernels/planar/mechanisms/` and, for the base, in `base_motion.hpp`.

#include "ensemble/model/structure.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
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
    pull_out
};
inline constexpr int mechanism_count = 25;
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

/// What a parameter is to its mechanism.
enum class ParameterRole {
    acting, ///< at its neutral value the mechanism does nothing by it; at least one of these is given
    needed, ///< defines how the mechanism acts, and must be given
    detail, ///< defines how the mechanism acts; has a default
    extra   ///< the same; a study's text has it only where it is not the default
};

struct MechanismParameter {
    const char* name;
    const char* suffix; ///< of its key in a study file: its unit
    const char* unit;   ///< as people write it; empty: none
    double low, high;   ///< what it may be
    bool open;          ///< `low` itself is outside
    ParameterRole role;
    double neutral; ///< of an acting one; of the others the default
    /// The member that it is in a realization; none where the sampler does something else with it.
    std::variant<std::monostate, double JointMechanisms::*, double BlockMechanisms::*, double BaseMechanisms::*,
                 double BaseChange::*, double JointStrengthening::*, double BlockStrengthening::*>
        member;
    const char* says;

    std::string key() const { return std::string(name) + suffix; }
};

struct MechanismRule {
    Mechanism mechanism;
    const char* name; ///< in study files
    MechanismPlace place;
    const char* says;
    std::span<const MechanismParameter> parameters;
    UsualPlaces usual = UsualPlaces::all;
};

/// All of them, in the order of the enumeration.
std::span<const MechanismRule> mechanism_rules();
const MechanismRule& rule_of(Mechanism mechanism);

inline constexpr std::size_t most_parameters = 6;

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

/// Why a mechanism cannot act at a place of a structure; empty: it can.
/// @pre the place is one of the structure's, and not a fixed block
std::string why_not(const MechanismRule& rule, const Layout& layout, int place);

/// What of a mechanism's values contradicts itself; empty: nothing.
/// @param values in the order of the rule's parameters
std::string contradiction(const MechanismRule& rule, std::span<const double> values);

/// Shear that the stone carries at a rigid dowel, embedded as deep in both blocks, when it is crushed along the whole
/// dowel: (sqrt 2 - 1) f d l. Source: K. W. Johansen, "Theory of timber connections", IABSE Publications 9 (1949)
/// 249-262, as EN 1995-1-1 (8.6c) for equal members.
double stone_carries_n(double strength_pa, double diameter_m, double embedment_m);

/// "stribeck_velocity": of the values that were drawn, in results.
std::string input_name(Mechanism mechanism, const MechanismParameter& parameter);

} // namespace stylobate
