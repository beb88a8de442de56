#pragma once
/// The keys of a distribution: { distribution, per, ... }.

#include "ensemble/model/study.hpp"
#include "io/keys/ranges.hpp"
#include "io/keys/words.hpp"

namespace stylobate {

// An axis of a study file: { from, to, count, spacing }.

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

struct SpreadKey : TableKey {
    struct Quality {
        Range value;                    ///< what a value may be
        std::string deviation_key;      ///< of the standard deviation; its unit is part of it
        bool relative = true;           ///< has a nominal value to scale: cov, lognormal, log_uniform make sense
        std::vector<Name<Per>> allowed; ///< the first is the default
        /// Models in which the standard deviation has the unit of its key.
        std::vector<std::string> deviation_models = KeyFacts().models;
        double turn = 0; ///< of an angle: a full turn, over which a uniform one goes without ends; 0: needs ends
    };
    SpreadKey(std::string key, std::string means, const Quality& quality, KeyFacts facts = {});
    SpreadKey(const SpreadKey&) = delete; // `keys` points into it

    bool relative;
    double turn; ///< see `Quality`
    Range value;
    WordKey<DistributionKind> distribution;
    NumberKey sd, cov, sigma_ln, from, to, min, max;
    WordKey<Per> per;

    /// The keys of this and of other quantities: one of those is not unknown, but not used.
    std::vector<std::string> names_of_all() const;
    /// The keys that a distribution uses.
    std::vector<std::string> names_for(DistributionKind kind) const;
};

/// That of a perturbed quantity.
const SpreadKey& spread_key(Quantity quantity);
/// That of a mechanism's parameter.
const SpreadKey& spread_key(Mechanism mechanism, std::size_t parameter);

/// [perturbation], with [perturbation.mechanisms] in it.
const TableKey& perturbation_table();
/// [perturbation.mechanisms], and the table of one mechanism in it
const TableKey& perturbed_mechanisms();
const TableKey& perturbed_parameters(Mechanism mechanism);

} // namespace stylobate
