#include "studies/decisions/risk/risk_answer.hpp"

#include "studies/decisions/risk/risk_text.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// A part of the squared width without which the interval is less than 14 % narrower.
constexpr double small_part = 0.25;

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
        return fmt::format("How often the limit state '{}' is reached is not determined: {} times a year. {}",
                           s.meaning, bounds_text(s.estimate.bounds), s.note);
    const double years = risk.years.back();
    const RiskNumber p = probability_over(s.estimate.frequency, years);
    if (!(s.estimate.frequency.value > 0))
        return fmt::format("No run of the study reached the limit state '{}'. By shaking as strong as the strongest of "
                           "the runs, or stronger, its probability in {:g} years is at most {:.3g} % ({:g} % interval "
                           "from 0).",
                           s.meaning, years, 100 * p.total.upper, 100 * risk.level);
    const std::string text =
        fmt::format("In {:g} years the limit state '{}' is reached with a probability of {:.3g} % ({:.3g} to {:.3g}; "
                    "{:g} % interval), on average once in {:.4g} years.",
                    years, s.meaning, 100 * p.value, 100 * p.total.lower, 100 * p.total.upper, 100 * risk.level,
                    1 / s.estimate.frequency.value);
    if (std::isnan(s.estimate.by_mean_hazard))
        return text;
    return text + fmt::format(" By the mean hazard, the mean over its fractiles, the probability is {:.3g} %.",
                              100 * probability_over(s.estimate.by_mean_hazard, years));
}

std::string risk_grounds(const Risk& risk)
{
    const StateRisk& s = risk.principal();
    if (!s.determined || !(s.estimate.frequency.value > 0))
        return {};
    const auto [low, high] = middle_of(s.estimate);
    const std::string unit = measure_unit(risk.hazard.measure);
    std::string text = fmt::format("At least 80 % of the risk comes from {}{}. ", short_measure(risk.hazard.measure),
                                   low > 0 && std::isinf(high) ? fmt::format(" above {:.2g} {}", low, unit)
                                   : low > 0          ? fmt::format(" between {:.2g} and {:.2g} {}", low, high, unit)
                                   : std::isinf(high) ? std::string(" at all intensities")
                                                      : fmt::format(" below {:.2g} {}", high, unit));
    const double part = s.estimate.frequency.fragility_part;
    if (risk.hazard.fractiles.empty())
        return text + "The interval is that of the fragility alone, since the hazard states no uncertainty.";
    if (!std::isfinite(part))
        return text + "The interval has no finite width, so its parts are not known; more motions in the study may "
                      "give one.";
    text += fmt::format("Of the uncertainty (the interval's squared width) {:.0f} % is due to the hazard and {:.0f} % "
                        "due to the fragility. ",
                        100 * (1 - part), 100 * part);
    if (part > 1 - small_part)
        return text + "More motions in the study would narrow it; a better hazard curve hardly would.";
    if (part < small_part)
        return text + "A better hazard curve would narrow it; more motions hardly would.";
    return text + "A better hazard curve and more motions in the study would both narrow it.";
}

} // namespace stylobate
