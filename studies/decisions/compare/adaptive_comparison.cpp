#include "studies/decisions/compare/adaptive_comparison.hpp"

#include "ensemble/estimators/paired/paired_allocation.hpp"
#include "ensemble/model/input_error.hpp"
#include "studies/decisions/compare/pairing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

constexpr std::uint64_t first_look = 8; ///< pairs of each cell

StudySide side_now(const StudyRun& run)
{
    StudySide side(run.study(), run.header());
    run.for_each_row([&](const ResultRow& row) { side.add(row); });
    return side;
}

PairedBudget budget_of(const Study& base, const AdaptiveChoice& choice)
{
    return {choice.budget, std::min(first_look, base.realizations), choice.margin};
}

} // namespace

void check_adaptive(const Study& base, const std::string& name, const AdaptiveChoice& choice)
{
    if (!base.surface)
        throw InputError(fmt::format("--adaptive {}: {} is no study of kind \"surface\", whose cells pairs could go "
                                     "to.\n  Leave --adaptive out.",
                                     choice.budget, name));
    const auto cells = static_cast<std::uint64_t>(base.surface->cells());
    const std::uint64_t least = cells * budget_of(base, choice).minimum;
    if (choice.budget < least)
        throw InputError(
            fmt::format("--adaptive {}: {} has {} cells, whose first look takes {} pairs.\n  Give at least "
                        "{}.",
                        choice.budget, name, cells, least, least));
}

std::optional<Comparison> compare_adaptively(const StudyRuns& studies, const std::vector<std::string>& names,
                                             const AdaptiveChoice& choice, double level, const RunOptions& options,
                                             Observer& observer)
{
    StudyRun& base = *studies.front();
    PairLayout layout = pair_layout(base.study(), base.header().motions, level);
    Comparison comparison = comparison_facts(base.study(), base.header(), names.front(), base.results(), level);
    comparison.adaptive_budget = choice.budget;
    comparison.adaptive_margin = choice.margin;
    for (std::size_t i = 1; i < studies.size(); ++i) {
        StudyRun& variant = *studies[i];
        PairedAllocation allocation(budget_of(base.study(), choice), layout.cells, layout.per_cell, level);
        layout.looks = &allocation.looks();
        layout.asked.assign(layout.cells, 0);
        std::vector<PairedCounts> counts(layout.cells);
        while (true) {
            const std::vector<std::uint64_t> before = layout.asked;
            layout.asked = allocation.next(counts);
            std::vector<std::uint64_t> indices;
            for (std::size_t cell = 0; cell < layout.cells; ++cell)
                for (std::uint64_t k = before[cell]; k < layout.asked[cell]; ++k)
                    indices.push_back(cell * layout.per_cell + k);
            if (indices.empty())
                break;
            if (!base.run_some(indices, options, observer) || !variant.run_some(indices, options, observer))
                return std::nullopt;
            counts = count_pairs(side_now(base), side_now(variant), 0, 0, layout);
        }
        VariantComparison found = compare_sides(side_now(base), base.header().input_names, side_now(variant),
                                                variant.header().input_names, layout);
        comparison.adaptive_rounds = std::max(comparison.adaptive_rounds, allocation.rounds());
        add_variant(comparison, std::move(found), names[i], variant.results(), base.header(), variant.header());
    }
    return comparison;
}

} // namespace stylobate
