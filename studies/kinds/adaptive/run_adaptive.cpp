#include "studies/kinds/adaptive/run_adaptive.hpp"

#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/round.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

SurfaceTable table_of(AdaptiveAllocation& allocation, const ResultHeader& header, const SurfaceTrials& data)
{
    SurfaceTable table;
    table.frequency_hz = header.frequency_hz;
    table.pga_m_s2 = header.pga_m_s2;
    table.trials = data.trials;
    table.collapses = data.collapses;
    for (const CellEstimate& cell : allocation.estimate(data)) {
        table.probability.push_back(cell.probability);
        table.lower.push_back(cell.interval.lower);
        table.upper.push_back(cell.interval.upper);
        table.method.push_back(cell.method);
    }
    table.interval = fmt::format("adaptive {}", adaptive_level);
    table.half_width = allocation.looks().half_width();
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
    const AdaptiveLooks& looks = allocation.looks();
    progress.expected = 0;
    for (std::size_t cell = 0; cell < asked.size(); ++cell) {
        std::uint64_t n = asked[cell];
        if (!looks.narrow({table.lower[cell], table.upper[cell]}) && table.trials[cell] > 0) {
            const double share = static_cast<double>(table.collapses[cell]) / static_cast<double>(table.trials[cell]);
            const auto narrow_at = [&](std::uint64_t trials) {
                const auto collapses = std::llround(share * static_cast<double>(trials));
                return looks.narrow(looks.interval(trials, static_cast<std::uint64_t>(collapses)));
            };
            while (n < looks.trials().back() && !narrow_at(n))
                n = looks.after(n);
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

bool CellOutcomes::has(std::uint64_t index) const
{
    const auto& cell = state_.at(index / most_);
    return index % most_ < cell.size() && cell[index % most_];
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

AdaptiveRun run_adaptive(const LoadedStudy& loaded, const RunOptions& options, CellOutcomes& outcomes,
                         const std::function<void(const ResultRow&)>& sink, Observer& observer)
{
    const Study& study = loaded.study();
    const SurfaceSpec& surface = *study.surface;
    const ResultHeader header = loaded.result_header();
    AdaptiveAllocation allocation(*surface.adaptive, header.frequency_hz.size(), header.pga_m_s2.size(),
                                  study.realizations);
    AdaptiveRun run;
    run.progress.total = surface.adaptive->budget;
    run.progress.open_end = true;
    std::vector<std::uint64_t> before = allocation.asked();
    while (true) {
        const std::vector<std::uint64_t>& asked = allocation.next(outcomes.trials(before));
        std::vector<std::uint64_t> round;
        for (std::size_t cell = 0; cell < asked.size(); ++cell)
            for (std::uint64_t k = before[cell]; k < asked[cell]; ++k)
                round.push_back(cell * study.realizations + k);
        if (round.empty())
            break;
        if (!run_round(loaded, options, round, outcomes, sink, observer, run.progress))
            return run;
        before = asked;
        foretell(allocation, table_of(allocation, header, outcomes.trials(before)), before, surface.adaptive->budget,
                 run.progress);
    }
    run.progress.total = run.progress.done;
    run.progress.open_end = false;
    run.complete = true;
    run.table = table_of(allocation, header, outcomes.trials(before));
    return run;
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
    std::string text = wide == 0 ? fmt::format("every cell is known to ±{:.3g} (95 %)", table.half_width)
                                 : fmt::format("{} of {} cells are not known to ±{:.3g} (95 %), the worst to ±{:.3g}",
                                               wide, table.lower.size(), table.half_width, widest);
    text += fmt::format(" after {} rounds, {} of {} by borrowing from their neighbours", table.rounds, borrowed,
                        table.lower.size());
    if (wide == 0)
        text +=
            fmt::format("; with equally many realizations in each cell it would take {}, {:.1f} times as many", uniform,
                        static_cast<double>(uniform) / static_cast<double>(std::max<std::uint64_t>(all, 1)));
    return text;
}

} // namespace stylobate
