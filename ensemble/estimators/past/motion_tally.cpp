#include "ensemble/estimators/past/motion_tally.hpp"

#include <algorithm>
#include <cassert>

namespace stylobate {

namespace {

/// C(n, k); 0 where k > n.
double choose(std::uint64_t n, std::uint64_t k)
{
    if (k > n)
        return 0;
    double value = 1;
    for (std::uint64_t i = 0; i < k; ++i)
        value *= static_cast<double>(n - i) / static_cast<double>(i + 1);
    return value;
}

double part_of(std::uint32_t count, std::uint32_t all)
{
    return static_cast<double>(count) / static_cast<double>(all);
}

} // namespace

double agreeing_share(const MotionTally& tally)
{
    assert(tally.valid > 0 && "a share of something");
    return part_of(tally.agree, tally.valid);
}

double built_share(const MotionTally& tally, std::uint64_t built, std::uint64_t standing)
{
    assert(tally.valid >= built && standing >= 1 && standing <= built && "N can be drawn from the structures");
    if (tally.agree == 0)
        return 0;
    return agreeing_share(tally) * choose(tally.stand - 1, standing - 1) *
           choose(tally.valid - tally.stand, built - standing) / choose(tally.valid - 1, built - 1);
}

double all_stand_share(const MotionTally& tally, std::uint64_t m)
{
    assert(tally.valid >= m && "m can be drawn from the structures");
    return choose(tally.stand, m) / choose(tally.valid, m);
}

double site_share(std::span<const MotionTally> site)
{
    double as_is = 1, mirrored = 1, both = 1;
    for (const MotionTally& one : site) {
        as_is *= part_of(one.as_is, one.valid);
        mirrored *= part_of(one.mirrored, one.valid);
        both *= part_of(one.as_is + one.mirrored - one.agree, one.valid);
    }
    return as_is + mirrored - both;
}

CellCount effective_count(std::span<const double> shares, double most)
{
    const auto motions = static_cast<double>(shares.size());
    double sum = 0, squares = 0;
    for (const double share : shares) {
        sum += share;
        squares += share * share;
    }
    if (squares == sum) // all of them are 0 or 1
        return {motions, sum};
    const double mean = sum / motions, variance = squares / motions - mean * mean;
    // rounding of equal shares aside
    const double trials = variance > 1e-12 * mean ? std::min(mean * (1 - mean) * motions / variance, most) : most;
    return {trials, mean * trials};
}

} // namespace stylobate
