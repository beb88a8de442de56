#include "studies/decisions/compare/comparison_answer.hpp"

#include "studies/decisions/compare/comparison_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace stylobate {

namespace {

/// Where the pairs come from: "over the 64 cells of the study".
std::string over_all(const Comparison& c)
{
    if (c.motions > 0)
        return fmt::format("over {} motions at {} intensities", c.motions, c.cells());
    return c.cells() > 1 ? fmt::format("over the {} cells of the study, each with the same weight", c.cells())
                         : "under the study's shaking";
}

std::string interval_text(const PairedDifference& d)
{
    return fmt::format("{:.3f} [{:.3f}, {:.3f}]", d.value, d.lower, d.upper);
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

} // namespace

std::string answer_text(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    const PlaceComparison& all = limit.overall;
    if (all.counts.pairs() == 0)
        return fmt::format("With {} nothing can be said: no pair of realizations is valid in both studies.",
                           variant.name);
    std::string text =
        fmt::format("With {} the probability of {} is {:.3f} instead of {:.3f} {}: a difference of {} at {:g} %. ",
                    variant.name, limit.describe, all.variant.probability, all.base.probability, over_all(c),
                    difference_text(all), 100 * c.level);
    switch (limit.verdict(all)) {
    case ChangeVerdict::better:
    case ChangeVerdict::less:
        return text + (limit.damage ? "It helps." : "It is less.");
    case ChangeVerdict::worse:
    case ChangeVerdict::more:
        return text + (limit.damage ? "It harms." : "It is more.");
    default:
        return text + fmt::format("No difference is shown; one larger than {:.3f} is excluded.", all.largest());
    }
}

std::string harm_text(const Comparison& c, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    if (c.cells() == 1 || !limit.damage)
        return {};
    const std::vector<std::size_t> cells = limit.named(c.rate, true);
    if (cells.empty())
        return {};
    std::size_t worst = cells.front();
    for (const std::size_t cell : cells)
        if (limit.cells[cell].difference > limit.cells[worst].difference)
            worst = cell;
    return fmt::format("It harms in {} of {} cells ({}), most at {}: {} instead of {}, difference {}.", cells.size(),
                       limit.cells.size(), adjustment_text(c), c.place(worst),
                       fmt::format("{:.3f}", limit.cells[worst].variant.probability),
                       fmt::format("{:.3f}", limit.cells[worst].base.probability), difference_text(limit.cells[worst]));
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
    if (const std::string harm = harm_text(c, variant); !harm.empty())
        all.push_back(harm);
    if (answer == Sign::none && overall.counts.pairs() > 0 && overall.difference != 0) {
        // an interval's half width falls with the root of the number of pairs
        const double half = (overall.upper - overall.lower) / 2;
        const double times = std::pow(half / std::fabs(overall.difference), 2);
        all.push_back(fmt::format("More pairs: were the difference the one that was found, about {:.2g} times as many "
                                  "would show it.",
                                  times));
    }
    if (all.empty())
        all.push_back(variant.depends.empty() ? "Nothing that was looked at."
                                              : "No drawn quantity within its range changes the sign of the answer.");
    return all;
}

} // namespace stylobate
