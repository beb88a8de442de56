/// The step counted on the number that counts (`counted.hpp`).

#include "bench/counted.hpp"
#include "bench/spatial_column.hpp"
#include "kernels/planar/step.hpp"
#include "kernels/spatial/step.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <vector>

namespace stylobate {

namespace {

OperationCounts counted_per(long block_steps)
{
    return {counted.add / block_steps,  counted.mul / block_steps,  counted.fma / block_steps,
            counted.div / block_steps,  counted.sqrt / block_steps, counted.load / block_steps,
            counted.store / block_steps};
}

} // namespace

OperationCounts operations_per_block_step(int blocks)
{
    const Study study = rocking_column(blocks);
    const Sampler sampler(study, nullptr);
    std::vector<TopologyJoint> joints;
    for (int i = 1; i < blocks; ++i)
        joints.push_back({i - 1, i});
    Topology topology{blocks, 1, blocks - 1, blocks - 1, joints.data()};
    std::vector<int> bed_lists(static_cast<std::size_t>(bed_lists_size(topology)));
    list_beds(topology, bed_lists.data());
    std::vector<double> memory(bundle_registers(topology), 0.0);
    const Bundle b = bind_bundle(topology, 1, memory.data());
    const Realization r = sampler.realization(0);
    for (int i = 0; i < blocks; ++i) {
        const Block& block = r.blocks[static_cast<std::size_t>(i)];
        b.at(OfBlock::half_width, i, 0) = block.half_width_m;
        b.at(OfBlock::half_height, i, 0) = block.half_height_m;
        b.at(OfBlock::y, i, 0) = -1e-6 * i;
    }
    for (int j = 0; j < blocks - 1; ++j) {
        b.at(OfJoint::height, j, 0) = 0.029;
        b.at(OfJoint::depth_limit, j, 0) = 0.001;
        b.at(OfJoint::K_n, j, 0) = 1e8;
    }
    counted = {};
    Stepper<Counted, Baseline, false, true>(topology, b).run(0, 16);
    return counted_per(16L * (blocks - 1));
}

OperationCounts operations_per_spatial_step(spatial::BedKind kind)
{
    const spatial::Column column(kind);
    std::vector<double> memory(spatial::bundle_registers(column.topology()), 0.0);
    const spatial::Bundle b = spatial::bind_bundle(column.topology(), 1, memory.data());
    column.load(b, 0);
    counted = {};
    spatial::Stepper<Counted>(column.topology(), b).run(0, chunk_steps);
    return counted_per(static_cast<long>(chunk_steps) * spatial::Column::drums);
}

} // namespace stylobate
