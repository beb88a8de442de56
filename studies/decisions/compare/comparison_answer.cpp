#include "studies/decisions/compare/comparison_answer.hpp"

#include "io/files/suggest.hpp"
#include "studies/decisions/compare/comparison_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace stylobate {

namespace {

/// Where the pairs come from: "over the 64 cells of the study".
std::string over_all(const Comparison& c)
{
    if (c.motions > 0)
        return fmt::format("over {}{}", counted(c.motions, "motion"),
                           c.cells() > 1 ? fmt::format(" at {} intensities", c.cells()) : "");
    return c.cells() > 1 ? fmt::format("over the {} cells of the study, each with the same weight", c.cells())
                         : "under the study's shaking";
}

std::string interval_text(const PairedDifference& d)
{
    return fmt::format("{:.3f} ({:.3f} to {:.3f})", d.value, d.lower, d.upper);
}

bool depends(const Comparison& c, const InputDependence& input)
{
    return input.p_adjusted <= c.rate;
}

enum class Sign { none, less, more };
template <class Interval>
Sign sign_of(const Interval& interval)
{
    return interval.upper < 0 ? Sign::less : interval.lower > 0 ? Sign::more : Sign::none;
}

/// The third of a quantity in words: "friction below 0.65".
std::string third_text(const InputDependence& input, std::size_t third)
{
    const auto& between = input.found.between;
    switch (third) {
    case 0:
        return fmt::format("{} below {:.3g}", input.input, between[0]);
    case 1:
        return fmt::format("{} from {:.3g} to {:.3g}", input.input, between[0], between[1]);
    default:
        return fmt::format("{} above {:.3g}", input.input, between[1]);
    }
}

/// The cells in which it harms, or helps, with the number of them and the one of the largest difference; empty where
/// none is named.
std::string cells_text(const Comparison& c, const VariantComparison& variant, bool worse)
{
    const LimitComparison& limit = variant.limits.front();
    if (c.cells() == 1 || !limit.damage)
        return {};
    const std::vector<std::size_t> cells = limit.named(c.rate, worse); // the largest difference first
    if (cells.empty())
        return {};
    const PlaceComparison& most = limit.cells[cells.front()];
    return fmt::format("It {} in {} of {} {} ({}), most at {}: {:.3f} instead of {:.3f}, difference {}.",
                       worse ? "harms" : "helps", cells.size(), limit.cells.size(),
                       c.motions > 0 ? "intensities" : "cells", adjustment_text(c), c.place(cells.front()),
                       most.variant.probability, most.base.probability, difference_text(most));
}

/// How many pairs, or motions, would show the difference that was found: the distance of the interval's limit from it
/// falls with the root of their number. @pre the interval contains 0
std::string more_pairs_text(const Comparison& c, const PlaceComparison& all)
{
    const char* what = c.motions > 0 ? "motions" : "pairs";
    if (all.difference == 0)
        return fmt::format("More {} would exclude smaller differences; the one that was found is 0.", what);
    const auto number = static_cast<double>(c.motions > 0 ? c.motions : all.counts.pairs());
    const double reach = all.difference < 0 ? all.upper - all.difference : all.difference - all.lower;
    const double needed = std::max(number + 1, number * std::pow(reach / all.difference, 2));
    const double step = std::pow(10, std::max(0.0, std::floor(std::log10(needed)) - 1)); // two digits, upwards
    return fmt::format("More {}: were the difference the one that was found, about {:.0f} instead of {:.0f} would "
                       "show it.",
                       what, std::ceil(needed / step - 1e-6) * step, number);
}

} // namespace

std::string answer_text(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    const PlaceComparison& all = limit.overall;
    if (all.counts.pairs() == 0)
        return fmt::format("With {} nothing can be said: no pair of realizations is valid in both studies.",
                           variant.name);
    std::string text = fmt::format(
        "With {} the probability of {} is {:.3f} instead of {:.3f} {}: a difference of {} at {:g} %. ", variant.name,
        limit.name, all.variant.probability, all.base.probability, over_all(c), difference_text(all), 100 * c.level);
    switch (limit.verdict(all)) {
    case ChangeVerdict::better:
    case ChangeVerdict::less:
        return text + (limit.damage ? "It helps." : "It is less.");
    case ChangeVerdict::worse:
    case ChangeVerdict::more:
        return text + (limit.damage ? "It harms." : "It is more.");
    default:
        return text + (all.largest() < 1 ? "Undecided: " + points_text(all) + "."
                                         : std::string("Undecided: no difference is excluded."));
    }
}

std::string harm_text(const Comparison& c, const VariantComparison& variant)
{
    return cells_text(c, variant, true);
}

std::vector<std::string> dependence_texts(const Comparison& c, const VariantComparison& variant)
{
    std::vector<std::string> all;
    for (const InputDependence& input : variant.depends)
        if (depends(c, input))
            all.push_back(fmt::format("{}: the difference is {} at {}, and {} at {} (adjusted p = {:.2g}).",
                                      input.input, interval_text(input.found.thirds[0]), third_text(input, 0),
                                      interval_text(input.found.thirds[2]), third_text(input, 2), input.p_adjusted));
    return all;
}

std::vector<std::string> what_would_change_it(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    const PlaceComparison& overall = limit.overall;
    if (overall.counts.pairs() == 0)
        return {"Pairs that are valid in both studies; there is none."};
    const Sign answer = sign_of(overall);
    std::vector<std::string> all;
    for (const InputDependence& input : variant.depends) {
        if (!depends(c, input))
            continue;
        for (std::size_t third = 0; third < input.found.thirds.size(); ++third) {
            const PairedDifference& d = input.found.thirds[third];
            if (const Sign sign = sign_of(d); sign != answer)
                all.push_back(fmt::format("{}: {} {}.", third_text(input, third),
                                          sign == Sign::none     ? "no difference is shown,"
                                          : answer == Sign::none ? "a difference is shown,"
                                                                 : "the difference has the other sign,",
                                          interval_text(d)));
        }
    }
    for (const bool worse : {true, false}) // cells that are not as the answer is
        if (const std::string cells = cells_text(c, variant, worse);
            !cells.empty() && answer != (worse ? Sign::more : Sign::less))
            all.push_back(cells);
    if (answer == Sign::none)
        all.push_back(more_pairs_text(c, overall));
    if (all.empty())
        all.push_back(variant.depends.empty() ? "Nothing that was examined: no test by drawn quantity was made."
                                              : "None of the drawn quantities is shown to change it.");
    return all;
}

} // namespace stylobate
