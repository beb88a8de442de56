#pragma once
/// The warp of a CUDA device, for `BedLanes` (`bed_lanes.hpp`). Compiled by nvcc only.

#include "kernels/lanes/bed_lanes.hpp"

namespace stylobate {

struct CudaWarp {
    using Real = double;
    /// A thread has its own lane's value.
    template <class T>
    struct Each {
        T value;
        STYLOBATE_LANES T& operator[](int) { return value; }
        STYLOBATE_LANES const T& operator[](int) const { return value; }
    };
    static constexpr unsigned all = ~0U;
    int lane; ///< of this thread

    template <class F>
    STYLOBATE_LANES void each(const F& f) const
    {
        f(lane);
    }
    template <class Value>
    STYLOBATE_LANES static Value& of(Value& value, int)
    {
        return value;
    }
    STYLOBATE_LANES void sync() const { __syncwarp(); }
    STYLOBATE_LANES bool any(const Each<bool>& flags) const { return __any_sync(all, flags.value); }
    STYLOBATE_LANES Each<std::uint32_t> votes_of_group(const Each<bool>& flags, const Each<int>& groups,
                                                       int width) const
    {
        const unsigned votes = __ballot_sync(all, flags.value);
        return {votes >> (groups.value * width & (warp_lanes - 1)) & ((1U << width) - 1)};
    }
    STYLOBATE_LANES double from(double value, const Each<int>& lanes) const
    {
        return __shfl_sync(all, value, lanes.value);
    }
};

} // namespace stylobate
