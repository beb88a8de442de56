#include "io/tables/kind_tables.hpp"

#include <utility>

namespace stylobate {

Table to_table(const FragilityTable& f)
{
    Table table("fragility");
    table.set("measure", f.measure);
    table.set("interval", "95 % by the motions: jackknife of curves, weighted motions of shares");
    const Table::Shape states = {f.states.size()};
    table.add("motion", f.motion);
    table.add("intensity", f.intensity);
    if (f.states.empty()) // too few motions for any curve
        return table;
    table.add("states", f.states);
    table.add("meanings", f.meanings);
    table.add("trials", f.trials, states);
    table.add("reached", f.reached, states);
    table.add("median", f.median, states);
    table.add("dispersion", f.dispersion, states);
    table.add("grid", f.grid);
    table.add("curve", f.curve, {states[0], f.grid.size()});
    if (f.stripe.empty())
        return table;
    table.add("stripe", f.stripe);
    table.add("share", f.share, {states[0], f.stripe.size()});
    return table;
}

FragilityTable fragility_table(const Table& table)
{
    FragilityTable f;
    if (table.empty())
        return f;
    f.measure = table.text("measure");
    f.motion = table.integers("motion", table.shape("motion"));
    f.intensity = table.numbers("intensity", {f.motion.size()});
    if (!table.has("states"))
        return f;
    f.states = table.texts("states");
    f.meanings = table.texts("meanings");
    const Table::Shape states = {f.states.size()};
    f.trials = table.counts("trials", states);
    f.reached = table.counts("reached", states);
    f.median = table.intervals("median", states);
    f.dispersion = table.intervals("dispersion", states);
    f.grid = table.numbers("grid", table.shape("grid"));
    f.curve = table.intervals("curve", {states[0], f.grid.size()});
    if (!table.has("stripe"))
        return f;
    f.stripe = table.numbers("stripe", table.shape("stripe"));
    f.share = table.intervals("share", {states[0], f.stripe.size()});
    return f;
}

Table to_table(const RareTable& rare)
{
    Table table("rare");
    table.set("probability", rare.probability);
    table.set("lower", rare.lower);
    table.set("upper", rare.upper);
    table.set("interval", rare.interval);
    table.set("realizations", rare.realizations);
    table.set("plain_realizations", rare.plain_realizations);
    const Table::Shape both = {rare.repeats.size(), rare.levels};
    table.add("repeats", rare.repeats);
    table.add("threshold_m", rare.threshold_m, both, "m");
    table.add("share", rare.share, both);
    table.add("acceptance", rare.acceptance, both);
    table.add("stuck", rare.stuck, both);
    return table;
}

RareTable rare_table(const Table& table)
{
    RareTable rare;
    if (table.empty())
        return rare;
    rare.probability = table.number("probability");
    rare.lower = table.number("lower");
    rare.upper = table.number("upper");
    rare.interval = table.text("interval");
    rare.realizations = table.count("realizations");
    rare.plain_realizations = table.number("plain_realizations");
    const Table::Shape both = table.shape("share");
    if (both.size() != 2)
        table.refuse("'rare/share' is not a matrix");
    rare.levels = both[1];
    rare.repeats = table.numbers("repeats", {both[0]});
    rare.threshold_m = table.numbers("threshold_m", both);
    rare.share = table.numbers("share", both);
    rare.acceptance = table.numbers("acceptance", both);
    rare.stuck = table.numbers("stuck", both);
    return rare;
}

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
