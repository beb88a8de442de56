#pragma once
/// The picture of a collapse: which blocks fall, in which order and when.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// The falls of many realizations, block by block.
struct FallOrder {
    struct Block {
        std::string name;
        std::uint64_t first = 0;         ///< realizations in which it fell before all others
        std::vector<double> fall_time_s; ///< one for each realization in which it fell, ascending
        double lower = 0;                ///< interval of the probability that it falls
        double upper = 1;
    };
    /// Where a block stands at rest [m].
    struct Place {
        double left = 0, right = 0, bottom = 0, top = 0;
    };
    std::vector<Block> blocks;  ///< in layout order
    std::vector<Place> places;  ///< of the blocks; empty: not known
    std::uint64_t trials = 0;   ///< valid realizations
    double end_time_s = 0;      ///< of the longest of them
    std::uint64_t together = 0; ///< realizations in which several blocks fell first, at the same step
    std::string interval;       ///< name of the interval and its level, for example "jeffreys 0.95"
};

/// Draws, for every block that fell in any realization, the share of the realizations in which it had fallen by then,
/// over time (1800 x 1350 pixels). Beside the curves a table of the blocks in the order of their falls, which is that
/// of the colours too: each with its share and interval, its median time, and how often it was the first. Where more
/// than 12 blocks fell and their places are known, a drawing of the structure stands for the table: each block in the
/// colour of its median time, with its share. Where they are not known, of more than 24 blocks those with the smallest
/// shares are grey and not in the table.
///
/// @param note a second line below the title's; may be empty
/// @throws InputError if no block fell, or if the picture cannot be written
void plot_order(const FallOrder& order, const std::string& title, const std::string& note,
                const std::filesystem::path& png);

/// The blocks that fell, by the median of their fall times.
std::vector<std::size_t> order_of_falls(const FallOrder& order);

} // namespace stylobate
