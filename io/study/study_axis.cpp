#include "io/study/study_axis.hpp"

#include "io/study/study_names.hpp"

#include <fmt/format.h>

namespace stylobate {

Axis read_axis(const KeyReader& table, std::string_view key, const Range& range, const std::vector<std::string>& more)
{
    if (!table.has(key))
        table.missing(key, fmt::format("Give it as {{ from = ..., to = ..., count = ..., spacing = \"linear\" }} "
                                       "with values in {}. {}",
                                       range.text(), range.hint));
    const KeyReader keys = table.table(key);
    std::vector<std::string> known = more;
    known.insert(known.end(), {"from", "to", "count", "spacing"});
    keys.allow_only(known);
    Axis axis;
    axis.from = keys.number("from", range);
    axis.to = keys.number("to", range);
    axis.count = static_cast<int>(keys.whole("count", 1, 1000));
    axis.spacing = keys.choice_or("spacing", spacing_names, axis.spacing);
    if (axis.from > axis.to)
        keys.refuse("from", fmt::format("is above to = {}", axis.to), "Axes run upwards.");
    if (axis.count == 1 && axis.from != axis.to)
        keys.refuse("count", fmt::format("is one value, but from = {} and to = {}", axis.from, axis.to),
                    "Give more values, or the same from and to.");
    if (axis.count > 1 && axis.from == axis.to)
        keys.refuse("count", fmt::format("gives equal values: from = to = {}", axis.from),
                    "Give count = 1, or another from or to.");
    return axis;
}

} // namespace stylobate
