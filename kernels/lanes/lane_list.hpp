#pragma once
/// Which lane of a group holds what, for structures that are no single stack: lane j holds bed j and the block that
/// lies on it. Of a block with several beds, such as an epistyle, the first one's lane is the block's; those of the
/// others hold copies of it, which go through the same operations.

#include "kernels/lanes/warp.hpp"
#include "kernels/planar/topology.hpp"

#include <cstdint>

namespace stylobate {

/// Beds of one block that lanes add up.
inline constexpr int most_beds_of_block = 4;
/// Beds of a structure that lanes step.
inline constexpr int most_lane_beds = warp_lanes - 1;

/// What a lane holds.
struct LaneBed {
    int block;          ///< that lies on the bed, its number in the bundle
    int lower;          ///< lane of the group that holds the bed's lower block; -1: it is a fixed one
    std::uint32_t beds; ///< of the block, in the order of `list_beds`, a byte each: as entries there; 255: no more
};

/// What lanes hold, of structures that are no single stack, or have watched pairs.
struct LaneLists {
    const LaneBed* bed = nullptr; ///< (beds) `list_lanes`
    const int* owner = nullptr;   ///< (blocks) lane of the group that each block is of; -1: it is fixed
    int top = 0;                  ///< lane of the group that holds the block whose displacement is followed
};

/// Lanes of a group for so many beds: of those widths that leave one lane of the warp spare, the least of the same
/// number of groups.
constexpr int lanes_of_group(int beds)
{
    return beds <= 6 ? 6 : beds <= 7 ? 7 : beds <= 10 ? 10 : beds <= 15 ? 15 : 31;
}

/// Lists the lanes.
/// @param lane (beds) to be written;  @param owner (blocks) to be written: the lane of each block, -1 of fixed ones
/// @return false: the structure has more beds than lanes, a block with more than `most_beds_of_block` or with none
/// below it, or beds in another order than the blocks
inline bool list_lanes(const Topology& t, LaneBed* lane, int* owner)
{
    if (t.beds() > most_lane_beds)
        return false;
    for (int i = 0; i < t.blocks; ++i)
        owner[i] = -1;
    int last = t.fixed - 1; // the sums over blocks go from lane to lane
    for (int j = 0; j < t.beds(); ++j) {
        const int block = t.joint[j].upper;
        if (block < t.fixed)
            return false;
        if (owner[block] < 0) {
            if (block != last + 1)
                return false;
            last = block;
            owner[block] = j;
        }
    }
    if (last + 1 != t.blocks)
        return false;
    for (int j = 0; j < t.beds(); ++j) {
        const auto [lower, block] = t.joint[j];
        std::uint32_t beds = 0xFFFFFFFFU;
        const int count = t.bed_lists[block + 1] - t.bed_lists[block];
        if (count > most_beds_of_block)
            return false;
        for (int k = count - 1; k >= 0; --k)
            beds = beds << 8 | static_cast<std::uint32_t>(t.bed_lists[t.bed_lists[block] + k]);
        lane[j] = {block, owner[lower], beds};
    }
    return true;
}

} // namespace stylobate
