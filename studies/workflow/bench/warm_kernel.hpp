#pragma once
/// A bundle of rocking columns as the ensemble leaves it after some chunks, and the kernel that steps it: for what
/// measures the steps alone.

#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stylobate {

class WarmKernel {
public:
    /// @param blocks of the column, the fixed one counted
    WarmKernel(Isa isa, int blocks)
        : kernels_(kernels(isa)), study_(rocking_column(blocks)), sampler_(study_, nullptr),
          lanes_(study_, nullptr, kernels_, sampler_.realization(0), study_.realizations)
    {
        for (int lane = 0; lane < lanes_.lanes(); ++lane)
            lanes_.load(lane, sampler_.realization(static_cast<std::uint64_t>(lane)));
        for (int chunk = 0; chunk < 100; ++chunk)
            lanes_.advance();
        const std::size_t size = bundle_registers(model().topology()) * static_cast<std::size_t>(lanes_.lanes());
        start_.assign(model().memory(), model().memory() + size);
    }

    /// One chunk, always with the same base motion: not for long without `restart`.
    void run() const
    {
        (twice() ? kernels_.planar.run_twice : kernels_.planar.run)(model().topology(), model().bundle(), 0,
                                                                    chunk_steps);
    }
    /// Whether two registers are stepped at a time.
    bool twice() const { return model().twice(); }
    void restart() const { std::copy(start_.begin(), start_.end(), model().memory()); }
    /// Of one chunk.
    int block_steps() const { return lanes_.lanes() * model().topology().free_blocks() * chunk_steps; }

private:
    const PlanarModel& model() const { return lanes_.model(); }

    const KernelTable& kernels_;
    Study study_;
    Sampler sampler_;
    LaneSet lanes_;
    std::vector<double> start_;
};

} // namespace stylobate
