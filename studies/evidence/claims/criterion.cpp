/// Evaluates a criterion on samples, case by case.

#include "studies/evidence/claims/verdict.hpp"

#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/model/input_error.hpp"
#include "studies/evidence/claims/claim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace stylobate::claims {

namespace {

/// The ways of moving of which a realization shows exactly one.
constexpr std::array modes{Event::stood, Event::rocked_only, Event::slid_only, Event::rocked_and_slid};
/// So many realizations of a cell have a most frequent way of moving.
constexpr std::size_t fewest_moving = 20;
/// Outside of these shares a cell is decided.
constexpr double open_from = 0.05, open_to = 0.95;

struct Cell {
    std::size_t f = 0, p = 0;
};

/// What the judging of one test shares.
class Judge {
public:
    Judge(const ClaimFile& file, const Test& test, double margin)
        : file_(file), test_(test), c_(test.criterion), margin_(margin)
    {
    }

    /// Of one variant (bound, trend), or of a group of them along an axis (order, same).
    std::optional<Case> one(const std::vector<const Sample*>& group, std::size_t range) const
    {
        Case found;
        found.levels = group.front()->levels;
        found.range = range;
        const std::vector<std::size_t> rows = frequencies(*group.front(), test_.ranges[range].frequency);
        if (rows.empty())
            return std::nullopt;
        const std::vector<Cell> cells = cells_of(*group.front(), rows);
        return compares(group, cells, found) ? std::optional(found) : std::nullopt;
    }

private:
    /// @returns whether there is something to compare
    bool compares(const std::vector<const Sample*>& group, const std::vector<Cell>& cells, Case& found) const
    {
        switch (c_.kind) {
        case Criterion::Kind::bound:
            return bound(*group.front(), cells, found);
        case Criterion::Kind::trend:
            return trend(*group.front(), cells, found);
        case Criterion::Kind::order:
            return order(group, cells, found);
        case Criterion::Kind::paired:
            return paired(group, cells, found);
        case Criterion::Kind::same:
            break;
        }
        return same(group, cells, found);
    }

    bool of_onset() const { return c_.measure.kind == Measure::Kind::onset; }

    static double level(std::size_t numbers) { return 1 - (1 - case_level) / static_cast<double>(numbers); }

    static std::vector<std::size_t> frequencies(const Sample& sample, const Window& window)
    {
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < sample.frequency_hz.size(); ++i)
            if (window.holds(sample.frequency_hz[i] / (window.over_f1 ? sample.f1_hz : 1)))
                rows.push_back(i);
        return rows;
    }

    std::vector<Cell> cells_of(const Sample& sample, const std::vector<std::size_t>& rows) const
    {
        std::vector<Cell> cells;
        for (const std::size_t f : rows)
            for (std::size_t p = 0; p < sample.pga_m_s2.size(); ++p) {
                if (of_onset() ? p == 0 : c_.pga.holds(sample.pga_m_s2[p]))
                    cells.push_back({f, p});
            }
        const bool one_each = of_onset() || c_.kind != Criterion::Kind::trend || cells.size() == rows.size();
        if (cells.empty() || !one_each)
            throw InputError(fmt::format("{}: claim {}: {} PGAs of the axis ({:g} to {:g} m/s2) lie in pga_m_s2 = "
                                         "[{:g}, {:g}].\n  {}",
                                         file_.file, test_.id, cells.size() / rows.size(), sample.pga_m_s2.front(),
                                         sample.pga_m_s2.back(), c_.pga.from, c_.pga.to,
                                         cells.empty() ? "The window must hold one at least."
                                                       : "A trend follows one PGA along the frequencies."));
        return cells;
    }

    std::string at(const Sample& s, const Cell& cell) const
    {
        const bool one_f = s.frequency_hz.size() == 1, one_p = s.pga_m_s2.size() == 1;
        std::string text;
        if (!one_f)
            text += fmt::format(" at {:.3g} Hz", s.frequency_hz[cell.f]);
        if (!of_onset() && !one_p)
            text += fmt::format("{} {:.3g} m/s²", one_f ? " at" : ",", s.pga_m_s2[cell.p]);
        return text;
    }

    std::string shown(const Estimate& e) const { return number_text(c_.measure, e); }

    bool bound(const Sample& sample, const std::vector<Cell>& cells, Case& found) const
    {
        const double low = c_.at_least.value_or(-HUGE_VAL), high = c_.at_most.value_or(HUGE_VAL);
        // what clears a bound, and what certainly does not
        const auto [low_cleared, low_missed] = cleared(low, 1);
        const auto [high_cleared, high_missed] = cleared(high, -1);
        std::size_t known = 0, holding = 0, failing = 0, at_cell = 0;
        std::pair<double, double> extreme; // how far inside the bounds the value lies, then the interval
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Estimate e = estimate(sample, cells[i].f, cells[i].p, c_.measure, level(cells.size()));
            if (!e.known())
                continue;
            holding += e.lower >= low_cleared && e.upper <= high_cleared;
            failing += e.upper < low_missed || e.lower > high_missed;
            const std::pair inside{std::min(e.value - low, high - e.value), std::min(e.lower - low, high - e.upper)};
            if (known == 0 || (c_.any ? inside > extreme : inside < extreme)) {
                extreme = inside;
                found.number = e;
                at_cell = i;
            }
            ++known;
        }
        if (known == 0) {
            found.number_text = "too few realizations";
            return true;
        }
        found.number_text = shown(found.number) + at(sample, cells[at_cell]);
        if (c_.any)
            found.finding = holding > 0 ? Finding::holds : failing == known ? Finding::fails : Finding::undecided;
        else
            found.finding = failing > 0 ? Finding::fails : holding == known ? Finding::holds : Finding::undecided;
        return true;
    }

    struct Cleared {
        double beyond, short_of;
    };
    /// From where on a bound is cleared in a sense by the margin, and from where on it is missed by it.
    Cleared cleared(double bound, double sense) const
    {
        if ((c_.at_least && c_.at_most) || !std::isfinite(bound))
            return {bound, bound};
        const bool part = c_.measure.kind == Measure::Kind::probability || c_.measure.kind == Measure::Kind::minority;
        const double up = part ? 1 - bound : bound, down = bound;
        return {bound + sense * margin_ * (sense > 0 ? up : down), bound - sense * margin_ * (sense > 0 ? down : up)};
    }

    /// Whether a to b goes as the criterion says (1), against it (-1), or is not certain to do either by the margin
    /// (0).
    int sense(const Estimate& a, const Estimate& b) const
    {
        const auto lies_below = [&](const Estimate& low, const Estimate& high) {
            return low.known() && high.known() && low.upper * (1 + margin_) <= high.lower && low.value < high.value;
        };
        if (c_.way == Criterion::Way::either)
            return lies_below(a, b) || lies_below(b, a) ? 1 : 0;
        const Estimate &low = c_.way == Criterion::Way::rises ? a : b, &high = c_.way == Criterion::Way::rises ? b : a;
        return lies_below(low, high) ? 1 : lies_below(high, low) ? -1 : 0;
    }

    struct Sequence {
        int ends = 0;                    ///< sense from the first to the last
        bool against = false;            ///< some pair goes the wrong way
        bool along = false;              ///< some pair goes the right way
        std::size_t first = 0, last = 0; ///< the pair that decides
    };

    Sequence follow(const std::vector<Estimate>& e) const
    {
        Sequence s;
        s.last = e.size() - 1;
        s.ends = sense(e.front(), e.back());
        for (std::size_t i = 0; i < e.size() && !s.against; ++i)
            for (std::size_t j = i + 1; j < e.size() && !s.against; ++j)
                if (const int way = sense(e[i], e[j]); way > 0) {
                    s.along = true;
                } else if (way < 0) {
                    s.against = true;
                    s.first = i;
                    s.last = j;
                }
        return s;
    }

    /// Whether numbers lie on the same side beyond the axis, all of them, so that nothing can be said of their order.
    static bool all_beyond(const std::vector<Estimate>& e)
    {
        return std::all_of(e.begin(), e.end(), [](const Estimate& x) { return std::isinf(x.value); }) ||
               std::all_of(e.begin(), e.end(), [&](const Estimate& x) {
                   return x.known() && x.lower == 0 && x.value == e.front().value && x.upper == e.front().upper;
               });
    }

    bool trend(const Sample& sample, const std::vector<Cell>& cells, Case& found) const
    {
        std::vector<Estimate> e;
        for (const Cell& cell : cells)
            e.push_back(estimate(sample, cell.f, cell.p, c_.measure, level(cells.size())));
        if (e.size() < 2 || (of_onset() && all_beyond(e)))
            return false;
        const Sequence s = follow(e);
        found.number = e[s.last];
        found.number_text = fmt::format("{}{}; {}{}", shown(e[s.first]), at(sample, cells[s.first]), shown(e[s.last]),
                                        at(sample, cells[s.last]));
        found.finding = s.against ? Finding::fails : s.ends > 0 ? Finding::holds : Finding::undecided;
        return true;
    }

    bool paired(const std::vector<const Sample*>& group, const std::vector<Cell>& cells, Case& found) const
    {
        const Sample &first = *group.front(), &last = *group.back();
        std::vector<PairedCounts> strata;
        double of_first = 0, of_last = 0;
        std::uint64_t pairs = 0;
        for (const Cell& cell : cells) {
            const PairedCounts counts = pairs_of(first.cell(cell.f, cell.p), last.cell(cell.f, cell.p));
            if (counts.pairs() == 0)
                continue;
            const auto n = static_cast<double>(counts.pairs());
            const double a = static_cast<double>(counts.base()) / n, b = static_cast<double>(counts.variant()) / n;
            if ((a + b) / 2 < open_from || (a + b) / 2 > open_to)
                continue;
            strata.push_back(counts);
            of_first += a;
            of_last += b;
            pairs += counts.pairs();
        }
        if (strata.empty())
            return false;
        of_first /= static_cast<double>(strata.size());
        of_last /= static_cast<double>(strata.size());
        const PairedDifference d = stratified_difference(strata, case_level);
        found.number = {d.value, d.lower, d.upper, pairs};
        found.number_text = fmt::format(
            "{}: {:.1f} %; {}: {:.1f} %; difference {:+.1f} ({:+.1f} to {:+.1f}) percentage points, {} pairs "
            "in {} {}",
            level_name(first), 100 * of_first, level_name(last), 100 * of_last, 100 * d.value, 100 * d.lower,
            100 * d.upper, pairs, strata.size(), strata.size() == 1 ? "cell" : "cells");
        const double least = margin_ * std::max(of_first, of_last), sense = c_.way == Criterion::Way::rises ? 1 : -1;
        const double low = std::min(sense * d.lower, sense * d.upper),
                     high = std::max(sense * d.lower, sense * d.upper);
        found.finding = low > least ? Finding::holds : high < -least ? Finding::fails : Finding::undecided;
        return true;
    }

    /// Of realizations of equal number, of those that are valid at both levels.
    PairedCounts pairs_of(const std::vector<Observation>& first, const std::vector<Observation>& last) const
    {
        PairedCounts counts;
        for (auto a = first.begin(), b = last.begin(); a != first.end() && b != last.end();) {
            if (a->index != b->index) {
                a->index < b->index ? ++a : ++b;
                continue;
            }
            counts.add(a->has(c_.measure.event, c_.measure.within_cycles),
                       b->has(c_.measure.event, c_.measure.within_cycles));
            ++a;
            ++b;
        }
        return counts;
    }

    bool order(const std::vector<const Sample*>& group, const std::vector<Cell>& cells, Case& found) const
    {
        std::size_t compared = 0, right = 0;
        bool against = false;
        double widest = -1;
        for (const Cell& cell : cells) {
            std::vector<Estimate> e;
            for (const Sample* sample : group)
                e.push_back(estimate(*sample, cell.f, cell.p, c_.measure, level(cells.size() * group.size())));
            if (e.size() < 2 || std::any_of(e.begin(), e.end(), [](const Estimate& x) { return !x.known(); }))
                continue;
            if (of_onset() && all_beyond(e))
                continue;
            ++compared;
            const Sequence s = follow(e);
            right += c_.way == Criterion::Way::either ? s.along : s.ends > 0 && !s.against;
            // shown: the first pair that speaks against, else the ends that lie farthest apart
            const double a = e[s.first].value, b = e[s.last].value;
            const double apart =
                std::isinf(a) || std::isinf(b) ? 1 : std::fabs(a - b) / std::max({std::fabs(a), std::fabs(b), 1e-300});
            if (!against && (s.against || apart > widest)) {
                widest = apart;
                found.number = e[s.last];
                found.number_text = fmt::format("{}: {}; {}: {}{}", level_name(*group[s.first]), shown(e[s.first]),
                                                level_name(*group[s.last]), shown(e[s.last]), at(*group.front(), cell));
            }
            against = against || s.against;
        }
        if (compared == 0)
            return false;
        const std::size_t enough = c_.any || c_.way == Criterion::Way::either ? 1 : compared;
        found.finding = against ? Finding::fails : right >= enough ? Finding::holds : Finding::undecided;
        return true;
    }

    bool same(const std::vector<const Sample*>& group, const std::vector<Cell>& cells, Case& found) const
    {
        bool decided = true, equal = true;
        std::size_t compared = 0;
        for (const Cell& cell : cells) {
            std::vector<Mode> all;
            for (const Sample* sample : group) {
                const std::size_t f = std::min(cell.f, sample->frequency_hz.size() - 1);
                const std::size_t p = std::min(cell.p, sample->pga_m_s2.size() - 1);
                all.push_back(most_frequent(sample->cell(f, p), cells.size() * group.size()));
            }
            if (std::any_of(all.begin(), all.end(), [](const Mode& mode) {
                    return mode.share.realizations < fewest_moving || mode.event == Event::stood;
                }))
                continue;
            ++compared;
            std::string text;
            bool alike = true;
            for (std::size_t k = 0; k < all.size(); ++k) {
                decided = decided && all[k].certain;
                alike = alike && all[k].event == all.front().event;
                text += fmt::format("{}{}: {} {}", text.empty() ? "" : "; ", level_name(*group[k]),
                                    event_text(all[k].event), number_text({}, all[k].share));
            }
            if (compared == 1 || !alike) {
                found.number = all.front().share;
                found.number_text = text + at(*group.front(), cell);
            }
            equal = equal && alike;
            if (!equal)
                break;
        }
        found.finding = !decided ? Finding::undecided : equal ? Finding::holds : Finding::fails;
        return compared > 0;
    }

    struct Mode {
        Event event;
        Estimate share;
        bool certain;
    };

    Mode most_frequent(const std::vector<Observation>& cell, std::size_t cells) const
    {
        std::array<Estimate, modes.size()> share;
        std::size_t best = 0;
        for (std::size_t i = 0; i < modes.size(); ++i) {
            Measure measure = c_.measure;
            measure.event = modes[i];
            share[i] = probability(cell, measure, level(cells * modes.size()));
            if (share[i].value > share[best].value)
                best = i;
        }
        bool certain = share[best].known();
        for (std::size_t i = 0; i < modes.size(); ++i)
            certain = certain && (i == best || share[i].below(share[best]));
        return {modes[best], share[best], certain};
    }

    std::string level_name(const Sample& sample) const
    {
        const std::size_t i = axis_index(file_.axes, *c_.along);
        return file_.axes[i].levels[sample.levels[i]].name;
    }

    const ClaimFile& file_;
    const Test& test_;
    const Criterion& c_;
    double margin_;
};

} // namespace

std::vector<Case> judge(const ClaimFile& file, const Test& test, const std::vector<Sample>& samples, double margin)
{
    // groups of variants that differ in the compared axis alone; without one, each variant is a group
    const std::size_t along = test.criterion.along ? axis_index(file.axes, *test.criterion.along) : file.axes.size();
    std::vector<std::vector<const Sample*>> groups;
    for (const Sample& sample : samples) {
        if (sample.why_not || !picked(file.axes, sample.levels, test.only))
            continue;
        const auto is_of = [&](const std::vector<const Sample*>& group) {
            for (std::size_t i = 0; i < file.axes.size(); ++i)
                if (i != along && group.front()->levels[i] != sample.levels[i])
                    return false;
            return true;
        };
        const auto group = std::find_if(groups.begin(), groups.end(), is_of);
        if (along < file.axes.size() && group != groups.end())
            group->push_back(&sample);
        else
            groups.push_back({&sample});
    }

    const Judge judge(file, test, margin);
    std::vector<Case> cases;
    for (const auto& group : groups)
        if (along == file.axes.size() || group.size() > 1)
            for (std::size_t range = 0; range < test.ranges.size(); ++range)
                if (const std::optional<Case> one = judge.one(group, range))
                    cases.push_back(*one);
    return cases;
}

const char* to_string(Finding finding)
{
    return finding == Finding::holds ? "holds" : finding == Finding::fails ? "fails" : "undecided";
}

} // namespace stylobate::claims
