#include "ensemble/spatial/structure/builder.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/plan_face.hpp"
#include "ensemble/spatial/structure/step_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

namespace stylobate {
namespace {

/// Sums of lengths as people write them differ by rounding, by less than this part of them.
constexpr double rounding = 1e-9;

/// Where a solid stands, seen from above.
PlanFace in_plan(const Solid& solid, const Face& face)
{
    const std::array<double, 3> middle = solid.middle_m();
    return {face.round, middle[0], middle[2], face.half_x_m, face.half_z_m};
}

/// Its outline, at its widest.
PlanFace outline(const Solid& solid)
{
    return in_plan(solid, solid.bottom.half_x_m > solid.top.half_x_m ? solid.bottom : solid.top);
}

Face face_of(const Frustum& frustum, double ratio)
{
    return {frustum.shape == Shape::round, ratio * frustum.width_m / 2, ratio * frustum.depth_m / 2};
}

/// Of an echinus the disc at its bottom.
Face bottom_of(const Frustum& frustum)
{
    const double radius = frustum.echinus_ratio * frustum.width_m / 2;
    return frustum.echinus_part > 0 ? Face{true, radius, radius} : face_of(frustum, 1);
}

/// Along x or z, as an index of a vector.
std::size_t index_of(Along along)
{
    return along == Along::z ? 2 : 0;
}

double half_along(const Solid& solid, std::size_t axis)
{
    return axis == 0 ? solid.bottom.half_x_m : axis == 1 ? solid.height_m / 2 : solid.bottom.half_z_m;
}

/// How far two blocks overlap along an axis at rest; below 0: a gap.
double overlap_along(const Solid& a, const Solid& b, std::size_t axis)
{
    return half_along(a, axis) + half_along(b, axis) - std::abs(a.middle_m()[axis] - b.middle_m()[axis]);
}

double contact_mass(const Solid& below, const Solid& above)
{
    return below.fixed ? above.mass_kg : above.fixed ? below.mass_kg : std::min(below.mass_kg, above.mass_kg);
}

/// Sets the member of a structure that a parameter is.
void set_member(const MechanismParameter& parameter, std::size_t place, double value, Realization& realization)
{
    if (const auto* joint = std::get_if<double JointMechanisms::*>(&parameter.member))
        realization.space.joints[place].mechanisms.** joint = value;
    else if (const auto* block = std::get_if<double BlockMechanisms::*>(&parameter.member))
        realization.space.solids[place].mechanisms.** block = value;
    else if (const auto* change = std::get_if<double BaseChange::*>(&parameter.member))
        realization.change.** change = value;
}

/// Whether the step of a realization needs rows for it: the others are values of bodies, joints and the base.
bool has_rows(Mechanism mechanism)
{
    switch (mechanism) {
    case Mechanism::stribeck:
    case Mechanism::face_damping:
    case Mechanism::friction_wear:
    case Mechanism::adhesion:
    case Mechanism::dowel:
    case Mechanism::wedge:
    case Mechanism::tie:
        return true;
    default:
        return false;
    }
}

} // namespace

SpatialBuilder::SpatialBuilder(const Study& study)
    : study_(&study), layout_(lay_out(study.structure)), mechanisms_(acting_mechanisms(study, layout_)),
      nominal_(nominal_values(study, layout_, mechanisms_)),
      has_ground_(
          std::any_of(layout_.beds.begin(), layout_.beds.end(), [](const PlacedBed& bed) { return bed.lower < 0; }))
{
    for (const ActingMechanism& acting : mechanisms_)
        if (acting.rule->models == MechanismModels::planar)
            throw InputError(fmt::format("mechanisms.{}: is not available with structure.dimensions = 3. Remove it.",
                                         acting.rule->name));
    with_mechanisms_ = study.contact.damping == DampingAt::ends ||
                       std::any_of(mechanisms_.begin(), mechanisms_.end(), [](const ActingMechanism& acting) {
                           return acting.may_act && has_rows(acting.rule->mechanism);
                       });
}

Realization SpatialBuilder::build(RealizationValues values, RealizationHeader header) const
{
    Realization realization{std::move(header), {}, {}};
    realization.gravity_m_s2 = study_->structure.gravity_m_s2;
    realization.space.initial_tilt_rad = study_->initial.tilt_rad;
    realization.space.initial_tilt_direction_rad = study_->initial.tilt_direction_rad;
    realization.space.initial_tilt_block = study_->initial.tilt_from_block;
    realization.space.with_mechanisms = with_mechanisms_;
    realization.space.base_tilt_rad = {values[Quantity::tilt][0], values[Quantity::tilt_x][0]};
    const auto moved = std::find_if(mechanisms_.begin(), mechanisms_.end(), [](const ActingMechanism& acting) {
        return acting.rule->mechanism == Mechanism::drum_offset;
    });
    for (std::size_t i = 0; i < layout_.blocks.size(); ++i) {
        if (moved != mechanisms_.end()) {
            const auto m = static_cast<std::size_t>(moved - mechanisms_.begin());
            values[Quantity::drum_offset][i] += values.of(m, 0, i);
            values[Quantity::drum_offset_z][i] += values.of(m, 1, i);
        }
        if (!values.twin_m.empty())
            values[Quantity::drum_offset][i] += values.twin_m[i];
    }
    stack(values, realization);
    lay_epistyles(values, realization);
    realization.space.drums = static_cast<int>(layout_.blocks.size());
    if (has_ground_)
        realization.space.solids.push_back(ground());
    join(values, realization);
    butt(values, realization);
    check_overlaps(realization);
    apply_mechanisms(values, realization);
    return realization;
}

/// A block of the layout with its drawn sizes and mass, in its column's axis or its place along the colonnade.
Solid SpatialBuilder::solid(const RealizationValues& values, std::size_t i, double height_m, double bottom_m) const
{
    const PlacedBlock& placed = layout_.blocks[i];
    const double scale = values[Quantity::drum_width][i] / placed.drawn_width_m();
    const bool epistyle = placed.role == BlockRole::epistyle; // only its length is drawn
    Frustum frustum = placed.frustum();
    frustum.height_m = height_m;
    frustum.width_m *= epistyle && placed.along == Along::z ? 1 : scale;
    frustum.depth_m *= epistyle && placed.along == Along::x ? 1 : scale;
    const double nominal_volume = placed.frustum().volume_m3();

    Solid solid;
    solid.bottom = bottom_of(frustum);
    solid.top = face_of(frustum, frustum.top_ratio);
    solid.height_m = height_m;
    // the nominal mass times what has changed: without perturbation it is the nominal mass to the last bit
    solid.mass_kg = placed.mass_kg * (values[Quantity::density][i] / (placed.mass_kg / nominal_volume)) *
                    (frustum.volume_m3() / nominal_volume);
    const std::array<double, 3> inertia = frustum.inertia_per_mass_m2();
    for (std::size_t axis = 0; axis < 3; ++axis)
        solid.inertia_kg_m2[axis] = solid.mass_kg * inertia[axis];
    solid.centre_height_m = frustum.centre_height_m();
    solid.centre_m = {placed.axis_m + values[Quantity::drum_offset][i], bottom_m + solid.centre_height_m,
                      placed.axis_z_m + values[Quantity::drum_offset_z][i]};
    solid.fixed = placed.fixed;
    solid.role = placed.role;
    solid.column = placed.column;
    return solid;
}

void SpatialBuilder::stack(const RealizationValues& values, Realization& realization) const
{
    std::vector<Solid>& solids = realization.space.solids;
    for (const StackedDrum& of : stacked_drums(*study_, layout_, values, realization.index))
        solids.push_back(solid(values, solids.size(), of.height_m, of.bottom_m));
}

/// The epistyles, as they are laid one after the other along each line, in the direction of its axis, and abreast of
/// each other: one that is too long or too wide for its place pushes the next ones.
void SpatialBuilder::lay_epistyles(const RealizationValues& values, Realization& realization) const
{
    std::vector<Solid>& solids = realization.space.solids;
    const std::size_t first = solids.size();
    for (std::size_t i = first; i < layout_.blocks.size(); ++i)
        solids.push_back(solid(values, i, values[Quantity::drum_height][i], layout_.blocks[i].bottom()));
    std::vector<std::size_t> order(solids.size() - first);
    std::iota(order.begin(), order.end(), first);
    const auto nominal = [&](std::size_t i, std::size_t axis) {
        const PlacedBlock& block = layout_.blocks[i];
        return axis == 0 ? std::pair(block.x_m(), block.width_m / 2) : std::pair(block.z_m(), block.depth_m / 2);
    };
    const auto place = [&](std::size_t i) {
        const std::size_t axis = index_of(layout_.blocks[i].along);
        return std::pair(nominal(i, axis).first, nominal(i, 2 - axis).first);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    // where they are meant to lie apart
    const auto apart = [&](std::size_t a, std::size_t b, std::size_t axis) {
        const auto [at_a, half_a] = nominal(a, axis);
        const auto [at_b, half_b] = nominal(b, axis);
        return std::abs(at_a - at_b) >= (half_a + half_b) * (1 - rounding);
    };
    for (std::size_t k = 1; k < order.size(); ++k)
        for (std::size_t before = 0; before < k; ++before) {
            Solid& pushed = solids[order[k]];
            const Solid& other = solids[order[before]];
            const Along along = layout_.blocks[order[k]].along;
            if (along != layout_.blocks[order[before]].along || overlap_along(pushed, other, 1) <= 0)
                continue;
            for (const std::size_t axis : {index_of(along), 2 - index_of(along)}) {
                const double overlap = overlap_along(pushed, other, axis);
                const bool faces = !apart(order[k], order[before], 2 - axis) || // else corner to corner
                                   overlap_along(pushed, other, 2 - axis) > rounding * half_along(pushed, 2 - axis);
                if (apart(order[k], order[before], axis) && faces && overlap > 0)
                    pushed.centre_m[axis] +=
                        nominal(order[k], axis).first < nominal(order[before], axis).first ? -overlap : overlap;
            }
        }
}

/// A wide flat block with its top face at y = 0.
Solid SpatialBuilder::ground() const
{
    double far = 0, tallest = 0, top = 0;
    for (const PlacedBlock& block : layout_.blocks) {
        far = std::max({far, std::abs(block.x_m()) + block.width_m, std::abs(block.z_m()) + block.depth_m});
        tallest = std::max(tallest, block.height_m);
        top = std::max(top, block.top());
    }
    Solid ground;
    // so wide that what slides stays on it
    ground.bottom = {false, 50 * std::max(far, top), 50 * std::max(far, top)};
    ground.top = ground.bottom;
    ground.height_m = tallest;
    ground.mass_kg = layout_.blocks.front().mass_kg;
    ground.inertia_kg_m2.fill(ground.mass_kg * ground.top.half_x_m * ground.top.half_x_m);
    ground.centre_height_m = tallest / 2;
    ground.centre_m = {0, -tallest / 2, 0};
    ground.fixed = true;
    ground.role = BlockRole::ground;
    ground.column = -1;
    return ground;
}

/// "drum 3 of column 2" or "the ground"
std::string SpatialBuilder::name(int solid) const
{
    const auto i = static_cast<std::size_t>(solid);
    return i < layout_.blocks.size() ? layout_.blocks[i].name : "the ground";
}

/// Stiffness, dashpots and friction of a joint.
/// @param value of each quantity: which of its values   @param area that bears
void SpatialBuilder::give_law(const RealizationValues& values, const Realization& realization, std::size_t value,
                              double area, SolidJoint& joint) const
{
    const std::vector<Solid>& solids = realization.space.solids;
    const double mass =
        contact_mass(solids[static_cast<std::size_t>(joint.lower)], solids[static_cast<std::size_t>(joint.upper)]);
    const BedSpec own = value < layout_.beds.size() ? layout_.beds[value].bed : BedSpec{};
    const DampingRatios ratio = damping_ratios(*study_, values, own);
    const double tangential = values[Quantity::tangential_stiffness][value];
    joint.friction = values[Quantity::friction][value];
    joint.area_m2 = area;
    joint.normal_stiffness_n_m3 = values[Quantity::normal_stiffness][value];
    joint.tangential_stiffness_n_m = tangential * area;
    // critical for the mass on the springs of the whole area, spread over it
    joint.normal_damping_n_s_m3 = 2 * ratio.normal * std::sqrt(joint.normal_stiffness_n_m3 * mass / area);
    joint.tangential_damping_n_s_m3 = 2 * ratio.tangential * std::sqrt(tangential * mass / area);
    if (study_->contact.damping == DampingAt::ends)
        joint.mechanisms.face_damping = 1;
}

/// The beds.
void SpatialBuilder::join(const RealizationValues& values, Realization& realization) const
{
    const std::vector<Solid>& solids = realization.space.solids;
    for (std::size_t j = 0; j < layout_.beds.size(); ++j) {
        SolidJoint joint;
        joint.upper = layout_.beds[j].upper;
        joint.lower = layout_.beds[j].lower >= 0 ? layout_.beds[j].lower : realization.space.drums; // the ground
        const Solid& below = solids[static_cast<std::size_t>(joint.lower)];
        const Solid& above = solids[static_cast<std::size_t>(joint.upper)];
        const bool on_ground = below.role == BlockRole::ground;
        const PlanFace upper = in_plan(above, above.bottom);
        PlanFace lower = in_plan(below, below.top);
        if (on_ground) // a plane, of the shape of the face that stands on it
            lower = {upper.round, upper.x_m, upper.z_m, lower.half_x_m, lower.half_z_m};
        if (const double gap = gap_m(lower, upper); gap >= 0)
            throw InputError(
                fmt::format("perturbation.drum_offset: in realization {} {} lies at x = {:g} m, z = {:g} m "
                            "and {} below it at x = {:g} m, z = {:g} m, and they do not touch. Lower "
                            "sd_m, or set min and max well within half a drum's width ({:g} m).",
                            realization.index, name(joint.upper), upper.x_m, upper.z_m, name(joint.lower), lower.x_m,
                            lower.z_m, std::min(upper.half_x_m, lower.half_x_m)));
        // two epistyles share the seat on a column; a drum lies on a whole face
        const bool seat = above.role == BlockRole::epistyle;
        const PlanFace common = common_rectangle(lower, upper);
        joint.inner_ratio = layout_.beds[j].bed.inner_ratio;
        const double bearing = 1 - joint.inner_ratio * joint.inner_ratio;
        const double area =
            bearing * (seat ? common_area_m2(lower, upper) : std::min(lower.area_m2(), upper.area_m2()));
        joint.point_m = {seat ? common.x_m : upper.x_m, above.middle_m()[1] - above.height_m / 2,
                         seat ? common.z_m : upper.z_m};
        joint.lower_face = {lower.round, lower.half_x_m, lower.half_z_m};
        joint.upper_face = above.bottom;
        joint.lower_middle_m = {lower.z_m - joint.point_m[2], lower.x_m - joint.point_m[0]};
        joint.upper_middle_m = {upper.z_m - joint.point_m[2], upper.x_m - joint.point_m[0]};
        give_law(values, realization, j, area, joint);
        realization.space.joints.push_back(joint);
    }
}

/// The joints between the vertical faces of epistyles that are next to each other.
void SpatialBuilder::butt(const RealizationValues& values, Realization& realization) const
{
    const std::vector<Solid>& solids = realization.space.solids;
    const auto drums = static_cast<std::size_t>(realization.space.drums);
    for (std::size_t i = 0; i < drums; ++i)
        for (std::size_t k = i + 1; k < drums; ++k)
            for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
                if (solids[i].role != BlockRole::epistyle || solids[k].role != BlockRole::epistyle)
                    continue;
                const bool ordered = solids[i].middle_m()[axis] <= solids[k].middle_m()[axis];
                const std::size_t low = ordered ? i : k, high = ordered ? k : i;
                const Solid &left = solids[low], &right = solids[high];
                const double gap = -overlap_along(left, right, axis);
                // one that has slid so far does not lie on its seat any more
                const double reach = std::min(left.height_m, right.height_m) / 2;
                // in cyclic order behind the normal: y and z, or x and y
                const std::size_t first = axis == 0 ? 1 : 0, second = axis == 0 ? 2 : 1;
                const double wide = overlap_along(left, right, first), high_m = overlap_along(left, right, second);
                if (gap < -rounding * half_along(left, axis) || gap > reach || wide <= rounding * reach ||
                    high_m <= rounding * reach)
                    continue;
                SolidJoint joint;
                joint.lower = static_cast<int>(low);
                joint.upper = static_cast<int>(high);
                joint.normal = axis == 0 ? Normal::x : Normal::z;
                joint.gap_m = std::max(gap, 0.0);
                std::array<double, 3> point{};
                point[axis] = left.middle_m()[axis] + half_along(left, axis);
                for (const std::size_t other : {first, second}) {
                    const double from = std::max(left.middle_m()[other] - half_along(left, other),
                                                 right.middle_m()[other] - half_along(right, other));
                    const double to = std::min(left.middle_m()[other] + half_along(left, other),
                                               right.middle_m()[other] + half_along(right, other));
                    point[other] = (from + to) / 2;
                }
                joint.point_m = point;
                const auto end = [axis](const Solid& solid) {
                    const double upright = solid.height_m / 2;
                    return Face{false, axis == 0 ? upright : solid.bottom.half_x_m,
                                axis == 0 ? solid.bottom.half_z_m : upright};
                };
                joint.lower_face = end(left);
                joint.upper_face = end(right);
                joint.lower_middle_m = {left.middle_m()[first] - point[first], left.middle_m()[second] - point[second]};
                joint.upper_middle_m = {right.middle_m()[first] - point[first],
                                        right.middle_m()[second] - point[second]};
                give_law(values, realization, layout_.beds.size(), wide * high_m, joint);
                realization.space.joints.push_back(joint);
            }
}

/// No two bodies in one place, those of one column aside, which lie one on the other.
void SpatialBuilder::check_overlaps(const Realization& realization) const
{
    const std::vector<Solid>& solids = realization.space.solids;
    const auto drums = static_cast<std::size_t>(realization.space.drums);
    for (std::size_t i = 0; i < drums; ++i)
        for (std::size_t k = i + 1; k < drums; ++k) {
            const Solid &a = solids[i], &b = solids[k];
            if (a.column >= 0 && a.column == b.column)
                continue;
            const double high = overlap_along(a, b, 1);
            if (high <= rounding * (a.height_m + b.height_m + std::abs(a.centre_m[1])))
                continue;
            const double wide = -gap_m(outline(a), outline(b));
            if (wide > rounding * (a.bottom.half_x_m + b.bottom.half_x_m))
                throw InputError(fmt::format("perturbation: in realization {} {} and {} overlap by {:.3g} m at rest. "
                                             "Lower the spread of drum_width, drum_height and drum_offset, or give "
                                             "them room.",
                                             realization.index, name(static_cast<int>(i)), name(static_cast<int>(k)),
                                             std::min(wide, high)));
        }
}

void SpatialBuilder::apply_mechanisms(const RealizationValues& values, Realization& realization) const
{
    for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
        const auto& [rule, at, nominal, may_act] = mechanisms_[m];
        if (!may_act) // its details are without meaning
            continue;
        for (std::size_t place = 0; place < at.size(); ++place) {
            if (!at[place])
                continue;
            std::array<double, most_parameters> drawn{};
            for (std::size_t p = 0; p < rule->parameters.size(); ++p) {
                drawn[p] = values.of(m, p, place);
                set_member(rule->parameters[p], place, drawn[p], realization);
            }
            if (const auto why = contradiction(*rule, drawn))
                throw InputError(fmt::format("mechanisms.{}: in realization {} at {} {}: {}. Change the values, or "
                                             "limit their spread with min and max.",
                                             rule->name, realization.index,
                                             rule->place == MechanismPlace::joint ? "joint" : "block", place, *why));
            if (rule->mechanism == Mechanism::stribeck)
                realization.space.joints[place].mechanisms.dynamic_ratio = drawn[0] / study_->contact.friction;
            else if (rule->mechanism == Mechanism::joint_friction)
                realization.space.joints[place].friction *= drawn[0];
            else if (rule->mechanism == Mechanism::eccentricity)
                displace_mass(place, realization);
        }
    }
}

/// The centre of mass of a body beside its axis.
void SpatialBuilder::displace_mass(std::size_t place, Realization& realization) const
{
    Solid& solid = realization.space.solids[place];
    const double x = solid.mechanisms.eccentricity_m, z = solid.mechanisms.eccentricity_z_m;
    const double part = solid.centre_height_m / solid.height_m; // the section at the height of the centre of mass
    const auto half = [part](double bottom, double top) { return bottom + part * (top - bottom); };
    const PlanFace section{solid.bottom.round, 0, 0, half(solid.bottom.half_x_m, solid.top.half_x_m),
                           half(solid.bottom.half_z_m, solid.top.half_z_m)};
    if (!(outside_m(section, x, z) < 0))
        throw InputError(fmt::format("mechanisms.eccentricity: in realization {} the centre of mass of {} lies {:g} m "
                                     "from its axis, outside the block. Lower the values, or limit their spread with "
                                     "min and max.",
                                     realization.index, name(static_cast<int>(place)), std::hypot(x, z)));
    solid.eccentricity_m = {x, z};
    solid.centre_m[0] += x;
    solid.centre_m[2] += z;
}

void SpatialBuilder::move(const Replica& replica, std::uint64_t original, Realization& realization) const
{
    const int moved = study_->design().replica_set->block;
    std::vector<Solid>& solids = realization.space.solids;
    solids[static_cast<std::size_t>(moved)].centre_m[0] += replica.size;
    for (SolidJoint& joint : realization.space.joints) {
        if (joint.normal != Normal::y || (joint.lower != moved && joint.upper != moved))
            continue;
        const Solid& below = solids[static_cast<std::size_t>(joint.lower)];
        const Solid& above = solids[static_cast<std::size_t>(joint.upper)];
        if (gap_m(in_plan(below, below.top), in_plan(above, above.bottom)) >= 0)
            throw InputError(fmt::format("twins.moves_m: displaced by {:g} m, {} of realization {} does not touch {} "
                                         "any more. Reduce the displacement.",
                                         replica.size, name(moved), original,
                                         name(joint.lower == moved ? joint.upper : joint.lower)));
        (joint.lower == moved ? joint.lower_middle_m : joint.upper_middle_m)[1] += replica.size;
    }
}

double SpatialBuilder::step_s(const Realization& realization) const
{
    const RunSpec& run = study_->run;
    const double bound = spatial_step_bound_s(realization, run.step_bound);
    if (!run.step_s)
        return run.step_fraction * bound;
    if (*run.step_s > bound && !run.allow_step_above_bound)
        throw InputError(
            fmt::format("run.step_s = {:g} is above {:.6g} s, the safe bound of realization {}; allowed: (0, {:.6g}].\n"
                        "  Reduce it, or omit it: the step is then chosen for each realization. If it is intended, set "
                        "run.allow_step_above_bound = true.",
                        *run.step_s, bound, realization.index, bound));
    return *run.step_s;
}

} // namespace stylobate
