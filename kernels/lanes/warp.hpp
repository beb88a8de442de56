#pragma once
/// The warp of a device, as the lanes' step sees it.
///
/// A warp is a class W with
///   Real                  a number of each lane (`double` on a device)
///   Each<T>               any value of each lane: value[lane]
///   each(f)               calls f(lane) for every lane, in no order
///   of(real, lane)        that lane's number
///   from(real, lanes)     the number of another lane
///   any(flags)            whether any lane has it
///   votes_of_group(flags, groups, width)   bit k: lane k of the lane's own group has it
///   sync()                what has been written to memory can be read by other lanes from now on
/// Between two calls of `sync` no lane may read what another one writes. All of these but `each` and `of` are for the
/// whole warp at once.

#include <cstdint>

namespace stylobate {

inline constexpr int warp_lanes = 32;
/// The last lane of a warp holds nothing: an empty realization at rest, which others read as their neighbour.
inline constexpr int spare_lane = warp_lanes - 1;

#if defined(__CUDACC__)
#define STYLOBATE_LANES __device__ __forceinline__
#define STYLOBATE_LANES_APART __device__ __noinline__
#define STYLOBATE_UNROLLED _Pragma("unroll")
#define STYLOBATE_ROLLED _Pragma("unroll 1")
#else
#define STYLOBATE_LANES inline
#define STYLOBATE_LANES_APART inline
#define STYLOBATE_UNROLLED
#define STYLOBATE_ROLLED
#endif

/// How many lanes of a group come before this one, of those that a vote names.
constexpr int earlier_votes(std::uint32_t votes, int number)
{
    int count = 0;
    for (std::uint32_t left = votes & ((1U << number) - 1); left != 0; left &= left - 1)
        ++count;
    return count;
}

} // namespace stylobate
