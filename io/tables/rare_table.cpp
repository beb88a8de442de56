#include "io/tables/rare_table.hpp"

namespace stylobate {

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

} // namespace stylobate
