#include "ensemble/engine/lanes.hpp"

#include "ensemble/statics/mechanisms.hpp"
#include "kernels/step.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stylobate {

namespace {

// A realization has come to rest when, after the shaking, its kinetic energy stays below this part of what it takes to
// topple the weakest part of it, for as long as 2 / p. (A resting stack keeps a small rocking vibration that the
// dashpots at the centroids hardly damp; its residual displacement is the mean over that time.)
constexpr double rest_energy = 1e-2;
// Nor may it slip faster than this part of its width in a time of 1 / p.
constexpr double rest_slip = 1e-4;
constexpr double rest_time = 2;
// A block that has turned beyond its slenderness angle has fallen unless it comes back within 1 / p.
constexpr double fall_time = 1;
// How far a block may stray before close pairs are looked for again, as a part of the smallest half size: small enough
// that what stands apart stays out of the list, large enough that looking is rare.
constexpr double skin_part = 0.25;

bool is_single(const Study& study)
{
    return study.run.precision == Precision::single;
}

/// @param interval steps between two checks
std::uint64_t whole_checks(double time_s, double step_s, int interval)
{
    const double checks = std::ceil(time_s / step_s / interval);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(checks)) * static_cast<std::uint64_t>(interval);
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

LaneSet::LaneSet(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern,
                 std::uint64_t waiting)
    : study_(study), record_(record), kernels_(kernels), place_of_(pattern.blocks.size(), -1)
{
    const auto take = [&](int block) {
        if (place_of_[static_cast<std::size_t>(block)] < 0) {
            place_of_[static_cast<std::size_t>(block)] = static_cast<int>(order_.size());
            order_.push_back(block);
        }
    };
    for (const Block& block : pattern.blocks) // what a clamp holds to may touch no free block
        if (const int right = block.reinforcement.clamp_to;
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
    if (topology_.model.reinforced)
        list_clamps(pattern);

    if (topology_.model.rigid()) {
        rigid_order_ = rigid_order(topology_);
        topology_.rigid_order = rigid_order_.list.data();
        topology_.rigid_edges = rigid_order_.edges;
    }

    twice_ = !is_single(study) && topology_.model == Model{} && topology_.stack && topology_.watched == 0 &&
             topology_.free_blocks() <= kernels.twice_blocks && waiting > static_cast<std::uint64_t>(kernels.lanes);
    lanes_ = static_cast<std::size_t>(is_single(study) ? kernels.single_lanes : (twice_ ? 2 : 1) * kernels.lanes);
    places_.resize(lanes_);
    memory_ = aligned_array<double>(bundle_registers(topology_) * lanes_);
    bundle_ = bind_bundle(topology_, lanes(), memory_.get(), close_.data());
    if (is_single(study)) {
        if (topology_.model.extended())
            throw std::invalid_argument("run.precision = \"single\" supports only the paper's model and rigid blocks");
        single_.emplace(topology_, bundle_, kernels_);
    }
    parameters_memory_ = aligned_array<double>(9 * lanes_);
    double* p = parameters_memory_.get();
    for (double** array : {&parameters_.cycles_per_step, &parameters_.amplitude_m, &parameters_.cycles,
                           &parameters_.phase_cycles, &parameters_.offset, &parameters_.start_ramps_per_cycle,
                           &parameters_.end_ramps_per_cycle, &parameters_.end_velocity, &first_step_}) {
        *array = p;
        p += lanes_;
    }
    for (int lane = 0; lane < lanes(); ++lane)
        clear(lane);
    active_ = 0;
}

void LaneSet::list_clamps(const Realization& pattern)
{
    // of the kernel's blocks: a fixed block that nothing touches is none of them
    int* const clamped = bed_lists_.data() + (bed_lists_.size() - order_.size());
    for (std::size_t i = 0; i < pattern.blocks.size(); ++i)
        if (const int right = pattern.blocks[i].reinforcement.clamp_to; right >= 0)
            clamped[place_of_[i]] = place_of_[static_cast<std::size_t>(right)];
}

void LaneSet::clear(int lane)
{
    Place& place = places_[static_cast<std::size_t>(lane)];
    if (place.busy)
        --active_;
    place = Place{};
    for (std::size_t i = 0; i < bundle_registers(topology_); ++i)
        memory_[i * lanes_ + static_cast<std::size_t>(lane)] = 0;
    BaseMotion{}.store(parameters_, lane);
    // an empty lane must not divide by a rate of zero
    parameters_.cycles_per_step[lane] = 1;
    for (int k = 0; k < topology_.blocks; ++k)
        bundle_.at(OfBlock::half_width, k, lane) = empty_half_width;
    for (int k = 0; k < topology_.joints; ++k)
        bundle_.at(OfJoint::depth_limit, k, lane) = empty_depth_limit;
    first_step_[lane] = 0;
    if (single_)
        single_->take(lane);
}

void LaneSet::store_state(int lane, const Realization& r)
{
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
        const LimitStates& limits = places_[static_cast<std::size_t>(lane)].limits;
        bundle_.at(OfBlock::least_y, k, lane) = limits.lowest_m(block);
        bundle_.at(OfBlock::most_turn, k, lane) = limits.turn_limit_rad(i);
        const double e = block.extension.eccentricity_m, theta = rest.theta_rad[i];
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
    if (topology_.model.extended())
        store_extension(statics, order_, bundle_, lane);
    if (topology_.model.reinforced)
        store_reinforcement(statics, order_, bundle_, lane);
    if (topology_.model.rigid())
        store_rigid(lane, r);
    bundle_.at(OfRealization::gravity_dx, lane) = dt2 * r.gravity_m_s2 * std::sin(r.base_tilt_rad);
    bundle_.at(OfRealization::gravity_dy, lane) = -dt2 * r.gravity_m_s2 * std::cos(r.base_tilt_rad);
    bundle_.at(OfRealization::skin, lane) = skin_part * places_[static_cast<std::size_t>(lane)].scales.least_size_m;
}

/// What the rigid form needs beside.
void LaneSet::store_rigid(int lane, const Realization& r)
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
void LaneSet::first_increments(int lane)
{
    const std::size_t registers = bundle_registers(topology_) - chunk_steps; // the table of base motion stays at 0
    const AlignedArray<double> memory = aligned_array<double>(registers + chunk_steps);
    const Bundle one = bind_bundle(topology_, 1, memory.get(), close_.data());
    // (so do those of its rotation and of the vertical motion: the lane has just been cleared)
    for (std::size_t i = 0; i < registers; ++i)
        memory[i] = memory_[i * lanes_ + static_cast<std::size_t>(lane)];
    kernels(Isa::scalar).run(topology_, one, 0, 1);
    for (int i = topology_.fixed; i < topology_.blocks; ++i) {
        bundle_.at(OfBlock::dx, i, lane) = -0.5 * one.at(OfBlock::dx, i, 0);
        bundle_.at(OfBlock::dy, i, lane) = -0.5 * one.at(OfBlock::dy, i, 0);
        bundle_.at(OfBlock::dtheta, i, lane) = -0.5 * one.at(OfBlock::dtheta, i, 0);
    }
    Watch& w = places_[static_cast<std::size_t>(lane)].watch;
    w.start_potential_j = one.at(OfRealization::potential, 0) / (w.step_s * w.step_s);
    w.start_shear_j = spring_energy(topology_, bundle_, lane);
    w.start_spring_j = w.start_shear_j;
    for (int j = 0; j < topology_.joints; ++j)
        w.start_spring_j += one.at(OfJoint::elastic, j, 0);
    if (topology_.model.extended())
        for (int j = 0; j < topology_.beds(); ++j)
            for (const auto field : {OfJointExtension::dowel_at, OfJointExtension::dowel_force})
                bundle_.at(field, j, lane) = one.at(field, j, 0);
    if (topology_.model.reinforced) {
        using J = OfJointReinforcement;
        using B = OfBlockReinforcement;
        for (int j = 0; j < topology_.joints; ++j)
            for (int f = J::memory; f < J::count; ++f)
                bundle_.at(static_cast<J::Field>(f), j, lane) = one.at(static_cast<J::Field>(f), j, 0);
        for (int i = 0; i < topology_.blocks; ++i)
            for (int f = B::memory; f < B::count; ++f)
                bundle_.at(static_cast<B::Field>(f), i, lane) = one.at(static_cast<B::Field>(f), i, 0);
    }
    w.start_dowel_j = dowel_energy(topology_, bundle_, lane);
}

void LaneSet::load(int lane, Realization realization)
{
    clear(lane);
    Place& place = places_[static_cast<std::size_t>(lane)];
    place.busy = true;
    ++active_;
    place.realization = std::move(realization);
    const Realization& r = place.realization;
    assert((!model_of(r).mechanisms || topology_.model.mechanisms) &&
           (!model_of(r).reinforced || topology_.model.reinforced) && r.form == topology_.model.form &&
           "the realizations of a bundle follow the model of the pattern that it was made from");
    place.scales = scales_of(r);
    place.motion = BaseMotion(study_.excitation, r, record_);
    place.motion.store(parameters_, lane);
    if (r.vertical != nullptr)
        place.vertical = BaseMotion::along(r.vertical, r.step_s, r.change.offset_s);

    const bool shaken = study_.excitation.kind != ExcitationKind::none;
    Watch& w = place.watch;
    const int interval = check_steps(topology_);
    w.step_s = r.step_s;
    const double end_s = std::max(place.motion.duration_s(), place.vertical ? place.vertical->duration_s() : 0.0);
    w.shaking_end_s = shaken ? end_s : 0;
    w.barrier_j = place.scales.barrier_j;
    w.rest_energy_j = rest_energy * place.scales.barrier_j;
    w.rest_slip_m = rest_slip * place.scales.width_m * place.scales.p_rad_s * interval * r.step_s;
    w.may_rest = shaken;
    w.last_step = whole_checks(end_s + tail_s(study_.excitation, r), r.step_s, interval);
    w.rest_steps = whole_checks(rest_time / place.scales.p_rad_s, r.step_s, interval);
    w.seated = 1;
    w.beds_alone = topology_.model.rigid() && (topology_.watched > 0 || study_.outcome.follow == Follow::rest);
    const Block& base = r.blocks[static_cast<std::size_t>(r.joints.front().lower)];
    place.limits = LimitStates(r, study_.outcome, base.y_m + base.half_height_m,
                               whole_checks(fall_time / place.scales.p_rad_s, r.step_s, interval));
    store_state(lane, r);
    first_increments(lane);
    if (single_)
        single_->take(lane);
    read_motion(lane);
    place.start_offset_m = bed_offsets(r, place.moved);
    place.start_top_x_m = centre(topology_.top, lane).x_m;
}

void LaneSet::advance()
{
    advance(0, chunk_steps);
}

void LaneSet::advance(int first, int last)
{
    const int interval = check_steps(topology_);
    for (int done = first; done < last;) {
        const int from = done;
        done = std::min(last, (from / interval + 1) * interval);
        run(from, done);
        if (done % interval == 0)
            for (int lane = 0; lane < lanes(); ++lane)
                if (!free(lane) && !this->done(lane))
                    check(lane, done);
    }
}

/// The tables of the base's motion at the beginning of a chunk, and the steps.
void LaneSet::run(int first, int last)
{
    if (first == 0)
        fill_tables();
    if (single_)
        single_->run(first, last);
    else
        (twice_ ? kernels_.run_twice : kernels_.run)(topology_, bundle_, first, last);
}

void LaneSet::fill_tables()
{
    const auto each_busy = [this](auto&& fill) {
        for (int lane = 0; lane < lanes(); ++lane)
            if (!free(lane))
                fill(lane);
    };
    const MotionFormula formula = BaseMotion::formula(study_.excitation.kind);
    if (BaseMotion::on_host(study_)) {
        each_busy([this](int lane) { motion(lane).fill(first_step_[lane], bundle_.base_table + lane, lanes()); });
        if (single_)
            single_->take_base();
    } else if (single_) {
        single_->fill_base(formula, parameters_, first_step_);
    } else {
        (twice_ ? kernels_.fill_twice : kernels_.fill)(formula, parameters_, first_step_, bundle_.base_table);
    }
    if (topology_.model.extended())
        each_busy([this](int lane) { fill_extension(lane); });
}

/// Second differences of the base's displacement [m], for `chunk_steps` steps from one of the realization's own on.
std::array<double, chunk_steps> LaneSet::base_chunk(int lane, double first_step) const
{
    std::array<double, chunk_steps> table{};
    const BaseMotion& base = motion(lane);
    if (BaseMotion::on_host(study_)) {
        base.fill(first_step, table.data(), 1);
        return table;
    }
    std::array<double, 8> values{};
    const FormulaParameters one{&values[0], &values[1], &values[2], &values[3],
                                &values[4], &values[5], &values[6], &values[7]};
    base.store(one, 0);
    kernels(Isa::scalar).fill(BaseMotion::formula(study_.excitation.kind), one, &first_step, table.data());
    return table;
}

void LaneSet::fill_extension(int lane)
{
    const Place& place = places_[static_cast<std::size_t>(lane)];
    const Realization& r = place.realization;
    const double first = first_step_[lane];
    if (place.vertical)
        place.vertical->fill(first, bundle_.vertical_table + lane, lanes());
    else if (r.base.vertical_ratio != 0)
        for (std::size_t k = 0; k < chunk_steps; ++k)
            bundle_.vertical_table[k * lanes_ + static_cast<std::size_t>(lane)] =
                r.base.vertical_ratio * bundle_.base_table[k * lanes_ + static_cast<std::size_t>(lane)];
    if (r.base.pitch_rad_s2_m == 0)
        return;
    // Samples with straight lines between them have no second derivative: the rotation is their mean under a triangle
    // as wide as two samples, whose second derivative is a difference of three values.
    const double reach = std::max(1.0, std::round(place.motion.spacing_s() / r.step_s));
    const auto before = base_chunk(lane, first - reach), now = base_chunk(lane, first),
               after = base_chunk(lane, first + reach);
    const double per = r.base.pitch_rad_s2_m / (r.step_s * r.step_s);
    for (std::size_t k = 0; k < chunk_steps; ++k) {
        const int step = static_cast<int>(k);
        const Turn turn = turn_of(r, reach, before[k], now[k], after[k]);
        bundle_.at(OfPitch::angle, step, lane) = turn.angle_rad;
        bundle_.at(OfPitch::increment, step, lane) = turn.increment_rad;
        bundle_.at(OfPitch::second, step, lane) = per * ((after[k] - now[k]) - (now[k] - before[k])) / (reach * reach);
    }
}

/// @param reach steps between the three second differences of the base's displacement [m]
LaneSet::Turn LaneSet::turn_of(const Realization& r, double reach, double before, double now, double after)
{
    const double per = r.base.pitch_rad_s2_m / (r.step_s * r.step_s);
    return {per * (before + 10 * now + after) / 12, per * (after - before) / (2 * reach)};
}

void LaneSet::nudge(int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2)
{
    assert(topology_.model.mechanisms && "only the extended model can be nudged");
    const int k = place_of_[static_cast<std::size_t>(block)];
    const double dt = realization(lane).step_s, dt2 = dt * dt;
    if (k < topology_.fixed)
        return;
    bundle_.at(OfBlockExtension::nudge_x, k, lane) = dt2 * x_m_s2;
    bundle_.at(OfBlockExtension::nudge_y, k, lane) = dt2 * y_m_s2;
    bundle_.at(OfBlockExtension::nudge_theta, k, lane) = dt2 * theta_rad_s2;
}

BlockMotion LaneSet::centre(int k, int lane) const
{
    const Planar<double> moved = centre_of(topology_, bundle_, k, lane);
    return {moved.x, moved.y, moved.theta};
}

void LaneSet::read_motion(int lane)
{
    Place& place = places_[static_cast<std::size_t>(lane)];
    place.moved.resize(place.realization.blocks.size());
    place.inside.resize(place.realization.blocks.size(), -1);
    for (int k = topology_.fixed; k < topology_.blocks; ++k) {
        const auto i = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        place.moved[i] = centre(k, lane);
        place.inside[i] = static_cast<int>(bundle_.at(OfBlock::inside, k, lane));
    }
}

/// Not finite? fallen? energy out of balance? at rest, or out of time?
void LaneSet::check(int lane, int done)
{
    Place& place = places_[static_cast<std::size_t>(lane)];
    Watch& w = place.watch;
    w.steps += static_cast<std::uint64_t>(check_steps(topology_));
    first_step_[lane] = static_cast<double>(w.steps);

    read_motion(lane);
    if (!is_finite(topology_, bundle_, lane))
        return end(lane, State::invalid, InvalidReason::not_finite);

    place.limits.check(place.realization, w.steps, place.moved, place.inside, done);
    w.undecided = place.limits.undecided();
    w.seated = !place.limits.unseated();
    if (place.limits.fallen() && study_.outcome.follow == Follow::collapse)
        return end(lane, State::collapsed, InvalidReason::none);

    if (leaves_beds(topology_, bundle_, lane, w)) {
        place.handed = hand_over(lane);
        return;
    }
    if (unbalanced(topology_, bundle_, lane, w))
        return end(lane, State::invalid, InvalidReason::energy);

    if (watch_rest(topology_, bundle_, lane, place.limits.undecided(), w)) {
        place.limits.conclude(place.realization);
        end(lane, place.limits.fallen() ? State::collapsed : State::stood, InvalidReason::none);
    }
}

void LaneSet::end(int lane, State state, InvalidReason reason)
{
    Place& place = places_[static_cast<std::size_t>(lane)];
    const Realization& r = place.realization;
    Outcome o;
    o.step_s = r.step_s;
    o.steps = place.steps_before + (place.watch.steps - place.first_step);
    o.end_time_s = static_cast<double>(place.watch.steps) * r.step_s;
    o.peak_top_displacement_m = bundle_.at(OfRealization::peak_top, lane);
    const Watch& w = place.watch;
    o.at_rest = at_rest(w) ? 1 : 0;
    o.residual_top_displacement_m = w.quiet_top_m / static_cast<double>(w.quiet_checks) - place.start_top_x_m;
    o.top_path_m = bundle_.at(OfRealization::top_path, lane);
    o.total_sliding_m = bundle_.at(OfRealization::slip, lane);
    o.sliding_path_m = bundle_.at(OfRealization::path, lane);
    o.rocking_path_rad = bundle_.at(OfRealization::rocking_path, lane);
    const std::vector<double> offsets = bed_offsets(r, place.moved);
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        const double moved = std::fabs(offsets[j] - place.start_offset_m[j]);
        o.residual_sliding_m += moved;
        o.residual_dislocation = std::max(o.residual_dislocation, moved / bed_width_m(r, r.joints[j]));
    }
    for (int j = 0; j < topology_.beds(); ++j) {
        const double rotation = bundle_.at(OfJoint::max_rotation, j, lane);
        o.total_rocking_rad += rotation;
        o.max_relative_rotation_rad = std::max(o.max_relative_rotation_rad, rotation);
    }
    const EnergyBalance balance = energy_balance(topology_, bundle_, lane, w);
    o.energy_kinetic_j = balance.kinetic;
    o.energy_potential_j = balance.potential;
    o.energy_spring_j = balance.spring;
    o.energy_friction_j = balance.friction;
    o.energy_damping_j = balance.damping;
    o.energy_base_work_j = balance.base_work;
    o.energy_residual = balance.residual;
    if (state != State::invalid && !(std::fabs(o.energy_residual) < energy_bound)) {
        state = State::invalid;
        reason = InvalidReason::energy;
    }
    if (state == State::invalid)
        o.at_rest = 0;
    if (o.at_rest == 0) // a snapshot of what still moves is no residual
        o.residual_top_displacement_m = o.residual_sliding_m = o.residual_dislocation =
            std::numeric_limits<double>::quiet_NaN();
    // a realization that was set aside has no outcome
    (state == State::invalid ? LimitStates(r, study_.outcome, 0, 0) : place.limits).write(r, o);
    if (study_.survival) {
        o.bed_offset_m.assign(offsets.size(), 0);
        o.rotation_rad.assign(static_cast<std::size_t>(r.drums), 0);
        for (std::size_t j = 0; state != State::invalid && j < offsets.size(); ++j)
            o.bed_offset_m[j] = offsets[j] - place.start_offset_m[j];
        for (std::size_t i = 0; state != State::invalid && i < o.rotation_rad.size(); ++i)
            o.rotation_rad[i] = place.moved[i].theta_rad;
    }
    if (state == State::stood) {
        // the dominant of the two ways of moving, by the displacement that each stands for at the edge of a drum
        const bool rocks = o.max_relative_rotation_rad > study_.outcome.rocking_threshold_rad;
        const bool slides = o.total_sliding_m > study_.outcome.sliding_threshold * place.scales.width_m;
        const double opening = o.total_rocking_rad * place.scales.width_m;
        if (rocks && (!slides || opening >= o.total_sliding_m))
            state = State::rocked;
        else if (slides)
            state = State::slid;
    }
    o.state = state;
    o.invalid_reason = reason;
    place.outcome = o;
}

SimulatedTime LaneSet::furthest() const
{
    SimulatedTime furthest;
    for (const Place& place : places_) {
        const double reached = static_cast<double>(place.watch.steps) * place.watch.step_s;
        if (place.busy && reached > furthest.reached_s)
            furthest = {reached, static_cast<double>(place.watch.last_step) * place.watch.step_s};
    }
    return furthest;
}

Snapshot LaneSet::snapshot(int lane) const
{
    const Realization& r = realization(lane);
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

} // namespace stylobate
