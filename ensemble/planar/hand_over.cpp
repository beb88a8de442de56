#include "ensemble/planar/hand_over.hpp"

#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

// Of the contacts of `compliant_form`.
constexpr double sunk_part = 1e-4;
constexpr double shear_part = 0.5;
constexpr double ratio_of_damping = 0.5;

/// Sums over the path of a realization, which go on.
constexpr std::array path_fields = {OfRealization::slip,           OfRealization::path,
                                    OfRealization::rocking_path,   OfRealization::friction_energy,
                                    OfRealization::dashpot_energy, OfRealization::shear_energy,
                                    OfRealization::base_energy,    OfRealization::peak_top,
                                    OfRealization::top_path};

} // namespace

Realization compliant_form(const Realization& rigid)
{
    assert(rigid.form == ContactForm::rigid && rigid.step_s > 0);
    Realization r = rigid;
    r.form = ContactForm::area;
    double line_load_n_m = 0;
    for (int j = 0; j < r.beds(); ++j)
        line_load_n_m = std::max(line_load_n_m, bed_load_n(r, j) / face_length_m(r, j));
    const double K_n = line_load_n_m / (sunk_part * scales_of(r).least_size_m);
    for (int j = 0; j < static_cast<int>(r.joints.size()); ++j) {
        Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        const double chord = j < r.beds() ? face_length_m(r, j) : longest_contact_m(lower, upper);
        const double mass = contact_mass_kg(lower, upper);
        joint.normal_stiffness_n_m2 = K_n;
        joint.tangential_stiffness_n_m = shear_part * K_n * chord;
        joint.normal_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(K_n * chord * mass);
        joint.tangential_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(joint.tangential_stiffness_n_m * mass);
        joint.damping_chord_m = chord;
        joint.restitution = 0;
    }
    // an even part, so that the middle of a rigid step is between two of these
    const double longest_s = RunSpec{}.step_fraction * step_bound_to_rest(r).dt_s;
    r.step_s = rigid.step_s / (2 * std::ceil(rigid.step_s / (2 * longest_s)));
    return r;
}

HandOver PlanarModel::hand_over(int lane, const Place& place) const
{
    HandOver h{place.realization, place.watch, place.measured, {}, {}, {}};
    h.increment.resize(place.measured.moved.size());
    for (int k = topology_.fixed; k < topology_.blocks; ++k)
        h.increment[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])] = {
            bundle_.at(OfBlock::dx, k, lane), bundle_.at(OfBlock::dy, k, lane), bundle_.at(OfBlock::dtheta, k, lane)};
    for (int j = 0; j < topology_.beds(); ++j)
        h.max_rotation_rad.push_back(bundle_.at(OfJoint::max_rotation, j, lane));
    for (const auto field : path_fields)
        h.of[field] = bundle_.at(field, lane);
    return h;
}

void take_over(LaneSet& set, int lane, const HandOver& h)
{
    set.load(lane, compliant_form(h.realization));
    LaneSet::Place& place = set.place(lane);
    PlanarModel& model = set.model();
    const Topology& topology = model.topology();
    const Bundle& bundle = model.bundle();
    const Realization& r = place.realization;
    const double shorter = r.step_s / h.realization.step_s;
    const auto times = static_cast<std::uint64_t>(std::lround(1 / shorter));
    // the increment of a step is the velocity at its middle
    const std::uint64_t step = h.watch.steps * times - times / 2;
    for (int k = topology.fixed; k < topology.blocks; ++k) {
        const auto i = static_cast<std::size_t>(model.order()[static_cast<std::size_t>(k)]);
        const BlockMotion &at = h.measured.moved[i], &d = h.increment[i];
        bundle.at(OfBlock::x, k, lane) = at.x_m - 0.5 * d.x_m;
        bundle.at(OfBlock::y, k, lane) = at.y_m - 0.5 * d.y_m;
        bundle.at(OfBlock::theta, k, lane) = at.theta_rad - 0.5 * d.theta_rad;
        bundle.at(OfBlock::dx, k, lane) = shorter * d.x_m;
        bundle.at(OfBlock::dy, k, lane) = shorter * d.y_m;
        bundle.at(OfBlock::dtheta, k, lane) = shorter * d.theta_rad;
    }
    for (int j = 0; j < topology.joints; ++j)
        for (const auto field : {OfJoint::spring, OfJoint::shear_force})
            bundle.at(field, j, lane) = 0;
    for (int j = 0; j < topology.beds(); ++j)
        bundle.at(OfJoint::max_rotation, j, lane) = h.max_rotation_rad[static_cast<std::size_t>(j)];
    for (const auto field : path_fields)
        bundle.at(field, lane) = h.of[field];
    bundle.at(OfRealization::base_energy, lane) *= shorter * shorter;
    model.take_single(lane);

    Watch& w = place.watch;
    w.start_potential_j = h.watch.start_potential_j;
    w.start_spring_j = h.watch.start_spring_j;
    w.start_shear_j = h.watch.start_shear_j;
    w.slip_m = h.watch.slip_m;
    w.seated = h.watch.seated;
    w.steps = place.first_step = step;
    place.steps_before = h.watch.steps;
    set.bases().first_step(lane) = static_cast<double>(step);
    const std::uint64_t fall_steps = place.measured.limits.fall_steps();
    place.measured = h.measured;
    place.measured.limits.shorten_steps(times, fall_steps);
    model.read(lane, place);
}

CompliantSet::CompliantSet(const Study& study, const Motion* record, const KernelTable& kernels,
                           const Realization& pattern)
    : pattern_(compliant_form(pattern)), set_(study, record, kernels, pattern_)
{
}

void CompliantSet::fill()
{
    for (int lane = 0; lane < set_.lanes() && !waiting_.empty(); ++lane)
        if (set_.free(lane)) {
            take_over(set_, lane, waiting_.back());
            waiting_.pop_back();
        }
}

} // namespace stylobate
