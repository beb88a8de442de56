#include "ensemble/model/nominal.hpp"

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

} // namespace

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
        return of_beds(layout, &BedSpec::normal_stiffness_n_m2, contact.normal_stiffness_n_m2);
    case Quantity::tangential_stiffness:
        return of_beds(layout, &BedSpec::tangential_stiffness_n_m, contact.tangential_stiffness_n_m);
    case Quantity::damping_ratio:
        return {contact.normal_damping_ratio};
    case Quantity::drum_width:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.width_m; });
    case Quantity::drum_height:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.height_m; });
    case Quantity::drum_offset:
        return of_blocks(layout, [](const PlacedBlock& block) { return block.offset_m; });
    case Quantity::density:
        return of_blocks(layout, [&](const PlacedBlock& block) {
            return block.mass_kg / (block.width_m * block.height_m * structure.depth_m);
        });
    case Quantity::tilt:
        return {0};
    case Quantity::phase:
        return {study.excitation.phase_rad};
    case Quantity::pulse_frequency:
        return {study.excitation.frequency_hz};
    case Quantity::pulse_gamma:
        return {study.excitation.gamma};
    }
    return {0};
}

double nominal_tail_s(const StructureSpec& structure)
{
    double top = -std::numeric_limits<double>::infinity(), bottom = -top, widest = 0;
    for (const PlacedBlock& block : lay_out(structure).blocks) {
        if (block.fixed || block.role != BlockRole::drum)
            continue;
        top = std::max(top, block.top());
        bottom = std::min(bottom, block.bottom());
        widest = std::max(widest, block.width_m);
    }
    return 12 / std::sqrt(0.75 * structure.gravity_m_s2 / std::hypot(widest / 2, 0.5 * (top - bottom)));
}

double shaking_pause_s(const Study& study)
{
    return study.design().motions->pause_s.value_or(pause_tails * nominal_tail_s(study.structure));
}

} // namespace stylobate
