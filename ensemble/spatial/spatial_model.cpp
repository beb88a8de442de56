#include "ensemble/spatial/spatial_model.hpp"

#include "ensemble/spatial/structure/settle.hpp"
#include "ensemble/spatial/structure/solid_mechanisms.hpp"
#include "kernels/spatial/bed.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

using B = spatial::OfBody;
using J = spatial::OfJoint;
using W = spatial::OfRealization; // the whole

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A body that leans less than this falls the way it is displaced, else the way its axis leans.
constexpr double least_lean_rad = 0.1;

spatial::Vector<double> vector_of(const std::array<double, 3>& v)
{
    return {v[0], v[1], v[2]};
}

/// Beyond this angle from upright a body on its bottom face overturns by itself: its slenderness angle.
double slenderness_rad(const Solid& solid)
{
    return std::atan2(std::min(solid.bottom.half_x_m, solid.bottom.half_z_m), solid.centre_height_m);
}

/// Lowest solid that carries others and does not move: rest heights are counted from its top.
double base_top_m(const SpatialStructure& structure)
{
    const Solid& base = structure.solids[static_cast<std::size_t>(structure.joints.front().lower)];
    return base.centre_m[1] - base.centre_height_m + base.height_m;
}

FallStates fall_states(const SpatialStructure& structure, std::uint64_t fall_steps)
{
    std::vector<FallStates::Body> bodies;
    for (const Solid& solid : structure.solids)
        bodies.push_back({solid.role, solid.column, solid.fixed});
    return {std::move(bodies), fall_steps};
}

/// The rotation about the axis of a joint's lower body, of its upper body [rad].
double twist_rad(const spatial::Quaternion<double>& turned)
{
    return 2 * std::atan2(turned.y, turned.w);
}

} // namespace

SpatialModel::SpatialModel(const Study& study, const KernelTable& kernels, const Realization& pattern, std::uint64_t)
    : study_(study), kernels_(kernels), lanes_(static_cast<std::size_t>(kernels.lanes)), solids_(pattern.space),
      memory_(aligned_array<double>(spatial::bundle_registers(topology()) * lanes_)),
      tables_(aligned_array<double>(static_cast<std::size_t>(channels) * chunk_steps * lanes_)),
      bundle_(spatial::bind_bundle(topology(), lanes(), memory_.get()))
{
}

void SpatialModel::clear(int lane)
{
    const std::size_t registers = spatial::bundle_registers(topology());
    for (std::size_t i = 0; i < registers; ++i)
        memory_[i * lanes_ + static_cast<std::size_t>(lane)] = 0;
}

void SpatialModel::begin(int lane, Place& place)
{
    const Realization& r = place.realization;
    const SpatialStructure& space = r.space;
    SpatialMeasured& m = place.measured;
    assert((!model_in_space(space).mechanisms || topology().model.mechanisms) &&
           "the realizations of a bundle follow the model of the pattern that it was made from");
    m.falls = fall_states(space, whole_checks(fall_time / place.scales.p_rad_s, r.step_s, check_steps()));
    m.direction_cosine = std::cos(r.direction_rad);
    m.direction_sine = std::sin(r.direction_rad);
    store_solids(r, solids_, bundle_, lane);
    const double base_top = base_top_m(space);
    for (std::size_t i = 0; i < space.solids.size(); ++i) {
        const Solid& solid = space.solids[i];
        m.least_y_m.push_back((study_.outcome.collapse_height_fraction - 1) * (solid.centre_m[1] - base_top));
        m.least_upright.push_back(std::cos(slenderness_rad(solid)));
        if (const int k = solids_.place_of(i); k >= topology().fixed) {
            bundle_.at(B::least_y, k, lane) = m.least_y_m[i];
            bundle_.at(B::least_upright, k, lane) = m.least_upright[i];
        }
    }
    bundle_.at(W::across_x, lane) = -m.direction_sine;
    bundle_.at(W::across_z, lane) = m.direction_cosine;
    settle(r, solids_, bundle_, lane);
    first_increments(lane, place.watch);
    for (int j = 0; j < topology().joints; ++j)
        m.start_offset_m.push_back(face_offset(j, lane));
    m.start_top_x_m = bundle_.at(B::x, topology().top, lane);
    m.start_top_z_m = bundle_.at(B::z, topology().top, lane);
}

/// The increments before the first step: U(-dt) = U0 + a0 dt2 / 2 for a start from rest, a0 by one trial step of the
/// contact forces and gravity alone (the base does not move before it starts); the angular momentum likewise.
void SpatialModel::first_increments(int lane, Watch& w)
{
    const std::size_t registers = spatial::bundle_registers(topology());
    const AlignedArray<double> memory = aligned_array<double>(registers);
    const spatial::Bundle one = spatial::bind_bundle(topology(), 1, memory.get());
    // (the tables of the base's motion are at 0: the lane has just been cleared)
    for (std::size_t i = 0; i < registers; ++i)
        memory[i] = memory_[i * lanes_ + static_cast<std::size_t>(lane)];
    kernels(Isa::scalar).spatial.run(topology(), one, 0, 1);
    for (int i = topology().fixed; i < topology().bodies; ++i)
        for (const B::Field field : {B::dx, B::dy, B::dz, B::l_x, B::l_y, B::l_z})
            bundle_.at(field, i, lane) = -0.5 * one.at(field, i, 0);
    using D = spatial::OfJointMechanisms; // dowels may be strained at rest, and have yielded
    for (int j = 0; topology().model.mechanisms && j < topology().joints; ++j)
        for (int field = D::dowel_set; field < D::count; ++field)
            bundle_.at(static_cast<D::Field>(field), j, lane) = one.at(static_cast<D::Field>(field), j, 0);
    w.start_dowel_j = spatial::dowel_energy(topology(), bundle_, lane);
    w.start_potential_j = one.at(W::potential, 0) / (w.step_s * w.step_s);
    w.start_spring_j = spatial::bed_energy(topology(), one, 0) + spatial::spring_energy(topology(), bundle_, lane);
}

void SpatialModel::run(const LaneBases& bases, const std::vector<Place>& places, int first, int last)
{
    if (first == 0)
        fill_tables(bases, places);
    kernels_.spatial.run(topology(), bundle_, first, last);
}

/// The three scalar motions of each lane, and from them the motion of its base along x, y and z.
void SpatialModel::fill_tables(const LaneBases& bases, const std::vector<Place>& places)
{
    const std::size_t size = chunk_steps * lanes_;
    double* const u1 = tables_.get();
    double* const u2 = u1 + size;
    double* const u3 = u2 + size;
    int channel = 0;
    for (double* const table : {u1, u2, u3}) {
        if (bases.on_host()) {
            for (int lane = 0; lane < lanes(); ++lane)
                if (const Place& place = places[static_cast<std::size_t>(lane)]; place.busy)
                    place.motions[static_cast<std::size_t>(channel)].fill(bases.first_step(lane), table + lane,
                                                                          lanes());
        } else {
            bases.fill(channel, table);
        }
        ++channel;
    }
    double* const x = bundle_.rows<spatial::OfBaseX::Field>();
    double* const y = bundle_.rows<spatial::OfBaseY::Field>();
    double* const z = bundle_.rows<spatial::OfBaseZ::Field>();
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        if (!places[lane].busy)
            continue;
        const double c = places[lane].measured.direction_cosine, s = places[lane].measured.direction_sine;
        for (std::size_t i = lane; i < size; i += lanes_) {
            x[i] = c * u1[i] - s * u2[i];
            y[i] = u3[i];
            z[i] = s * u1[i] + c * u2[i];
        }
    }
}

bool SpatialModel::rests(int lane, Place& place) const
{
    SpatialMeasured& m = place.measured;
    const bool over = watch_rest(topology(), bundle_, lane, m.falls.undecided(), place.watch);
    if (place.watch.quiet != 0) {
        if (place.watch.quiet_checks == 1)
            m.quiet_top_z_m = 0;
        m.quiet_top_z_m += bundle_.at(B::z, topology().top, lane);
    }
    return over;
}

void SpatialModel::check_limits(int lane, Place& place, int done) const
{
    const Realization& r = place.realization;
    SpatialMeasured& m = place.measured;
    const std::uint64_t steps = place.watch.steps;
    m.falls.begin_check();
    for (int k = topology().fixed; k < topology().bodies; ++k) {
        const auto i = static_cast<std::size_t>(solids_.order()[static_cast<std::size_t>(k)]);
        if (!m.falls.watches(i))
            continue;
        const spatial::Vector<double> axis = spatial::direction_of<spatial::Axis::y>(attitude(k, lane));
        m.falls.see(i, steps, bundle_.at(B::y, k, lane) < m.least_y_m[i], axis.y < m.least_upright[i],
                    static_cast<int>(bundle_.at(B::inside, k, lane)), done);
    }
    for (int j = 0; j < topology().joints && m.falls.may_unseat(steps); ++j) {
        const SolidJoint& joint = r.space.joints[static_cast<std::size_t>(j)];
        if (joint.normal != Normal::y ||
            r.space.solids[static_cast<std::size_t>(joint.upper)].role != BlockRole::epistyle)
            continue;
        const std::array<double, 2> offset = face_offset(j, lane); // along z and x
        if (std::fabs(offset[0]) > joint.lower_face.half_z_m + joint.upper_face.half_z_m ||
            std::fabs(offset[1]) > joint.lower_face.half_x_m + joint.upper_face.half_x_m)
            m.falls.unseat(static_cast<std::size_t>(joint.upper), steps);
    }
    place.watch.undecided = m.falls.undecided();
    place.watch.seated = !m.falls.unseated();
}

spatial::Quaternion<double> SpatialModel::attitude(int k, int lane) const
{
    return {bundle_.at(B::q_w, k, lane), bundle_.at(B::q_x, k, lane), bundle_.at(B::q_y, k, lane),
            bundle_.at(B::q_z, k, lane)};
}

spatial::Vector<double> SpatialModel::displacement(int k, int lane) const
{
    return {bundle_.at(B::x, k, lane), bundle_.at(B::y, k, lane), bundle_.at(B::z, k, lane)};
}

spatial::Quaternion<double> SpatialModel::turned(int j, int lane) const
{
    const spatial::TopologyJoint& joint = topology().joint[j];
    return spatial::relative_rotation(attitude(joint.lower, lane), attitude(joint.upper, lane));
}

std::array<double, 2> SpatialModel::face_offset(int j, int lane) const
{
    const spatial::TopologyJoint& joint = topology().joint[j];
    const auto body = [&](int k, J::Field anchor) {
        const auto at = [&](int n) { return bundle_.at(static_cast<J::Field>(anchor + n), j, lane); };
        const spatial::Quaternion<double> q = attitude(k, lane);
        return spatial::BedBody<double>{displacement(k, lane), q, spatial::minus_identity(q), {at(0), at(1), at(2)}};
    };
    const spatial::BedPose<double> pose =
        spatial::bed_pose(body(joint.lower, J::lower_anchor), body(joint.upper, J::upper_anchor), joint.normal,
                          bundle_.at(J::gap, j, lane));
    return {pose.place.x, pose.place.y};
}

void SpatialModel::measure(int lane, const Place& place, State state, Outcome& o) const
{
    const Realization& r = place.realization;
    const SpatialMeasured& m = place.measured;
    const Watch& w = place.watch;
    const double radial2 = bundle_.at(W::peak_radial, lane);
    o.peak_top_displacement_m = std::sqrt(radial2);
    o.out_of_plane_share = radial2 > 0 ? bundle_.at(W::peak_across, lane) / o.peak_top_displacement_m : 0;
    const auto checks = static_cast<double>(w.quiet_checks);
    o.residual_top_displacement_m = w.quiet_top_m / checks - m.start_top_x_m;
    o.residual_top_z_m = m.quiet_top_z_m / checks - m.start_top_z_m;
    o.total_sliding_m = bundle_.at(W::slip, lane);
    for (int j = 0; j < topology().joints; ++j) {
        const SolidJoint& joint = r.space.joints[static_cast<std::size_t>(j)];
        const std::array<double, 2> now = face_offset(j, lane), start = m.start_offset_m[static_cast<std::size_t>(j)];
        const double moved = std::hypot(now[0] - start[0], now[1] - start[1]);
        const double half_m = std::min({joint.lower_face.half_x_m, joint.lower_face.half_z_m, joint.upper_face.half_x_m,
                                        joint.upper_face.half_z_m});
        o.residual_sliding_m += moved;
        o.residual_dislocation = std::max(o.residual_dislocation, moved / (2 * half_m));
        const double tilt = std::acos(std::clamp(1 - bundle_.at(J::most_tilt, j, lane), -1.0, 1.0));
        o.total_rocking_rad += tilt;
        o.max_relative_rotation_rad = std::max(o.max_relative_rotation_rad, tilt);
        const double half_twist = std::min(bundle_.at(J::most_twist, j, lane), 1.0);
        o.max_twist_rad = std::max(o.max_twist_rad, 2 * std::asin(half_twist));
        if (joint.normal == Normal::y)
            o.residual_twist_rad = std::max(o.residual_twist_rad, std::fabs(twist_rad(turned(j, lane))));
    }
    if (o.at_rest == 0)
        forget_residuals(o);
    // a realization that was set aside has no outcome
    const bool valid = state != State::invalid;
    (valid ? m.falls : fall_states(r.space, 0)).write(r.step_s, r.space.drums, o);
    o.fall_azimuth_rad = nan;
    o.fallen_column = -1;
    if (valid)
        measure_fall(lane, m, r.space, o);
}

void SpatialModel::measure_fall(int lane, const SpatialMeasured& m, const SpatialStructure& space, Outcome& o) const
{
    double most = -2; // of several at the same step the one that is turned farthest beyond its limit
    for (int k = topology().fixed; k < topology().bodies; ++k) {
        const auto i = static_cast<std::size_t>(solids_.order()[static_cast<std::size_t>(k)]);
        if (!m.falls.fell_first(i))
            continue;
        const spatial::Vector<double> axis = spatial::direction_of<spatial::Axis::y>(attitude(k, lane)),
                                      moved = displacement(k, lane);
        if (const double beyond = m.least_upright[i] - axis.y; beyond > most)
            most = beyond;
        else
            continue;
        const bool leans = std::acos(std::clamp(axis.y, -1.0, 1.0)) > least_lean_rad;
        o.fall_azimuth_rad = leans ? std::atan2(axis.z, axis.x) : std::atan2(moved.z, moved.x);
        o.fallen_column = space.solids[i].column;
    }
}

State SpatialModel::motion_of(const Place& place, const Outcome& o) const
{
    return dominant_motion(study_.outcome, place.scales.width_m, o);
}

SolidSnapshot SpatialModel::snapshot(int lane, const Place& place) const
{
    SolidSnapshot s;
    const std::vector<Solid>& solids = place.realization.space.solids;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const int k = solids_.place_of(i);
        const spatial::Quaternion<double> q = k < 0 ? spatial::no_rotation<double>() : attitude(k, lane);
        const spatial::Vector<double> middle = vector_of(solids[i].middle_m()),
                                      from = middle - vector_of(solids[i].centre_m),
                                      u = k < 0 ? spatial::zero_vector<double>() : displacement(k, lane);
        const spatial::Vector<double> at = middle + (u + spatial::displaced(spatial::minus_identity(q), from));
        std::size_t list = 0;
        for (const double value : {at.x, at.y, at.z, q.w, q.x, q.y, q.z})
            s.lists[list++].push_back(value);
    }
    return s;
}

Trajectory SpatialModel::trajectory_of(const Realization& realization, std::vector<std::string> names)
{
    Trajectory t(spatial_channels);
    t.index = realization.index;
    t.name = std::move(names);
    for (std::size_t i = 0; i < t.name.size(); ++i) {
        const Solid& solid = realization.space.solids[i];
        const std::array<double, 3> middle = solid.middle_m();
        t["rest_x_m"].push_back(middle[0]);
        t["rest_y_m"].push_back(middle[1]);
        t["rest_z_m"].push_back(middle[2]);
        t["half_height_m"].push_back(solid.height_m / 2);
        t["bottom_half_x_m"].push_back(solid.bottom.half_x_m);
        t["bottom_half_z_m"].push_back(solid.bottom.half_z_m);
        t["top_half_x_m"].push_back(solid.top.half_x_m);
        t["top_half_z_m"].push_back(solid.top.half_z_m);
        t["round"].push_back(!solid.bottom.round ? 0 : solid.top.round ? 1 : 2);
        t.role.push_back(solid.role);
        t.column.push_back(solid.column);
    }
    return t;
}

std::array<double, SpatialModel::channels> SpatialModel::base_place(const Place& place, double time_s)
{
    const double u1 = place.motions[0].displacement_m(time_s), u2 = place.motions[1].displacement_m(time_s),
                 u3 = place.motions[2].displacement_m(time_s);
    const double c = place.measured.direction_cosine, s = place.measured.direction_sine;
    return {c * u1 - s * u2, u3, s * u1 + c * u2};
}

} // namespace stylobate
