#include "ensemble/model/mechanism_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>

namespace stylobate {
namespace {

constexpr auto acting = ParameterRole::acting;
constexpr auto needed = ParameterRole::needed;
constexpr auto detail = ParameterRole::detail;
constexpr auto extra = ParameterRole::extra;
constexpr std::monostate by_sampler{};
constexpr auto in_plane = MechanismModels::planar;
constexpr auto in_space = MechanismModels::spatial;
constexpr auto in_both = MechanismModels::both;

using Joint_ = JointMechanisms;
using Block_ = BlockMechanisms;
using OnJoint_ = JointStrengthening;
using OnBlock_ = BlockStrengthening;

// name, suffix, unit, low, high, open, role, neutral, member, what it is
constexpr MechanismParameter stribeck[] = {
    // neutral: as much as the friction of [contact] (`neutral_spec`)
    {"dynamic_friction", "", "", 0, 10, true, acting, 1, by_sampler,
     "friction coefficient at high slip velocity; where beds have their own friction, its ratio to that of [contact] "
     "applies"},
    {"velocity", "_m_s", "m/s", 0, 100, true, needed, 1, &Joint_::stribeck_velocity_m_s,
     "slip velocity at which the difference of the friction has fallen to 1/e"}};
constexpr MechanismParameter joint_friction[] = {
    {"ratio", "", "", 0, 10, true, acting, 1, by_sampler,
     "ratio of the friction of the joint to its value without this mechanism"}};
constexpr MechanismParameter drag[] = {
    {"coefficient", "_n_s2_m2", "N s2/m2", 0, 1e9, false, acting, 0, &Block_::drag_n_s2_m2,
     "c in F = -(c |v| + d) v, v in the laboratory"},
    {"linear", "_n_s_m", "N s/m", 0, 1e9, false, acting, 0, &Block_::drag_n_s_m, "d in the same"}};
constexpr MechanismParameter corner_loss[] = {
    {"left", "_m", "m", 0, 10, false, acting, 0, &Joint_::chip_left_m, "length of the face lost at its left end"},
    {"right", "_m", "m", 0, 10, false, acting, 0, &Joint_::chip_right_m, "length of the face lost at its right end"}};
constexpr MechanismParameter hertz[] = {
    {"exponent", "", "", 0.5, 3, false, acting, 1, &Joint_::force_exponent, "q in F = K A^q"},
    {"reference_overlap", "_m2", "m2", 0, 1, false, detail, 0, by_sampler,
     "overlap at which the force is the linear law's; 0: that of the weight on the bed"}};
constexpr MechanismParameter rate_damping[] = {
    {"rate", "_s_m", "s/m", 0, 1e6, false, acting, 0, &Joint_::rate_s_m, "lambda in F = K A (1 + lambda v)"}};
constexpr MechanismParameter face_damping[] = {{"share", "", "", 0, 1, false, acting, 0, &Joint_::face_damping,
                                                "share of the normal dashpot that acts at the ends of the contact"}};
constexpr MechanismParameter friction_wear[] = {
    {"rate", "_per_m", "1/m", 0, 1e6, false, acting, 0, &Joint_::wear_per_m, "k in mu (1 - k S), S the slip so far"}};
constexpr MechanismParameter corner_wear[] = {{"loss", "_m_rad", "m/rad", 0, 10, false, acting, 0,
                                               &Joint_::corner_wear_m_rad,
                                               "length lost at both ends per path of the relative rotation"}};
constexpr MechanismParameter table_pitch[] = {{"rotation", "_rad_s2_m", "rad s2/m", -1, 1, false, acting, 0,
                                               &BaseMechanisms::pitch_rad_s2_m,
                                               "rotation of the table per horizontal acceleration"}};
constexpr MechanismParameter vertical_motion[] = {
    {"ratio", "", "", -10, 10, false, acting, 0, &BaseMechanisms::vertical_ratio,
     "vertical over horizontal acceleration; or file, component, unit and baseline of a vertical record"}};
constexpr MechanismParameter harmonic_distortion[] = {
    {"second", "", "", -1, 1, false, acting, 0, &BaseChange::second,
     "overtone at twice the frequency, as a fraction of the displacement"},
    {"second_quadrature", "", "", -1, 1, false, acting, 0, &BaseChange::second_quadrature,
     "the same, a quarter of its period ahead"},
    {"third", "", "", -1, 1, false, acting, 0, &BaseChange::third,
     "overtone at three times the frequency, as a fraction of the displacement"},
    {"third_quadrature", "", "", -1, 1, false, acting, 0, &BaseChange::third_quadrature,
     "the same, a quarter of its period ahead"}};
constexpr MechanismParameter time_offset[] = {{"offset", "_s", "s", -100, 100, false, acting, 0, &BaseChange::offset_s,
                                               "delay of the given motion relative to the base"}};
constexpr MechanismParameter sensor_gain[] = {{"gain", "", "", 0, 100, true, acting, 1, &BaseChange::gain,
                                               "ratio of the true motion of the base to the given one"}};
constexpr MechanismParameter dowel[] = {
    {"stiffness", "_n_m", "N/m", 0, 1e12, false, acting, 0, &Joint_::dowel_stiffness_n_m, "stiffness against sliding"},
    {"yield", "_n", "N", 0, 1e12, true, needed, 0, &Joint_::dowel_yield_n, "force at which the dowel yields"},
    {"gap", "_m", "m", 0, 1, false, detail, 0, &Joint_::dowel_gap_m, "free play to either side before it acts"},
    {"stone_strength", "_pa", "Pa", 0, 1e9, false, extra, 0, by_sampler,
     "compressive strength of the stone, to check the yield force against; 0: not checked"},
    {"diameter", "_m", "m", 0, 1, false, extra, 0, by_sampler, "diameter of the dowel, for this check"},
    {"embedment", "_m", "m", 0, 10, false, extra, 0, by_sampler,
     "length of the dowel in either block, for this check"}};
constexpr MechanismParameter adhesion[] = {
    {"force", "_n_m", "N/m", 0, 1e9, false, acting, 0, &Joint_::adhesion_n_m,
     "force of adhesion per contact length, until the joint first slips", in_plane},
    {"strength", "_pa", "Pa", 0, 1e9, false, acting, 0, &Joint_::adhesion_pa,
     "force of adhesion per area of the bed, until the joint first slips", in_space},
    {"tension", "_n_m", "N/m", 0, 1e9, false, extra, 0, &Joint_::adhesion_tension_n_m,
     "force per contact length that it holds against opening, until it breaks there; 0: it does not", in_plane}};
constexpr MechanismParameter eccentricity[] = {
    {"offset", "_m", "m", -10, 10, false, acting, 0, &Block_::eccentricity_m,
     "distance of the centre of mass from the geometric centre, to the right"},
    {"offset_z", "_m", "m", -10, 10, false, acting, 0, &Block_::eccentricity_z_m, "the same along z", in_space}};
constexpr MechanismParameter wedge[] = {
    {"angle", "_rad", "rad", -0.5, 0.5, false, acting, 0, &Joint_::wedge_rad,
     "rotation of the lower block's face, counter-clockwise"},
    {"angle_x", "_rad", "rad", -0.5, 0.5, false, acting, 0, &Joint_::wedge_x_rad, "the same about x", in_space}};
constexpr MechanismParameter drum_offset[] = {
    {"offset", "_m", "m", -10, 10, false, acting, 0, by_sampler,
     "displacement of the block from its nominal position, to the right"},
    {"offset_z", "_m", "m", -10, 10, false, acting, 0, by_sampler, "the same along z", in_space}};
constexpr MechanismParameter tie[] = {
    {"stiffness", "_n_m", "N/m", -1e12, 1e12, false, acting, 0, &Block_::tie_n_m,
     "horizontal stiffness against the base; negative: away from its place"},
    {"dashpot", "_n_s_m", "N s/m", 0, 1e9, false, acting, 0, &Block_::tie_n_s_m,
     "horizontal force against the velocity relative to the base"},
    {"force", "_n", "N", -1e12, 1e12, false, acting, 0, &Block_::tie_n, "constant force, to the right"},
    {"turning_dashpot", "_n_m_s", "N m s", 0, 1e9, false, acting, 0, &Block_::tie_n_m_s,
     "moment against the rate of rotation relative to the base"}};

constexpr MechanismParameter tendon[] = {
    {"stiffness", "_n_m", "N/m", 0, 1e12, false, acting, 0, &OnBlock_::tendon_n_m, "axial stiffness E A / L"},
    {"prestress", "_n", "N", 0, 1e12, false, detail, 0, &OnBlock_::tendon_prestress_n,
     "tension at rest; 0: just taut, so that it acts as soon as the anchors move apart"},
    {"yield", "_n", "N", 0, 1e12, true, extra, 1e12, &OnBlock_::tendon_yield_n, "tension at which it yields"}};
constexpr MechanismParameter bearing[] = {
    {"stiffness", "_n_m", "N/m", 0, 1e12, false, acting, 0, &OnJoint_::bearing_n_m,
     "horizontal stiffness, of an elastomeric bearing G A / t"},
    {"dashpot", "_n_s_m", "N s/m", 0, 1e12, false, acting, 0, &OnJoint_::bearing_n_s_m,
     "horizontal force against the velocity of the offset"},
    {"curvature", "_per_m", "1/m", 0, 100, false, acting, 0, &OnJoint_::bearing_per_m,
     "curvature 1 / R of the dish of a friction pendulum"}};
constexpr MechanismParameter mortar[] = {
    {"tensile_strength", "_pa", "Pa", 0, 1e9, false, acting, 0, by_sampler, "tensile strength of the bond"},
    {"cohesion", "_pa", "Pa", 0, 1e9, true, needed, 0, by_sampler, "its shear strength without pressure"}};
constexpr MechanismParameter clamp[] = {
    {"stiffness", "_n_m", "N/m", 0, 1e12, false, acting, 0, &OnBlock_::clamp_n_m, "axial stiffness of the clamps"},
    {"strength", "_n", "N", 0, 1e12, true, needed, 1, &OnBlock_::clamp_strength_n,
     "force at which they yield or slip out of the stone"},
    {"gap", "_m", "m", 0, 1, false, detail, 0, &OnBlock_::clamp_gap_m, "free play to either side"},
    {"compression", "", "", 0, 1, false, detail, 1, &OnBlock_::clamp_compression,
     "ratio of the stiffness in compression to that in tension; 0: acts in tension alone"},
    {"height", "_m", "m", -100, 100, false, extra, 0, &OnBlock_::clamp_height_m,
     "height above the middle of the block"},
    {"break", "_m", "m", 0, 10, true, extra, 10, &OnBlock_::clamp_break_m, "elongation at which they break"}};
constexpr MechanismParameter pull_out[] = {
    {"hold", "_n", "N", 0, 1e12, false, acting, 0, &OnJoint_::hold_n, "axial force at which one dowel slips"},
    {"stiffness", "_n_m", "N/m", 0, 1e12, true, needed, 1, &OnJoint_::hold_stiffness_n_m,
     "axial stiffness of one dowel"},
    {"length", "_m", "m", 0, 10, true, needed, 1, &OnJoint_::hold_length_m,
     "embedded length: the dowel is out when the joint has opened by it"},
    {"spread", "_m", "m", 0, 10, false, detail, 0, &OnJoint_::hold_spread_m,
     "distance of each of the two dowels from the middle of the face"}};

constexpr MechanismParameter rod[] = {
    {"to_right", "_n_m", "N/m", 0, 1e12, false, acting, 0, &Block_::rod_right_n_m,
     "stiffness with which it pushes the block to the right; 0: it does not"},
    {"to_left", "_n_m", "N/m", 0, 1e12, false, acting, 0, &Block_::rod_left_n_m,
     "stiffness with which it pushes the block to the left; 0: it does not"},
    {"height", "_m", "m", 0, 100, false, detail, 0, &Block_::rod_height_m,
     "height at which it touches the block, above the block's lower face"},
    {"speed", "_m_s", "m/s", -100, 100, false, detail, 0, &Block_::rod_speed_m_s,
     "velocity of its other end, to the right; 0: the end is held"},
    {"start", "_s", "s", 0, 1e6, false, detail, 0, &Block_::rod_start_s, "time at which that end begins to move"},
    {"travel", "_m", "m", 0, 100, false, detail, 0, &Block_::rod_travel_m, "path after which that end stops"},
    {"laboratory", "", "", 0, 1, false, detail, 0, &Block_::rod_laboratory,
     "1: that end is held in the laboratory, 0: on the base; between: it follows a part of the base's motion"}};
constexpr MechanismParameter table_tilt[] = {
    {"angle", "_rad", "rad", -1.5, 1.5, false, acting, 0, &BaseMechanisms::tilt_rad,
     "angle to which the base is turned, counter-clockwise"},
    {"rate", "_rad_s", "rad/s", 0, 10, true, needed, 1, &BaseMechanisms::tilt_rate_rad_s, "rate of the rotation"},
    {"start", "_s", "s", 0, 1e6, false, detail, 0, &BaseMechanisms::tilt_start_s, "time at which it begins"}};

constexpr auto joint = MechanismPlace::joint;
constexpr auto block = MechanismPlace::block;
constexpr auto base = MechanismPlace::base;

constexpr MechanismRule rules[] = {
    {Mechanism::stribeck, "stribeck", joint, "friction falls with the velocity of the slip", stribeck, UsualPlaces::all,
     in_both},
    {Mechanism::joint_friction, "joint_friction", joint, "a joint with another friction", joint_friction,
     UsualPlaces::all, in_both},
    {Mechanism::drag, "drag", block, "drag of a medium on a block", drag},
    {Mechanism::corner_loss, "corner_loss", joint, "chipped corners: a shorter contact face", corner_loss},
    {Mechanism::hertz, "hertz", joint, "contact force that is a nonlinear function of the overlap", hertz},
    {Mechanism::rate_damping, "rate_damping", joint, "damping in proportion to the overlap (Hunt and Crossley)",
     rate_damping},
    {Mechanism::face_damping, "face_damping", joint, "normal damping at the ends of the contact", face_damping,
     UsualPlaces::all, in_both},
    {Mechanism::friction_wear, "friction_wear", joint, "friction that wears off with the slip", friction_wear,
     UsualPlaces::all, in_both},
    {Mechanism::corner_wear, "corner_wear", joint, "corners that wear off with the rocking", corner_wear},
    {Mechanism::table_pitch, "table_pitch", base, "a shaking table that rotates as it accelerates", table_pitch},
    {Mechanism::vertical_motion, "vertical_motion", base, "a base that moves vertically too", vertical_motion},
    {Mechanism::harmonic_distortion, "harmonic_distortion", base, "overtones of the base motion", harmonic_distortion,
     UsualPlaces::all, in_both},
    {Mechanism::time_offset, "time_offset", base, "a clock of the base that differs from that of the blocks",
     time_offset, UsualPlaces::all, in_both},
    {Mechanism::sensor_gain, "sensor_gain", base, "a base motion with another amplitude than the given one",
     sensor_gain, UsualPlaces::all, in_both},
    {Mechanism::dowel, "dowel", joint, "dowels between two blocks", dowel, UsualPlaces::all, in_both},
    {Mechanism::adhesion, "adhesion", joint, "adhesion until the first slip", adhesion, UsualPlaces::all, in_both},
    {Mechanism::eccentricity, "eccentricity", block, "an eccentric centre of mass", eccentricity, UsualPlaces::all,
     in_both},
    {Mechanism::wedge, "wedge", joint, "a face that is not square", wedge, UsualPlaces::all, in_both},
    {Mechanism::drum_offset, "drum_offset", block, "a block displaced from its nominal position", drum_offset,
     UsualPlaces::all, in_both},
    {Mechanism::tie, "tie", block, "a block tied to the base: spring, dashpots, constant force", tie, UsualPlaces::all,
     in_both},
    {Mechanism::tendon, "tendon", block, "a cable through a column, from the fixed ground to the top of a drum", tendon,
     UsualPlaces::tops},
    {Mechanism::bearing, "bearing", joint, "a seismic isolator in a joint, beside its friction", bearing,
     UsualPlaces::feet},
    {Mechanism::mortar, "mortar", joint, "a bonded joint, until it breaks", mortar},
    {Mechanism::clamp, "clamp", block, "clamps between a block and its neighbour at the right", clamp,
     UsualPlaces::neighbours},
    {Mechanism::pull_out, "pull_out", joint, "two dowels that resist the opening of a joint until they are out",
     pull_out},
    {Mechanism::rod, "rod", block, "a rod that holds, pulls or pushes a block", rod},
    {Mechanism::table_tilt, "table_tilt", base, "a base that is slowly turned out of level", table_tilt}};
static_assert(std::size(rules) == static_cast<std::size_t>(Mechanism::count));

constexpr bool in_order()
{
    for (std::size_t i = 0; i < std::size(rules); ++i)
        if (rules[i].mechanism != static_cast<Mechanism>(i) || rules[i].parameters.size() > most_parameters)
            return false;
    return true;
}
static_assert(in_order(), "the table has every mechanism, in the order of the enumeration");

} // namespace

std::span<const MechanismRule> mechanism_rules()
{
    return rules;
}

const MechanismRule& rule_of(Mechanism mechanism)
{
    return rules[static_cast<std::size_t>(mechanism)];
}

const char* to_string(Mechanism mechanism)
{
    return rule_of(mechanism).name;
}

MechanismSpec neutral_spec(Mechanism mechanism, double friction)
{
    MechanismSpec spec;
    spec.mechanism = mechanism;
    const auto& parameters = rule_of(mechanism).parameters;
    std::transform(parameters.begin(), parameters.end(), spec.values.begin(),
                   [](const MechanismParameter& parameter) { return parameter.neutral; });
    if (mechanism == Mechanism::stribeck)
        spec.values[0] *= friction;
    return spec;
}

bool acts(const MechanismSpec& spec, double friction)
{
    const MechanismSpec neutral = neutral_spec(spec.mechanism, friction);
    const auto& parameters = rule_of(spec.mechanism).parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        if (parameters[i].role == acting && spec.values[i] != neutral.values[i])
            return true;
    return false;
}

std::vector<int> usual_places(const MechanismRule& rule, const Layout& layout)
{
    std::vector<int> places;
    const int beds = static_cast<int>(layout.beds.size()), blocks = static_cast<int>(layout.blocks.size());
    const auto at = [&](int i) -> const PlacedBlock& { return layout.blocks[static_cast<std::size_t>(i)]; };
    if (rule.place == MechanismPlace::joint) {
        for (int j = 0, column = -1; j < beds; ++j) {
            const PlacedBlock& upper = at(layout.beds[static_cast<std::size_t>(j)].upper);
            const bool foot = upper.role == BlockRole::drum && upper.column != column;
            column = upper.column;
            if (rule.usual != UsualPlaces::feet || foot)
                places.push_back(j);
        }
        return places;
    }
    for (int i = 0; i < blocks && rule.place == MechanismPlace::block; ++i) {
        const bool top = at(i).role == BlockRole::drum && (i + 1 == blocks || at(i + 1).column != at(i).column);
        const int beside = right_neighbour(layout, i);
        const bool pair = at(i).role == BlockRole::epistyle && beside >= 0 && at(beside).role == BlockRole::epistyle;
        if (!at(i).fixed && (rule.usual == UsualPlaces::all || (rule.usual == UsualPlaces::tops && top) ||
                             (rule.usual == UsualPlaces::neighbours && pair)))
            places.push_back(i);
    }
    return places;
}

std::optional<std::string> why_not(const MechanismRule& rule, const Layout& layout, int place)
{
    if (rule.mechanism == Mechanism::tendon && layout.blocks[static_cast<std::size_t>(place)].role != BlockRole::drum)
        return "is no drum, and a tendon goes through a column";
    if (rule.mechanism == Mechanism::clamp && right_neighbour(layout, place) < 0)
        return "has no neighbour at its right";
    return std::nullopt;
}

std::optional<std::string> contradiction(const MechanismRule& rule, std::span<const double> values)
{
    const auto number = [&](std::size_t i) { return fmt::format("{} = {:g}", rule.parameters[i].key(), values[i]); };
    if (rule.mechanism == Mechanism::tendon && values[1] > 0 && values[0] == 0)
        return number(1) + " has no effect without a stiffness";
    if (rule.mechanism == Mechanism::tendon && values[1] > values[2])
        return number(1) + " is above " + number(2);
    if (rule.mechanism == Mechanism::adhesion && values[2] > 0 && values[0] == 0)
        return number(2) + " has no effect without force_n_m";
    if (rule.mechanism == Mechanism::rod && values[3] != 0 && values[5] == 0)
        return number(3) + " has no effect without travel_m";
    if (rule.mechanism == Mechanism::dowel && values[3] > 0) {
        if (!(values[4] > 0 && values[5] > 0))
            return number(3) + " needs diameter_m and embedment_m";
        const double most = stone_carries_n(values[3], values[4], values[5]);
        if (values[1] > most)
            return fmt::format("{} is above {:.4g} N, at which the stone is crushed", number(1), most);
    }
    return std::nullopt;
}

double stone_carries_n(double strength_pa, double diameter_m, double embedment_m)
{
    return (std::numbers::sqrt2 - 1) * strength_pa * diameter_m * embedment_m;
}

std::string input_name(Mechanism mechanism, const MechanismParameter& parameter)
{
    return std::string(to_string(mechanism)) + "_" + parameter.name;
}

} // namespace stylobate
