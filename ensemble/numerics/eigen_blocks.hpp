#pragma once
/// Equal bits on every processor: Eigen sums the products of larger matrices in blocks whose sizes follow the caches
/// of the machine, and the order of a sum decides its last digits. Programs that link a file that includes this have
/// the same blocks everywhere.

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace stylobate {

/// [bytes] Levels 1, 2 and 3 of a common processor. Other sizes give other last digits, and hardly another speed.
inline constexpr std::array<std::ptrdiff_t, 3> block_caches = {32 << 10, 1 << 20, 32 << 20};

inline const bool same_blocks_everywhere = [] {
    Eigen::setCpuCacheSizes(block_caches[0], block_caches[1], block_caches[2]);
    return true;
}();

} // namespace stylobate
