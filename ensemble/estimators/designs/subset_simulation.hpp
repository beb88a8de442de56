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
/// Engineering Mechanics 41 (2015) 89). As there, the pilot adapts s from step to step so that 44 % are accepted. s is
/// one number for all dimensions: steps proportional to the scatter of the seeds in each dimension, which are usual
/// too, depend on where the seeds happen to lie, and made the probability of a shell in ten dimensions 15 to 30 % too
/// small.
///
/// Levels and steps that are chosen by the samples which are then counted pull the product to one side, by a part of
/// order 1 / samples (Cerou, Del Moral, Furon & Guyader, "Sequential Monte Carlo for rare event estimation", Statistics
/// and Computing 22 (2012) 795): upwards by 0.9 % with 500 samples at 1e-5, by 5 % with 100 (docs/sensitivity.md). They
/// are therefore chosen by a pilot, a whole simulation that is not counted. All others keep its levels and steps. Their
/// products are then unbiased whatever the pilot has chosen: the steps leave the distribution above a level invariant,
/// and each sample above it begins the same number of chains on average (Del Moral, Doucet & Jasra, "Sequential Monte
/// Carlo samplers", Journal of the Royal Statistical Society B 68 (2006) 411).
///
/// In the pilot a level is the greatest response of the samples that do not continue.
///
/// Error formulas from a single run need the correlation of the chains; they are wrong for a response that jumps, and
/// for chains that do not move. The whole is therefore repeated with independent numbers, and the interval is that of
/// the mean of independent repeats (`mean_of_repeats`). Its coverage is measured in docs/sensitivity.md.
///
/// Every number is a function of (seed, simulation, evaluation, element): the same run results however a batch is
/// evaluated.

#include "ensemble/numerics/row_bootstrap.hpp"

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
/// moves there. `first` is the number of the first one in this simulation, counted from 0.
using Response = std::function<std::vector<double>(const std::vector<double>& points, std::uint64_t first)>;

struct SubsetLevel {
    double threshold = 0;      ///< lower bound of its samples; -infinity for the first one, which is plain sampling
    double probability = 0;    ///< share of its samples above the next threshold, or that fail
    double acceptance = 1;     ///< share of the accepted candidates
    double stuck = 0;          ///< share of the chains that never moved
    std::vector<double> steps; ///< s of each step of the chains; none of the first level
};

struct SubsetRun {
    double probability = 0; ///< 0 if the limit was not reached
    std::vector<SubsetLevel> levels;
    std::uint64_t evaluations = 0;
    std::uint64_t invalid = 0;
};

/// Chooses levels and steps; its own probability is biased.
/// @param simulation number of the simulation: 0 by convention, and others for those that are counted
/// @throws std::invalid_argument if there are fewer than two chains, or no dimension
SubsetRun subset_pilot(std::size_t dimension, const Response& response, const SubsetOptions& options,
                       std::uint64_t simulation = 0);

/// A simulation with the thresholds and steps of a pilot, unbiased if it has another number. It ends early, with
/// probability 0, where no sample is above the next threshold.
/// @param plan levels of a pilot with the same options
/// @throws std::invalid_argument as of the pilot
SubsetRun subset_simulation(std::size_t dimension, const Response& response, const SubsetOptions& options,
                            const std::vector<SubsetLevel>& plan, std::uint64_t simulation);

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
