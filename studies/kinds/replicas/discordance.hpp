#pragma once
/// Share of discordant pairs (perturbed replica and original with different verdicts), and its interpretation.
///
/// Let A be the verdict of an original (1: collapsed) and B that of its replica. Pairs of different originals are
/// independent, so the share of pairs with A != B has a binomial interval. Two independent realizations of a cell
/// differ with probability I = a (1 - b) + (1 - a) b, a and b the probabilities of collapse of the two kinds (2 p (1 -
/// p) for moved replicas, whose p is the original's). As P(A != B) = I - 2 cov(A, B), the ratio
///
///   P(A != B) / I
///
/// is the share of the verdict's variance in the cell that is due to the quantity in which the replicas differ: 0 where
/// the verdict follows from the shared draws, 1 where it is independent of them.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace stylobate {

/// Pairs of a cell by their verdicts.
struct PairCounts {
    std::uint64_t neither = 0, original = 0, replica = 0, both = 0; ///< who collapsed
    std::uint64_t trials() const { return neither + original + replica + both; }
    std::uint64_t discordant() const { return original + replica; }
};

/// Predictability of a verdict, by the probability that a perturbed replica has another one. For a fair coin it is 1/2.
enum class Sureness {
    certain,  ///< below 1/20: nineteen of twenty replicas agree
    probable, ///< up to 1/4: three of four agree
    coin_flip ///< above: replicas differ at least half as often as tosses of a fair coin do
};
inline constexpr std::array<const char*, 3> sureness_names = {"certain", "probable", "coin flip"};
inline constexpr double certain_below = 0.05, coin_flip_above = 0.25;
Sureness sureness(double discordant_probability);

struct DiscordantShare {
    std::uint64_t trials = 0, discordant = 0;
    double probability = 0;      ///< NaN without trials
    double lower = 0, upper = 1; ///< Jeffreys, 95 %
    double independent = 0;      ///< I, without bias (over all pairs of different originals); NaN below two trials
    /// The class that contains the interval; none where the interval covers several (too few pairs).
    std::optional<Sureness> verdict() const
    {
        return trials > 0 && sureness(lower) == sureness(upper) ? std::optional(sureness(lower)) : std::nullopt;
    }
};
DiscordantShare discordant_share(const PairCounts& counts);
inline constexpr const char* too_few_pairs = "too few pairs to say";
/// With fewer pairs no verdict is certain, even where none differs.
std::uint64_t fewest_pairs();

/// Over many cells, each with its own probabilities.
struct DiscordanceRatio {
    DiscordantShare all;                    ///< of all pairs; its `independent` is the mean of those of the cells
    double ratio = 0, lower = 0, upper = 0; ///< NaN where no verdict differs anywhere; 95 %, linearized
};
/// The ratio of means over the pairs. Cells with fewer than two pairs are left out.
DiscordanceRatio discordance_ratio(const std::vector<PairCounts>& cells);

} // namespace stylobate
