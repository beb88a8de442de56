#pragma once
/// Probabilities too small to be counted: subset simulation (Au & Beck, "Estimation of small failure probabilities in
/// high dimensions by subset simulation", Probabilistic Engineering Mechanics 16 (2001) 263).
///
/// A realization is a point u of independent standard normal numbers with a response g(u); it fails where g >= limit.
/// The failure is reached through levels b_1 < b_2 < ... < limit, each the share p0 of the one before:
///
///   P(fail) = P(g > b_1) P(g > b_2 | g > b_1) ... P(fail | g > b_last)
///
/// Beyond the first level the samples come from Markov chains, one from each of the samples above the level, all
/// advanced together: a step is one batch of realizations, one for each chain. A candidate is
///
///   v = r u + s z,   z standard normal,   r = sqrt(1 - s^2)
///
/// which leaves the normal distribution invariant in any number of dimensions; it is accepted if g(v) > b, else the
/// chain stays (Papaioannou, Betz, Zwirglmaier & Straub, "MCMC algorithms for subset simulation", Probabilistic
/// Engineering Mechanics 41 (2015) 89). As there, s is adapted from step to step so that 44 % are accepted. s is one
/// number for all dimensions: steps proportional to the scatter of the seeds in each dimension, which are usual too,
/// depend on where the seeds happen to lie, and made the probability of a shell in ten dimensions 15 to 30 % too small.
///
/// A level is the greatest response of the samples that do not continue, which makes the product unbiased (Brehier et
/// al., "Unbiasedness of some generalized adaptive multilevel splitting algorithms", Annals of Applied Probability 26
/// (2016) 3559). Where responses are equal to it, all of them stay behind, and some of the others start two chains.
///
/// Error formulas from a single run need the correlation of the chains; they are wrong for a response that jumps, and
/// for chains that do not move. The whole is therefore repeated with independent numbers, and the interval is that of
/// the mean of independent repeats (`mean_of_repeats`). Its coverage is measured in docs/sensitivity.md.
///
/// Every number is a function of (seed, repeat, evaluation, element): the same run results however a batch is
/// evaluated.

#include "ensemble/estimators/resampling/row_bootstrap.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace stylobate {

struct SubsetOptions {
    std::size_t samples = 500;      ///< at each level
    double level_probability = 0.1; ///< p0; samples x p0 is the number of chains
    std::size_t most_levels = 10;
    double limit = 0; ///< of the response
    std::uint64_t seed = 1;
};

/// A batch of points, (n x dimension) row by row, to their responses (n); NaN: the realization is invalid, and no chain
/// moves there. `first` is the number of the first one in this repeat, counted from 0.
using Response = std::function<std::vector<double>(const std::vector<double>& points, std::uint64_t first)>;

struct SubsetLevel {
    double threshold = 0;   ///< lower bound of its samples; -infinity for the first one, which is plain sampling
    double probability = 0; ///< share of its samples above the next threshold, or that fail
    double acceptance = 1;  ///< share of the accepted candidates
    double stuck = 0;       ///< share of the chains that never moved
    double step = 1;        ///< f at the end
};

struct SubsetRun {
    double probability = 0; ///< 0 if the limit was not reached
    std::vector<SubsetLevel> levels;
    std::uint64_t evaluations = 0;
    std::uint64_t invalid = 0;
};

/// @param repeat number of the repeat
/// @throws std::invalid_argument if there are fewer than two chains, or no dimension
SubsetRun subset_simulation(std::size_t dimension, const Response& response, const SubsetOptions& options,
                            std::uint64_t repeat);

/// Fewer repeats give no interval: with four it holds in 93 to 94 of 100 cases only.
inline constexpr std::size_t least_repeats = 5;

/// The mean of independent repeats, with Cox's interval of the mean of a lognormal number with Student's quantile
/// (Olsson, "Confidence intervals for the mean of a log-normal distribution", Journal of Statistics Education 13
/// (2005)): a product of shares is nearly lognormal, and the mean of ten such numbers is far from normal.
///
///   exp(m + v / 2 -+ t sqrt(v / n + v^2 / (2 (n - 1)))),   m, v mean and variance of the n logarithms
///
/// Undetermined with fewer than `least_repeats`, or if all are 0; without an interval if one is 0.
Estimate mean_of_repeats(const std::vector<double>& repeats, double level);

/// Realizations of plain sampling that would give the same relative error: (1 - p) / (p d^2) with d = s / (p sqrt n), s
/// the standard deviation of the repeats (the variance of a binomial share).
double plain_sampling_cost(const std::vector<double>& repeats);

} // namespace stylobate
