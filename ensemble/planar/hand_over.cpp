/// How a realization goes from rigid contacts to contacts that yield (`planar_model.hpp`, `compliant_set.hpp`).

#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/structure/compliant_form.hpp"

#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

/// Sums over the path of a realization, which go on.
constexpr std::array path_fields = {OfRealization::slip,           OfRealization::path,
                                    OfRealization::rocking_path,   OfRealization::friction_energy,
                                    OfRealization::dashpot_energy, OfRealization::shear_energy,
                                    OfRealization::base_energy,    OfRealization::peak_top,
                                    OfRealization::top_path};

} // namespace

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

} // namespace stylobate
