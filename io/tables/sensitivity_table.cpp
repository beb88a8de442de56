#include "io/tables/sensitivity_table.hpp"

#include <utility>

namespace stylobate {

Table to_table(const SensitivityTable& s)
{
    Table table("sensitivity");
    table.set("method", s.method);
    table.set("interval", s.interval);
    table.set("rows", s.rows);
    table.set("invalid_rows", s.invalid_rows);
    table.set("inner", s.inner);
    table.add("outcomes", s.outcomes);
    table.add("units", s.units);
    table.add("meanings", s.meanings);
    table.add("factors", s.factors);
    std::vector<std::string> names;
    for (const SensitivityTable::Index& index : s.indices)
        names.push_back(index.name);
    table.add("indices", names);
    const Table::Shape outcomes = {s.outcomes.size()}, both = {s.outcomes.size(), s.factors.size()};
    table.add("acts", s.acts, {s.factors.size()});
    table.add("mean", s.mean, outcomes);
    if (!s.explained.value.empty())
        table.add("explained", s.explained, outcomes);
    for (const SensitivityTable::Index& index : s.indices)
        table.add(index.name, index.of, both);
    return table;
}

SensitivityTable sensitivity_table(const Table& table)
{
    SensitivityTable s;
    if (table.empty())
        return s;
    s.method = table.text("method");
    s.interval = table.text("interval");
    s.rows = table.count("rows");
    s.invalid_rows = table.count("invalid_rows");
    s.inner = table.count("inner");
    s.outcomes = table.texts("outcomes");
    s.units = table.texts("units");
    s.meanings = table.texts("meanings");
    s.factors = table.texts("factors");
    if (s.units.size() != s.outcomes.size() || s.meanings.size() != s.outcomes.size())
        table.refuse("'sensitivity' does not have a unit and a meaning for each outcome");
    const Table::Shape outcomes = {s.outcomes.size()}, both = {s.outcomes.size(), s.factors.size()};
    s.acts = table.counts("acts", {s.factors.size()});
    s.mean = table.intervals("mean", outcomes);
    if (table.has("explained"))
        s.explained = table.intervals("explained", outcomes);
    for (const std::string& name : table.texts("indices"))
        s.indices.push_back({name, table.intervals(name, both)});
    return s;
}

Table listed(const SensitivityTable& s)
{
    std::vector<std::string> outcome, unit, name, factor;
    IntervalArray all;
    const auto line = [&](std::size_t o, const std::string& index, const std::string& of_factor,
                          const IntervalArray& of, std::size_t i) {
        outcome.push_back(s.outcomes[o]);
        unit.push_back(s.units[o]);
        name.push_back(index);
        factor.push_back(of_factor);
        all.add(of.value[i], of.lower[i], of.upper[i]);
    };
    for (std::size_t o = 0; o < s.outcomes.size(); ++o) {
        line(o, "mean", "", s.mean, o);
        if (!s.explained.value.empty())
            line(o, "explained", "", s.explained, o);
        for (const SensitivityTable::Index& index : s.indices)
            for (std::size_t k = 0; k < s.factors.size(); ++k)
                line(o, index.name, s.factors[k], index.of, o * s.factors.size() + k);
    }
    Table table("sensitivity");
    table.add("outcome", std::move(outcome));
    table.add("unit", std::move(unit));
    table.add("index", std::move(name));
    table.add("factor", std::move(factor));
    table.add("value", std::move(all.value));
    table.add("lower", std::move(all.lower));
    table.add("upper", std::move(all.upper));
    return table;
}

} // namespace stylobate
