#include "ensemble/sampler.hpp"

#include "ensemble/input_error.hpp"
#include "ensemble/step_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace stylobate {
namespace {

Stream stream_of(Quantity quantity)
{
    switch (quantity) {
    case Quantity::friction:
        return Stream::friction;
    case Quantity::normal_stiffness:
        return Stream::normal_stiffness;
    case Quantity::tangential_stiffness:
        return Stream::tangential_stiffness;
    case Quantity::damping_ratio:
        return Stream::damping_ratio;
    case Quantity::drum_width:
        return Stream::drum_width;
    case Quantity::drum_height:
        return Stream::drum_height;
    case Quantity::drum_offset:
        return Stream::drum_offset;
    case Quantity::density:
        return Stream::density;
    case Quantity::tilt:
        return Stream::tilt;
    case Quantity::phase:
        return Stream::phase;
    }
    throw std::invalid_argument("a quantity that is not in the enumeration");
}

/// Quantities of which a value below 0 means nothing.
bool is_positive(Quantity quantity)
{
    return quantity != Quantity::drum_offset && quantity != Quantity::tilt && quantity != Quantity::phase;
}

/// A value that is drawn as a whole takes the place of the nominal one.
bool replaces(const Perturbation& perturbation)
{
    return perturbation.distribution == DistributionKind::uniform ||
           perturbation.distribution == DistributionKind::log_uniform;
}

} // namespace

/// Each quantity of one realization, joint by joint, block by block, or once.
struct Sampler::Values {
    std::array<std::vector<double>, quantity_count> of;

    const std::vector<double>& operator[](Quantity quantity) const { return of[static_cast<std::size_t>(quantity)]; }
};

Sampler::Sampler(const Study& study, const Motion* record) : study_(study)
{
    if (study.excitation.kind == ExcitationKind::record) {
        if (record == nullptr || record->empty())
            throw std::invalid_argument("a study with a record was given no base motion");
        record_frequency_hz_ = record->predominant_frequency_hz / study.excitation.time_scale;
        record_pga_m_s2_ = record->pga_m_s2;
    }
    for (Perturbation perturbation : study.perturbations) {
        const Quantity quantity = perturbation.quantity;
        const std::size_t draws = perturbation.per == Per::structure ? 1 : count(quantity);
        if (is_positive(quantity))
            perturbation.min = std::max(perturbation.min.value_or(0), 0.0);
        drawn_.push_back({quantity, stream_of(quantity), draws, Distribution(perturbation, nominal(quantity))});
        for (std::size_t i = 0; i < draws; ++i)
            input_names_.push_back(perturbation.per == Per::structure ? std::string(to_string(quantity))
                                                                      : fmt::format("{}[{}]", to_string(quantity), i));
    }
}

Realization Sampler::realization(std::uint64_t index) const
{
    assert(index < study_.total() && "the index is one of the study's");
    Realization realization;
    realization.index = index;
    realization.gravity_m_s2 = study_.structure.gravity_m_s2;
    realization.initial_tilt_rad = study_.initial.tilt_rad;
    const Values values = draw(index, realization.inputs);
    stack(values, realization);
    join(values, realization);
    shake(values, realization);
    realization.step_s = step(realization);
    return realization;
}

std::size_t Sampler::count(Quantity quantity) const
{
    switch (quantity) {
    case Quantity::friction:
    case Quantity::normal_stiffness:
    case Quantity::tangential_stiffness: // each free drum stands on one joint
        return static_cast<std::size_t>(study_.structure.blocks - study_.structure.fixed_blocks);
    case Quantity::drum_width:
    case Quantity::drum_height:
    case Quantity::drum_offset:
    case Quantity::density:
        return static_cast<std::size_t>(study_.structure.blocks);
    case Quantity::damping_ratio:
    case Quantity::tilt:
    case Quantity::phase:
        break;
    }
    return 1;
}

double Sampler::nominal(Quantity quantity) const
{
    const StructureSpec& structure = study_.structure;
    switch (quantity) {
    case Quantity::friction:
        return study_.contact.friction;
    case Quantity::normal_stiffness:
        return study_.contact.normal_stiffness_n_m2;
    case Quantity::tangential_stiffness:
        return study_.contact.tangential_stiffness_n_m;
    case Quantity::damping_ratio:
        return study_.contact.normal_damping_ratio;
    case Quantity::drum_width:
        return structure.drum_width_m;
    case Quantity::drum_height:
        return structure.drum_height_m;
    case Quantity::density:
        return structure.drum_mass_kg / (structure.drum_width_m * structure.drum_height_m * structure.depth_m);
    case Quantity::phase:
        return study_.excitation.phase_rad;
    case Quantity::drum_offset:
    case Quantity::tilt:
        break;
    }
    return 0;
}

Sampler::Values Sampler::draw(std::uint64_t index, std::vector<double>& inputs) const
{
    Values values;
    for (int q = 0; q < quantity_count; ++q) {
        const auto quantity = static_cast<Quantity>(q);
        values.of[static_cast<std::size_t>(q)].assign(count(quantity), nominal(quantity));
    }
    for (const Drawn& drawn : drawn_) {
        std::vector<double>& target = values.of[static_cast<std::size_t>(drawn.quantity)];
        for (std::size_t i = 0; i < drawn.draws; ++i) {
            const double value = drawn.distribution.value(uniform01(study_.seed, index, drawn.stream, i));
            inputs.push_back(value);
            if (drawn.draws == target.size())
                target[i] = value;
            else
                target.assign(target.size(), value);
        }
    }
    return values;
}

void Sampler::stack(const Values& values, Realization& realization) const
{
    const StructureSpec& structure = study_.structure;
    const double density = nominal(Quantity::density);
    double top = 0;
    for (std::size_t i = 0; i < count(Quantity::drum_width); ++i) {
        const double width = values[Quantity::drum_width][i];
        const double height = values[Quantity::drum_height][i];
        Block block;
        block.half_width_m = width / 2;
        block.half_height_m = height / 2;
        // the nominal mass times what has changed: without perturbation it is the nominal mass to the last bit
        block.mass_kg = structure.drum_mass_kg * (values[Quantity::density][i] / density) *
                        (width / structure.drum_width_m) * (height / structure.drum_height_m);
        block.inertia_kg_m2 = block.mass_kg * (width * width + height * height) / 12;
        block.x_m = values[Quantity::drum_offset][i];
        block.y_m = top + height / 2;
        block.fixed = static_cast<int>(i) < structure.fixed_blocks;
        realization.blocks.push_back(block);
        top += height;
    }
    realization.drums = structure.blocks;

    if (structure.fixed_blocks == 0) {
        // so wide that a column that has fallen and slid still lies on it
        Block ground;
        ground.half_width_m = 50 * std::max(structure.drum_width_m, structure.blocks * structure.drum_height_m);
        ground.half_height_m = structure.drum_height_m;
        ground.mass_kg = structure.drum_mass_kg;
        ground.inertia_kg_m2 =
            ground.mass_kg * (ground.half_width_m * ground.half_width_m + ground.half_height_m * ground.half_height_m) /
            3;
        ground.y_m = -ground.half_height_m;
        ground.fixed = true;
        realization.blocks.push_back(ground);
    }
}

void Sampler::join(const Values& values, Realization& realization) const
{
    const ContactSpec& contact = study_.contact;
    const std::vector<Block>& blocks = realization.blocks;

    // The ratio that is drawn is the normal one. A value that takes the nominal one's place is that of both; a change
    // of the nominal one changes both in proportion.
    const double ratio_n = values[Quantity::damping_ratio][0];
    double ratio_t = contact.tangential_damping_ratio;
    for (const Perturbation& perturbation : study_.perturbations)
        if (perturbation.quantity == Quantity::damping_ratio)
            ratio_t = replaces(perturbation) || contact.normal_damping_ratio == 0
                          ? ratio_n
                          : ratio_t * (ratio_n / contact.normal_damping_ratio);

    for (std::size_t j = 0; j < count(Quantity::friction); ++j) {
        Joint joint;
        joint.upper = study_.structure.fixed_blocks + static_cast<int>(j);
        joint.lower = joint.upper > 0 ? joint.upper - 1 : realization.drums; // the lowest drum stands on the ground
        const Block& lower = blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = blocks[static_cast<std::size_t>(joint.upper)];
        const double chord = 2 * std::min(lower.half_width_m, upper.half_width_m);
        if (std::abs(upper.x_m - lower.x_m) >= upper.half_width_m + lower.half_width_m)
            throw InputError(
                fmt::format("perturbation.drum_offset: in realization {} drum {} lies at x = {:g} m and the "
                            "one below it at {:g} m, and they do not touch. Lower sd_m, or set min_m and "
                            "max_m well within half the drum's width ({:g} m).",
                            realization.index, joint.upper, upper.x_m, lower.x_m, study_.structure.drum_width_m / 2));
        const double mass = lower.fixed ? upper.mass_kg : std::min(lower.mass_kg, upper.mass_kg);

        joint.friction = values[Quantity::friction][j];
        joint.normal_stiffness_n_m2 = values[Quantity::normal_stiffness][j];
        joint.tangential_stiffness_n_m = values[Quantity::tangential_stiffness][j];
        joint.normal_damping_n_s_m =
            contact.normal_damping_n_s_m.value_or(2 * ratio_n * std::sqrt(joint.normal_stiffness_n_m2 * chord * mass));
        joint.tangential_damping_n_s_m =
            contact.tangential_damping_n_s_m.value_or(2 * ratio_t * std::sqrt(joint.tangential_stiffness_n_m * mass));
        joint.damping_chord_m = contact.damping_per == DampingPer::chord ? chord : 0;
        realization.joints.push_back(joint);
    }
}

void Sampler::shake(const Values& values, Realization& realization) const
{
    const ExcitationSpec& excitation = study_.excitation;
    realization.base_tilt_rad = values[Quantity::tilt][0];
    realization.phase_rad = values[Quantity::phase][0];
    if (study_.surface) {
        const auto cell = static_cast<int>(study_.cell(realization.index));
        realization.frequency_hz = study_.surface->frequency_hz.value(cell / study_.surface->pga_m_s2.count);
        realization.pga_m_s2 = study_.surface->pga_m_s2.value(cell % study_.surface->pga_m_s2.count);
        return;
    }
    switch (excitation.kind) {
    case ExcitationKind::none:
        break;
    case ExcitationKind::harmonic:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        realization.frequency_hz = excitation.frequency_hz;
        realization.pga_m_s2 = excitation.pga_m_s2;
        break;
    case ExcitationKind::record:
        realization.frequency_hz = record_frequency_hz_;
        realization.pga_m_s2 = excitation.pga_m_s2 > 0 ? excitation.pga_m_s2 : record_pga_m_s2_;
        break;
    }
}

double Sampler::step(const Realization& realization) const
{
    const StepBound bound = step_bound(realization.blocks, realization.joints);
    if (!study_.run.step_s)
        return study_.run.step_fraction * bound.dt_s;
    if (*study_.run.step_s > bound.dt_s && !study_.run.allow_step_above_bound)
        throw InputError(
            fmt::format("run.step_s = {:g} is above {:.6g} s, the safe bound of realization {} (set by the "
                        "{}); allowed: (0, {:.6g}].\n  Lower it, or leave it out: the step is then chosen "
                        "for each realization. If it is meant, set run.allow_step_above_bound = true.",
                        *study_.run.step_s, bound.dt_s, realization.index, to_string(bound.governed_by), bound.dt_s));
    return *study_.run.step_s;
}

} // namespace stylobate
