#pragma once
/// Forecasts of falling: which tests a model may be fitted on, a rule without mechanics, and how good probabilities
/// are, against what fell.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace stylobate::measured {

/// One prediction and what happened.
struct Forecast {
    double probability = 0; ///< of falling, in [0, 1]
    bool fell = false;
    std::string group; ///< what is drawn as a whole in the bootstrap, such as the ground motion
};

struct Scores {
    std::size_t count = 0;
    double right = 0; ///< share with (probability >= 1/2) = fell
    double brier = 0; ///< mean of (probability - fell)2: smaller is better
    double log = 0;   ///< mean of -ln(probability of what happened) [nat]: smaller is better
    int false_falls = 0;
    int false_stands = 0;
};

/// Probabilities are taken no nearer to 0 and 1 than `surest`, so that one miss cannot decide a log score.
inline constexpr double surest = 0.005;
Scores score(const std::vector<Forecast>& forecasts);

/// A 95 % interval of a mean.
struct Estimate {
    double mean = 0, low = 0, high = 0;
};
/// "+0.031 (+0.012 to +0.051)"
std::string signed_interval(const Estimate& estimate);

/// Mean of values with the percentile bootstrap over groups: groups are drawn with replacement, each with all of its
/// values.
/// @param seed of std::mt19937_64
Estimate grouped_mean(const std::vector<double>& values, const std::vector<std::string>& groups, int draws = 4000,
                      std::uint64_t seed = 1);

/// What each forecast adds to a score (`Scores` has their means).
using Measure = std::function<double(const Forecast&)>;
double share_right(const Forecast& forecast);
double brier(const Forecast& forecast);
double log_loss(const Forecast& forecast);

/// Mean of measure(first) - measure(second), test by test.
/// @pre the same tests in the same order
Estimate difference(const std::vector<Forecast>& first, const std::vector<Forecast>& second, const Measure& measure);

/// Probability that each of two answers deserves: (falls + 1/2) / (tests + 1) among the tests in which it was given.
struct Answers {
    double after_stand = 0, after_fall = 0;
    double of(bool fall) const { return fall ? after_fall : after_stand; }
};
Answers answers_worth(const std::vector<bool>& predicted, const std::vector<bool>& fell);

/// Which tests a model may be fitted on: whole ground motions, by a rule that is fixed before anything is looked at.
/// The distinct groups are put in the order of their names; the first, third, fifth and so on are for fitting, the
/// others are held out. Tests of one group never part.
/// @param group of each test, such as its ground motion   @return (tests) true: for fitting
std::vector<bool> fitting_half(const std::vector<std::string>& group);

/// The probability of an event from a few numbers: P = 1 / (1 + exp(-(b_0 + b_1 x_1 + ...))).
struct Logistic {
    std::vector<double> coefficients; ///< b_0 first
    double probability(const std::vector<double>& x) const;
};

/// By maximum likelihood.
/// @param x (observations x numbers)   @pre as many of each, at least one observation
/// @throws InputError if the numbers separate the events
Logistic fit_logistic(const std::vector<std::vector<double>>& x, const std::vector<bool>& event);

} // namespace stylobate::measured
