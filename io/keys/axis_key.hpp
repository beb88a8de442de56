#pragma once
/// An axis of a study file: { from, to, count, spacing }.

#include "ensemble/model/study.hpp"
#include "io/keys/words.hpp"

namespace stylobate {

struct AxisKey : TableKey {
    struct Example {
        const char* from;
        const char* to;
        const char* count;
        const char* spacing;
    };
    /// @param allowed for `from` and `to`   @param more keys that stand before those of the axis
    AxisKey(std::string key, std::string means, const Range& allowed, const Example& to_begin_with,
            std::vector<const TomlKey*> more = {}, KeyFacts facts = {})
        : TableKey(std::move(key), std::move(means), std::move(more), std::move(facts)),
          from("from", &Axis::from, allowed, "first value", {.needed = true, .example = to_begin_with.from}),
          to("to", &Axis::to, allowed, "last value", {.needed = true, .example = to_begin_with.to}),
          count("count", &Axis::count, {1, 1000}, "number of values", {.needed = true, .example = to_begin_with.count}),
          spacing("spacing", &Axis::spacing, spacing_names, "equal differences, or equal ratios",
                  {.example = to_begin_with.spacing})
    {
        keys.insert(keys.end(), {&from, &to, &count, &spacing});
    }
    AxisKey(const AxisKey&) = delete; // `keys` points into it

    NumberKey from, to;
    WholeKey count;
    WordKey<Spacing> spacing;
};

} // namespace stylobate
