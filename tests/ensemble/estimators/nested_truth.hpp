#pragma once
/// Responses of a nested design whose components of variance are known.

#include "ensemble/estimators/fragility/dispersion_shares.hpp"
#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/numerics/random.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace stylobate {

/// Sums of independent normal parts.
struct NestedTruth {
    std::array<double, dispersion_levels> sd = {0.5, 0.4, 0.3, 0.3}; ///< of the parts, by DispersionLevel
    bool binary = false; ///< 1 where the sum is above 0.3, else 0, in its place
    std::size_t records = 40;
    bool unequal = false; ///< 1 to twice as many structures, contacts and twins instead of 3, 2 and 2

    std::vector<NestedRun> draw(std::uint64_t seed, std::uint64_t repeat) const
    {
        std::uint64_t element = 0;
        const auto uniform = [&] { return uniform01(seed, repeat, Stream::virtual_specimen, element++); };
        const auto normal = [&](std::size_t level) { return sd[level] * link_quantile(Link::probit, uniform()); };
        const auto count = [&](std::uint32_t usual) {
            return unequal ? 1 + static_cast<std::uint32_t>(uniform() * 2 * usual) : usual;
        };
        std::vector<NestedRun> runs;
        for (std::uint32_t r = 0; r < records; ++r) {
            const double record = normal(0);
            for (std::uint32_t s = 0, structures = count(3); s < structures; ++s) {
                const double structure = normal(1);
                for (std::uint32_t c = 0, contacts = count(2); c < contacts; ++c) {
                    const double contact = normal(2);
                    for (std::uint32_t i = 0, twins = count(2); i < twins; ++i) {
                        const double y = record + structure + contact + normal(3);
                        runs.push_back({r, s, c, 0, binary ? (y > 0.3 ? 1.0 : 0.0) : y});
                    }
                }
            }
        }
        return runs;
    }
};

} // namespace stylobate
