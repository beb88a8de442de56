#include "studies/verify/value_checks.hpp"

#include "io/files/suggest.hpp"
#include "io/store/result_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
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
    RowLook(const ResultRow& row, FileCheck& check) : row_(row), check_(check) {}

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
                if (facts.none == std::string_view(it_still_moved) && row_.outcome.at_rest == 0)
                    return require(group + name, value, std::isnan(value), "NaN of what still moved");
                require(group + name, value, std::isfinite(value), "a finite number");
                const bool none = value == -1 && is_event_time(facts);
                require(group + name, value, none || facts.is_signed || !(value < 0), "a number that is not negative");
            }
        };
        visit_numbers(check, row_);
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
        RowLook look(row, check);
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
    visit_lists<Trajectory>(
        [&](const char* name, auto, auto, auto field) { lists(name, stored.*field, again.*field); });
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

} // namespace stylobate
