#include "studies/decisions/risk/risk_answer.hpp"

#include "studies/decisions/risk/risk_text.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// The intensities between which the middle 80 % of a frequency lie, by whole parts.
std::pair<double, double> middle_of(const FrequencyEstimate& estimate)
{
    double sum = 0, below = 0;
    for (const FrequencyPart& part : estimate.parts)
        sum += part.frequency.value;
    std::pair<double, double> range{0, estimate.parts.back().to};
    for (const FrequencyPart& part : estimate.parts) {
        const double next = below + part.frequency.value / sum;
        if (below <= 0.1 && next > 0.1)
            range.first = part.from;
        if (below < 0.9 && next >= 0.9)
            range.second = part.to;
        below = next;
    }
    return range;
}

} // namespace

std::string risk_answer(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined)
        return fmt::format(
            "How often the limit state '{}' is reached is not determined: between {:.2g} and {:.2g} times "
            "a year. {}",
            s.meaning, s.estimate.bounds.lower, s.estimate.bounds.upper, s.note);
    const double years = risk.years.back();
    const RiskNumber p = probability_over(s.estimate.frequency, years);
    return fmt::format(
        "In {:g} years the limit state '{}' is reached with a probability of {:.3g} % ({:.3g} to {:.3g}; "
        "{:g} % interval), on average once in {:.4g} years.",
        years, s.meaning, 100 * p.value, 100 * p.total.lower, 100 * p.total.upper, 100 * risk.level,
        1 / s.estimate.frequency.value);
}

std::string risk_grounds(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined || !(s.estimate.frequency.value > 0))
        return {};
    const auto [low, high] = middle_of(s.estimate);
    std::string text = fmt::format(
        "Most of it (the middle 80 %) comes from these intensities, {}: {}{}. ", describe_measure(risk.hazard.measure),
        low > 0 ? fmt::format("from {:.3g} ", low) : "", std::isinf(high) ? "on" : fmt::format("to {:.3g}", high));
    const double part = s.estimate.frequency.fragility_part;
    if (risk.hazard.fractiles.empty())
        return text + "The interval is that of the fragility alone, since the hazard states no uncertainty.";
    if (!std::isfinite(part))
        return text + "What makes the interval wide cannot be told.";
    text += fmt::format("{:.0f} % of the interval's width comes from the hazard, {:.0f} % from the fragility. ",
                        100 * (1 - part), 100 * part);
    return text + (part < 0.5 ? "A better hazard curve would narrow it; more motions hardly would."
                              : "More motions in the study would narrow it; a better hazard curve hardly would.");
}

} // namespace stylobate
