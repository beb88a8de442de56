#include "studies/verify/value_checks.hpp"

#include "io/files/suggest.hpp"
#include "io/store/result_layout.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/verify/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <variant>

namespace stylobate {

namespace {

/// Of numbers: bit by bit, so that NaN is NaN, and 0 is not -0.
template <class Value>
bool same_value(const Value& a, const Value& b)
{
    if constexpr (std::is_same_v<Value, double>)
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    else
        return a == b;
}

template <class Value>
std::string shown(const Value& value)
{
    if constexpr (std::is_enum_v<Value>)
        return to_string(value);
    else
        return fmt::format("{}", value);
}

/// Adds each difference of two lists, or the first one alone.
template <class List>
void compare_lists(const std::string& where, std::optional<std::uint64_t> realization, const List& stored,
                   const List& again, FileCheck& check, bool first_alone = false)
{
    if (stored.size() != again.size()) {
        check.add(
            {where, realization, fmt::format("{} values", stored.size()), fmt::format("{} values", again.size())});
        return;
    }
    for (std::size_t i = 0; i < stored.size(); ++i)
        if (!same_value(stored[i], again[i])) {
            check.add({fmt::format("{}[{}]", where, i), realization, shown(stored[i]), shown(again[i])});
            if (first_alone)
                return;
        }
}

template <class Value>
void compare_values(const std::string& where, const Value& stored, const Value& again, FileCheck& check)
{
    if (!same_value(stored, again))
        check.add({where, std::nullopt, shown(stored), shown(again)});
}

/// What is wrong with one row, value by value.
class RowLook {
public:
    /// @param dimensions of the structure, 2 or 3
    RowLook(const ResultRow& row, int dimensions, FileCheck& check) : row_(row), dimensions_(dimensions), check_(check)
    {
    }

    template <class Value>
    void expect(const char* where, const Value& stored, const Value& expected)
    {
        if (!same_value(stored, expected))
            check_.add({where, row_.index, shown(stored), shown(expected)});
    }
    void require(const std::string& where, double stored, bool holds, const char* expected)
    {
        if (!holds)
            check_.add({where, row_.index, shown(stored), expected});
    }

    /// Of any valid realization: finite, and not negative where it is no signed quantity. -1 stands for none.
    void numbers()
    {
        const auto check = [&](const std::string& group, const char* name, const FieldFacts& facts, const auto& value) {
            if constexpr (std::is_same_v<decltype(value), const double&>) {
                if (facts.none == it_still_moved && row_.outcome.at_rest == 0)
                    return require(group + name, value, std::isnan(value), "NaN of what still moved");
                if (facts.none == std::string_view(nothing_fell) && row_.outcome.fallen_blocks == 0)
                    return require(group + name, value, std::isnan(value), "NaN where nothing fell");
                require(group + name, value, std::isfinite(value), "a finite number");
                const bool none = value == -1 && is_event_time(facts);
                require(group + name, value, none || facts.is_signed || !(value < 0), "a number that is not negative");
            }
        };
        visit_numbers(dimensions_, check, row_);
        const Outcome& o = row_.outcome;
        require("outcome/at_rest", o.at_rest, o.at_rest == 0 || o.at_rest == 1, "0 or 1");
        require("outcome/step_s", o.step_s, o.step_s > 0, "a number above 0");
        for (const double time : {o.collapse_time_s, o.unseating_time_s, o.total_collapse_time_s})
            require("outcome/end_time_s", o.end_time_s, !(o.end_time_s < time), "a time that is not before the falls");
    }

    /// Values derived from the fall times.
    void falls()
    {
        const Outcome& o = row_.outcome;
        double first = -1;
        std::int32_t fallen = 0, first_block = -1;
        for (std::size_t i = 0; i < o.fall_time_s.size(); ++i) {
            const double time = o.fall_time_s[i];
            require(fmt::format("outcome/fall_time_s[{}]", i), time, std::isfinite(time) && (time >= 0 || time == -1),
                    "a time, or none");
            fallen += time >= 0;
            if (time >= 0 && (first < 0 || time < first)) {
                first = time;
                first_block = static_cast<std::int32_t>(i);
            } else if (time >= 0 && time == first) {
                first_block = several_blocks;
            }
        }
        expect("outcome/collapse_time_s", o.collapse_time_s, first);
        expect("outcome/first_collapse_block", o.first_collapse_block, first_block);
        expect("outcome/fallen_blocks", o.fallen_blocks, fallen);
        if ((o.state == State::collapsed) != (first >= 0))
            check_.add(
                {"outcome/state", row_.index, shown(o.state), first >= 0 ? "collapsed" : "a state without fall"});
        require("outcome/unseated_block", o.unseated_block, (o.unseated_block == -1) == (o.unseating_time_s < 0),
                "a block where there is a time of unseating, and -1 elsewhere");
    }

    /// Of a survival study; the sum of the offsets is a column of its own.
    void final_state()
    {
        const Outcome& o = row_.outcome;
        double sliding = 0;
        for (std::size_t i = 0; i < o.bed_offset_m.size(); ++i) {
            require(fmt::format("outcome/bed_offset_m[{}]", i), o.bed_offset_m[i], std::isfinite(o.bed_offset_m[i]),
                    "a finite number");
            sliding += std::fabs(o.bed_offset_m[i]);
        }
        for (std::size_t i = 0; i < o.rotation_rad.size(); ++i)
            require(fmt::format("outcome/rotation_rad[{}]", i), o.rotation_rad[i], std::isfinite(o.rotation_rad[i]),
                    "a finite number");
        if (!o.bed_offset_m.empty() && o.at_rest == 1)
            expect("outcome/residual_sliding_m", o.residual_sliding_m, sliding);
    }

private:
    const ResultRow& row_;
    const int dimensions_;
    FileCheck& check_;
};

} // namespace

RowChecks check_rows(const Study& study, const ResultReader& reader)
{
    RowChecks checks;
    FileCheck& check = checks.check;
    check.name = "rows";
    std::uint64_t rows = 0;
    reader.for_each_row([&](const ResultRow& row) {
        ++rows;
        RowLook look(row, reader.header().dimensions, check);
        if (row.index >= study.total())
            check.add({"index", row.index, shown(row.index), fmt::format("an index below {}", study.total())});
        checks.wrong_cell = checks.wrong_cell || row.index >= study.total() || row.cell != study.cell(row.index);
        look.expect("cell", row.cell, study.cell(row.index));
        const Outcome& o = row.outcome;
        const bool invalid = o.state == State::invalid;
        if (invalid != (o.invalid_reason != InvalidReason::none))
            check.add({"outcome/invalid_reason", row.index, shown(o.invalid_reason),
                       invalid ? "the reason of an invalid realization" : "none"});
        if (invalid)
            return; // it has no value
        look.numbers();
        look.falls();
        look.final_state();
    });
    const std::uint64_t wanted = reader.header().total;
    if (reader.complete() && rows != wanted)
        check.add({"realizations", std::nullopt, shown(rows), shown(wanted)});
    check.text = fmt::format("the values of {}: ranges, and falls derived from fall times", counted(rows, "row"));
    return checks;
}

void compare_rows(const ResultHeader& header, const ResultRow& stored, const ResultRow& again, FileCheck& check)
{
    if (same_bits(stored, again))
        return;
    visit_numbers(
        header.dimensions,
        [&](const std::string& group, const char* name, auto, const auto& a, const auto& b) {
            if (!same_value(a, b))
                check.add({group + name, stored.index, shown(a), shown(b)});
        },
        stored, again);
    const auto lists = [&](const std::vector<double>& a, const std::vector<double>& b, const auto& name) {
        for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
            if (i >= a.size() || i >= b.size() || !same_value(a[i], b[i]))
                check.add(
                    {name(i), stored.index, i < a.size() ? shown(a[i]) : "none", i < b.size() ? shown(b[i]) : "none"});
    };
    visit_lists(std::type_identity<Outcome>(), [&](const char* name, auto field, auto, auto) {
        lists(stored.outcome.*field, again.outcome.*field,
              [&](std::size_t i) { return fmt::format("outcome/{}[{}]", name, i); });
    });
    lists(stored.inputs, again.inputs, [&](std::size_t i) {
        return i < header.input_names.size() ? "input/" + header.input_names[i] : fmt::format("input {}", i);
    });
}

void compare_trajectories(const Trajectory& stored, const Trajectory& again, FileCheck& check)
{
    const auto lists = [&](const char* name, const auto& a, const auto& b) {
        compare_lists(fmt::format("trajectories/{}/{}", stored.index, name), stored.index, a, b, check, true);
    };
    visit_lists(stored, [&](const TrajectoryChannel& channel, const std::vector<double>& list) {
        lists(channel.name, list, again[channel.name]);
    });
    lists("column", stored.column, again.column);
    lists("blocks", stored.name, again.name);
    if (stored.role != again.role)
        check.add({fmt::format("trajectories/{}/role", stored.index), stored.index, "other roles", "the study's"});
}

void compare_surfaces(const SurfaceTable& stored, const SurfaceTable& again, FileCheck& check)
{
    const auto lists = [&](const char* where, const auto& a, const auto& b) {
        compare_lists(where, std::nullopt, a, b, check);
    };
    lists("surface/frequency_hz", stored.frequency_hz, again.frequency_hz);
    lists("surface/direction_deg", stored.direction_deg, again.direction_deg);
    lists("surface/pga_m_s2", stored.pga_m_s2, again.pga_m_s2);
    lists("surface/trials", stored.trials, again.trials);
    lists("surface/collapses", stored.collapses, again.collapses);
    lists("surface/probability", stored.probability, again.probability);
    lists("surface/lower", stored.lower, again.lower);
    lists("surface/upper", stored.upper, again.upper);
    lists("surface/method", stored.method, again.method);
    compare_values("surface/interval", stored.interval, again.interval, check);
    compare_values("surface/half_width", stored.half_width, again.half_width, check);
    compare_values("surface/rounds", stored.rounds, again.rounds, check);
}

void compare_tables(const Table& stored, const Table& again, FileCheck& check)
{
    for (const Table::Column& column : again.columns()) {
        const std::string where = again.name() + "/" + column.name;
        const auto found = std::ranges::find(stored.columns(), column.name, &Table::Column::name);
        if (found == stored.columns().end() || found->values.index() != column.values.index() ||
            found->shape != column.shape) {
            check.add({where, std::nullopt, found == stored.columns().end() ? "nothing" : "another type or shape",
                       "what the realizations make"});
            continue;
        }
        std::visit(
            [&](const auto& values) {
                compare_lists(where, std::nullopt, std::get<std::remove_cvref_t<decltype(values)>>(found->values),
                              values, check);
            },
            column.values);
    }
    for (const auto& [name, value] : again.attributes()) {
        const auto found =
            std::ranges::find(stored.attributes(), name, &std::pair<std::string, Table::Attribute>::first);
        const std::string where = fmt::format("attribute {} of {}", name, again.name());
        if (found == stored.attributes().end() || found->second.index() != value.index()) {
            check.add({where, std::nullopt, "nothing", "what the realizations make"});
            continue;
        }
        std::visit(
            [&](const auto& expected) {
                compare_values(where, std::get<std::remove_cvref_t<decltype(expected)>>(found->second), expected,
                               check);
            },
            value);
    }
}

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
