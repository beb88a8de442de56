#include "studies/measured/diagnosis/campaigns/cause_model.hpp"

#include "ensemble/model/mechanism_spec.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stylobate {

namespace {

std::optional<Mechanism> mechanism_of(const std::string& name)
{
    for (const MechanismRule& rule : mechanism_rules())
        if (name == rule.name)
            return rule.mechanism;
    return std::nullopt;
}

void set(MechanismSpec& spec, const char* name, double value)
{
    const MechanismRule& rule = rule_of(spec.mechanism);
    for (std::size_t p = 0; p < rule.parameters.size(); ++p)
        if (std::string_view(rule.parameters[p].name) == name)
            spec.values[p] = value;
}

/// A dowel whose size is the force at which it yields; its second parameter is then the slip at which it does.
bool yields(const Cause& cause)
{
    return cause.parameter == "yield_n";
}

/// The force of a tie that a cause is.
double& tie_member(const Cause& cause, BlockMechanisms& block)
{
    return cause.parameter == "stiffness_n_m"   ? block.tie_n_m
           : cause.parameter == "dashpot_n_s_m" ? block.tie_n_s_m
           : cause.parameter == "force_n"       ? block.tie_n
                                                : block.tie_n_m_s;
}

/// [mechanisms] are in the order of their list.
void add(const MechanismSpec& spec, Study& study)
{
    study.mechanisms.push_back(spec);
    std::sort(study.mechanisms.begin(), study.mechanisms.end(),
              [](const MechanismSpec& a, const MechanismSpec& b) { return a.mechanism < b.mechanism; });
}

} // namespace

void apply_cause(const SizedCause& sized, const SpecimenStructure& built, Realization& r)
{
    const Cause& cause = sized.cause;
    const std::string& m = cause.mechanism;
    const double size = sized.size;
    if (m == "table_pitch")
        r.base.pitch_rad_s2_m = size;
    if (m == "vertical_motion" && cause.parameter == "ratio")
        r.base.vertical_ratio = size;
    for (int bed = 0; bed < r.beds(); ++bed) {
        const bool here = cause.joint < 0 || built.bed[static_cast<std::size_t>(cause.joint)] == bed;
        if (!here)
            continue;
        Joint& joint = r.joints[static_cast<std::size_t>(bed)];
        JointMechanisms& e = joint.mechanisms;
        if (m == "joint_friction")
            joint.friction *= size;
        else if (m == "stribeck") {
            e.dynamic_ratio = size;
            e.stribeck_velocity_m_s = cause.fixed;
        } else if (m == "friction_wear")
            e.wear_per_m = size;
        else if (m == "adhesion") {
            e.adhesion_n_m = size;
            e.adhesion_tension_n_m = cause.fixed * size;
        } else if (m == "dowel" && yields(cause)) {
            e.dowel_stiffness_n_m = size / cause.fixed;
            e.dowel_gap_m = 0;
            e.dowel_yield_n = size;
        } else if (m == "dowel") {
            e.dowel_stiffness_n_m = size;
            e.dowel_gap_m = cause.fixed;
            e.dowel_yield_n = 1e9;
        } else if (m == "corner_loss") {
            if (cause.side != "right")
                e.chip_left_m = size;
            if (cause.side != "left")
                e.chip_right_m = size;
        } else if (m == "corner_wear")
            e.corner_wear_m_rad = size;
        else if (m == "wedge")
            e.wedge_rad = size;
        else if (m == "rate_damping")
            e.rate_s_m += size;
        else if (m == "face_damping") { // beside the joint's own dashpot, at the ends of the face
            const double own = joint.normal_damping_n_s_m;
            e.face_damping = (e.face_damping * own + size) / (own + size);
            joint.normal_damping_n_s_m = own + size;
        }
    }
    for (std::size_t b = 0; b < built.block.size(); ++b) {
        if (cause.block >= 0 && static_cast<std::size_t>(cause.block) != b)
            continue;
        Block& block = r.blocks[static_cast<std::size_t>(built.block[b])];
        if (m == "drag")
            (cause.parameter == "linear_n_s_m" ? block.mechanisms.drag_n_s_m : block.mechanisms.drag_n_s2_m2) = size;
        else if (m == "eccentricity")
            block.mechanisms.eccentricity_m = size;
        else if (m == "tie")
            tie_member(cause, block.mechanisms) = size;
    }
    r.with_mechanisms = true;
}

void carry_wear(const SizedCause& sized, const SpecimenStructure& built, const JointPath& before, Realization& r)
{
    if (!sized.cause.persists || sized.cause.joint < 0)
        return;
    const auto j = static_cast<std::size_t>(sized.cause.joint);
    Joint& joint = r.joints[static_cast<std::size_t>(built.bed[j])];
    JointMechanisms& e = joint.mechanisms;
    if (sized.cause.mechanism == "friction_wear") { // mu (1 - k (S0 + S)) = mu (1 - k S0) (1 - k S / (1 - k S0))
        const double left = std::max(1 - sized.size * before.slip_m[j], 0.0);
        joint.friction *= left;
        e.wear_per_m = left > 0 ? sized.size / left : 0;
    } else if (sized.cause.mechanism == "corner_wear") {
        e.chip_left_m += sized.size * before.rotation_rad[j];
        e.chip_right_m += sized.size * before.rotation_rad[j];
    }
}

void add_mechanism(const SizedCause& sized, const SpecimenStructure& built, Study& study)
{
    const Cause& cause = sized.cause;
    const std::optional<Mechanism> mechanism = mechanism_of(cause.mechanism);
    if (!mechanism)
        return;
    MechanismSpec spec = neutral_spec(*mechanism, study.contact.friction);
    if (cause.joint >= 0)
        spec.places = {built.bed[static_cast<std::size_t>(cause.joint)]};
    if (cause.block >= 0)
        spec.places = {built.block[static_cast<std::size_t>(cause.block)]};
    const double size = sized.size;
    switch (*mechanism) {
    case Mechanism::stribeck:
        set(spec, "dynamic_friction", size * study.contact.friction);
        set(spec, "velocity", cause.fixed);
        break;
    case Mechanism::corner_loss:
        set(spec, "left", cause.side == "right" ? 0 : size);
        set(spec, "right", cause.side == "left" ? 0 : size);
        break;
    case Mechanism::face_damping: // a study has no dashpot of one joint alone: that of the joint, at the ends
        set(spec, "share", 1);
        break;
    case Mechanism::dowel:
        set(spec, "stiffness", yields(cause) ? size / cause.fixed : size);
        set(spec, "yield", yields(cause) ? size : 1e9);
        set(spec, "gap", yields(cause) ? 0 : cause.fixed);
        break;
    case Mechanism::adhesion:
        set(spec, "force", size);
        set(spec, "tension", cause.fixed * size);
        break;
    case Mechanism::drag:
    case Mechanism::tie:
        for (std::size_t p = 0; p < rule_of(*mechanism).parameters.size(); ++p)
            if (rule_of(*mechanism).parameters[p].key() == cause.parameter)
                spec.values[p] = size;
        break;
    default:
        // one acting parameter: the first
        for (std::size_t p = 0; p < rule_of(*mechanism).parameters.size(); ++p)
            if (rule_of(*mechanism).parameters[p].role == ParameterRole::acting) {
                spec.values[p] = size;
                break;
            }
    }
    add(spec, study);
}

void add_distortion(const TableDistortion& distortion, double gain, Study& study)
{
    MechanismSpec spec = neutral_spec(Mechanism::harmonic_distortion, study.contact.friction);
    const std::vector<double>& size = distortion.size;
    if (distortion.polynomial) {
        set(spec, "second_quadrature", -size[0] / 2 / gain);
        set(spec, "third", -size[1] / 4 / gain);
    } else {
        set(spec, "second", size[0] / gain);
        set(spec, "second_quadrature", size[1] / gain);
        set(spec, "third", size[2] / gain);
        set(spec, "third_quadrature", size[3] / gain);
    }
    add(spec, study);
}

} // namespace stylobate
