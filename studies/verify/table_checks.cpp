#include "studies/verify/table_checks.hpp"

#include "studies/verify/compared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <variant>

namespace stylobate {

namespace {

template <class Value>
void compare_lists(const std::string& where, const std::vector<Value>& stored, const std::vector<Value>& again,
                   FileCheck& check)
{
    if (stored.size() != again.size())
        check.add(
            {where, std::nullopt, fmt::format("{} values", stored.size()), fmt::format("{} values", again.size())});
    else
        for (std::size_t i = 0; i < stored.size(); ++i)
            if (!same_value(stored[i], again[i]))
                check.add({fmt::format("{}[{}]", where, i), std::nullopt, shown(stored[i]), shown(again[i])});
}

template <class Value>
void compare_values(const std::string& where, const Value& stored, const Value& again, FileCheck& check)
{
    if (!same_value(stored, again))
        check.add({where, std::nullopt, shown(stored), shown(again)});
}

} // namespace

void compare_surfaces(const SurfaceTable& stored, const SurfaceTable& again, FileCheck& check)
{
    compare_lists("surface/frequency_hz", stored.frequency_hz, again.frequency_hz, check);
    compare_lists("surface/pga_m_s2", stored.pga_m_s2, again.pga_m_s2, check);
    compare_lists("surface/trials", stored.trials, again.trials, check);
    compare_lists("surface/collapses", stored.collapses, again.collapses, check);
    compare_lists("surface/probability", stored.probability, again.probability, check);
    compare_lists("surface/lower", stored.lower, again.lower, check);
    compare_lists("surface/upper", stored.upper, again.upper, check);
    compare_lists("surface/method", stored.method, again.method, check);
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
                compare_lists(where, std::get<std::remove_cvref_t<decltype(values)>>(found->values), values, check);
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
