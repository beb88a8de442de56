#pragma once
/// When a cell of a surface is looked at, and which interval may then be told although it was looked at before.
///
/// A cell's trials come in batches: after n_1 < n_2 < ... trials it is looked at, and it is finished at the first look
/// whose interval is at most 2 h wide (h: the half width that is asked for). An interval that is right for a number of
/// trials fixed beforehand need not be right then, because the number depends on the trials. But this rule asks how
/// wide an interval is, not where it lies, and the width depends on the trials through p (1 - p) / n alone: there is
/// little to be gained by chance. What remains is known exactly. The chance of every path (collapses so far at each
/// look) is the binomial one, so the coverage
///
///   C(p) = sum over looks k and counts s at which the rule stops:  P(reaches n_k with s, p) [p in I(n_k, s)]
///
/// is a finite sum. The interval is Jeffreys' (see `interval.hpp`) at the lowest level, in steps of 0.001, at which the
/// average of C over p is at least the level that is asked for, also when the looks end early (budget) at any of them.
/// Looks from 8 on with h = 0.05 and 0.95: level 0.953, average 0.951, and the worst p has 0.880, no worse than
/// Jeffreys' with a fixed number (0.878). With a count of 1/2 the cell is finished after 408 trials, without a collapse
/// after 28; all cells with the trials of the worst one would need 382. A confidence sequence, which holds for every
/// way to stop at once, would need about twice as many.
///
/// Group-sequential sampling: Jennison & Turnbull, "Group Sequential Methods" (2000), chapter 12; fixed-width intervals
/// of a proportion: Frey, The American Statistician 64 (2010) 242.

#include "ensemble/numerics/interval.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// The looks at one cell, and its interval at them.
class AdaptiveLooks {
public:
    /// @param first      trials at the first look
    /// @param most       and at the last one
    /// @param half_width h, in (0, 0.5)
    /// @param level      confidence, in (0, 1)
    /// @pre 1 <= first <= most
    AdaptiveLooks(std::uint64_t first, std::uint64_t most, double half_width, double level);

    /// n_1 ... n_K: each about a fifth more than the one before, in multiples of 4; up to where every count is enough.
    const std::vector<std::uint64_t>& trials() const { return trials_; }
    /// The first look with more trials than these; the last one if there is none.
    std::uint64_t after(std::uint64_t trials) const;
    double half_width() const { return half_width_; }
    double level() const { return level_; }
    /// Level of Jeffreys' interval that makes the coverage right.
    double interval_level() const { return interval_level_; }
    /// Also of numbers of trials between the looks: an invalid realization is no trial.
    BinomialInterval interval(std::uint64_t trials, std::uint64_t collapses) const;
    /// Whether an interval is narrow enough.
    bool narrow(const BinomialInterval& interval) const { return interval.upper - interval.lower <= 2 * half_width_; }

    struct Expected {
        double coverage = 0; ///< C(p)
        double trials = 0;   ///< mean number of them at the end
    };
    /// Exactly, for a cell whose probability is p. @param looks after which it ends in any case
    Expected expected(double p, std::size_t looks) const;

private:
    struct Count {
        bool stops;
        BinomialInterval interval;
    };
    /// For every look and count of collapses, up to where every count stops.
    using Rule = std::vector<std::vector<Count>>;
    Rule rule_at(double interval_level) const;
    /// By number of looks, from 1 on.
    std::vector<Expected> expected_by_looks(const Rule& rule, double p) const;
    bool is_right(const Rule& rule) const;

    std::vector<std::uint64_t> trials_;
    double half_width_;
    double level_;
    double interval_level_;
    Rule rule_;
};

/// Trials that a cell needs if their number is fixed beforehand and nothing is known of p: Jeffreys' interval of p =
/// 1/2 at the level is just narrow enough.
std::uint64_t uniform_trials(double half_width, double level);

} // namespace stylobate
