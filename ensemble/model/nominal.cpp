#include "ensemble/model/nominal.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/layout_in_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

std::vector<double> of_beds(const Layout& layout, std::optional<double> BedSpec::*own, double common)
{
    std::vector<double> values;
    for (const PlacedBed& bed : layout.beds)
        values.push_back((bed.bed.*own).value_or(common));
    return values;
}

template <class Value>
std::vector<double> of_blocks(const Layout& layout, Value&& value)
{
    std::vector<double> values;
    for (const PlacedBlock& block : layout.blocks)
        values.push_back(value(block));
    return values;
}

void add(const MechanismSpec& spec, const Layout& layout, double friction, std::vector<ActingMechanism>& all)
{
    const MechanismRule& rule = rule_of(spec.mechanism);
    auto acting = std::find_if(all.begin(), all.end(), [&](const ActingMechanism& a) { return a.rule == &rule; });
    if (acting == all.end()) {
        const std::size_t places = rule.place == MechanismPlace::joint   ? layout.beds.size()
                                   : rule.place == MechanismPlace::block ? layout.blocks.size()
                                                                         : 1;
        const MechanismSpec neutral = neutral_spec(spec.mechanism, friction);
        ActingMechanism& one = all.emplace_back(ActingMechanism{&rule, std::vector<bool>(places), {}});
        for (std::size_t p = 0; p < rule.parameters.size(); ++p)
            one.values[p].assign(places, neutral.values[p]);
        acting = all.end() - 1;
    }
    acting->may_act = acting->may_act || acts(spec, friction);
    std::vector<int> places = spec.places;
    if (places.empty())
        places = rule.place == MechanismPlace::base ? std::vector<int>{0} : usual_places(rule, layout);
    for (const int place : places) {
        acting->at[static_cast<std::size_t>(place)] = true;
        for (std::size_t p = 0; p < rule.parameters.size(); ++p)
            acting->values[p][static_cast<std::size_t>(place)] = spec.values[p];
    }
}

} // namespace

std::vector<ActingMechanism> acting_mechanisms(const Study& study, const Layout& layout)
{
    std::vector<ActingMechanism> all;
    for (const MechanismSpec& spec : study.mechanisms)
        add(spec, layout, study.contact.friction, all);
    for (const MechanismPerturbation& perturbation : study.mechanism_perturbations)
        std::find_if(all.begin(), all.end(), [&](const ActingMechanism& a) {
            return a.rule->mechanism == perturbation.mechanism;
        })->may_act = true;
    return all;
}

RealizationValues nominal_values(const Study& study, const Layout& layout,
                                 const std::vector<ActingMechanism>& mechanisms)
{
    RealizationValues values;
    for (int q = 0; q < quantity_count; ++q)
        values.all.push_back(nominal_values(study, layout, static_cast<Quantity>(q)));
    values[Quantity::friction].push_back(study.contact.friction);
    const ContactSpec& contact = study.contact;
    const bool spatial = study.structure.spatial();
    values[Quantity::normal_stiffness].push_back(spatial ? contact.normal_stiffness_n_m3
                                                         : contact.normal_stiffness_n_m2);
    values[Quantity::tangential_stiffness].push_back(spatial ? contact.tangential_stiffness_n_m3
                                                             : contact.tangential_stiffness_n_m);
    for (const ActingMechanism& mechanism : mechanisms)
        values.all.insert(values.all.end(), mechanism.values.begin(), mechanism.values.end());
    return values;
}

DampingRatios damping_ratios(const Study& study, const RealizationValues& values, const BedSpec& own)
{
    const ContactSpec& contact = study.contact;
    DampingRatios ratio{values[Quantity::damping_ratio][0], contact.tangential_damping_ratio};
    double changed = 1;
    for (const Perturbation& perturbation : study.perturbations) {
        if (perturbation.quantity != Quantity::damping_ratio)
            continue;
        const bool replaces = perturbation.distribution == DistributionKind::uniform ||
                              perturbation.distribution == DistributionKind::log_uniform;
        if (!replaces && contact.normal_damping_ratio != 0)
            changed = ratio.normal / contact.normal_damping_ratio;
        ratio.tangential = replaces || contact.normal_damping_ratio == 0 ? ratio.normal : ratio.tangential * changed;
    }
    if (own.normal_damping_ratio)
        ratio.normal = *own.normal_damping_ratio * changed;
    if (own.tangential_damping_ratio)
        ratio.tangential = *own.tangential_damping_ratio * changed;
    return ratio;
}

std::vector<double> nominal_restitution(const Study& study, const Layout& layout)
{
    return of_beds(layout, &BedSpec::restitution, study.contact.restitution);
}

std::vector<double> nominal_values(const Study& study, const Layout& layout, Quantity quantity)
{
    const StructureSpec& structure = study.structure;
    const ContactSpec& contact = study.contact;
    switch (quantity) {
    case Quantity::friction:
        return of_beds(layout, &BedSpec::friction, contact.friction);
    case Quantity::normal_stiffness:
        return structure.spatial() ? of_beds(layout, &BedSpec::normal_stiffness_n_m3, contact.normal_stiffness_n_m3)
                                   : of_beds(layout, &BedSpec::normal_stiffness_n_m2, contact.normal_stiffness_n_m2);
    case Quantity::tangential_stiffness:
        return structure.spatial()
                   ? of_beds(layout, &BedSpec::tangential_stiffness_n_m3, contact.tangential_stiffness_n_m3)
                   : of_beds(layout, &BedSpec::tangential_stiffness_n_m, contact.tangential_stiffness_n_m);
    case Quantity::damping_ratio:
        return {contact.normal_damping_ratio};
    case Quantity::drum_width:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.drawn_width_m(); });
    case Quantity::drum_height:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.height_m; });
    case Quantity::drum_offset:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.offset_m; });
    case Quantity::density:
        return of_blocks(layout, [&](const PlacedBlock& block) { return block.mass_kg / volume_m3(structure, block); });
    case Quantity::tilt:
    case Quantity::tilt_x:
        return {0};
    case Quantity::phase:
        return {study.excitation.phase_rad};
    case Quantity::pulse_frequency:
        return {study.excitation.frequency_hz};
    case Quantity::pulse_gamma:
        return {study.excitation.gamma};
    case Quantity::direction:
        return {study.excitation.direction_deg};
    case Quantity::drum_offset_z:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.offset_z_m; });
    }
    return {0};
}

std::vector<StackedDrum> stacked_drums(const Study& study, const Layout& layout, const RealizationValues& values,
                                       std::uint64_t index)
{
    const bool dressed = study.structure.kind == StructureKind::colonnade &&
                         std::any_of(study.perturbations.begin(), study.perturbations.end(),
                                     [](const Perturbation& p) { return p.quantity == Quantity::drum_height; });
    const std::vector<PlacedBlock>& blocks = layout.blocks;
    std::vector<StackedDrum> drums;
    double top = 0;
    for (std::size_t i = 0; i < blocks.size() && blocks[i].role == BlockRole::drum; ++i) {
        if (i > 0 && blocks[i].column != blocks[i - 1].column)
            top = 0;
        const bool topmost = i + 1 == blocks.size() || blocks[i + 1].column != blocks[i].column;
        double height = values[Quantity::drum_height][i];
        if (dressed && topmost) {
            height = blocks[i].top() - top;
            if (height < blocks[i].height_m / 2)
                throw InputError(fmt::format("perturbation.drum_height: in realization {} the drums of column {} leave "
                                             "{:g} m for {}, less than half of its {:g} m: the columns of a colonnade "
                                             "have equal heights. Reduce its spread, or limit it with min and max.",
                                             index, blocks[i].column + 1, height, blocks[i].name, blocks[i].height_m));
        }
        drums.push_back({top, height});
        top += height;
    }
    return drums;
}

std::vector<double> static_sinkage_m(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const double ground = std::numeric_limits<double>::infinity();
    std::vector<double> carried(layout.blocks.size(), 0.0); // weight on top of each block
    std::vector<int> seats(layout.blocks.size(), 0);
    for (const PlacedBed& bed : layout.beds)
        ++seats[static_cast<std::size_t>(bed.upper)];
    std::vector<double> sinkage(layout.beds.size());
    for (std::size_t i = layout.beds.size(); i-- > 0;) { // from the epistyles down
        const PlacedBed& bed = layout.beds[i];
        const PlacedBlock& upper = layout.blocks[static_cast<std::size_t>(bed.upper)];
        const auto at = static_cast<std::size_t>(bed.upper);
        const double weight = (upper.mass_kg * study.structure.gravity_m_s2 + carried[at]) / seats[at];
        double left = -ground, right = ground;
        if (bed.lower >= 0)
            carried[static_cast<std::size_t>(bed.lower)] += weight;
        if (study.structure.spatial()) {
            sinkage[i] = weight / (bed.bed.normal_stiffness_n_m3.value_or(study.contact.normal_stiffness_n_m3) *
                                   bed_in_plan(layout, bed).area_m2);
            continue;
        }
        if (bed.lower >= 0) {
            const PlacedBlock& lower = layout.blocks[static_cast<std::size_t>(bed.lower)];
            left = lower.left();
            right = lower.right();
        }
        const double length = std::min(right, upper.right()) - std::max(left, upper.left());
        sinkage[i] = weight / (bed.bed.normal_stiffness_n_m2.value_or(study.contact.normal_stiffness_n_m2) * length);
    }
    return sinkage;
}

double nominal_tail_s(const StructureSpec& structure)
{
    double top = -std::numeric_limits<double>::infinity(), bottom = -top, widest = 0;
    for (const PlacedBlock& block : lay_out(structure).blocks) {
        if (block.fixed || block.role != BlockRole::drum)
            continue;
        top = std::max(top, block.top());
        bottom = std::min(bottom, block.bottom());
        widest = std::max({widest, block.width_m, block.depth_m}); // in the plane a placed block has no depth
    }
    return 12 / std::sqrt(0.75 * structure.gravity_m_s2 / std::hypot(widest / 2, 0.5 * (top - bottom)));
}

double shaking_pause_s(const Study& study)
{
    return study.design().motions->pause_s.value_or(pause_tails * nominal_tail_s(study.structure));
}

} // namespace stylobate
