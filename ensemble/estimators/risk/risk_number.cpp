#include "ensemble/estimators/risk/risk_number.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

RiskNumber combined(double value, const Limits& fragility, const std::optional<HazardSpread>& hazard)
{
    RiskNumber number{value, fragility, fragility, {value, value}, 1};
    if (!hazard)
        return number;
    number.hazard = {value * hazard->low, value * hazard->high};
    const double down = std::log(hazard->middle / hazard->low), up = std::log(hazard->high / hazard->middle);
    if (!(value > 0)) {
        number.total = {0, fragility.upper * hazard->high};
        number.fragility_part = std::nan("");
        return number;
    }
    const double fragility_down = std::log(value / fragility.lower), fragility_up = std::log(fragility.upper / value);
    const double middle = value * hazard->middle;
    number.total = {middle * std::exp(-std::hypot(fragility_down, down)),
                    middle * std::exp(std::hypot(fragility_up, up))};
    const bool whole = std::isfinite(fragility_down);
    const double of_fragility = std::pow(fragility_up + (whole ? fragility_down : 0), 2);
    const double of_hazard = std::pow(up + (whole ? down : 0), 2);
    number.fragility_part = std::isfinite(of_fragility) ? of_fragility / (of_fragility + of_hazard) : std::nan("");
    return number;
}

double probability_over(double frequency, double years)
{
    return -std::expm1(-frequency * years);
}

RiskNumber probability_over(const RiskNumber& frequency, double years)
{
    const auto at = [years](double f) { return probability_over(f, years); };
    const auto limits = [&](const Limits& l) { return Limits{at(std::max(l.lower, 0.0)), at(l.upper)}; };
    return {at(frequency.value), limits(frequency.total), limits(frequency.fragility), limits(frequency.hazard),
            frequency.fragility_part};
}

} // namespace stylobate
