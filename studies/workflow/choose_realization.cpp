#include "studies/workflow/choose_realization.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

/// The options must select in one way.
void check_asked(const RealizationChoice& choice)
{
    const bool by_property = choice.cells.frequency_hz || choice.cells.pga_m_s2 || !choice.cells.motion.empty() ||
                             choice.cells.intensity || choice.fallen || choice.stood || choice.nth;
    if (choice.index && by_property)
        throw InputError(fmt::format("--realization {}: names one realization; omit the options that select among them "
                                     "(--frequency, --pga, --motion, --intensity, --fallen, --stood, --nth)",
                                     *choice.index));
    if (!choice.index && !by_property)
        throw InputError("no realization is given.\n  Give its index by --realization I, or select one: --frequency HZ "
                         "--pga M_S2 of a surface, --motion NAME --intensity X of a fragility study, --fallen or "
                         "--stood, --nth N.");
    if (choice.fallen && choice.stood)
        throw InputError("--fallen --stood: these options exclude each other; give one of them");
    if (choice.nth && *choice.nth < 1)
        throw InputError(fmt::format("--nth {}: counts from 1", *choice.nth));
}

} // namespace

ChosenRealization choose_realization(const Results& of, const RealizationChoice& choice)
{
    const ResultReader& reader = of.reader();
    const std::string& results = of.file();
    check_asked(choice);
    const ResultHeader& header = reader.header();
    if (choice.index) {
        const std::uint64_t end = of.end();
        const auto index = static_cast<std::uint64_t>(std::max(*choice.index, 0LL));
        if (*choice.index < 0 || index >= end || index < header.first)
            throw InputError(fmt::format("--realization {}: {} has realizations {} to {}", *choice.index, results,
                                         header.first, end - 1));
        return {index, ""};
    }
    const ChosenCells cells = of.kind().choose(choice.cells, results);
    const bool by_outcome = choice.fallen || choice.stood;
    std::vector<std::uint64_t> found;
    std::uint64_t all = 0;
    const auto consider = [&](std::uint64_t index, std::uint64_t cell, State state) {
        // perturbed replicas are not among the realizations of a cell
        if (!cells.has(cell) || !of.kind().is_trial(index))
            return;
        ++all;
        const bool fell = state == State::collapsed, valid = state != State::invalid;
        if (!by_outcome || (choice.fallen ? fell : valid && !fell))
            found.push_back(index);
    };
    if (header.has_rows())
        reader.for_each_row([&](const ResultRow& row) { consider(row.index, row.cell, row.outcome.state); });
    else if (by_outcome)
        throw InputError(fmt::format("--{}: {} has no rows of realizations (output.realizations = \"none\"), so it "
                                     "does not record which realization fell. Select by --frequency, --pga and --nth.",
                                     choice.fallen ? "fallen" : "stood", results));
    else
        for (std::uint64_t i = header.first; i < header.first + header.total; ++i)
            consider(i, of.study().cell(i), State::stood);
    std::sort(found.begin(), found.end());

    const std::string what = choice.fallen ? "fell" : choice.stood ? "stood" : "there are";
    const std::string where = cells.words.empty() ? "" : " " + cells.words;
    const std::string among = fmt::format("{} of {}{}{}", found.size(), all, where,
                                          header.has_rows() && !reader.complete() ? ", of those run so far" : "");
    const auto nth = static_cast<std::uint64_t>(choice.nth.value_or(1));
    if (found.empty())
        throw InputError(by_outcome ? fmt::format("{}: no realization {}: {}", results, what, among)
                                    : fmt::format("{}: no realization{} was run", results, where));
    if (nth > found.size())
        throw InputError(fmt::format("--nth {}: only {} {}", nth, among, by_outcome ? what : "are there"));
    return {found[nth - 1],
            by_outcome ? fmt::format("number {} of the {} that {}, of {}{}", nth, found.size(), what, all, where)
                       : fmt::format("number {} of {}{}", nth, all, where)};
}

} // namespace stylobate
