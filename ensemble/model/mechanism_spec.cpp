#include "ensemble/model/mechanism_spec.hpp"

#include <algorithm>
#include <iterator>

namespace stylobate {
namespace {

constexpr auto acting = ParameterRole::acting;
constexpr auto needed = ParameterRole::needed;
constexpr auto detail = ParameterRole::detail;
constexpr std::monostate by_sampler{};

using Joint_ = JointExtension;
using Block_ = BlockExtension;

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
constexpr MechanismParameter drag[] = {{"coefficient", "_n_s2_m2", "N s2/m2", 0, 1e9, false, acting, 0,
                                        &Block_::drag_n_s2_m2, "c in F = -c |v| v, v in the laboratory"}};
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
                                               &BaseExtension::pitch_rad_s2_m,
                                               "rotation of the table per horizontal acceleration"}};
constexpr MechanismParameter vertical_motion[] = {
    {"ratio", "", "", -10, 10, false, acting, 0, &BaseExtension::vertical_ratio,
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
    {"gap", "_m", "m", 0, 1, false, detail, 0, &Joint_::dowel_gap_m, "free play to either side before it acts"}};
constexpr MechanismParameter adhesion[] = {{"force", "_n_m", "N/m", 0, 1e9, false, acting, 0, &Joint_::adhesion_n_m,
                                            "force of adhesion per contact length, until the joint first slips"}};
constexpr MechanismParameter eccentricity[] = {
    {"offset", "_m", "m", -10, 10, false, acting, 0, &Block_::eccentricity_m,
     "distance of the centre of mass from the geometric centre, to the right"}};
constexpr MechanismParameter wedge[] = {{"angle", "_rad", "rad", -0.5, 0.5, false, acting, 0, &Joint_::wedge_rad,
                                         "rotation of the lower block's face, counter-clockwise"}};
constexpr MechanismParameter drum_offset[] = {{"offset", "_m", "m", -10, 10, false, acting, 0, by_sampler,
                                               "displacement of the block from its nominal position, to the right"}};
constexpr MechanismParameter tie[] = {
    {"stiffness", "_n_m", "N/m", -1e12, 1e12, false, acting, 0, &Block_::tie_n_m,
     "horizontal stiffness against the base; negative: away from its place"},
    {"dashpot", "_n_s_m", "N s/m", 0, 1e9, false, acting, 0, &Block_::tie_n_s_m,
     "horizontal force against the velocity relative to the base"},
    {"force", "_n", "N", -1e12, 1e12, false, acting, 0, &Block_::tie_n, "constant force, to the right"},
    {"turning_dashpot", "_n_m_s", "N m s", 0, 1e9, false, acting, 0, &Block_::tie_n_m_s,
     "moment against the rate of rotation relative to the base"}};

constexpr auto joint = MechanismPlace::joint;
constexpr auto block = MechanismPlace::block;
constexpr auto base = MechanismPlace::base;

constexpr MechanismRule rules[] = {
    {Mechanism::stribeck, "stribeck", joint, "friction falls with the velocity of the slip", stribeck},
    {Mechanism::joint_friction, "joint_friction", joint, "a joint with another friction", joint_friction},
    {Mechanism::drag, "drag", block, "drag of a medium on a block", drag},
    {Mechanism::corner_loss, "corner_loss", joint, "chipped corners: a shorter contact face", corner_loss},
    {Mechanism::hertz, "hertz", joint, "contact force that is a nonlinear function of the overlap", hertz},
    {Mechanism::rate_damping, "rate_damping", joint, "damping in proportion to the overlap (Hunt and Crossley)",
     rate_damping},
    {Mechanism::face_damping, "face_damping", joint, "normal damping at the ends of the contact", face_damping},
    {Mechanism::friction_wear, "friction_wear", joint, "friction that wears off with the slip", friction_wear},
    {Mechanism::corner_wear, "corner_wear", joint, "corners that wear off with the rocking", corner_wear},
    {Mechanism::table_pitch, "table_pitch", base, "a shaking table that rotates as it accelerates", table_pitch},
    {Mechanism::vertical_motion, "vertical_motion", base, "a base that moves vertically too", vertical_motion},
    {Mechanism::harmonic_distortion, "harmonic_distortion", base, "overtones of the base motion", harmonic_distortion},
    {Mechanism::time_offset, "time_offset", base, "a clock of the base that differs from that of the blocks",
     time_offset},
    {Mechanism::sensor_gain, "sensor_gain", base, "a base motion with another amplitude than the given one",
     sensor_gain},
    {Mechanism::dowel, "dowel", joint, "dowels between two blocks", dowel},
    {Mechanism::adhesion, "adhesion", joint, "adhesion until the first slip", adhesion},
    {Mechanism::eccentricity, "eccentricity", block, "an eccentric centre of mass", eccentricity},
    {Mechanism::wedge, "wedge", joint, "a face that is not square", wedge},
    {Mechanism::drum_offset, "drum_offset", block, "a block displaced from its nominal position", drum_offset},
    {Mechanism::tie, "tie", block, "a block tied to the base: spring, dashpots, constant force", tie}};
static_assert(std::size(rules) == mechanism_count);

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

std::string input_name(Mechanism mechanism, const MechanismParameter& parameter)
{
    return std::string(to_string(mechanism)) + "_" + parameter.name;
}

} // namespace stylobate
