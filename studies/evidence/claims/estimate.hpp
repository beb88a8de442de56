#pragma once
/// Numbers with intervals from the realizations of a variant.

#include "studies/evidence/claims/sample.hpp"

namespace stylobate::claims {

/// A number that lies between `lower` and `upper` with the confidence asked for.
struct Estimate {
    double value = 0;
    double lower = 0;
    double upper = 0;
    std::size_t realizations = 0; ///< that it rests on

    bool known() const { return realizations > 0; }
    /// Certainly below another one.
    bool below(const Estimate& other) const
    {
        return known() && other.known() && upper <= other.lower && value < other.value;
    }
};

/// Of an event in a cell, with Jeffreys' interval. Unknown if nothing of what was `given` happened.
Estimate probability(const std::vector<Observation>& cell, const Measure& measure, double level);

/// min(p, 1 - p) of that, with the interval that follows.
Estimate minority(const std::vector<Observation>& cell, const Measure& measure, double level);

/// Of an amount in a cell. The interval runs from the k-th smallest to the k-th largest value with the largest k at
/// which it covers the median of any distribution with the level: the chance that the median lies below the k-th
/// smallest of n is the chance of fewer than k heads in n throws of a coin. Unknown where n is too small for k = 1.
Estimate median(const std::vector<Observation>& cell, const Measure& measure, double level);

/// The lowest PGA at which the probability of an event crosses 1/2, at one frequency.
///
/// The value is interpolated in the logarithm of the PGA; it is infinite where no PGA of the axis is enough, and the
/// first PGA where that is enough already. The interval ends at values of the axis: below `lower` (0 if there is none)
/// every probability is certainly below 1/2, and at `upper` (infinite if there is none) it is certainly above. So it
/// is never finer than the axis, whatever the shape of the curve between its values.
Estimate onset(const Sample& sample, std::size_t frequency, const Measure& measure, double level);

/// Any of the three; for an onset `pga` is not used.
Estimate estimate(const Sample& sample, std::size_t frequency, std::size_t pga, const Measure& measure, double level);

} // namespace stylobate::claims
