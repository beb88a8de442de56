#include "ensemble/engine/single_bundle.hpp"

#include "ensemble/engine/watch.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

namespace stylobate {

namespace {

constexpr std::array compensated_fields = {
    std::pair{OfBlock::x, OfRemainder::x},         std::pair{OfBlock::y, OfRemainder::y},
    std::pair{OfBlock::theta, OfRemainder::theta}, std::pair{OfBlock::dx, OfRemainder::dx},
    std::pair{OfBlock::dy, OfRemainder::dy},       std::pair{OfBlock::dtheta, OfRemainder::dtheta}};

/// Sums over time: 1e5 steps would drown what a step adds.
constexpr std::array summed_fields = {OfRealization::slip,           OfRealization::path,
                                      OfRealization::rocking_path,   OfRealization::friction_energy,
                                      OfRealization::dashpot_energy, OfRealization::shear_energy,
                                      OfRealization::base_energy,    OfRealization::top_path};
/// What else of a realization the steps write.
constexpr std::array state_fields = {OfRealization::base_step, OfRealization::peak_top, OfRealization::kinetic,
                                     OfRealization::potential};
constexpr std::array joint_fields = {OfJoint::spring, OfJoint::max_rotation, OfJoint::elastic};

} // namespace

SingleBundle::SingleBundle(const Topology& topology, const Bundle& host, const KernelTable& kernels)
    : topology_(topology), host_(host), kernels_(kernels),
      memory_(aligned_array<float>(bundle_registers<float>(topology) * static_cast<std::size_t>(kernels.single_lanes))),
      own_(bind_bundle(topology, kernels.single_lanes, memory_.get(), host.close))
{
    assert(host.lanes == kernels.single_lanes && "the host's bundle has a place for each lane");
    assert(!topology.model.extended() && "single precision supports only the paper's model");
}

void SingleBundle::take(int lane)
{
    // both bundles have their registers in one order, but for the remainders before the tables, which come of their own
    const auto lanes = static_cast<std::size_t>(host_.lanes);
    for (std::size_t i = 0; i < bundle_registers(topology_) - table_registers(topology_); ++i) {
        const std::size_t at = i * lanes + static_cast<std::size_t>(lane);
        memory_[at] = static_cast<float>(host_.blocks[at]);
    }
    for (int block = 0; block < topology_.blocks; ++block)
        for (const auto& [field, remainder] : compensated_fields) {
            const double value = host_.at(field, block, lane);
            own_.at(remainder, block, lane) = static_cast<float>(value - static_cast<float>(value));
        }
    for (const auto field : summed_fields)
        own_.at(field, lane) = 0;
}

void SingleBundle::take_base()
{
    for (int i = 0; i < chunk_steps * host_.lanes; ++i)
        own_.base_table[i] = static_cast<float>(host_.base_table[i]);
}

void SingleBundle::fill_base(MotionFormula formula, const FormulaParameters& parameters, const double* first_step)
{
    kernels_.fill_single(formula, parameters, first_step, own_.base_table);
}

void SingleBundle::run(int first, int last)
{
    kernels_.run_single(topology_, own_, first, last);
    give(last % check_steps(topology_) == 0);
}

/// @param checked a check comes next
void SingleBundle::give(bool checked) const
{
    const int lanes = host_.lanes;
    for (int block = topology_.fixed; block < topology_.blocks; ++block)
        for (const auto& [field, remainder] : compensated_fields) {
            if (field >= OfBlock::dx && !topology_.model.rigid()) // of no use to the host
                continue;
            const float* const value = &own_.at(field, block, 0);
            const float* const rest = &own_.at(remainder, block, 0);
            double* const to = &host_.at(field, block, 0);
            for (int lane = 0; lane < lanes; ++lane)
                to[lane] = static_cast<double>(value[lane]) + rest[lane];
        }
    for (int block = topology_.fixed; block < topology_.blocks; ++block)
        for (int lane = 0; lane < lanes; ++lane)
            host_.at(OfBlock::inside, block, lane) = own_.at(OfBlock::inside, block, lane);
    for (int joint = 0; joint < topology_.joints; ++joint)
        for (const auto field : joint_fields) {
            const float* const value = &own_.at(field, joint, 0);
            double* const to = &host_.at(field, joint, 0);
            for (int lane = 0; lane < lanes; ++lane)
                to[lane] = value[lane];
        }
    if (topology_.model.rigid())
        give_beds();
    for (const auto field : state_fields)
        for (int lane = 0; lane < lanes; ++lane)
            host_.at(field, lane) = own_.at(field, lane);
    if (!checked) // else the sums would depend on where a chunk was parted
        return;
    for (const auto field : summed_fields)
        for (int lane = 0; lane < lanes; ++lane) {
            host_.at(field, lane) += own_.at(field, lane);
            own_.at(field, lane) = 0;
        }
}

/// What tells the host whether a realization is to be handed over (`leaves_beds`).
void SingleBundle::give_beds() const
{
    const auto give = [lanes = host_.lanes](const float* from, double* to) { std::copy_n(from, lanes, to); };
    for (int block = topology_.fixed; block < topology_.blocks; ++block)
        for (const auto field : {OfBlock::sine, OfBlock::versine})
            give(&own_.at(field, block, 0), &host_.at(field, block, 0));
    for (int joint = 0; joint < topology_.beds(); ++joint)
        for (const auto field : {OfRigidJoint::left_x, OfRigidJoint::right_x, OfRigidJoint::sliding})
            give(&own_.at(field, joint, 0), &host_.at(field, joint, 0));
}

} // namespace stylobate
