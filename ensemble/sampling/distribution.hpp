#pragma once
/// From a uniform number to a value of a perturbed quantity.

#include "ensemble/model/study.hpp"

#include <string>

namespace stylobate {

/// The distribution of one perturbed quantity about its nominal value, truncated to [min, max] where these are given
/// (see `Spread`). Sampled by inversion (Devroye, "Non-Uniform Random Variate Generation" (1986), chapter II.2): one
/// uniform number in, one value out, non-decreasing.
///
/// The truncated normal is inverted through the nearer tail, so that it keeps its relative accuracy when both limits
/// lie far out on one side (own derivation). Logarithms and exponentials have twice the digits of a double and are
/// rounded once (`elementary.hpp`), so that the value does not depend on the processor.
class Distribution {
public:
    /// @param nominal value of the quantity without perturbation, in its unit
    /// @throws InputError if no probability lies between min and max, or if a lognormal has nominal <= 0
    Distribution(const Perturbation& perturbation, double nominal)
        : Distribution(perturbation, std::string("perturbation.") + to_string(perturbation.quantity), nominal)
    {
    }
    /// @param name for messages: the key in a study file
    Distribution(const Spread& spread, const std::string& name, double nominal);

    /// @param u uniform in (0, 1)
    /// @return the value, within [min, max], in the quantity's unit
    double value(double u) const;

private:
    DistributionKind kind_;
    double location_; ///< mean; nominal of a lognormal; from
    double scale_;    ///< standard deviation; of a lognormal that of ln value; for the uniform ones: to
    double min_;      ///< -infinity where there is none
    double max_;      ///< infinity where there is none
    // normal and lognormal: probabilities below and above min and max, both kept because 1 - p loses the tail
    double below_min_ = 0;
    double below_max_ = 1;
    double above_min_ = 1;
    double above_max_ = 0;
};

} // namespace stylobate
