#pragma once
/// The interim analyses of a cell of a surface, and an interval that is valid under them.
///
/// The trials of a cell come in batches: after n_1 < n_2 < ... trials there is an interim analysis, and the
/// cell is finished at the first one whose interval is at most 2 h wide (h: the requested half
/// width). An interval that is valid for a number of trials fixed beforehand need not be valid then, because the number
/// depends on the trials. This rule, however, depends on the width of an interval and not on its position, and the
/// width depends on the trials through p (1 - p) / n alone: the effect is small. It is known exactly. The probability
/// of every path (collapses so far at each analysis) is binomial, so the coverage
///
///   C(p) = sum over analyses k and counts s at which the rule stops:  P(reaches n_k with s, p) [p in I(n_k, s)]
///
/// is a finite sum. The interval is Jeffreys' (see `interval.hpp`) at the lowest level, in steps of 0.001, at which the
/// average of C over p is at least the requested level, also when the analyses end early (budget) at any of them.
/// Analyses from 8 on with h = 0.05 and 0.95: level 0.953, average 0.951, and the worst p has 0.880, no worse than
/// Jeffreys' with a fixed number (0.878). With a count of 1/2 the cell is finished after 408 trials, without a collapse
/// after 28; all cells with the trials of the worst one would need 382. A confidence sequence, which is valid for every
/// stopping rule, would need about twice as many.
///
/// Source: group-sequential sampling, Jennison & Turnbull, "Group Sequential Methods with Applications to Clinical
/// Trials" (2000), chapter 12; fixed-width intervals of a proportion with exact coverage, Frey, "Fixed-width sequential
/// confidence intervals for a proportion", The American Statistician 64 (2010) 242. The adjusted level of Jeffreys'
/// interval is an own choice.

#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

// Rounds of trials of the cells of a surface: those that are undecided proceed to their next look, the widest
// intervals first, until the budget is spent.

/// The first of ascending looks with more trials than these; the last one if there is none.
inline std::uint64_t next_look(const std::vector<std::uint64_t>& looks, std::uint64_t trials)
{
    const auto next = std::upper_bound(looks.begin(), looks.end(), trials);
    return next == looks.end() ? looks.back() : *next;
}

class WidestFirst {
public:
    /// @param budget trials of all cells together, enough for the first look of each
    WidestFirst(std::uint64_t budget, std::size_t cells) : budget_(budget), asked_(cells, 0) {}

    /// Trials of each cell after the next round: the first look of each, then more of those that are undecided. If they
    /// are the same as before, the rounds are finished.
    /// @param looks trials of a cell at each of its looks, ascending
    /// @param width of the interval of cell i; none where it is decided
    template <class Width>
    const std::vector<std::uint64_t>& next(const std::vector<std::uint64_t>& looks, const Width& width)
    {
        if (rounds_ == 0) {
            std::fill(asked_.begin(), asked_.end(), looks.front());
            ++rounds_;
            return asked_;
        }
        std::vector<std::pair<double, std::size_t>> open;
        for (std::size_t cell = 0; cell < asked_.size(); ++cell)
            if (asked_[cell] < looks.back())
                if (const std::optional<double> wide = width(cell))
                    open.emplace_back(*wide, cell);
        std::stable_sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        std::uint64_t left = budget_ - std::accumulate(asked_.begin(), asked_.end(), std::uint64_t{0});
        bool more = false;
        for (const auto& [wide, cell] : open) {
            const std::uint64_t add = next_look(looks, asked_[cell]) - asked_[cell];
            if (add > left)
                break;
            asked_[cell] += add;
            left -= add;
            more = true;
        }
        rounds_ += more;
        return asked_;
    }
    const std::vector<std::uint64_t>& asked() const { return asked_; }
    std::uint64_t rounds() const { return rounds_; }

private:
    std::uint64_t budget_;
    std::vector<std::uint64_t> asked_; ///< (cells)
    std::uint64_t rounds_ = 0;
};

/// The interim analyses of one cell, and its interval at them.
class InterimAnalyses {
public:
    /// @param first      trials at the first analysis
    /// @param most       and at the last one
    /// @param half_width h, in (0, 0.5)
    /// @param level      confidence, in (0, 1)
    /// @pre 1 <= first <= most
    InterimAnalyses(std::uint64_t first, std::uint64_t most, double half_width, double level);

    /// n_1 ... n_K: each about a fifth more than the one before, in multiples of 4; up to where every count suffices.
    const std::vector<std::uint64_t>& trials() const { return trials_; }
    /// The first analysis with more trials than these; the last one if there is none.
    std::uint64_t after(std::uint64_t trials) const { return next_look(trials_, trials); }
    double half_width() const { return half_width_; }
    double level() const { return level_; }
    /// Level of Jeffreys' interval that gives the requested coverage.
    double interval_level() const { return interval_level_; }
    /// Also for numbers of trials between the analyses: an invalid realization is not a trial.
    BinomialInterval interval(std::uint64_t trials, std::uint64_t collapses) const;
    /// Whether an interval is narrow enough.
    bool narrow(const BinomialInterval& interval) const { return interval.upper - interval.lower <= 2 * half_width_; }

    struct Expected {
        double coverage = 0; ///< C(p)
        double trials = 0;   ///< mean number of them at the end
    };
    /// Exactly, for a cell whose probability is p. @param analyses number after which it ends in any case
    Expected expected(double p, std::size_t analyses) const;

private:
    struct Count {
        bool stops;
        BinomialInterval interval;
    };
    /// For every analysis and count of collapses, up to where every count stops.
    using Rule = std::vector<std::vector<Count>>;
    Rule rule_at(double interval_level) const;
    /// By number of analyses, from 1 on.
    std::vector<Expected> expected_by_analyses(const Rule& rule, double p) const;
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
