#pragma once
/// What goes between a bundle that is stepped in single precision and that in double precision, which the host writes
/// and reads: on the processor for many lanes at once, on a device for one slot.

#include "ensemble/planar/planar_watch.hpp"
#include "kernels/planar/bundle.hpp"

#include <initializer_list>

namespace stylobate {

namespace detail {

/// Calls f(field, its remainder) for what is kept as a compensated sum.
template <class F>
STYLOBATE_INLINE void each_compensated(F&& f)
{
    f(OfBlock::x, OfRemainder::x);
    f(OfBlock::y, OfRemainder::y);
    f(OfBlock::theta, OfRemainder::theta);
    f(OfBlock::dx, OfRemainder::dx);
    f(OfBlock::dy, OfRemainder::dy);
    f(OfBlock::dtheta, OfRemainder::dtheta);
}

/// Calls f(field) for the sums over time: 1e5 steps would drown what a step adds.
template <class F>
STYLOBATE_INLINE void each_sum(F&& f)
{
    for (const auto field : {OfRealization::slip, OfRealization::path, OfRealization::rocking_path,
                             OfRealization::friction_energy, OfRealization::dashpot_energy, OfRealization::shear_energy,
                             OfRealization::base_energy, OfRealization::top_path})
        f(field);
}

} // namespace detail

/// Rounds what the host has written of lanes `first` to `last - 1`.
STYLOBATE_INLINE void round_lanes(const Topology& topology, const Bundle& host, const BundleOf<float>& single,
                                  int first, int last)
{
    // both bundles have their registers in one order, but for the remainders before the tables, which come of their own
    const auto registers = static_cast<long>(bundle_registers(topology) - table_registers(topology));
    for (long i = 0; i < registers; ++i)
        for (int lane = first; lane < last; ++lane)
            single.begin[0][i * host.lanes + lane] = static_cast<float>(host.begin[0][i * host.lanes + lane]);
    for (int block = 0; block < topology.blocks; ++block)
        detail::each_compensated([&](auto field, auto remainder) {
            for (int lane = first; lane < last; ++lane) {
                const double value = host.at(field, block, lane);
                single.at(remainder, block, lane) = static_cast<float>(value - static_cast<float>(value));
            }
        });
    detail::each_sum([&](auto field) {
        for (int lane = first; lane < last; ++lane)
            single.at(field, lane) = 0;
    });
}

/// Gives the host what a check of lanes `first` to `last - 1` reads, and moves the sums over time there.
/// @param checked a check comes next: else the sums stay, because they would depend on where a chunk was parted
STYLOBATE_INLINE void give_lanes(const Topology& topology, const BundleOf<float>& single, const Bundle& host, int first,
                                 int last, bool checked)
{
    const auto copy = [first, last](const float* from, double* to) {
        for (int lane = first; lane < last; ++lane)
            to[lane] = from[lane];
    };
    for (int block = topology.fixed; block < topology.blocks; ++block) {
        detail::each_compensated([&](auto field, auto remainder) {
            if (field >= OfBlock::dx && !topology.model.rigid()) // of no use to the host
                return;
            const float* const value = &single.at(field, block, 0);
            const float* const rest = &single.at(remainder, block, 0);
            double* const to = &host.at(field, block, 0);
            for (int lane = first; lane < last; ++lane)
                to[lane] = static_cast<double>(value[lane]) + rest[lane];
        });
        copy(&single.at(OfBlock::inside, block, 0), &host.at(OfBlock::inside, block, 0));
    }
    for (int joint = 0; joint < topology.joints; ++joint)
        for (const auto field : {OfJoint::spring, OfJoint::max_rotation, OfJoint::elastic})
            copy(&single.at(field, joint, 0), &host.at(field, joint, 0));
    if (topology.model.rigid()) { // whether a realization is to be handed over (`leaves_beds`)
        for (int block = topology.fixed; block < topology.blocks; ++block)
            for (const auto field : {OfBlock::sine, OfBlock::versine})
                copy(&single.at(field, block, 0), &host.at(field, block, 0));
        for (int joint = 0; joint < topology.beds(); ++joint)
            for (const auto field : {OfRigidJoint::left_x, OfRigidJoint::right_x, OfRigidJoint::sliding})
                copy(&single.at(field, joint, 0), &host.at(field, joint, 0));
    }
    for (const auto field :
         {OfRealization::base_step, OfRealization::peak_top, OfRealization::kinetic, OfRealization::potential})
        copy(&single.at(field, 0), &host.at(field, 0));
    if (!checked)
        return;
    detail::each_sum([&](auto field) {
        for (int lane = first; lane < last; ++lane) {
            host.at(field, lane) += single.at(field, lane);
            single.at(field, lane) = 0;
        }
    });
}

} // namespace stylobate
