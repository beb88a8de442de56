#pragma once
/// Realizations with every mechanism, and runs of them whose every bit can be compared.

#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/structure/mechanisms.hpp"
#include "studies/evidence/verification/model.hpp"
#include "tests/ensemble/engine/outcome_bits.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace stylobate::model {

/// Everything that a run says of a realization: positions after each chunk, then its outcome.
using Bits = std::vector<std::uint64_t>;

inline void add_bits(const LaneSet& set, int lane, Bits& bits)
{
    const Snapshot s = set.snapshot(lane);
    for (const std::vector<double>* values : {&s.x_m, &s.y_m, &s.theta_rad})
        for (const double value : *values)
            bits.push_back(std::bit_cast<std::uint64_t>(value));
}

/// Runs realizations in the lanes of one bundle of an instruction set, over and over until all have been, each for at
/// most `chunks` chunks.
inline std::vector<Bits> run_bits(Isa isa, const Study& study, const std::vector<Realization>& all, int chunks)
{
    std::vector<Bits> bits(all.size());
    LaneSet set(study, nullptr, kernels(isa), all.front());
    const auto lanes = static_cast<std::size_t>(set.lanes());
    for (std::size_t begin = 0; begin < all.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, all.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
            set.load(static_cast<int>(i), all[begin + i]);
        for (int chunk = 0; chunk < chunks; ++chunk) {
            set.advance();
            for (std::size_t i = 0; i < count; ++i)
                if (!set.outcome(static_cast<int>(i)))
                    add_bits(set, static_cast<int>(i), bits[begin + i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (const auto& outcome = set.outcome(static_cast<int>(i)))
                for (const std::uint64_t word : outcome_bits(*outcome))
                    bits[begin + i].push_back(word);
            set.clear(static_cast<int>(i));
        }
    }
    return bits;
}

} // namespace stylobate::model
