#include "ensemble/planar/structure/builder.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace stylobate {

namespace {

/// The rotation of a base that is turned at a rate, which it takes up and gives up within about 0.2 s each.
Motion turning(const BaseMechanisms& base)
{
    constexpr double spacing_s = 0.1;
    const double time_s = std::abs(base.tilt_rad) / base.tilt_rate_rad_s;
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::round(time_s / spacing_s)));
    const double dt = time_s / static_cast<double>(pieces);
    std::vector<double> acceleration(pieces + 4, 0.0);
    acceleration[1] += std::copysign(base.tilt_rate_rad_s, base.tilt_rad) / dt;
    acceleration[1 + pieces] -= acceleration[1];
    return motion_of(std::move(acceleration), dt);
}

} // namespace

PlanarBuilder::PlanarBuilder(const Study& study)
    : study_(&study), layout_(lay_out(study.structure)), mechanisms_(study, layout_),
      nominal_(nominal_values(study, layout_, mechanisms_.acting())), restitution_(nominal_restitution(study, layout_))
{
    const bool watches = study.structure.kind == StructureKind::colonnade || study.outcome.follow == Follow::rest;
    has_ground_ = watches || std::any_of(layout_.beds.begin(), layout_.beds.end(),
                                         [](const PlacedBed& bed) { return bed.lower < 0; });
    if (watches)
        watch_pairs();
}

void PlanarBuilder::move(const Replica& replica, std::uint64_t original, Realization& realization) const
{
    const int moved = study_->design().replica_set->block;
    realization.blocks[static_cast<std::size_t>(moved)].x_m += replica.size;
    for (int j = 0; j < realization.beds(); ++j) {
        const Joint& bed = realization.joints[static_cast<std::size_t>(j)];
        if (bed.lower != moved && bed.upper != moved)
            continue;
        const Block& below = realization.blocks[static_cast<std::size_t>(bed.lower)];
        const Block& above = realization.blocks[static_cast<std::size_t>(bed.upper)];
        if (std::abs(above.x_m - below.x_m) >= above.half_width_m + below.half_width_m)
            throw InputError(fmt::format("twins.moves_m: displaced by {:g} m, {} of realization {} does not touch {} "
                                         "any more. Reduce the displacement.",
                                         replica.size, name(moved), original,
                                         name(bed.lower == moved ? bed.upper : bed.lower)));
    }
}

Realization PlanarBuilder::build(RealizationValues values, RealizationHeader header) const
{
    Realization realization{std::move(header), {}};
    realization.gravity_m_s2 = study_->structure.gravity_m_s2;
    realization.restitution_law = study_->contact.restitution_law;
    realization.initial_tilt_rad = study_->initial.tilt_rad;
    realization.initial_tilt_block = study_->initial.tilt_from_block;
    realization.initial_lift_m = study_->initial.lift_m;
    for (std::size_t i = 0; i < layout_.blocks.size(); ++i)
        values[Quantity::drum_offset][i] +=
            mechanisms_.offset_m(values, i) + (values.twin_m.empty() ? 0 : values.twin_m[i]);
    stack(values, realization);
    lay_epistyles(values, realization);
    realization.drums = static_cast<int>(layout_.blocks.size());
    if (has_ground_)
        realization.blocks.push_back(ground());
    join(values, realization);
    watch(values, realization);
    mechanisms_.apply(values, realization);
    if (realization.base.tilt_rad != 0)
        realization.tilt = std::make_shared<const Motion>(turning(realization.base));
    realization.base_tilt_rad = values[Quantity::tilt][0];
    return realization;
}

/// Every pair with a free block that shares no bed, by lower and upper block; the ground comes after all blocks.
void PlanarBuilder::watch_pairs()
{
    const int ground = static_cast<int>(layout_.blocks.size());
    std::set<std::pair<int, int>> beds;
    for (const PlacedBed& bed : layout_.beds)
        beds.emplace(bed.lower < 0 ? ground : bed.lower, bed.upper);
    const auto is_fixed = [&](int i) { return i == ground || layout_.blocks[static_cast<std::size_t>(i)].fixed; };
    for (int lower = 0; lower <= ground; ++lower)
        for (int upper = lower == ground ? 0 : lower + 1; upper < ground; ++upper)
            if (!(is_fixed(lower) && is_fixed(upper)) && !beds.contains({lower, upper}))
                watched_.emplace_back(lower, upper);
}

/// A block of the layout with its drawn sizes and mass, in its column's axis or its place along the colonnade.
Block PlanarBuilder::block(const RealizationValues& values, std::size_t i, double height_m) const
{
    const PlacedBlock& placed = layout_.blocks[i];
    const double width = values[Quantity::drum_width][i];
    const double density = placed.mass_kg / (placed.width_m * placed.height_m * study_->structure.depth_m);
    Block block;
    block.half_width_m = width / 2;
    block.half_height_m = height_m / 2;
    // the nominal mass times what has changed: without perturbation it is the nominal mass to the last bit
    block.mass_kg = placed.mass_kg * (values[Quantity::density][i] / density) * (width / placed.width_m) *
                    (height_m / placed.height_m);
    block.inertia_kg_m2 = block.mass_kg * (width * width + height_m * height_m) / 12;
    block.x_m = placed.axis_m + values[Quantity::drum_offset][i];
    block.fixed = placed.fixed;
    block.role = placed.role;
    block.column = placed.column;
    return block;
}

void PlanarBuilder::stack(const RealizationValues& values, Realization& realization) const
{
    for (const StackedDrum& of : stacked_drums(*study_, layout_, values, realization.index)) {
        Block drum = block(values, realization.blocks.size(), of.height_m);
        drum.y_m = of.bottom_m + of.height_m / 2;
        realization.blocks.push_back(drum);
    }
}

/// The epistyles, one after the other from the left, as they are laid: one that is too long for its place pushes the
/// next ones to the right.
void PlanarBuilder::lay_epistyles(const RealizationValues& values, Realization& realization) const
{
    for (std::size_t i = realization.blocks.size(); i < layout_.blocks.size(); ++i) {
        const double height = values[Quantity::drum_height][i];
        Block epistyle = block(values, i, height);
        epistyle.y_m = layout_.blocks[i].bottom() + height / 2;
        if (layout_.blocks[i - 1].role == BlockRole::epistyle) {
            const Block& before = realization.blocks.back();
            const bool side_by_side =
                std::abs(epistyle.y_m - before.y_m) < epistyle.half_height_m + before.half_height_m;
            const double gap = epistyle.x_m - before.x_m - epistyle.half_width_m - before.half_width_m;
            if (side_by_side && gap < 0)
                epistyle.x_m = before.x_m + before.half_width_m + epistyle.half_width_m;
        }
        realization.blocks.push_back(epistyle);
    }
}

/// A wide flat block with its top face at y = 0.
Block PlanarBuilder::ground() const
{
    double left = 0;
    double right = 0;
    double tallest = 0;
    std::size_t drums = 0;
    for (const PlacedBlock& block : layout_.blocks) {
        left = std::min(left, block.left());
        right = std::max(right, block.right());
        tallest = std::max(tallest, block.height_m);
    }
    for (const ColumnSpec& column : study_->structure.columns)
        drums = std::max(drums, column.drums.size());
    const std::size_t courses = drums + (study_->structure.epistyles.empty() ? 0 : 1);

    // so wide that fallen and sliding blocks stay on it
    Block ground;
    ground.half_width_m = 50 * std::max(right - left, static_cast<double>(courses) * tallest);
    ground.half_height_m = tallest;
    ground.mass_kg = layout_.blocks.front().mass_kg;
    ground.inertia_kg_m2 =
        ground.mass_kg * (ground.half_width_m * ground.half_width_m + ground.half_height_m * ground.half_height_m) / 3;
    ground.y_m = -ground.half_height_m;
    ground.fixed = true;
    ground.role = BlockRole::ground;
    ground.column = -1;
    return ground;
}

/// "drum 3 of column 2" or "the ground"
std::string PlanarBuilder::name(int block) const
{
    const auto i = static_cast<std::size_t>(block);
    return i < layout_.blocks.size() ? layout_.blocks[i].name : "the ground";
}

/// The contact of two blocks. @param value of each quantity: which of its values   @param chord_m full contact length
Joint PlanarBuilder::joint(const RealizationValues& values, const std::vector<Block>& blocks, int lower, int upper,
                           std::size_t value, double chord_m) const
{
    const ContactSpec& contact = study_->contact;
    const Block& below = blocks[static_cast<std::size_t>(lower)];
    const Block& above = blocks[static_cast<std::size_t>(upper)];
    const double mass = contact_mass_kg(below, above);
    const BedSpec own = value < layout_.beds.size() ? layout_.beds[value].bed : BedSpec{};
    const DampingRatios ratio = damping_ratios(*study_, values, own);
    Joint joint;
    joint.lower = lower;
    joint.upper = upper;
    joint.friction = values[Quantity::friction][value];
    joint.normal_stiffness_n_m2 = values[Quantity::normal_stiffness][value];
    joint.tangential_stiffness_n_m = values[Quantity::tangential_stiffness][value];
    joint.normal_damping_n_s_m = 2 * ratio.normal * std::sqrt(joint.normal_stiffness_n_m2 * chord_m * mass);
    joint.tangential_damping_n_s_m = 2 * ratio.tangential * std::sqrt(joint.tangential_stiffness_n_m * mass);
    if (contact.normal_damping_n_s_m && !own.normal_damping_ratio)
        joint.normal_damping_n_s_m = *contact.normal_damping_n_s_m;
    if (contact.tangential_damping_n_s_m && !own.tangential_damping_ratio)
        joint.tangential_damping_n_s_m = *contact.tangential_damping_n_s_m;
    joint.restitution = value < restitution_.size() ? restitution_[value] : contact.restitution;
    joint.damping_chord_m = contact.damping_per == DampingPer::chord ? chord_m : 0;
    return joint;
}

/// The beds.
void PlanarBuilder::join(const RealizationValues& values, Realization& realization) const
{
    const std::vector<Block>& blocks = realization.blocks;
    for (std::size_t j = 0; j < layout_.beds.size(); ++j) {
        const int upper = layout_.beds[j].upper;
        const int lower = layout_.beds[j].lower >= 0 ? layout_.beds[j].lower : realization.drums; // the ground
        const Block& below = blocks[static_cast<std::size_t>(lower)];
        const Block& above = blocks[static_cast<std::size_t>(upper)];
        const double apart = std::abs(above.x_m - below.x_m);
        const double reach = above.half_width_m + below.half_width_m;
        if (apart >= reach)
            throw InputError(fmt::format("perturbation.drum_offset: in realization {} {} lies at x = {:g} m and {} "
                                         "below it at {:g} m, and they do not touch. Lower sd_m, or set min and "
                                         "max well within half a drum's width ({:g} m).",
                                         realization.index, name(upper), above.x_m, name(lower), below.x_m,
                                         std::min(above.half_width_m, below.half_width_m)));
        // two epistyles share the seat on a column; a drum lies on a whole face
        const double face = 2 * std::min(below.half_width_m, above.half_width_m);
        const double chord = above.role == BlockRole::epistyle ? std::min(face, reach - apart) : face;
        realization.joints.push_back(joint(values, blocks, lower, upper, j, chord));
    }
}

/// Every other pair that can meet: a falling block may hit any other.
void PlanarBuilder::watch(const RealizationValues& values, Realization& realization) const
{
    const std::vector<Block>& blocks = realization.blocks;
    for (const auto& [lower, upper] : watched_) {
        const Block& a = blocks[static_cast<std::size_t>(lower)];
        const Block& b = blocks[static_cast<std::size_t>(upper)];
        const double wide = a.half_width_m + b.half_width_m - std::abs(a.x_m - b.x_m);
        const double high = a.half_height_m + b.half_height_m - std::abs(a.y_m - b.y_m);
        // the longest contact that the two can have: dashpots in proportion to the length reach their full value there
        const double chord = longest_contact_m(a, b);
        // rounding of sums of lengths aside
        if (std::min(wide, high) > 1e-9 * chord)
            throw InputError(fmt::format("perturbation: in realization {} {} and {} overlap by {:.3g} m at rest. Lower "
                                         "the spread of drum_width, drum_height and drum_offset, or give them room.",
                                         realization.index, name(lower), name(upper), std::min(wide, high)));
        Joint met = joint(values, blocks, lower, upper, layout_.beds.size(), chord);
        met.damping_chord_m = chord; // the contact of a corner must not have the dashpot of a face
        realization.joints.push_back(met);
    }
    realization.watched = static_cast<int>(watched_.size());
}

double PlanarBuilder::rigid_step_s(const Realization& realization) const
{
    constexpr double least_of_period = 20;
    const std::optional<double>& step_s = study_->run.step_s;
    const double f = realization.frequency_hz;
    if (step_s && *step_s * f * least_of_period > 1)
        throw InputError(fmt::format("run.step_s = {:g} is too long for the shaking of realization {}, {:.4g} Hz: a "
                                     "period has less than {:g} steps.\n  Give at most {:.3g}, or omit it: the step is "
                                     "then chosen by accuracy.",
                                     *step_s, realization.index, f, least_of_period, 1 / (least_of_period * f)));
    return step_s.value_or(stylobate::rigid_step_s(realization, study_->run.accuracy.value_or(usual_accuracy)));
}

double PlanarBuilder::step_s(const Realization& realization) const
{
    if (realization.form == ContactForm::rigid)
        return rigid_step_s(realization);
    StepBound bound =
        study_->outcome.follow == Follow::rest ? step_bound_to_rest(realization) : step_bound(realization);
    if (study_->run.step_bound == StepBasis::structure)
        bound = structure_step_bound(realization, bound);
    if (!study_->run.step_s)
        return study_->run.step_fraction * bound.dt_s;
    if (*study_->run.step_s > bound.dt_s && !study_->run.allow_step_above_bound)
        throw InputError(
            fmt::format("run.step_s = {:g} is above {:.6g} s, the safe bound of realization {} (set by the "
                        "{}); allowed: (0, {:.6g}].\n  Reduce it, or omit it: the step is then chosen for each "
                        "realization. If it is intended, set run.allow_step_above_bound = true.",
                        *study_->run.step_s, bound.dt_s, realization.index, to_string(bound.governed_by), bound.dt_s));
    return *study_->run.step_s;
}

} // namespace stylobate
