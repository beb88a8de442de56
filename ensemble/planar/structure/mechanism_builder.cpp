#include "ensemble/planar/structure/mechanism_builder.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/structure/bed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

namespace stylobate {
namespace {

/// Whether the kernels have it, and not the sampler or the base motion alone.
bool has_mechanism_rows(const MechanismRule& rule)
{
    return std::any_of(rule.parameters.begin(), rule.parameters.end(), [](const MechanismParameter& parameter) {
        return !std::holds_alternative<std::monostate>(parameter.member) &&
               !std::holds_alternative<double BaseChange::*>(parameter.member);
    });
}

/// Whether it needs the rows of strengthening.
bool has_strengthening_rows(const MechanismRule& rule)
{
    return rule.mechanism == Mechanism::mortar ||
           std::any_of(rule.parameters.begin(), rule.parameters.end(), [](const MechanismParameter& parameter) {
               return std::holds_alternative<double JointStrengthening::*>(parameter.member) ||
                      std::holds_alternative<double BlockStrengthening::*>(parameter.member);
           });
}

/// Whether it is adhesion that holds against opening: the rows of strengthening have its bond. Where none is given none
/// is drawn.
bool holds(const ActingMechanism& acting)
{
    for (std::size_t p = 0; p < acting.rule->parameters.size(); ++p) {
        const auto* member = std::get_if<double JointMechanisms::*>(&acting.rule->parameters[p].member);
        const std::vector<double>& values = acting.values[p];
        if (member && *member == &JointMechanisms::adhesion_tension_n_m)
            return std::any_of(values.begin(), values.end(), [](double value) { return value > 0; });
    }
    return false;
}

/// Sets the member of a realization that a parameter is.
void set(const MechanismParameter& parameter, std::size_t place, double value, Realization& realization)
{
    std::visit(
        [&](auto member) {
            using Member = decltype(member);
            if constexpr (std::is_same_v<Member, double JointMechanisms::*>)
                realization.joints[place].mechanisms.*member = value;
            else if constexpr (std::is_same_v<Member, double BlockMechanisms::*>)
                realization.blocks[place].mechanisms.*member = value;
            else if constexpr (std::is_same_v<Member, double JointStrengthening::*>)
                realization.joints[place].strengthening.*member = value;
            else if constexpr (std::is_same_v<Member, double BlockStrengthening::*>)
                realization.blocks[place].strengthening.*member = value;
            else if constexpr (std::is_same_v<Member, double BaseMechanisms::*>)
                realization.base.*member = value;
            else if constexpr (std::is_same_v<Member, double BaseChange::*>)
                realization.change.*member = value;
        },
        parameter.member);
}

/// What was drawn for a place does not contradict itself.
void check(const MechanismRule& rule, const RealizationValues& values, std::size_t mechanism, std::size_t place,
           std::uint64_t index)
{
    std::array<double, most_parameters> at{};
    for (std::size_t p = 0; p < rule.parameters.size(); ++p)
        at[p] = values.of(mechanism, p, place);
    if (const auto why = contradiction(rule, at))
        throw InputError(fmt::format("mechanisms.{}: in realization {} at {} {}: {}. Change the values, or limit their "
                                     "spread with min and max.",
                                     rule.name, index, rule.place == MechanismPlace::joint ? "joint" : "block", place,
                                     *why));
}

/// What was drawn fits into the blocks.
void check_room(const Realization& realization)
{
    for (int j = 0; j < realization.beds(); ++j) {
        const JointMechanisms& mechanisms = realization.joints[static_cast<std::size_t>(j)].mechanisms;
        const double lost = mechanisms.chip_left_m + mechanisms.chip_right_m, left = face_length_m(realization, j);
        if (lost > 0 && !(left > 0))
            throw InputError(fmt::format("mechanisms.corner_loss: in realization {} joint {} loses {:g} m of its face "
                                         "of {:g} m. Lower the values, or limit their spread with max.",
                                         realization.index, j, lost, left + lost));
    }
    for (std::size_t i = 0; i < realization.blocks.size(); ++i) {
        const Block& block = realization.blocks[i];
        if (!(std::abs(block.mechanisms.eccentricity_m) < block.half_width_m))
            throw InputError(fmt::format("mechanisms.eccentricity: in realization {} the centre of mass of block {} "
                                         "lies {:g} m from its middle, outside the block of {:g} m. Lower the value, "
                                         "or limit its spread with min and max.",
                                         realization.index, i, block.mechanisms.eccentricity_m,
                                         2 * block.half_width_m));
        const BlockStrengthening& clamp = block.strengthening;
        if (clamp.clamp_to < 0)
            continue;
        const Block& right = realization.blocks[static_cast<std::size_t>(clamp.clamp_to)];
        const double y = block.y_m + clamp.clamp_height_m;
        if (std::abs(y - block.y_m) > block.half_height_m || std::abs(y - right.y_m) > right.half_height_m)
            throw InputError(
                fmt::format("mechanisms.clamp: in realization {} the clamp of block {} is {:g} m above its "
                            "middle, outside one of the two blocks. Reduce height_m.",
                            realization.index, i, clamp.clamp_height_m));
    }
}

} // namespace

MechanismBuilder::MechanismBuilder(const Study& study, const Layout& layout)
    : acting_(acting_mechanisms(study, layout)), friction_(study.contact.friction), depth_m_(study.structure.depth_m),
      form_(study.contact.form), damped_at_ends_(study.contact.damping == DampingAt::ends && form_ == ContactForm::area)
{
    with_mechanisms_ = damped_at_ends_ || study.vertical.has_value();
    for (const ActingMechanism& acting : acting_) {
        with_mechanisms_ = with_mechanisms_ || (acting.may_act && has_mechanism_rows(*acting.rule));
        strengthened_ = strengthened_ || (acting.may_act && (has_strengthening_rows(*acting.rule) || holds(acting)));
    }
    for (std::size_t i = 0; i < layout.blocks.size(); ++i)
        right_.push_back(right_neighbour(layout, static_cast<int>(i)));
}

double MechanismBuilder::offset_m(const RealizationValues& values, std::size_t block) const
{
    for (std::size_t i = 0; i < acting_.size(); ++i)
        if (acting_[i].rule->mechanism == Mechanism::drum_offset)
            return values.of(i, 0, block);
    return 0;
}

void MechanismBuilder::apply(const RealizationValues& values, Realization& realization) const
{
    realization.with_mechanisms = with_mechanisms_ || strengthened_;
    realization.strengthened = strengthened_;
    realization.form = form_;
    if (damped_at_ends_) // the other forms have theirs there anyway
        for (Joint& joint : realization.joints)
            joint.mechanisms.face_damping = 1;
    for (std::size_t i = 0; i < acting_.size(); ++i) {
        const auto& [rule, at, nominal, may_act] = acting_[i];
        if (!may_act) // its details are without meaning
            continue;
        for (std::size_t place = 0; place < at.size(); ++place) {
            if (!at[place])
                continue;
            for (std::size_t p = 0; p < rule->parameters.size(); ++p)
                set(rule->parameters[p], place, values.of(i, p, place), realization);
            check(*rule, values, i, place, realization.index);
            if (rule->mechanism == Mechanism::clamp)
                realization.blocks[place].strengthening.clamp_to = right_[place];
            if (rule->place != MechanismPlace::joint)
                continue;
            Joint& joint = realization.joints[place];
            if (rule->mechanism == Mechanism::stribeck) {
                joint.mechanisms.dynamic_ratio = values.of(i, 0, place) / friction_;
            } else if (rule->mechanism == Mechanism::joint_friction) {
                joint.friction *= values.of(i, 0, place);
            } else if (rule->mechanism == Mechanism::mortar) {
                joint.strengthening.bond_tension_n_m = values.of(i, 0, place) * depth_m_;
                joint.strengthening.bond_cohesion_n_m = values.of(i, 1, place) * depth_m_;
            } else if (rule->mechanism == Mechanism::hertz) {
                const double given = values.of(i, 1, place);
                joint.mechanisms.reference_overlap_m2 =
                    given > 0 ? given : bed_load_n(realization, static_cast<int>(place)) / joint.normal_stiffness_n_m2;
            }
        }
    }
    check_room(realization);
}

} // namespace stylobate
