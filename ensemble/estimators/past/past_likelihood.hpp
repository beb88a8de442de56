#pragma once
/// The likelihood of what is known of a structure, over the past that it may have had: a number of equally strong
/// events in succession, their frequency and their intensity.
///
/// In each cell k of n realizations agree with what is known (they stand, and their final state is the
/// observed one within its tolerance): approximate Bayesian computation with a uniform kernel (Tavare, Balding,
/// Griffiths & Donnelly, "Inferring coalescence times from DNA sequence data", Genetics 145 (1997) 505; Beaumont, Zhang
/// & Balding, "Approximate Bayesian computation in population genetics", Genetics 162 (2002) 2025). Where the error of
/// the measurement is uniform within the tolerance the share is the likelihood itself up to a factor, not an
/// approximation (Wilkinson, "Approximate Bayesian computation (ABC) gives exact results under the assumption of model
/// error", Statistical Applications in Genetics and Molecular Biology 12 (2013) 129).
///
/// The counts of the cells are independent. What follows from them has the interval of draws of every cell's
/// probability from its posterior Beta(k + c, n - k + c), one Latin hypercube over all cells (McKay, Beckman & Conover,
/// "A comparison of three methods for selecting values of input variables", Technometrics 21 (1979) 239). For a single
/// cell c = 1/2, Jeffreys' prior. For a mean over m cells c = 1 / (2 m): the mean of m equal cells then has Jeffreys'
/// posterior of their counts together, as sums of gamma variates add their shapes. With 1/2 in each of them the cells
/// without a success would together shift the mean by more than its own standard error.
///
/// The likelihood of a cell is the mean of its posterior, (k + c) / (n + 2 c), and not k / n: a posterior over pasts
/// that takes a cell without a success as impossible is too narrow (tests/ensemble/estimators/test_past.cpp).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stylobate {

/// Cells are counted by events, then frequency, then intensity.
struct PastAxes {
    std::vector<double> frequency_hz; ///< (nf) ascending
    std::vector<double> intensity;    ///< (ni) ascending, > 0
    std::size_t events = 1;           ///< largest number of events of a past

    std::size_t cells_of_one() const { return frequency_hz.size() * intensity.size(); }
    std::size_t cells() const { return events * cells_of_one(); }
    friend bool operator==(const PastAxes&, const PastAxes&) = default;
};

/// Of one cell. Where several structures share a motion these are the numbers of independent realizations that would
/// leave the mean as uncertain as it is (`effective_count`), and no whole ones.
struct CellCount {
    double trials = 0, successes = 0;
};

struct PastLikelihood {
    PastAxes axes;
    std::vector<double> value;              ///< (cells)
    std::vector<std::vector<double>> drawn; ///< (draws) of the cells

    /// Calls f(cells) for the value and then for each draw.
    void each(const std::function<void(std::span<const double>)>& f) const;
};

inline constexpr std::size_t past_draws = 1000;

/// What the draws are for.
enum class PastUse {
    cells, ///< cells one by one
    means, ///< means over the frequencies
    rates  ///< the same, weighted by the steep rates of a hazard curve: the value of a cell is k / n
};

/// c of the posterior.
double prior_count(const PastAxes& axes, PastUse use);

/// @param index of the first cell among the random numbers of `Stream::past`: other counts of a study have others
PastLikelihood past_likelihood(const PastAxes& axes, std::span<const CellCount> counts, std::uint64_t seed, PastUse use,
                               std::uint64_t index = 0);

/// A number, and the interval that the counts leave it; infinite where it lies beyond the axis.
struct PastEstimate {
    double value = 0, lower = 0, upper = 0;
};

/// A function of the value and of each draw, with the 95 % interval of the draws: percentiles, corrected for a
/// share of draws below the value that is not one half (Efron & Tibshirani, "An Introduction to the Bootstrap" (1993),
/// section 14.3, without acceleration; the correction is limited to half a standard deviation, and the interval
/// contains the value: own choices).
PastEstimate past_estimate(const PastLikelihood& likelihood,
                           const std::function<double(std::span<const double> cells)>& f);

// Structures that have been through the same motion.
//
// Given the motion, structures respond independently; without it they do not: a motion that fells one fells the others
// too. The likelihood of what is known of several is therefore the mean over the motions of a product, and not the
// product of their likelihoods. Of each motion the study has K structures, v of which are valid, and each factor of
// the product has an unbiased estimate by counts:
//
//   the state of one of them                          g / v, g of them agree
//   n of N that were built alike stand, one of these  (g / v) C(s - 1, n - 1) C(v - s, N - n) / C(v - 1, N - 1),
//   has the state                                     s of them stand (the probability that N drawn from them without
//                                                     replacement, one of which agrees, are such: Hoeffding, "A class
//                                                     of statistics with asymptotically normal distribution", Annals
//                                                     of Mathematical Statistics 19 (1948) 293)
//   all of m structures stand                         C(s, m) / C(v, m)
//   the states of structures A, B, ...                the product of g / v over the structures
//
// The motions of a cell are independent.

/// Of the structures under one motion.
struct MotionTally {
    std::uint32_t valid = 0, stand = 0;
    std::uint32_t as_is = 0, mirrored = 0, agree = 0; ///< with the observed state, its mirror image, one of the two
};

/// The share of those that agree. @pre some are valid
double agreeing_share(const MotionTally& tally);
/// The probability that a structure agrees and n - 1 of N - 1 others stand. @pre at least N are valid
double built_share(const MotionTally& tally, std::uint64_t built, std::uint64_t standing);
/// The probability that m of them all stand. @pre at least m are valid
double all_stand_share(const MotionTally& tally, std::uint64_t m);
/// The probability that all structures of a site agree, all as they are or all mirrored: the sense of the shaking is
/// that of all. @param site (structures) under one motion, some of each valid
double site_share(std::span<const MotionTally> site);

/// The mean of shares of independent motions as a count: k of n Bernoulli trials with the same mean k / n and the same
/// standard error. Where all shares are 0 or 1 it is their number. Where the shares do not differ, n is `most`; a mean
/// of 0 has as many trials as there are motions, since nothing tells that structures under one motion differ.
CellCount effective_count(std::span<const double> shares, double most);

} // namespace stylobate
