#include "io/tables/fragility_exchange.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/tables/fragility_measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace stylobate {
namespace {

constexpr double standard_gravity = 9.80665;

[[noreturn]] void refuse(const FragilityFunction& function, const std::string& text)
{
    throw InputError(fmt::format("fragility function '{}': {}", function.id, text));
}

void check_value(const FragilityFunction& function, const std::string& what, const FragilityValue& value, double least,
                 double most)
{
    if (!(value.value >= least && value.value <= most && std::isfinite(value.value)))
        refuse(function, fmt::format("{} = {} is outside [{}, {}].\n  Where an estimate has no curve, export its "
                                     "bounds as a discrete function.",
                                     what, value.value, least, most));
    const bool no_interval = std::isnan(value.lower) && std::isnan(value.upper); // too few motions
    if (!no_interval && !(value.lower <= value.value && value.value <= value.upper))
        refuse(function,
               fmt::format("{} = {} is outside its interval [{}, {}].", what, value.value, value.lower, value.upper));
}

double probability(const FragilityState& state, double intensity)
{
    return std::erfc(-std::log(intensity / state.median.value) / state.dispersion.value / std::sqrt(2.0)) / 2;
}

/// Damage is shared out by differences of neighbours: a later state that is more probable makes one negative.
void check_order(const FragilityModel& model, const FragilityFunction& function)
{
    const auto refuse_order = [&](std::size_t state, double intensity, double before, double here) {
        refuse(function,
               fmt::format("limit states in the wrong order: at intensity {:.4g} '{}' has probability {:.4g}, "
                           "but '{}' before it {:.4g}.\n  Order them from the first to be reached, narrow the range, "
                           "or export shares by stripe.",
                           intensity, model.limit_states[state], here, model.limit_states[state - 1], before));
    };
    for (std::size_t s = 1; s < function.states.size(); ++s) {
        const FragilityState &before = function.states[s - 1], &here = function.states[s];
        if (function.discrete) {
            for (std::size_t i = 0; i < function.intensity.size(); ++i)
                if (here.probability[i].value > before.probability[i].value + 1e-9)
                    refuse_order(s, function.intensity[i], before.probability[i].value, here.probability[i].value);
            continue;
        }
        // two lognormal curves cross once at most: their order at the ends of the range decides
        for (const double intensity : {function.least, function.most})
            if (probability(here, intensity) > probability(before, intensity) + 1e-3)
                refuse_order(s, intensity, probability(before, intensity), probability(here, intensity));
    }
}

} // namespace

double per_si_unit(const std::string& measure)
{
    if (measure == "PGA")
        return 1 / standard_gravity;
    if (measure == "PGV" || measure == "PGD")
        return 100;
    if (measure == "IA")
        return 1;
    if (measure == "CAV")
        return 1 / standard_gravity;
    if (measure.starts_with("SA(") && measure.ends_with(")")) {
        double period = 0;
        const char* const end = measure.data() + measure.size() - 1;
        const auto [rest, error] = std::from_chars(measure.data() + 3, end, period);
        if (error == std::errc() && rest == end && period > 0)
            return 1 / standard_gravity;
    }
    throw InputError(fmt::format("fragility: '{}' is not a known intensity measure of OpenQuake.\n  Known: PGA, "
                                 "PGV, PGD, SA(period), IA, CAV.",
                                 measure));
}

const char* openquake_unit(const std::string& measure)
{
    per_si_unit(measure); // refuses an unknown one
    return measure == "PGV"   ? "cm/s"
           : measure == "PGD" ? "cm"
           : measure == "IA"  ? "m/s"
           : measure == "CAV" ? "g s"
                              : "g";
}

void check_fragility_model(const FragilityModel& model)
{
    if (model.limit_states.empty() || model.functions.empty())
        throw InputError("fragility model: it has no limit states or no functions.");
    std::set<std::string> names;
    for (const std::string& name : model.limit_states)
        if (name.empty() || name.find_first_of(" \t\r\n") != std::string::npos || !names.insert(name).second)
            throw InputError(fmt::format("fragility model: limit state '{}' is empty, has a blank, or comes twice.\n  "
                                         "NRML separates limit states by blanks: write fallen_drum.",
                                         name));
    std::set<std::string> ids;
    for (const FragilityFunction& function : model.functions) {
        if (function.id.empty() || !ids.insert(function.measure + ' ' + function.id).second)
            refuse(function, "its name is empty or comes twice.");
        per_si_unit(function.measure);
        if (function.states.size() != model.limit_states.size())
            refuse(function, fmt::format("it has {} limit states, the model {}.", function.states.size(),
                                         model.limit_states.size()));
        if (function.discrete) {
            const auto& at = function.intensity;
            if (at.size() < 2 || !(at.front() > 0) ||
                std::adjacent_find(at.begin(), at.end(), [](double a, double b) { return !(a < b); }) != at.end())
                refuse(function, "its intensities are not two or more, above 0 and ascending.");
        } else if (!(function.least > 0 && function.least < function.most && std::isfinite(function.most)))
            refuse(function, fmt::format("its range of intensity [{}, {}] is not above 0 and ascending.",
                                         function.least, function.most));
        for (std::size_t s = 0; s < function.states.size(); ++s) {
            const FragilityState& state = function.states[s];
            const std::string& name = model.limit_states[s];
            if (!function.discrete) {
                check_value(function, name + ": median", state.median, 1e-300, 1e300);
                check_value(function, name + ": dispersion", state.dispersion, 1e-6, 10);
                continue;
            }
            if (state.probability.size() != function.intensity.size())
                refuse(function, fmt::format("{}: {} probabilities at {} intensities.", name, state.probability.size(),
                                             function.intensity.size()));
            for (const FragilityValue& value : state.probability)
                check_value(function, name + ": probability", value, 0, 1);
        }
        check_order(model, function);
    }
}

} // namespace stylobate
