#include "ensemble/planar/single_bundle.hpp"

#include "ensemble/planar/single_lanes.hpp"

#include <cassert>
#include <cstddef>

namespace stylobate {

SingleBundle::SingleBundle(const Topology& topology, const Bundle& host, const KernelTable& kernels)
    : topology_(topology), host_(host), kernels_(kernels),
      memory_(aligned_array<float>(bundle_registers<float>(topology) * static_cast<std::size_t>(kernels.single_lanes))),
      own_(bind_bundle(topology, kernels.single_lanes, memory_.get(), host.close))
{
    assert(host.lanes == kernels.single_lanes && "the host's bundle has a place for each lane");
    assert(!topology.model.has_mechanism_rows() && "single precision supports only the paper's model");
}

void SingleBundle::take(int lane)
{
    round_lanes(topology_, host_, own_, lane, lane + 1);
}

void SingleBundle::take_base()
{
    for (int i = 0; i < chunk_steps * host_.lanes; ++i)
        own_.rows<OfBase::Field>()[i] = static_cast<float>(host_.rows<OfBase::Field>()[i]);
}

void SingleBundle::run(int first, int last)
{
    kernels_.planar.run_single(topology_, own_, first, last);
    give_lanes(topology_, own_, host_, 0, host_.lanes, last % check_steps(topology_) == 0);
}

} // namespace stylobate
