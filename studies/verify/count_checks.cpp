#include "studies/verify/value_checks.hpp"

#include "io/files/suggest.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/verify/recorded_rounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <string_view>

namespace stylobate {

namespace {

/// Largest number of the invalid realizations in a file that are run again.
constexpr std::size_t most_invalid_again = 5;

std::string counted_at(const ResultHeader& header, const char* name, std::size_t cell)
{
    const std::size_t np = header.pga_m_s2.size();
    return fmt::format("tally/{}[{}, {}]", name, cell / np, cell % np);
}

/// Tells of two numbers unless they are the same.
void expect_count(FileCheck& check, const std::string& where, std::uint64_t stored, std::uint64_t expected,
                  std::string_view why)
{
    if (stored != expected)
        check.add({where, std::nullopt, fmt::format("{}", stored), fmt::format("{} ({})", expected, why)});
}

void check_cell(const Study& study, const ResultReader& reader, std::size_t cell, FileCheck& check)
{
    const Tally& tally = *reader.tally();
    const ResultHeader& header = reader.header();
    const std::uint64_t trials = tally.trials[cell], added = trials + tally.invalid[cell];
    if (reader.complete() ? added != study.realizations : added > study.realizations)
        check.add({counted_at(header, "trials", cell), std::nullopt, fmt::format("{}", trials),
                   fmt::format("with the invalid ones {}{}", reader.complete() ? "" : "at most ", study.realizations)});
    for (std::size_t k = 0; k < tally.limit_states; ++k)
        if (const std::uint64_t n = tally.reached[cell * tally.limit_states + k]; n > trials)
            check.add({fmt::format("{} ({})", counted_at(header, "reached", cell), header.limit_states[k]),
                       std::nullopt, fmt::format("{}", n), fmt::format("at most {}, the trials", trials)});
    std::uint64_t first = tally.first_together[cell];
    for (std::size_t b = 0; b < tally.blocks; ++b)
        first += tally.first[cell * tally.blocks + b];
    expect_count(check, counted_at(header, "first_fallen", cell), first,
                 tally.reached[cell * tally.limit_states + static_cast<std::size_t>(LimitState::collapse)],
                 "collapses");
}

} // namespace

FileCheck check_counts(const Study& study, const ResultReader& reader)
{
    FileCheck check{.name = "counts"};
    const Tally& tally = *reader.tally();
    if (tally.cells() * study.realizations != study.total() || reader.header().limit_states != limit_state_names()) {
        check.add({"tally/trials", std::nullopt, fmt::format("{} cells", tally.cells()), "the cells of the study"});
        return check;
    }
    for (std::size_t cell = 0; cell < tally.cells(); ++cell)
        check_cell(study, reader, cell, check);
    const auto reached = [&](LimitState limit) { return tally.all_reached(static_cast<std::size_t>(limit)); };
    const std::uint64_t collapses = reached(LimitState::collapse);
    expect_count(check, "tally/collapse_time/count", tally.collapse_time_s.total(), collapses, "collapses");
    expect_count(check, "tally/total_collapse_time/count", tally.total_collapse_time_s.total(),
                 reached(LimitState::total), "total collapses");
    const DoneSet::Part done = reader.counted()->all();
    expect_count(check, "tally/done", done.collapsed, collapses, "collapses");
    expect_count(check, "tally/done", done.invalid, tally.all_invalid(), "invalid ones");
    expect_count(check, "tally/invalid_index", tally.first_invalid.size(),
                 std::min<std::uint64_t>(tally.all_invalid(), Tally::most_invalid), "the invalid ones, at most 100");
    if (reader.complete())
        expect_count(check, "tally/done", done.end, study.total(), "all realizations");
    check.text = fmt::format("the counts of {} realizations in {} cells", tally.added(), tally.cells());
    return check;
}

CountReplay::CountReplay(const Study& study, const ResultReader& reader, std::uint64_t most, std::uint64_t seed)
    : study_(study), header_(reader.header()), tally_(*reader.tally()),
      again_(tally_.cells(), tally_.limit_states, tally_.blocks)
{
    if (most == 0)
        return;
    const RunOrder order(study.total());
    const std::uint64_t each = study.realizations;
    std::vector<std::uint64_t> cells(tally_.cells());
    std::iota(cells.begin(), cells.end(), 0);
    std::ranges::sort(cells, {}, [&](std::uint64_t cell) { return sample_key(seed, cell); });
    for (std::size_t i = 0; i < cells.size() && (cells_.size() + 1) * each <= most; ++i) {
        const std::uint64_t begin = cells[i] * each;
        bool whole = true;
        for (std::uint64_t index = begin; whole && index < begin + each; ++index)
            whole = reader.counted()->has(order.place(index));
        if (whole)
            cells_.push_back(cells[i]);
    }
    std::ranges::sort(cells_);
    if (tally_.energy_realization < study.total())
        singles_.push_back(tally_.energy_realization);
    for (const auto& [index, reason] : tally_.first_invalid)
        if (singles_.size() <= most_invalid_again)
            singles_.push_back(index);
    std::ranges::sort(singles_);
    for (const std::uint64_t cell : cells_)
        for (std::uint64_t k = 0; k < each; ++k)
            indices_.push_back(cell * each + k);
    indices_.insert(indices_.end(), singles_.begin(), singles_.end());
    std::ranges::sort(indices_);
    indices_.erase(std::unique(indices_.begin(), indices_.end()), indices_.end());
}

void CountReplay::take(const ResultRow& row)
{
    const TallyEntry entry = tally_entry(row);
    if (std::ranges::binary_search(cells_, row.cell))
        again_.add(entry);
    if (std::ranges::binary_search(singles_, row.index))
        taken_.push_back(entry);
}

void CountReplay::conclude(FileCheck& check) const
{
    for (const std::uint64_t cell : cells_) {
        const auto expect = [&](const char* name, const std::vector<std::uint64_t>& stored,
                                const std::vector<std::uint64_t>& again, std::size_t width, const auto& of) {
            for (std::size_t k = 0; k < width; ++k)
                if (const std::size_t at = cell * width + k; stored[at] != again[at])
                    check.add({counted_at(header_, name, cell) + of(k), std::nullopt, fmt::format("{}", stored[at]),
                               fmt::format("{}", again[at])});
        };
        const auto nothing = [](std::size_t) { return std::string(); };
        expect("trials", tally_.trials, again_.trials, 1, nothing);
        expect("invalid", tally_.invalid, again_.invalid, 1, nothing);
        expect("reached", tally_.reached, again_.reached, tally_.limit_states,
               [&](std::size_t k) { return fmt::format(" ({})", header_.limit_states[k]); });
        expect("first_fallen", tally_.first, again_.first, tally_.blocks,
               [&](std::size_t k) { return fmt::format(" ({})", header_.block_names[k]); });
        expect("first_together", tally_.first_together, again_.first_together, 1, nothing);
    }
    for (const TallyEntry& entry : taken_) {
        const auto named = tally_.first_invalid.find(entry.index);
        const InvalidReason stored = named == tally_.first_invalid.end() ? InvalidReason::none : named->second;
        if (stored != entry.invalid)
            check.add({"tally/invalid_reason", entry.index, to_string(stored), to_string(entry.invalid)});
        const bool worst = entry.index == tally_.energy_realization;
        if (worst &&
            std::bit_cast<std::uint64_t>(tally_.energy_residual) != std::bit_cast<std::uint64_t>(entry.energy_residual))
            check.add({"tally/energy_residual", entry.index, fmt::format("{}", tally_.energy_residual),
                       fmt::format("{}", entry.energy_residual)});
    }
    check.text = cells_.empty()
                     ? fmt::format("no rows are kept, and no counted cell of {} realizations fits into --replay; {}",
                                   study_.realizations, counted(singles_.size(), "single realization"))
                     : fmt::format("no rows are kept: the counts of {} of {} realizations, and {} single ones",
                                   counted(cells_.size(), "whole cell"), study_.realizations, singles_.size());
    if (indices_.empty() && check.verdict == CheckVerdict::passed)
        check.verdict = CheckVerdict::not_done;
}

} // namespace stylobate
