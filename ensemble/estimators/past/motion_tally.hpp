#pragma once
/// Structures that have been through the same motion.
///
/// Given the motion, structures respond independently; without it they do not: a motion that fells one fells the others
/// too. The likelihood of what is known of several is therefore the mean over the motions of a product, and not the
/// product of their likelihoods. Of each motion the study has K structures, v of which are valid, and each factor of
/// the product has an unbiased estimate by counts:
///
///   the state of one of them                          g / v, g of them agree
///   n of N that were built alike stand, one of these  (g / v) C(s - 1, n - 1) C(v - s, N - n) / C(v - 1, N - 1),
///   has the state                                     s of them stand (the probability that N drawn from them without
///                                                     replacement, one of which agrees, are such: Hoeffding, "A class
///                                                     of statistics with asymptotically normal distribution", Annals
///                                                     of Mathematical Statistics 19 (1948) 293)
///   all of m structures stand                         C(s, m) / C(v, m)
///   the states of structures A, B, ...                the product of g / v over the structures
///
/// The motions of a cell are independent.

#include "ensemble/estimators/past/past_likelihood.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

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
