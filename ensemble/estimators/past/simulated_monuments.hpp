#pragma once
/// A test of the posterior on monuments whose past is known.
///
/// Each is a realization that stands, drawn with the prior's probability of its cell, and measured with errors that are
/// uniform within the tolerances. Its past is then inferred from all other realizations. The posterior probability of
/// what lies below the true value, u, is uniform between 0 and 1 where the method is right (Talts, Betancourt, Simpson,
/// Vehtari & Gelman, "Validating Bayesian inference algorithms with simulation-based calibration" (2018)); a credible
/// interval of level p with equal tails contains the true value where (1 - p) / 2 <= u <= (1 + p) / 2. Of a value with
/// a share of the posterior of its own, which the true one has on an axis, u is drawn within that share.

#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/estimators/past/past_likelihood.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stylobate {

struct MonumentTest {
    std::vector<double> intensity, frequency, events; ///< u of each monument that could be judged
    std::size_t not_judged = 0;                       ///< no other realization agrees with it

    /// How many intervals of this level contain the true value.
    static std::size_t inside(const std::vector<double>& u, double level);
};

/// @param trials (cells) valid realizations   @param prior (cells) probability
/// @pre at least one value is measured
MonumentTest test_monuments(const PastAxes& axes, const std::vector<double>& trials, const StandingStates& standing,
                            const AgreeingStates& agreeing, const MeasuredState& measured,
                            std::span<const double> prior, std::size_t monuments, std::uint64_t seed);

} // namespace stylobate
