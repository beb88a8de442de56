#pragma once
/// A frequency or a probability with what is not known of it: of the fragility, of the hazard, and of both.

#include "ensemble/estimators/fragility/limits.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/model/fields.hpp"

#include <optional>

namespace stylobate {

/// A frequency at three curves of the hazard, over its value at the best estimate: the limits of a central interval
/// and the median.
struct HazardSpread {
    double low = 1, middle = 1, high = 1;
};

struct RiskNumber {
    double value = 0;
    Limits total;     ///< of both
    Limits fragility; ///< with the hazard's best estimate
    Limits hazard;    ///< with the fragility's best estimate; the value itself where the hazard has no fractiles
    /// Part of the squared width of `total`, on the scale of the logarithm, that is of the fragility: of the whole
    /// interval, or of its upper half where the lower limit is 0. NaN where the width is 0 or not finite.
    double fragility_part = 0;
};

template <class F>
void visit_fields(std::type_identity<RiskNumber>, F&& f)
{
    f("value", &RiskNumber::value);
    f(
        "lower", [](auto& n) -> auto& { return n.total.lower; });
    f(
        "upper", [](auto& n) -> auto& { return n.total.upper; });
    f(
        "fragility_lower", [](auto& n) -> auto& { return n.fragility.lower; });
    f(
        "fragility_upper", [](auto& n) -> auto& { return n.fragility.upper; });
    f(
        "hazard_lower", [](auto& n) -> auto& { return n.hazard.lower; });
    f(
        "hazard_upper", [](auto& n) -> auto& { return n.hazard.upper; });
    f("fragility_part", &RiskNumber::fragility_part, {.unit = "1"});
}

/// Both intervals together, by their distances from the value on the scale of the logarithm: the limits of a sum of
/// independent terms are at the root of the sum of their squared distances (MOVER; Zou & Donner, "Construction of
/// confidence limits about effect measures: a general approach", Statistics in Medicine 27 (2008) 1693). Exact limits
/// where one of them is certain. The interval is about the value at the hazard's median, as a mean hazard may lie
/// outside of all fractiles that are asked for.
/// @param hazard nothing where its uncertainty is not known
RiskNumber combined(double value, const Limits& fragility, const std::optional<HazardSpread>& hazard);

/// 1 - exp(-frequency x years): at least one event in these years, of a Poisson process.
double probability_over(double frequency, double years);
RiskNumber probability_over(const RiskNumber& frequency, double years);

} // namespace stylobate
