#include "io/study/study_axis.hpp"

#include <fmt/format.h>

namespace stylobate {

Axis read_axis(const KeyReader& table, const AxisKey& key, const Range& range)
{
    if (!table.has(key))
        table.missing(key.name, fmt::format("Give it as {{ from = ..., to = ..., count = ..., spacing = \"linear\" }} "
                                            "with values in {}. {}",
                                            range.text(), range.hint));
    const KeyReader keys = table.table(key);
    Axis axis;
    axis.from = keys.read_within(key.from, range);
    axis.to = keys.read_within(key.to, range);
    axis.count = static_cast<int>(keys.read(key.count));
    axis.spacing = keys.read(key.spacing);
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
