#pragma once
/// A warp on the processor, for `BedLanes`: 32 numbers in the place of one, all lanes in lockstep. Each operation is
/// that of `kernels/real.hpp`. (A missing barrier does not show here: the run of the device's own code sees it.)

#include "kernels/lanes/bed_lanes.hpp"

#include <array>

namespace stylobate {

struct WarpMask {
    std::array<bool, warp_lanes> of;
};
struct WarpReal {
    std::array<double, warp_lanes> of;
    WarpReal() = default;
    explicit WarpReal(double all) { of.fill(all); }
};

template <>
struct Lanes<WarpReal> {
    using Number = double;
    static constexpr int count = warp_lanes;
};

namespace detail {

/// Lane by lane f(lane). @tparam Result WarpReal or WarpMask
template <class Result, class F>
Result in_lanes(const F& f)
{
    Result result;
    for (std::size_t i = 0; i < warp_lanes; ++i)
        result.of[i] = f(i);
    return result;
}

} // namespace detail

#define STYLOBATE_WARP_OPERATOR(Result, op)                                                                            \
    inline Result operator op(const WarpReal& a, const WarpReal& b)                                                    \
    {                                                                                                                  \
        return detail::in_lanes<Result>([&](std::size_t i) { return a.of[i] op b.of[i]; });                            \
    }
STYLOBATE_WARP_OPERATOR(WarpReal, +)
STYLOBATE_WARP_OPERATOR(WarpReal, -)
STYLOBATE_WARP_OPERATOR(WarpReal, *)
STYLOBATE_WARP_OPERATOR(WarpReal, /)
STYLOBATE_WARP_OPERATOR(WarpMask, <)
STYLOBATE_WARP_OPERATOR(WarpMask, >)
STYLOBATE_WARP_OPERATOR(WarpMask, <=)
STYLOBATE_WARP_OPERATOR(WarpMask, >=)
STYLOBATE_WARP_OPERATOR(WarpMask, !=)
#undef STYLOBATE_WARP_OPERATOR

inline WarpMask operator&(const WarpMask& a, const WarpMask& b)
{
    return detail::in_lanes<WarpMask>([&](std::size_t i) { return a.of[i] && b.of[i]; });
}
inline WarpMask operator|(const WarpMask& a, const WarpMask& b)
{
    return detail::in_lanes<WarpMask>([&](std::size_t i) { return a.of[i] || b.of[i]; });
}
inline WarpMask operator!(const WarpMask& a)
{
    return detail::in_lanes<WarpMask>([&](std::size_t i) { return !a.of[i]; });
}
inline bool any(const WarpMask& mask)
{
    for (const bool one : mask.of)
        if (one)
            return true;
    return false;
}
inline WarpReal select(const WarpMask& mask, const WarpReal& yes, const WarpReal& no)
{
    return detail::in_lanes<WarpReal>([&](std::size_t i) { return mask.of[i] ? yes.of[i] : no.of[i]; });
}

#define STYLOBATE_WARP_OF_ONE(name)                                                                                    \
    inline WarpReal name(const WarpReal& a)                                                                            \
    {                                                                                                                  \
        return detail::in_lanes<WarpReal>([&](std::size_t i) { return stylobate::name(a.of[i]); });                    \
    }
STYLOBATE_WARP_OF_ONE(abs_of)
STYLOBATE_WARP_OF_ONE(sqrt_of)
STYLOBATE_WARP_OF_ONE(round_of)
#undef STYLOBATE_WARP_OF_ONE

#define STYLOBATE_WARP_OF_TWO(name)                                                                                    \
    inline WarpReal name(const WarpReal& a, const WarpReal& b)                                                         \
    {                                                                                                                  \
        return detail::in_lanes<WarpReal>([&](std::size_t i) { return stylobate::name(a.of[i], b.of[i]); });           \
    }
STYLOBATE_WARP_OF_TWO(min_of)
STYLOBATE_WARP_OF_TWO(max_of)
STYLOBATE_WARP_OF_TWO(turn_sign)
#undef STYLOBATE_WARP_OF_TWO

#define STYLOBATE_WARP_OF_THREE(name)                                                                                  \
    inline WarpReal name(const WarpReal& a, const WarpReal& b, const WarpReal& c)                                      \
    {                                                                                                                  \
        return detail::in_lanes<WarpReal>([&](std::size_t i) { return stylobate::name(a.of[i], b.of[i], c.of[i]); });  \
    }
STYLOBATE_WARP_OF_THREE(fma)
STYLOBATE_WARP_OF_THREE(fnma)
STYLOBATE_WARP_OF_THREE(fms)
#undef STYLOBATE_WARP_OF_THREE

struct HostWarp {
    using Real = WarpReal;
    template <class T>
    struct Each {
        std::array<T, warp_lanes> value{};
        T& operator[](int lane) { return value[static_cast<std::size_t>(lane)]; }
        const T& operator[](int lane) const { return value[static_cast<std::size_t>(lane)]; }
    };

    template <class F>
    void each(const F& f) const
    {
        for (int lane = 0; lane < warp_lanes; ++lane)
            f(lane);
    }
    static double& of(WarpReal& real, int lane) { return real.of[static_cast<std::size_t>(lane)]; }
    static double of(const WarpReal& real, int lane) { return real.of[static_cast<std::size_t>(lane)]; }
    static bool of(const WarpMask& mask, int lane) { return mask.of[static_cast<std::size_t>(lane)]; }
    void sync() const {}
    bool any(const Each<bool>& flags) const { return stylobate::any(WarpMask{flags.value}); }
    Each<std::uint32_t> votes_of_group(const Each<bool>& flags, const Each<int>& groups, int width) const
    {
        Each<std::uint32_t> found;
        for (int i = 0; i < warp_lanes; ++i)
            for (int k = 0; k < width; ++k)
                if (const int lane = groups[i] * width + k; lane < warp_lanes && flags[lane])
                    found[i] |= 1U << k;
        return found;
    }
    WarpReal from(const WarpReal& real, const Each<int>& lanes) const
    {
        return detail::in_lanes<WarpReal>(
            [&](std::size_t i) { return real.of[static_cast<std::size_t>(lanes.value[i])]; });
    }
};

} // namespace stylobate
