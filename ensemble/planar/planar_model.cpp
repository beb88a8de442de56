#include "ensemble/planar/planar_model.hpp"

#include "ensemble/planar/structure/mechanisms.hpp"
#include "kernels/planar/step.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stylobate {

namespace {

// How far a block may stray before close pairs are looked for again, as a part of the smallest half size: small enough
// that what stands apart stays out of the list, large enough that looking is rare.
constexpr double skin_part = 0.25;

bool is_single(const Study& study)
{
    return study.run.precision == Precision::single;
}

/// Of the narrower of a bed's two faces.
double bed_width_m(const Realization& r, const Joint& bed)
{
    return 2 * std::min(r.blocks[static_cast<std::size_t>(bed.lower)].half_width_m,
                        r.blocks[static_cast<std::size_t>(bed.upper)].half_width_m);
}

/// `face_offset` of every bed [m].
std::vector<double> bed_offsets(const Realization& r, const std::vector<BlockMotion>& moved)
{
    std::vector<double> offsets;
    for (int j = 0; j < r.beds(); ++j) {
        const Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const auto l = static_cast<std::size_t>(joint.lower), u = static_cast<std::size_t>(joint.upper);
        offsets.push_back(face_offset(r.blocks[l], moved[l], r.blocks[u], moved[u]));
    }
    return offsets;
}

} // namespace

PlanarModel::PlanarModel(const Study& study, const KernelTable& kernels, const Realization& pattern,
                         std::uint64_t waiting)
    : study_(study), kernels_(kernels), place_of_(pattern.blocks.size(), -1)
{
    const auto take = [&](int block) {
        if (place_of_[static_cast<std::size_t>(block)] < 0) {
            place_of_[static_cast<std::size_t>(block)] = static_cast<int>(order_.size());
            order_.push_back(block);
        }
    };
    for (const Block& block : pattern.blocks) // what a clamp holds to may touch no free block
        if (const int right = block.strengthening.clamp_to;
            right >= 0 && pattern.blocks[static_cast<std::size_t>(right)].fixed)
            take(right);
    // from the end: those on which others rest come last, next to the free blocks, as `Topology::stack` asks
    for (auto joint = pattern.joints.rbegin(); joint != pattern.joints.rend(); ++joint)
        for (int block : {joint->lower, joint->upper})
            if (pattern.blocks[static_cast<std::size_t>(block)].fixed)
                take(block);
    topology_.fixed = static_cast<int>(order_.size());
    for (std::size_t i = 0; i < pattern.blocks.size(); ++i)
        if (!pattern.blocks[i].fixed)
            take(static_cast<int>(i));
    for (const Joint& joint : pattern.joints)
        joints_.push_back(
            {place_of_[static_cast<std::size_t>(joint.lower)], place_of_[static_cast<std::size_t>(joint.upper)]});
    topology_.blocks = static_cast<int>(order_.size());
    topology_.top = topology_.blocks - 1;
    topology_.joints = static_cast<int>(joints_.size());
    topology_.watched = pattern.watched;
    topology_.joint = joints_.data();
    topology_.model = model_of(pattern);
    close_.resize(static_cast<std::size_t>(topology_.watched));
    bed_lists_.resize(static_cast<std::size_t>(bed_lists_size(topology_)));
    list_beds(topology_, bed_lists_.data());
    if (topology_.model.strengthened)
        list_clamps(pattern);

    if (topology_.model.rigid()) {
        rigid_order_ = rigid_order(topology_);
        topology_.rigid_order = rigid_order_.list.data();
        topology_.rigid_edges = rigid_order_.edges;
    }

    twice_ = !is_single(study) && topology_.model == StepModel{} && topology_.stack && topology_.watched == 0 &&
             topology_.free_blocks() <= kernels.planar.twice_blocks &&
             waiting > static_cast<std::uint64_t>(kernels.lanes);
    lanes_ = static_cast<std::size_t>(is_single(study) ? kernels.single_lanes : (twice_ ? 2 : 1) * kernels.lanes);
    memory_ = aligned_array<double>(bundle_registers(topology_) * lanes_);
    bundle_ = bind_bundle(topology_, lanes(), memory_.get(), close_.data());
    if (is_single(study)) {
        if (topology_.model.has_mechanism_rows())
            throw std::invalid_argument("run.precision = \"single\" supports only the paper's model and rigid blocks");
        single_.emplace(topology_, bundle_, kernels_);
    }
}

std::array<BaseMotion, PlanarModel::channels> PlanarModel::motions(const ExcitationSpec& excitation,
                                                                   const Realization& r, const Motion* record)
{
    const auto own = [&](const std::shared_ptr<const Motion>& motion, double start_s) {
        return motion == nullptr ? BaseMotion{} : BaseMotion::along(motion, r.step_s, r.change.offset_s - start_s);
    };
    return {BaseMotion(excitation, r, record), own(r.vertical, 0), own(r.tilt, r.base.tilt_start_s)};
}

void PlanarModel::list_clamps(const Realization& pattern)
{
    // of the kernel's blocks: a fixed block that nothing touches is none of them
    int* const clamped = bed_lists_.data() + (bed_lists_.size() - order_.size());
    for (std::size_t i = 0; i < pattern.blocks.size(); ++i)
        if (const int right = pattern.blocks[i].strengthening.clamp_to; right >= 0)
            clamped[place_of_[i]] = place_of_[static_cast<std::size_t>(right)];
}

void PlanarModel::clear(int lane)
{
    const std::size_t registers = bundle_registers(topology_);
    for (std::size_t i = 0; i < registers; ++i)
        memory_[i * lanes_ + static_cast<std::size_t>(lane)] = 0;
    for (int k = 0; k < topology_.blocks; ++k)
        bundle_.at(OfBlock::half_width, k, lane) = empty_half_width;
    for (int k = 0; k < topology_.joints; ++k)
        bundle_.at(OfJoint::depth_limit, k, lane) = empty_depth_limit;
    take_single(lane);
}

void PlanarModel::begin(int lane, Place& place)
{
    const Realization& r = place.realization;
    assert((!model_of(r).mechanisms || topology_.model.mechanisms) &&
           (!model_of(r).strengthened || topology_.model.strengthened) && r.form == topology_.model.form &&
           "the realizations of a bundle follow the model of the pattern that it was made from");
    place.watch.seated = 1;
    place.watch.beds_alone =
        topology_.model.rigid() && (topology_.watched > 0 || study_.outcome.follow == Follow::rest);
    const Block& base = r.blocks[static_cast<std::size_t>(r.joints.front().lower)];
    PlanarMeasured& m = place.measured;
    m.limits = LimitStates(r, study_.outcome, base.y_m + base.half_height_m,
                           whole_checks(fall_time / place.scales.p_rad_s, r.step_s, check_steps()));
    store_state(lane, place);
    first_increments(lane, place.watch);
    await_rods(place);
    take_single(lane);
    read(lane, place);
    m.start_offset_m = bed_offsets(r, m.moved);
    m.start_top_x_m = centre(topology_.top, lane).x_m;
}

/// The ends of rods move as long as they do, and the tail comes after them.
void PlanarModel::await_rods(Place& place)
{
    Watch& w = place.watch;
    for (const Block& block : place.realization.blocks) {
        const double end_s = block.mechanisms.rod_end_s();
        if (!w.may_rest || end_s <= w.shaking_end_s)
            continue;
        w.last_step += whole_checks(end_s - w.shaking_end_s, w.step_s, check_steps());
        w.shaking_end_s = end_s;
    }
}

void PlanarModel::store_state(int lane, const Place& place)
{
    const Realization& r = place.realization;
    const Statics statics(r);
    const StaticState& rest = statics.start;
    const double dt = r.step_s, dt2 = dt * dt;
    for (int k = 0; k < topology_.blocks; ++k) {
        const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        const Block& block = r.blocks[i];
        bundle_.at(OfBlock::half_width, k, lane) = block.half_width_m;
        bundle_.at(OfBlock::half_height, k, lane) = block.half_height_m;
        bundle_.at(OfBlock::mass, k, lane) = block.mass_kg;
        bundle_.at(OfBlock::inertia, k, lane) = block.inertia_kg_m2;
        if (block.fixed)
            continue;
        bundle_.at(OfBlock::dt2_per_mass, k, lane) = dt2 / block.mass_kg;
        bundle_.at(OfBlock::dt2_per_inertia, k, lane) = dt2 / block.inertia_kg_m2;
        bundle_.at(OfBlock::least_y, k, lane) = place.measured.limits.lowest_m(block);
        bundle_.at(OfBlock::most_turn, k, lane) = place.measured.limits.turn_limit_rad(i);
        const double e = block.mechanisms.eccentricity_m, theta = rest.theta_rad[i];
        bundle_.at(OfBlock::x, k, lane) = rest.x_m[i] - e * (1 - std::cos(theta));
        bundle_.at(OfBlock::y, k, lane) = rest.y_m[i] + e * std::sin(theta);
        bundle_.at(OfBlock::theta, k, lane) = theta;
    }
    for (int k = 0; k < topology_.joints; ++k) {
        const Joint& joint = r.joints[static_cast<std::size_t>(k)];
        const bool per_chord = joint.damping_chord_m > 0;
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        bundle_.at(OfJoint::reference_x, k, lane) = upper.x_m - lower.x_m;
        bundle_.at(OfJoint::height, k, lane) =
            k < topology_.beds() ? lower.half_height_m + upper.half_height_m : upper.y_m - lower.y_m;
        bundle_.at(OfJoint::depth_limit, k, lane) = 0.1 * std::min(lower.half_height_m, upper.half_height_m);
        bundle_.at(OfJoint::K_n, k, lane) = joint.normal_stiffness_n_m2;
        bundle_.at(OfJoint::K_t, k, lane) = joint.tangential_stiffness_n_m;
        bundle_.at(OfJoint::per_K_t, k, lane) =
            joint.tangential_stiffness_n_m > 0 ? 1 / joint.tangential_stiffness_n_m : 0;
        bundle_.at(OfJoint::C_n_per_dt, k, lane) = per_chord ? 0 : joint.normal_damping_n_s_m / dt;
        bundle_.at(OfJoint::C_t_per_dt, k, lane) = per_chord ? 0 : joint.tangential_damping_n_s_m / dt;
        bundle_.at(OfJoint::C_n_chord, k, lane) =
            per_chord ? joint.normal_damping_n_s_m / (joint.damping_chord_m * dt) : 0;
        bundle_.at(OfJoint::C_t_chord, k, lane) =
            per_chord ? joint.tangential_damping_n_s_m / (joint.damping_chord_m * dt) : 0;
        bundle_.at(OfJoint::mu, k, lane) = joint.friction;
        bundle_.at(OfJoint::spring, k, lane) = rest.spring_n[static_cast<std::size_t>(k)];
        bundle_.at(OfJoint::shear_force, k, lane) = rest.spring_n[static_cast<std::size_t>(k)];
    }
    if (topology_.model.has_mechanism_rows())
        store_mechanisms(statics, order_, bundle_, lane);
    if (topology_.model.strengthened)
        store_strengthening(statics, order_, bundle_, lane);
    if (topology_.model.rigid())
        store_rigid(lane, r);
    bundle_.at(OfRealization::gravity_dx, lane) = dt2 * r.gravity_m_s2 * std::sin(r.base_tilt_rad);
    bundle_.at(OfRealization::gravity_dy, lane) = -dt2 * r.gravity_m_s2 * std::cos(r.base_tilt_rad);
    bundle_.at(OfRealization::skin, lane) = skin_part * place.scales.least_size_m;
}

/// What the rigid form needs beside.
void PlanarModel::store_rigid(int lane, const Realization& r)
{
    const double per_dt2 = 1 / (r.step_s * r.step_s);
    for (int k = topology_.fixed; k < topology_.blocks; ++k) {
        const Block& block = r.blocks[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
        bundle_.at(OfRigidBlock::mass_per_dt2, k, lane) = block.mass_kg * per_dt2;
        bundle_.at(OfRigidBlock::inertia_per_dt2, k, lane) = block.inertia_kg_m2 * per_dt2;
    }
    for (int k = 0; k < topology_.joints; ++k) {
        // the ends that carry at first: of a bed whose upper block leans, the one that it leans over
        const double lean = bundle_.at(OfBlock::theta, topology_.joint[k].upper, lane) -
                            bundle_.at(OfBlock::theta, topology_.joint[k].lower, lane);
        const bool bed = k < topology_.beds();
        bundle_.at(OfRigidJoint::left, k, lane) = bed && lean >= 0 ? 1 : 0;
        bundle_.at(OfRigidJoint::right, k, lane) = bed && lean <= 0 ? 1 : 0;
        const Joint& joint = r.joints[static_cast<std::size_t>(k)];
        const bool poisson = r.restitution_law == RestitutionLaw::poisson;
        bundle_.at(poisson ? OfRigidJoint::expansion : OfRigidJoint::restitution, k, lane) = joint.restitution;
        if (poisson && bed && joint.restitution > 0)
            bundle_.at(OfRigid::expands, lane) = 1;
    }
}

/// The increments before the first step: U(-dt) = U0 + a0 dt2 / 2 for a start from rest, a0 by one trial step of the
/// contact forces and gravity alone (the base does not move before it starts).
void PlanarModel::first_increments(int lane, Watch& w)
{
    const std::size_t registers = bundle_registers(topology_) - chunk_steps; // the table of base motion stays at 0
    const AlignedArray<double> memory = aligned_array<double>(registers + chunk_steps);
    const Bundle one = bind_bundle(topology_, 1, memory.get(), close_.data());
    // (so do those of its rotation and of the vertical motion: the lane has just been cleared)
    for (std::size_t i = 0; i < registers; ++i)
        memory[i] = memory_[i * lanes_ + static_cast<std::size_t>(lane)];
    kernels(Isa::scalar).planar.run(topology_, one, 0, 1);
    for (int i = topology_.fixed; i < topology_.blocks; ++i) {
        bundle_.at(OfBlock::dx, i, lane) = -0.5 * one.at(OfBlock::dx, i, 0);
        bundle_.at(OfBlock::dy, i, lane) = -0.5 * one.at(OfBlock::dy, i, 0);
        bundle_.at(OfBlock::dtheta, i, lane) = -0.5 * one.at(OfBlock::dtheta, i, 0);
    }
    w.start_potential_j = one.at(OfRealization::potential, 0) / (w.step_s * w.step_s);
    w.start_shear_j = spring_energy(topology_, bundle_, lane);
    w.start_spring_j = w.start_shear_j;
    for (int j = 0; j < topology_.joints; ++j)
        w.start_spring_j += one.at(OfJoint::elastic, j, 0);
    if (topology_.model.has_mechanism_rows())
        for (int j = 0; j < topology_.beds(); ++j)
            for (const auto field : {OfJointMechanisms::dowel_at, OfJointMechanisms::dowel_force})
                bundle_.at(field, j, lane) = one.at(field, j, 0);
    if (topology_.model.strengthened) {
        using J = OfJointStrengthening;
        using B = OfBlockStrengthening;
        for (int j = 0; j < topology_.joints; ++j)
            for (int f = J::memory; f < J::count; ++f)
                bundle_.at(static_cast<J::Field>(f), j, lane) = one.at(static_cast<J::Field>(f), j, 0);
        for (int i = 0; i < topology_.blocks; ++i)
            for (int f = B::memory; f < B::count; ++f)
                bundle_.at(static_cast<B::Field>(f), i, lane) = one.at(static_cast<B::Field>(f), i, 0);
    }
    w.start_dowel_j = dowel_energy(topology_, bundle_, lane);
}

/// The tables of the base's motion at the beginning of a chunk, and the steps.
void PlanarModel::run(const LaneBases& bases, const std::vector<Place>& places, int first, int last)
{
    if (first == 0)
        fill_tables(bases, places);
    if (single_)
        single_->run(first, last);
    else
        (twice_ ? kernels_.planar.run_twice : kernels_.planar.run)(topology_, bundle_, first, last);
}

void PlanarModel::fill_tables(const LaneBases& bases, const std::vector<Place>& places)
{
    const auto each_busy = [&](auto&& fill) {
        for (int lane = 0; lane < lanes(); ++lane)
            if (const Place& place = places[static_cast<std::size_t>(lane)]; place.busy)
                fill(lane, place);
    };
    double* const table = bundle_.rows<OfBase::Field>();
    if (bases.on_host()) {
        each_busy([&](int lane, const Place& place) {
            place.motions[0].fill(bases.first_step(lane), table + lane, lanes());
        });
        if (single_)
            single_->take_base();
    } else if (single_) {
        bases.fill(0, single_->base_table());
    } else {
        bases.fill(0, table);
    }
    if (topology_.model.has_mechanism_rows())
        each_busy([&](int lane, const Place& place) { fill_mechanisms(lane, bases, place); });
}

void PlanarModel::fill_mechanisms(int lane, const LaneBases& bases, const Place& place)
{
    const Realization& r = place.realization;
    const double first = bases.first_step(lane);
    if (r.vertical != nullptr)
        place.motions[1].fill(first, bundle_.rows<OfVertical::Field>() + lane, lanes());
    else if (r.base.vertical_ratio != 0)
        for (std::size_t k = 0; k < chunk_steps; ++k)
            bundle_.rows<OfVertical::Field>()[k * lanes_ + static_cast<std::size_t>(lane)] =
                r.base.vertical_ratio * bundle_.rows<OfBase::Field>()[k * lanes_ + static_cast<std::size_t>(lane)];
    if (r.tilt != nullptr)
        fill_tilt(lane, first, place);
    if (r.base.pitch_rad_s2_m == 0)
        return;
    // Samples with straight lines between them have no second derivative: the rotation is their mean under a triangle
    // as wide as two samples, whose second derivative is a difference of three values.
    const double reach = std::max(1.0, std::round(place.motions[0].spacing_s() / r.step_s));
    const auto before = bases.chunk(place.motions[0], first - reach), now = bases.chunk(place.motions[0], first),
               after = bases.chunk(place.motions[0], first + reach);
    const double per = r.base.pitch_rad_s2_m / (r.step_s * r.step_s);
    for (std::size_t k = 0; k < chunk_steps; ++k) {
        const int step = static_cast<int>(k);
        const Turn turn = turn_of(r, reach, before[k], now[k], after[k]);
        const double second = per * ((after[k] - now[k]) - (now[k] - before[k])) / (reach * reach);
        const auto put = [&](OfPitch::Field field, double value) {
            double& at = bundle_.at(field, step, lane);
            at = r.tilt != nullptr ? at + value : value;
        };
        put(OfPitch::angle, turn.angle_rad);
        put(OfPitch::increment, turn.increment_rad);
        put(OfPitch::second, second);
    }
}

void PlanarModel::fill_tilt(int lane, double first_step, const Place& place)
{
    const BaseMotion& tilt = place.motions[2];
    std::array<double, chunk_steps> second{};
    tilt.fill(first_step, second.data(), 1);
    const auto angle = [&](double step) { return tilt.displacement_m(step * place.realization.step_s); };
    double before = angle(first_step - 1), now = angle(first_step);
    for (int k = 0; k < chunk_steps; ++k) {
        const double after = angle(first_step + k + 1);
        bundle_.at(OfPitch::angle, k, lane) = now;
        bundle_.at(OfPitch::increment, k, lane) = 0.5 * (after - before);
        bundle_.at(OfPitch::second, k, lane) = second[static_cast<std::size_t>(k)];
        before = now;
        now = after;
    }
}

/// @param reach steps between the three second differences of the base's displacement [m]
PlanarModel::Turn PlanarModel::turn_of(const Realization& r, double reach, double before, double now, double after)
{
    const double per = r.base.pitch_rad_s2_m / (r.step_s * r.step_s);
    return {per * (before + 10 * now + after) / 12, per * (after - before) / (2 * reach)};
}

BlockMotion PlanarModel::centre(int k, int lane) const
{
    const Planar<double> moved = centre_of(topology_, bundle_, k, lane);
    return {moved.x, moved.y, moved.theta};
}

void PlanarModel::read(int lane, Place& place) const
{
    PlanarMeasured& m = place.measured;
    m.moved.resize(place.realization.blocks.size());
    m.inside.resize(place.realization.blocks.size(), -1);
    for (int k = topology_.fixed; k < topology_.blocks; ++k) {
        const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        m.moved[i] = centre(k, lane);
        m.inside[i] = static_cast<int>(bundle_.at(OfBlock::inside, k, lane));
    }
}

void PlanarModel::check_limits(int, Place& place, int done)
{
    PlanarMeasured& m = place.measured;
    m.limits.check(place.realization, place.watch.steps, m.moved, m.inside, done);
    place.watch.undecided = m.limits.undecided();
    place.watch.seated = !m.limits.unseated();
}

void PlanarModel::measure(int lane, const Place& place, State state, Outcome& o) const
{
    const Realization& r = place.realization;
    const PlanarMeasured& m = place.measured;
    const Watch& w = place.watch;
    o.peak_top_displacement_m = bundle_.at(OfRealization::peak_top, lane);
    o.residual_top_displacement_m = w.quiet_top_m / static_cast<double>(w.quiet_checks) - m.start_top_x_m;
    o.top_path_m = bundle_.at(OfRealization::top_path, lane);
    o.total_sliding_m = bundle_.at(OfRealization::slip, lane);
    o.sliding_path_m = bundle_.at(OfRealization::path, lane);
    o.rocking_path_rad = bundle_.at(OfRealization::rocking_path, lane);
    const std::vector<double> offsets = bed_offsets(r, m.moved);
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        const double moved = std::fabs(offsets[j] - m.start_offset_m[j]);
        o.residual_sliding_m += moved;
        o.residual_dislocation = std::max(o.residual_dislocation, moved / bed_width_m(r, r.joints[j]));
    }
    for (int j = 0; j < topology_.beds(); ++j) {
        const double rotation = bundle_.at(OfJoint::max_rotation, j, lane);
        o.total_rocking_rad += rotation;
        o.max_relative_rotation_rad = std::max(o.max_relative_rotation_rad, rotation);
    }
    if (o.at_rest == 0)
        forget_residuals(o);
    // a realization that was set aside has no outcome
    const bool valid = state != State::invalid;
    (valid ? m.limits : LimitStates(r, study_.outcome, 0, 0)).write(r.step_s, r.drums, o);
    if (study_.design().end_state) {
        o.bed_offset_m.assign(offsets.size(), 0);
        o.rotation_rad.assign(static_cast<std::size_t>(r.drums), 0);
        for (std::size_t j = 0; valid && j < offsets.size(); ++j)
            o.bed_offset_m[j] = offsets[j] - m.start_offset_m[j];
        for (std::size_t i = 0; valid && i < o.rotation_rad.size(); ++i)
            o.rotation_rad[i] = m.moved[i].theta_rad;
    }
}

State PlanarModel::motion_of(const Place& place, const Outcome& o) const
{
    return dominant_motion(study_.outcome, place.scales.width_m, o);
}

Snapshot PlanarModel::snapshot(int lane, const Place& place) const
{
    const Realization& r = place.realization;
    Snapshot s;
    for (std::size_t i = 0; i < r.blocks.size(); ++i) {
        const Block& block = r.blocks[i];
        const int k = place_of_[i];
        const BlockMotion moved = k < 0 ? BlockMotion{} : centre(k, lane);
        s.x_m.push_back(block.x_m + moved.x_m);
        s.y_m.push_back(block.y_m + moved.y_m);
        s.theta_rad.push_back(moved.theta_rad);
    }
    return s;
}

Trajectory PlanarModel::trajectory_of(const Realization& realization, std::vector<std::string> names)
{
    Trajectory t(planar_channels);
    t.index = realization.index;
    t.name = std::move(names);
    for (std::size_t i = 0; i < t.name.size(); ++i) {
        const Block& block = realization.blocks[i];
        t["rest_x_m"].push_back(block.x_m);
        t["rest_y_m"].push_back(block.y_m);
        t["half_width_m"].push_back(block.half_width_m);
        t["half_height_m"].push_back(block.half_height_m);
        t.role.push_back(block.role);
        t.column.push_back(block.column);
    }
    return t;
}

void nudge(LaneSet& set, int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2)
{
    const Topology& topology = set.model().topology();
    assert(topology.model.mechanisms && "only a model with mechanisms can be nudged");
    const int k = set.model().place_of(block);
    const double dt = set.realization(lane).step_s, dt2 = dt * dt;
    if (k < topology.fixed)
        return;
    const Bundle& bundle = set.model().bundle();
    bundle.at(OfBlockMechanisms::nudge_x, k, lane) = dt2 * x_m_s2;
    bundle.at(OfBlockMechanisms::nudge_y, k, lane) = dt2 * y_m_s2;
    bundle.at(OfBlockMechanisms::nudge_theta, k, lane) = dt2 * theta_rad_s2;
}

} // namespace stylobate
