#include "ensemble/sampling/mechanism_sampler.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/structure/bed.hpp"

#include <fmt/format.h>

#include <algorithm>
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

} // namespace

Stream stream_of(Mechanism mechanism, std::size_t parameter)
{
    constexpr std::uint64_t room = 8; // for the parameters of one mechanism
    return static_cast<Stream>(static_cast<std::uint64_t>(Stream::mechanisms) +
                               room * static_cast<std::uint64_t>(mechanism) + parameter);
}

MechanismSampler::MechanismSampler(const Study& study, const Layout& layout)
    : friction_(study.contact.friction), depth_m_(study.structure.depth_m), damping_(study.contact.damping),
      form_(study.contact.form)
{
    with_mechanisms_ = (damping_ == DampingAt::ends && form_ == ContactForm::area) || study.vertical.has_value();
    for (const MechanismSpec& spec : study.mechanisms)
        add(spec, layout);
    for (const MechanismPerturbation& perturbation : study.mechanism_perturbations)
        add(perturbation);
    for (const Acting& acting : acting_) {
        with_mechanisms_ = with_mechanisms_ || (acting.may_act && has_mechanism_rows(*acting.rule));
        strengthened_ = strengthened_ || (acting.may_act && has_strengthening_rows(*acting.rule));
    }
    for (std::size_t i = 0; i < layout.blocks.size(); ++i)
        right_.push_back(right_neighbour(layout, static_cast<int>(i)));
}

void MechanismSampler::add(const MechanismSpec& spec, const Layout& layout)
{
    const MechanismRule& rule = rule_of(spec.mechanism);
    const std::size_t places = rule.place == MechanismPlace::joint   ? layout.beds.size()
                               : rule.place == MechanismPlace::block ? layout.blocks.size()
                                                                     : 1;
    auto acting = std::find_if(acting_.begin(), acting_.end(), [&](const Acting& a) { return a.rule == &rule; });
    if (acting == acting_.end()) {
        acting_.push_back({&rule, std::vector<bool>(places), false});
        const MechanismSpec neutral = neutral_spec(spec.mechanism, friction_);
        auto& values = nominal_.emplace_back();
        for (std::size_t p = 0; p < rule.parameters.size(); ++p)
            values[p].assign(places, neutral.values[p]);
        acting = acting_.end() - 1;
    }
    acting->may_act = acting->may_act || acts(spec, friction_);
    auto& values = nominal_[static_cast<std::size_t>(acting - acting_.begin())];
    const auto set_at = [&](std::size_t place) {
        acting->at[place] = true;
        for (std::size_t p = 0; p < rule.parameters.size(); ++p)
            values[p][place] = spec.values[p];
    };
    if (!spec.places.empty())
        for (const int place : spec.places)
            set_at(static_cast<std::size_t>(place));
    else if (rule.place == MechanismPlace::base)
        set_at(0);
    else
        for (const int place : usual_places(rule, layout))
            set_at(static_cast<std::size_t>(place));
}

void MechanismSampler::add(const MechanismPerturbation& perturbation)
{
    const MechanismRule& rule = rule_of(perturbation.mechanism);
    const MechanismParameter& parameter = rule.parameters[perturbation.parameter];
    const auto acting = std::find_if(acting_.begin(), acting_.end(), [&](const Acting& a) { return a.rule == &rule; });
    acting->may_act = true;
    const auto number = static_cast<std::size_t>(acting - acting_.begin());
    MechanismPerturbation within = perturbation;
    if (parameter.low >= 0) // a value below means nothing
        within.min = std::max(perturbation.min.value_or(parameter.low), parameter.low);

    const std::string name = input_name(rule.mechanism, parameter);
    const std::string key = fmt::format("perturbation.mechanisms.{}.{}", rule.name, parameter.key());
    Drawn drawn{number,
                perturbation.parameter,
                stream_of(rule.mechanism, perturbation.parameter),
                perturbation.per == Per::structure,
                {},
                {}};
    const std::vector<double>& values = nominal_[number][perturbation.parameter];
    for (std::size_t place = 0; place < values.size(); ++place) {
        if (!acting->at[place])
            continue;
        drawn.places.push_back(place);
        drawn.distributions.emplace_back(within, key, values[place]);
    }
    if (drawn.once || drawn.places.size() == 1)
        input_names_.push_back(name);
    else
        for (std::size_t place = 0; place < values.size(); ++place)
            input_names_.push_back(fmt::format("{}[{}]", name, place));
    drawn_.push_back(std::move(drawn));
}

std::vector<PointSet::Place> MechanismSampler::places(const Study& study) const
{
    std::vector<PointSet::Place> places;
    for (const Drawn& drawn : drawn_) {
        const MechanismRule& rule = *acting_[drawn.acting].rule;
        const int factor = study.design().factor(input_name(rule.mechanism, rule.parameters[drawn.parameter]));
        for (std::size_t i = 0; i < (drawn.once ? 1 : drawn.places.size()); ++i)
            places.push_back({drawn.stream, drawn.once ? 0 : drawn.places[i], factor});
    }
    return places;
}

MechanismSampler::Values MechanismSampler::draw(const PointSet& points, std::uint64_t index,
                                                std::vector<double>& inputs) const
{
    Values values = nominal_;
    for (const Drawn& drawn : drawn_) {
        std::vector<double>& target = values[drawn.acting][drawn.parameter];
        for (std::size_t i = 0; i < drawn.places.size(); ++i) {
            const std::size_t element = drawn.once ? 0 : drawn.places[i];
            target[drawn.places[i]] = drawn.distributions[i].value(points.uniform(index, drawn.stream, element));
        }
        if (drawn.once || drawn.places.size() == 1)
            inputs.push_back(target[drawn.places.front()]);
        else
            inputs.insert(inputs.end(), target.begin(), target.end());
    }
    return values;
}

double MechanismSampler::offset_m(const Values& values, std::size_t block) const
{
    for (std::size_t i = 0; i < acting_.size(); ++i)
        if (acting_[i].rule->mechanism == Mechanism::drum_offset)
            return values[i][0][block];
    return 0;
}

void MechanismSampler::apply(const Values& values, Realization& realization) const
{
    realization.with_mechanisms = with_mechanisms_ || strengthened_;
    realization.strengthened = strengthened_;
    realization.form = form_;
    if (damping_ == DampingAt::ends && form_ == ContactForm::area) // the other forms have theirs there anyway
        for (Joint& joint : realization.joints)
            joint.mechanisms.face_damping = 1;
    for (std::size_t i = 0; i < acting_.size(); ++i) {
        const auto& [rule, at, may_act] = acting_[i];
        if (!may_act) // its details are without meaning
            continue;
        for (std::size_t place = 0; place < at.size(); ++place) {
            if (!at[place])
                continue;
            for (std::size_t p = 0; p < rule->parameters.size(); ++p)
                set(rule->parameters[p], place, values[i][p][place], realization);
            check(*rule, values[i], place, realization.index);
            if (rule->mechanism == Mechanism::clamp)
                realization.blocks[place].strengthening.clamp_to = right_[place];
            if (rule->place != MechanismPlace::joint)
                continue;
            Joint& joint = realization.joints[place];
            if (rule->mechanism == Mechanism::stribeck) {
                joint.mechanisms.dynamic_ratio = values[i][0][place] / friction_;
            } else if (rule->mechanism == Mechanism::joint_friction) {
                joint.friction *= values[i][0][place];
            } else if (rule->mechanism == Mechanism::mortar) {
                joint.strengthening.bond_tension_n_m = values[i][0][place] * depth_m_;
                joint.strengthening.bond_cohesion_n_m = values[i][1][place] * depth_m_;
            } else if (rule->mechanism == Mechanism::hertz) {
                const double given = values[i][1][place];
                joint.mechanisms.reference_overlap_m2 =
                    given > 0 ? given : bed_load_n(realization, static_cast<int>(place)) / joint.normal_stiffness_n_m2;
            }
        }
    }
    check_room(realization);
}

/// What was drawn for a place does not contradict itself.
void MechanismSampler::check(const MechanismRule& rule, const Values::value_type& values, std::size_t place,
                             std::uint64_t index) const
{
    std::array<double, most_parameters> at{};
    for (std::size_t p = 0; p < rule.parameters.size(); ++p)
        at[p] = values[p][place];
    if (const std::string why = contradiction(rule, at); !why.empty())
        throw InputError(fmt::format("mechanisms.{}: in realization {} at {} {}: {}. Change the values, or limit their "
                                     "spread with min and max.",
                                     rule.name, index, rule.place == MechanismPlace::joint ? "joint" : "block", place,
                                     why));
}

/// What was drawn fits into the blocks.
void MechanismSampler::check_room(const Realization& realization) const
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

} // namespace stylobate
