#include "io/tables/fragility_table.hpp"

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

} // namespace stylobate
