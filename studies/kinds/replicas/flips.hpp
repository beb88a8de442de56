#pragma once
/// How often twins differ in their verdict, and what that says.
///
/// Let A be the verdict of an original (1: collapsed) and B that of its twin. Pairs of different originals are
/// independent, so the share of pairs with A != B has a binomial interval. Two realizations that have nothing in common
/// but the cell differ with I = a (1 - b) + (1 - a) b, a and b the probabilities of collapse of the two kinds (2 p (1 -
/// p) for moved twins, whose p is the original's). As P(A != B) = I - 2 cov(A, B), the ratio
///
///   P(A != B) / I
///
/// is the share of the verdict's variance in the cell that is decided by what twins do not share: 0 where a verdict
/// follows from the structure, 1 where it has nothing to do with it.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace stylobate {

/// Pairs of a cell by their verdicts.
struct PairCounts {
    std::uint64_t neither = 0, original = 0, twin = 0, both = 0; ///< who collapsed
    std::uint64_t trials() const { return neither + original + twin + both; }
    std::uint64_t flips() const { return original + twin; }
};

/// How sure a verdict is, by the probability that a twin has another one. A fair coin's is 1/2.
enum class Sureness {
    certain,  ///< below 1/20: nineteen of twenty twins agree
    probable, ///< up to 1/4: three of four agree
    coin_flip ///< above: twins differ at least half as often as tosses of a fair coin do
};
inline constexpr std::array<const char*, 3> sureness_names = {"certain", "probable", "coin flip"};
inline constexpr double certain_below = 0.05, coin_flip_above = 0.25;
Sureness sureness(double flip_probability);

struct FlipShare {
    std::uint64_t trials = 0, flips = 0;
    double probability = 0;      ///< NaN without trials
    double lower = 0, upper = 1; ///< Jeffreys, 95 %
    double independent = 0;      ///< I, without bias (over all pairs of different originals); NaN below two trials
    /// The class that the interval lies within; none where it reaches over several: too few pairs to say.
    std::optional<Sureness> verdict() const
    {
        return trials > 0 && sureness(lower) == sureness(upper) ? std::optional(sureness(lower)) : std::nullopt;
    }
};
FlipShare flip_share(const PairCounts& counts);
inline constexpr const char* too_few_pairs = "too few pairs to say";
/// With fewer pairs no verdict is certain, even where none differs.
std::uint64_t fewest_pairs();

/// Over many cells, each with its own probabilities.
struct FlipRatio {
    FlipShare all;                          ///< of all pairs; its `independent` is the mean of those of the cells
    double ratio = 0, lower = 0, upper = 0; ///< NaN where no verdict differs anywhere; 95 %, linearized
};
/// The ratio of means over the pairs. Cells with fewer than two pairs are left out.
FlipRatio flip_ratio(const std::vector<PairCounts>& cells);

} // namespace stylobate
