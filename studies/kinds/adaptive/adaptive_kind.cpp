#include "studies/kinds/adaptive/adaptive_kind.hpp"

#include "studies/kinds/limit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

SurfaceTable table_of(AdaptiveAllocation& allocation, const ResultHeader& header, const SurfaceTrials& data)
{
    SurfaceTable table;
    table.axes() = header;
    table.trials = data.trials;
    table.collapses = data.collapses;
    for (const CellEstimate& cell : allocation.estimate(data)) {
        table.probability.push_back(cell.probability);
        table.lower.push_back(cell.interval.lower);
        table.upper.push_back(cell.interval.upper);
        table.method.push_back(cell.method);
    }
    table.interval = fmt::format("adaptive {}", adaptive_level);
    table.half_width = allocation.analyses().half_width();
    table.rounds = allocation.rounds();
    return table;
}

/// What is known of a surface after a round: its mean, and how many realizations it will have taken. A cell that is too
/// wide is taken to go on with the share that it has until its own interval is narrow; what the neighbours will give is
/// not foreseen.
void foretell(AdaptiveAllocation& allocation, const SurfaceTable& table, const std::vector<std::uint64_t>& asked,
              std::uint64_t budget, Progress& progress)
{
    set_share(progress, mean_of(table));
    const InterimAnalyses& analyses = allocation.analyses();
    progress.expected = 0;
    for (std::size_t cell = 0; cell < asked.size(); ++cell) {
        std::uint64_t n = asked[cell];
        if (!analyses.narrow({table.lower[cell], table.upper[cell]}) && table.trials[cell] > 0) {
            const double share = static_cast<double>(table.collapses[cell]) / static_cast<double>(table.trials[cell]);
            const auto narrow_at = [&](std::uint64_t trials) {
                const auto collapses = std::llround(share * static_cast<double>(trials));
                return analyses.narrow(analyses.interval(trials, static_cast<std::uint64_t>(collapses)));
            };
            while (n < analyses.trials().back() && !narrow_at(n))
                n = analyses.after(n);
        }
        progress.expected += n;
    }
    progress.expected = std::min(progress.expected, budget);
}

} // namespace

void set_share(Progress& progress, const SurfaceMean& mean)
{
    progress.share = mean.value;
    progress.share_lower = std::max(0.0, mean.value - 1.96 * mean.error);
    progress.share_upper = std::min(1.0, mean.value + 1.96 * mean.error);
}

SurfaceMean mean_of(const SurfaceTable& table)
{
    SurfaceMean mean;
    double variance = 0;
    for (std::size_t cell = 0; cell < table.trials.size(); ++cell) {
        const auto n = static_cast<double>(table.trials[cell]);
        const double p = (static_cast<double>(table.collapses[cell]) + 0.5) / (n + 1); // Jeffreys' posterior
        mean.value += n > 0 ? table.probability[cell] : 0.5;
        variance += p * (1 - p) / (n + 2);
    }
    const auto cells = static_cast<double>(table.trials.size());
    mean.value /= cells;
    mean.error = std::sqrt(variance) / cells;
    return mean;
}

void CellOutcomes::add(const ResultRow& row)
{
    std::vector<std::optional<State>>& cell = state_.at(row.cell);
    const std::uint64_t k = row.index % most_;
    if (cell.size() <= k)
        cell.resize(k + 1);
    cell[k] = row.outcome.state;
}

SurfaceTrials CellOutcomes::trials(const std::vector<std::uint64_t>& asked) const
{
    SurfaceTrials data{rows_, columns_, {}, {}};
    for (std::size_t cell = 0; cell < asked.size(); ++cell) {
        const auto first = state_[cell].begin();
        const auto last = first + static_cast<std::ptrdiff_t>(asked[cell]);
        data.collapses.push_back(static_cast<std::uint64_t>(std::count(first, last, State::collapsed)));
        data.trials.push_back(asked[cell] - static_cast<std::uint64_t>(std::count(first, last, State::invalid)));
    }
    return data;
}

AdaptiveKind::AdaptiveKind(const Study& study, const ResultHeader& header)
    : SurfaceKind(study, header), outcomes_(header.rows().size(), header.pga_m_s2.size(), study.realizations)
{
}

bool AdaptiveKind::plan(Rounds& rounds)
{
    const AdaptiveSpec& spec = *study_.surface->adaptive;
    AdaptiveAllocation allocation(spec, header_.rows().size(), header_.pga_m_s2.size(), study_.realizations);
    rounds.progress.total = spec.budget;
    rounds.progress.open_end = true;
    std::vector<std::uint64_t> before = allocation.asked();
    while (true) {
        const std::vector<std::uint64_t>& asked = allocation.next(outcomes_.trials(before));
        std::vector<std::uint64_t> round;
        for (std::size_t cell = 0; cell < asked.size(); ++cell)
            for (std::uint64_t k = before[cell]; k < asked[cell]; ++k)
                round.push_back(cell * study_.realizations + k);
        if (round.empty())
            break;
        if (!rounds.run({.indices = round}))
            return false;
        before = asked;
        foretell(allocation, table_of(allocation, header_, outcomes_.trials(before)), before, spec.budget,
                 rounds.progress);
    }
    rounds.progress.total = rounds.progress.done;
    rounds.progress.open_end = false;
    table_ = table_of(allocation, header_, outcomes_.trials(before));
    return true;
}

void AdaptiveKind::share(Progress& progress) const
{
    set_share(progress, mean_of(*table_));
}

/// All cells have the same weight, however many realizations they have.
std::string AdaptiveKind::text() const
{
    const SurfaceMean mean = mean_of(*table_);
    std::string text =
        fmt::format("  {}\n  mean of the surface {:.3g} +- {:.2g} % collapsed (standard error; each cell "
                    "has the same weight)",
                    describe_adaptive(*table_), 100 * mean.value, 100 * mean.error);
    std::string list;
    for (const std::size_t block : first_fallen(counts()))
        list += fmt::format("{}{}: {}", list.empty() ? "" : ", ", header_.block_names[block], counts().first()[block]);
    if (!list.empty())
        text += fmt::format("\n  first block to fall, among the realizations that were run: {}", list);
    return text + "\n";
}

void AdaptiveKind::add_to(Json& json) const
{
    const SurfaceTable& table = *table_;
    double widest = 0;
    for (std::size_t cell = 0; cell < table.lower.size(); ++cell)
        widest = std::max(widest, (table.upper[cell] - table.lower[cell]) / 2);
    const SurfaceMean mean = mean_of(table);
    json.member(
        "adaptive",
        Json::object()
            .member("mean_probability", mean.value)
            .member("mean_standard_error", mean.error)
            .member("half_width", table.half_width)
            .member("widest", widest)
            .member("rounds", table.rounds)
            .member("borrowing_cells", static_cast<std::uint64_t>(std::count(table.method.begin(), table.method.end(),
                                                                             IntervalMethod::surface)))
            .member("uniform_realizations", table.lower.size() * uniform_trials(table.half_width, adaptive_level)));
}

std::string describe_adaptive(const SurfaceTable& table)
{
    std::uint64_t wide = 0;
    double widest = 0;
    for (std::size_t cell = 0; cell < table.lower.size(); ++cell) {
        const double half = (table.upper[cell] - table.lower[cell]) / 2;
        wide += half > table.half_width;
        widest = std::max(widest, half);
    }
    const auto borrowed = std::count(table.method.begin(), table.method.end(), IntervalMethod::surface);
    const std::uint64_t all = std::accumulate(table.trials.begin(), table.trials.end(), std::uint64_t{0});
    const std::uint64_t uniform = table.lower.size() * uniform_trials(table.half_width, adaptive_level);
    std::string text =
        wide == 0 ? fmt::format("every cell is within ±{:.3g} (95 %)", table.half_width)
                  : fmt::format("{} of {} cells are not within ±{:.3g} (95 %); the widest half width is ±{:.3g}", wide,
                                table.lower.size(), table.half_width, widest);
    text += fmt::format(" after {} rounds, {} of {} with pooled intervals", table.rounds, borrowed, table.lower.size());
    if (wide == 0)
        text += fmt::format("; equal numbers of realizations in each cell would need {}, {:.1f} times as many", uniform,
                            static_cast<double>(uniform) / static_cast<double>(std::max<std::uint64_t>(all, 1)));
    return text;
}

} // namespace stylobate
