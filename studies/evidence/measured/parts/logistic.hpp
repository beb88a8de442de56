#pragma once
/// Logistic regression: the probability of an event from a few numbers.

#include <vector>

namespace stylobate::measured {

/// P = 1 / (1 + exp(-(b_0 + b_1 x_1 + ...))).
struct Logistic {
    std::vector<double> coefficients; ///< b_0 first
    double probability(const std::vector<double>& x) const;
};

/// Maximum likelihood by Newton's method, less `ridge` times half the sum of squares of all coefficients but b_0, which
/// keeps them finite where the numbers separate the events.
/// @param x (observations x numbers)   @pre as many of each, at least one observation
Logistic fit_logistic(const std::vector<std::vector<double>>& x, const std::vector<bool>& event, double ridge = 1e-6);

} // namespace stylobate::measured
