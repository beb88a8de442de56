#pragma once
/// A bundle of rocking columns as the ensemble leaves it after some chunks, and the kernel that steps it: for what
/// measures the steps alone.

#include "bench/scenes.hpp"
#include "ensemble/planar/planar_model.hpp"

#include <algorithm>
#include <vector>

namespace stylobate {

class WarmKernel {
public:
    WarmKernel(Isa isa, int blocks)
        : table_(kernels(isa)), seen_(seen()), study_(rocking_column(blocks)), sampler_(study_, nullptr),
          lanes_(study_, nullptr, seen_, sampler_.realization(0), study_.realizations),
          block_steps_(lanes_.lanes() * (blocks - 1) * chunk_steps)
    {
        for (int lane = 0; lane < lanes_.lanes(); ++lane)
            lanes_.load(lane, sampler_.realization(static_cast<std::uint64_t>(lane)));
        for (int chunk = 0; chunk < 100; ++chunk)
            lanes_.advance();
        const std::size_t size = bundle_registers(topology) * static_cast<std::size_t>(bundle.lanes);
        start_.assign(bundle.begin[0], bundle.begin[0] + size);
    }

    /// One chunk, always with the same base motion: not for long without `restart`.
    void run() const { (twice() ? table_.planar.run_twice : table_.planar.run)(topology, bundle, 0, chunk_steps); }
    /// Whether two registers are stepped at a time.
    bool twice() const { return lanes_.lanes() > table_.lanes; }
    void restart() const { std::copy(start_.begin(), start_.end(), bundle.begin[0]); }
    /// Of one chunk.
    int block_steps() const { return block_steps_; }

private:
    // what the lanes give the kernel, looked at on its way
    inline static Topology topology;
    inline static Bundle bundle;
    inline static decltype(PlanarKernels::run) forward = nullptr, forward_twice = nullptr;

    KernelTable seen() const
    {
        forward = table_.planar.run;
        forward_twice = table_.planar.run_twice;
        KernelTable seen = table_;
        seen.planar.run_twice = [](const Topology& t, const Bundle& b, int first, int last) {
            topology = t;
            bundle = b;
            forward_twice(t, b, first, last);
        };
        seen.planar.run = [](const Topology& t, const Bundle& b, int first, int last) {
            topology = t;
            bundle = b;
            forward(t, b, first, last);
        };
        return seen;
    }

    const KernelTable& table_;
    KernelTable seen_;
    Study study_;
    Sampler sampler_;
    LaneSet lanes_;
    int block_steps_;
    std::vector<double> start_;
};

} // namespace stylobate
