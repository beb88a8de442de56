#include "studies/verify/replay_sample.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace stylobate {

/// SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195): its two multiplications, over both numbers.
std::uint64_t sample_key(std::uint64_t seed, std::uint64_t index)
{
    const auto mix = [](std::uint64_t z) {
        z += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    };
    return mix(mix(seed) ^ index);
}

std::vector<std::uint64_t> replay_sample(const ResultReader& reader, std::uint64_t most, std::uint64_t seed)
{
    using Keyed = std::pair<std::uint64_t, std::uint64_t>;   // key, index
    std::map<std::uint64_t, std::set<Keyed>> lowest_of_cell; // of each cell the `most` of the lowest keys
    if (most > 0)
        reader.for_each_row([&](const ResultRow& row) {
            std::set<Keyed>& lowest = lowest_of_cell[row.cell];
            lowest.emplace(sample_key(seed, row.index), row.index);
            if (lowest.size() > most)
                lowest.erase(std::prev(lowest.end()));
        });
    std::vector<std::tuple<std::size_t, std::uint64_t, std::uint64_t>> all; // number in its cell, key, index
    for (const auto& [cell, lowest] : lowest_of_cell) {
        std::size_t number = 0;
        for (const auto& [key, index] : lowest)
            all.emplace_back(number++, key, index);
    }
    std::ranges::sort(all);
    std::vector<std::uint64_t> sample;
    for (std::size_t i = 0; i < all.size() && i < most; ++i)
        sample.push_back(std::get<2>(all[i]));
    std::ranges::sort(sample);
    return sample;
}

} // namespace stylobate
