#include "io/store/tally.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

namespace stylobate {

Tally::Tally(std::size_t number_of_cells, std::size_t number_of_limit_states, std::size_t number_of_blocks)
    : limit_states(number_of_limit_states), blocks(number_of_blocks)
{
    visit_fields(std::type_identity<Tally>(),
                 [&](auto, auto field, auto by, auto) { (this->*field).resize(number_of_cells * width(by)); });
}

std::uint64_t Tally::all_trials() const
{
    return std::accumulate(trials.begin(), trials.end(), std::uint64_t{0});
}

std::uint64_t Tally::all_invalid() const
{
    return std::accumulate(invalid.begin(), invalid.end(), std::uint64_t{0});
}

std::uint64_t Tally::all_reached(std::size_t limit) const
{
    std::uint64_t all = 0;
    for (std::size_t cell = 0; cell < cells(); ++cell)
        all += reached[cell * limit_states + limit];
    return all;
}

void Tally::add(const TallyEntry& entry)
{
    if (entry.cell >= cells() || (entry.first_block >= 0 && static_cast<std::size_t>(entry.first_block) >= blocks))
        throw std::invalid_argument("realization " + std::to_string(entry.index) + " does not fit into the counts");
    if (entry.invalid != InvalidReason::none) {
        ++invalid[entry.cell];
        first_invalid.emplace(entry.index, entry.invalid);
        if (first_invalid.size() > most_invalid)
            first_invalid.erase(std::prev(first_invalid.end()));
        return;
    }
    ++trials[entry.cell];
    for (std::size_t limit = 0; limit < limit_states; ++limit)
        reached[entry.cell * limit_states + limit] += (entry.reached >> limit) & 1;
    if (entry.first_block >= 0)
        ++first[entry.cell * blocks + static_cast<std::size_t>(entry.first_block)];
    first_together[entry.cell] += entry.first_block == several_blocks;
    if (entry.collapse_time_s >= 0)
        collapse_time_s.add(entry.collapse_time_s);
    if (entry.total_collapse_time_s >= 0)
        total_collapse_time_s.add(entry.total_collapse_time_s);
    keep_worst(entry.energy_residual, entry.index);
}

void Tally::add(const Tally& other)
{
    if (other.cells() != cells() || other.limit_states != limit_states || other.blocks != blocks)
        throw std::invalid_argument("the counts are of another shape");
    visit_fields(std::type_identity<Tally>(), [&](auto, auto field, auto, auto) {
        std::ranges::transform(this->*field, other.*field, (this->*field).begin(), std::plus());
    });
    collapse_time_s.add(other.collapse_time_s);
    total_collapse_time_s.add(other.total_collapse_time_s);
    first_invalid.insert(other.first_invalid.begin(), other.first_invalid.end());
    while (first_invalid.size() > most_invalid)
        first_invalid.erase(std::prev(first_invalid.end()));
    if (other.energy_realization != no_realization)
        keep_worst(other.energy_residual, other.energy_realization);
}

void Tally::keep_worst(double residual, std::uint64_t realization)
{
    const double size = std::abs(residual), most = std::abs(energy_residual);
    if (size > most || (size == most && realization < energy_realization)) {
        energy_residual = residual;
        energy_realization = realization;
    }
}

} // namespace stylobate
