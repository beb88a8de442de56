#include "studies/check/run_cost.hpp"

#include "ensemble/experiment.hpp"
#include "ensemble/model/time_counts.hpp"
#include "ensemble/replicas/replicas.hpp"
#include "io/store/result_layout.hpp"
#include "studies/check/study_trial.hpp"
#include "studies/kinds/single/single_kind.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>

namespace stylobate {

namespace {

/// What a results file has beside its rows [bytes], measured on those of the ready studies: groups, attributes and
/// names, with cells and without; of each data set, each trajectory.
constexpr double frame_bytes = 20e3, cells_frame_bytes = 37e3, column_bytes = 500, trajectory_frame_bytes = 10e3;
/// Counts instead of rows: the frame, and each time of collapse with its count.
constexpr double counts_frame_bytes = 37e3, time_bytes = 16;
/// What a result costs while its file is written and finished: processor time over bytes [s], measured; of rows, of
/// trajectories.
constexpr double row_s_per_byte = 1.6e-8, trajectory_s_per_byte = 3.5e-8;

/// Of the trial; without one, all.
double collapsed_share(const Trial* trial)
{
    if (!trial || trial->count() == 0)
        return 1;
    return static_cast<double>(trial->shares().collapsed) / static_cast<double>(trial->count());
}

double file_bytes(const Study& study, const ResultHeader& header, const Kind& kind, const Trial* trial)
{
    const auto text = static_cast<double>(header.study_toml.size());
    const auto cells = static_cast<double>(study.cells());
    if (!header.has_rows()) {
        const auto numbers = static_cast<double>(header.limit_states.size() + header.block_names.size() + 16);
        constexpr double octaves = 4; // of times, each rounded to one of so many (`TimeCounts`)
        const double times = std::min(octaves * static_cast<double>(TimeCounts::most_exact),
                                      collapsed_share(trial) * static_cast<double>(header.total));
        return counts_frame_bytes + text + 8 * numbers * cells +
               time_bytes * times * (study.outcome.follow == Follow::rest ? 2 : 1);
    }
    const ResultLayout layout(header);
    return (study.cells() > 1 ? cells_frame_bytes : frame_bytes) + text +
           column_bytes * static_cast<double>(layout.columns().size()) +
           static_cast<double>(layout.row_bytes()) * static_cast<double>(header.total) + kind.table_bytes();
}

/// The most that realizations can cost which are chosen by what others did, over the mean of the trial. Of rare events
/// the longest of the trial: any may be chosen. Of an adaptive surface the dearest cells, each as often as it can be
/// asked for, until the budget is spent.
double dearest_over_mean(const Study& study, const TrialPart& part, std::uint64_t budget)
{
    double sum = 0, most = 0;
    std::vector<double> of_cell(study.cells()), runs(study.cells());
    for (const TrialRealization& r : part.run) {
        const auto steps = static_cast<double>(r.steps);
        sum += steps;
        most = std::max(most, steps);
        of_cell[r.cell] += steps;
        ++runs[r.cell];
    }
    const double mean = sum / static_cast<double>(part.run.size());
    if (!study.surface || mean == 0)
        return mean > 0 ? most / mean : 1;
    // what the trial has not met is like the others of its row, whose frequency mostly decides how long a realization
    // lasts
    const auto columns = static_cast<std::ptrdiff_t>(study.surface->pga_m_s2.count);
    for (auto row = of_cell.begin(), n = runs.begin(); row != of_cell.end(); row += columns, n += columns) {
        const double steps = std::accumulate(row, row + columns, 0.0), all = std::accumulate(n, n + columns, 0.0);
        for (std::ptrdiff_t k = 0; k < columns; ++k)
            row[k] = n[k] > 0 ? row[k] / n[k] : all > 0 ? steps / all : most;
    }
    std::sort(of_cell.rbegin(), of_cell.rend());
    auto left = static_cast<double>(budget);
    double spent = 0;
    for (std::size_t cell = 0; cell < of_cell.size() && left > 0; ++cell) {
        const double here = std::min(left, static_cast<double>(study.realizations));
        spent += here * of_cell[cell];
        left -= here;
    }
    return spent / (mean * static_cast<double>(budget));
}

/// Samples of a trajectory, in the mean over the trial; without one, of the longest.
double samples_of(const Study& study, const Trial* trial, double longest_s)
{
    double seconds = 0, runs = 0;
    if (trial)
        for (const TrialPart& part : trial->parts)
            for (const TrialRealization& r : part.run) {
                seconds += r.end_s;
                ++runs;
            }
    return std::ceil((runs > 0 ? seconds / runs : longest_s) * study.output.trajectory_rate_hz) + 1;
}

/// Replicas that are followed beside their originals, once more.
double followed_again(const Study& study)
{
    return static_cast<double>(separated_originals(study) * (1 + moves_of(study)));
}

} // namespace

RunSize size_of_run(const LoadedStudy& loaded, const Kind& kind, const Trial* trial)
{
    const Study& study = loaded.study();
    const ResultHeader header = loaded.result_header();
    RunSize size;
    size.realizations = study.design().most;
    size.at_most = header.selected;
    size.cells = study.cells();
    size.blocks = static_cast<int>(header.block_names.size());
    for (const PlacedBlock& block : lay_out(study.structure).blocks)
        size.free_blocks += !block.fixed;
    constexpr std::uint64_t looked_at = 64;
    TrialOrder order(study, 0, study.design().drawn_alone(study.originals()));
    size.step_s.low = size.longest_steps.low = std::numeric_limits<double>::infinity();
    double sum = 0, longest = 0;
    const std::vector<std::uint64_t> sample = order.next(looked_at);
    for (const std::uint64_t index : sample) {
        const Realization r = loaded.sampler().realization(index);
        const double end_s = longest_s(loaded.experiment(), r), steps = end_s / r.step_s;
        longest = std::max(longest, end_s);
        sum += steps;
        size.step_s = {std::min(size.step_s.low, r.step_s), std::max(size.step_s.high, r.step_s)};
        size.longest_steps = {std::min(size.longest_steps.low, steps), std::max(size.longest_steps.high, steps)};
    }
    size.most_block_steps = sum / static_cast<double>(sample.size()) * static_cast<double>(size.realizations) *
                            static_cast<double>(size.free_blocks);
    size.trajectories = kind.trajectories();
    const auto trajectories = static_cast<double>(size.trajectories);
    size.trajectory_bytes =
        trajectories * samples_of(study, trial, longest) *
        static_cast<double>(trajectory_bytes(study.structure.dimensions, 1, static_cast<std::uint64_t>(size.blocks)));
    size.file_bytes =
        file_bytes(study, header, kind, trial) + size.trajectory_bytes + trajectory_frame_bytes * trajectories;
    if (header.has_rows())
        size.row_bytes = kind.row_memory(sizeof(Outcome) + 8 * static_cast<double>(size.blocks) + 32);
    return size;
}

RunTime time_of_run(const LoadedStudy& loaded, const Trial& trial, const RunSize& size, double drawing_s)
{
    const Study& study = loaded.study();
    RunTime time;
    time.threads = trial.threads;
    time.at_most = size.at_most;
    time.steps.low = std::numeric_limits<double>::infinity();
    double variance = 0, mean_steps = 0;
    for (const TrialPart& part : trial.parts) {
        const double n = size.at_most ? static_cast<double>(size.realizations) : static_cast<double>(part.total);
        time.processor_s += n * part.processor_s;
        variance += n * part.processor_sd * n * part.processor_sd;
        double steps = 0;
        for (const TrialRealization& r : part.run) {
            steps += static_cast<double>(r.steps);
            time.steps.low = std::min(time.steps.low, static_cast<double>(r.steps));
            time.steps.high = std::max(time.steps.high, static_cast<double>(r.steps));
        }
        mean_steps = steps / static_cast<double>(std::max<std::size_t>(part.run.size(), 1));
        time.block_steps += n * mean_steps * size.free_blocks;
    }
    if (!trial.parts.empty())
        time.processor_s += followed_again(study) * trial.parts.front().processor_s;
    // the last realizations of every thread leave lanes empty: half a realization in a full register of each
    double drain = 0;
    if (!trial.whole())
        for (const TrialPart& part : trial.parts)
            drain += part.processor_s * 0.5 * static_cast<double>(trial.lanes);
    time.processor_s += drawing_s + drain + (size.file_bytes - size.trajectory_bytes) * row_s_per_byte +
                        size.trajectory_bytes * trajectory_s_per_byte;
    const double sd = std::sqrt(variance);
    // what the scatter of the trial leaves open, and what a machine changes from one minute to the next
    constexpr double slower = 0.25;
    time.processor_range_s = {std::max(0.0, (time.processor_s - 2 * sd) * (1 - slower)),
                              (time.processor_s + 2 * sd) * (1 + slower) + drain};
    if (size.at_most && !trial.parts.empty())
        time.processor_range_s = {0, time.processor_range_s.high *
                                         dearest_over_mean(study, trial.parts.front(), size.realizations)};
    return time;
}

RunTime longest_time_of_run(const Trial& trial, const RunSize& size)
{
    RunTime time;
    time.at_most = true;
    // one realization is stepped by one thread
    time.threads =
        static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(trial.threads), size.realizations));
    time.steps = size.longest_steps;
    time.block_steps = size.most_block_steps;
    time.processor_s = trial.lane_s_per_step * size.most_block_steps / std::max(size.free_blocks, 1);
    time.processor_range_s = {0, time.processor_s};
    return time;
}

double memory_of_run(const Study& study, const RunSize& size, double peak_bytes)
{
    constexpr double writer = 6e6; // the library of the files, which a check does not use
    const double counts = study.kept == KeptRealizations::none ? 4.5e6 : 0; // times of collapse, and the file anew
    const double rows = size.row_bytes * static_cast<double>(size.realizations) + counts;
    // what that library keeps of data sets: measured from 100 trajectories to 6400, short ones and long ones
    constexpr double each = 33e3, cached = 165e3, cache = 50e6;
    const auto n = static_cast<double>(size.trajectories);
    const auto followed = static_cast<double>(separated_originals(study));
    const double pairs = followed > 0 ? 6e6 + 7.6e3 * followed : 0; // measured with 0, 512 and 2048 of them
    return peak_bytes + writer + rows + pairs + each * n + std::min(cache, cached * n);
}

double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double peak_memory_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * static_cast<double>(usage.ru_maxrss);
}

} // namespace stylobate
