#include "bench/peers/collapse/convergence.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace stylobate::peers {

namespace {

constexpr double realization_s = 10;
constexpr std::size_t left_out = 2; ///< finest levels that are not judged

/// Draws of a batch at one level, appended to those that there are.
void add(Level& level, const Draws& draws)
{
    level.draws.collapsed.insert(level.draws.collapsed.end(), draws.collapsed.begin(), draws.collapsed.end());
    level.draws.simulated_s += draws.simulated_s;
    level.draws.processor_s += draws.processor_s;
}

/// What is left to do of one contender in one cell.
struct Work {
    std::size_t contender, cell;
    bool refining = true; ///< the first batch is not yet at its finest step
    bool over = false;
};

} // namespace

double Level::probability() const
{
    return static_cast<double>(std::accumulate(draws.collapsed.begin(), draws.collapsed.end(), 0)) /
           static_cast<double>(draws.collapsed.size());
}

double Level::rate() const
{
    return draws.simulated_s / realization_s / draws.processor_s;
}

Difference paired_difference(const std::vector<char>& a, const std::vector<char>& b)
{
    const std::size_t n = std::min(a.size(), b.size());
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double d = a[i] - b[i];
        sum += d;
        squares += d * d;
    }
    const double count = static_cast<double>(n), mean = sum / count;
    return {mean,
            squares == 0 ? 1 / count : std::sqrt(std::max(squares / count - mean * mean, 1 / count / count) / count)};
}

Difference level_error(const CellRun& run, std::size_t level)
{
    return paired_difference(run.levels[level].draws.collapsed, run.levels.back().draws.collapsed);
}

PooledError pooled(const std::vector<Difference>& errors)
{
    double square = 0, variance = 0;
    const double n = static_cast<double>(errors.size());
    for (const Difference& e : errors) {
        square += (e.value * e.value - e.error * e.error) / n;
        // of a square of mean m and standard deviation s: 4 m2 s2 + 2 s4, m2 being estimated by value2 - s2
        const double s2 = e.error * e.error, m2 = std::max(0.0, e.value * e.value - s2);
        variance += (4 * m2 * s2 + 2 * s2 * s2) / (n * n);
    }
    return {std::sqrt(std::max(0.0, square)), std::sqrt(std::max(0.0, square + 2 * std::sqrt(variance)))};
}

std::optional<Converged> converged(const std::vector<CellRun>& cells, double target)
{
    std::size_t levels = cells.front().levels.size();
    for (const CellRun& run : cells)
        levels = std::min(levels, run.levels.size());
    std::optional<Converged> found;
    for (std::size_t level = levels > left_out ? levels - left_out : 0; level-- > 0;) {
        std::vector<Difference> errors;
        double simulated_s = 0, processor_s = 0;
        for (const CellRun& run : cells) {
            errors.push_back(level_error(run, level));
            simulated_s += run.levels[level].draws.simulated_s;
            processor_s += run.levels[level].draws.processor_s;
        }
        const PooledError error = pooled(errors);
        if (error.value > target)
            break;
        found = {level, error, simulated_s / realization_s / processor_s, error.bound <= target};
    }
    return found;
}

std::vector<CollapseScan> scan_collapses(const std::vector<CellContender>& contenders, const std::vector<Cell>& cells,
                                         const CollapseOptions& options,
                                         const std::function<void(const std::string&)>& said)
{
    const auto began = std::chrono::steady_clock::now();
    const auto late = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() > 60 * options.minutes;
    };
    std::vector<CollapseScan> scans;
    std::vector<Work> works;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        scans.push_back({contenders[i], std::vector<CellRun>(cells.size())});
        for (std::size_t k = 0; k < cells.size(); ++k)
            works.push_back({i, k});
    }
    const auto run = [&](const Work& work, std::size_t level) {
        CellRun& cell = scans[work.contender].cells[work.cell];
        const std::uint64_t begin = level < cell.levels.size() ? cell.levels[level].draws.collapsed.size() : 0;
        const Draws draws = run_forked(contenders[work.contender], cells[work.cell], static_cast<int>(level), begin,
                                       std::min(begin + options.batch, options.draws), options.processes);
        if (level == cell.levels.size())
            cell.levels.push_back({contenders[work.contender].step_s(cells[work.cell], static_cast<int>(level)), {}});
        add(cell.levels[level], draws);
        cell.spent_s += draws.processor_s;
        said(fmt::format("{} {}, {}: step {:.3g} s, {} draws, {:.3f}, {:.3g} s", contenders[work.contender].engine,
                         contenders[work.contender].setting, cells[work.cell].name, cell.levels[level].step_s,
                         cell.levels[level].draws.collapsed.size(), cell.levels[level].probability(),
                         cell.levels[level].draws.processor_s));
    };
    const auto spent = [&](const Work& work) { return scans[work.contender].cells[work.cell].spent_s; };
    while (!late()) {
        Work* least = nullptr; // that has had the least time and is not over
        for (Work& work : works)
            if (!work.over && (least == nullptr || spent(work) < spent(*least)))
                least = &work;
        if (least == nullptr)
            break;
        CellRun& cell = scans[least->contender].cells[least->cell];
        if (least->refining) {
            run(*least, cell.levels.size());
            least->refining = static_cast<int>(cell.levels.size()) < contenders[least->contender].levels &&
                              2 * cell.levels.back().draws.processor_s < options.budget_s / 3;
            continue;
        }
        const double batch_s = cell.spent_s * static_cast<double>(options.batch) / static_cast<double>(cell.draws());
        least->over = cell.draws() >= options.draws || cell.spent_s + batch_s > options.budget_s;
        for (std::size_t level = 0; !least->over && level < cell.levels.size(); ++level)
            run(*least, level);
    }
    for (const CollapseScan& scan : scans) // what the clock has left without a step
        for (const CellRun& cell : scan.cells)
            if (cell.levels.empty())
                throw std::runtime_error("the time was too short for a first step in every cell");
    return scans;
}

namespace {

struct Child {
    pid_t id = -1;
    int from = -1; ///< where it writes its draws
    std::uint64_t draws = 0;
};

bool write_all(int to, const void* data, std::size_t bytes)
{
    const char* at = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t done = ::write(to, at, bytes);
        if (done <= 0)
            return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

bool read_all(int from, void* data, std::size_t bytes)
{
    char* at = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t done = ::read(from, at, bytes);
        if (done <= 0)
            return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

Child start(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end)
{
    int ends[2];
    if (::pipe(ends) != 0)
        throw std::runtime_error("no pipe to a process could be made");
    std::fflush(nullptr); // or the child would print it again
    const pid_t id = ::fork();
    if (id < 0)
        throw std::runtime_error("no process could be started");
    if (id == 0) {
        bool sent = false;
        try {
            const Draws draws = contender.run(cell, level, begin, end);
            const std::array<double, 2> times{draws.simulated_s, draws.processor_s};
            sent = write_all(ends[1], times.data(), sizeof times) &&
                   write_all(ends[1], draws.collapsed.data(), draws.collapsed.size());
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
        ::_exit(sent ? 0 : 1);
    }
    ::close(ends[1]);
    return {id, ends[0], end - begin};
}

} // namespace

Draws run_forked(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end,
                 int processes)
{
    if (processes == 1)
        return contender.run(cell, level, begin, end);
    std::vector<Child> children;
    const auto parts = static_cast<std::uint64_t>(processes);
    for (std::uint64_t part = 0; part < parts; ++part) {
        const std::uint64_t first = begin + (end - begin) * part / parts,
                            last = begin + (end - begin) * (part + 1) / parts;
        if (first < last)
            children.push_back(start(contender, cell, level, first, last));
    }
    Draws all;
    bool whole = true;
    for (const Child& child : children) {
        std::array<double, 2> times{};
        std::vector<char> collapsed(child.draws);
        whole = read_all(child.from, times.data(), sizeof times) &&
                read_all(child.from, collapsed.data(), collapsed.size()) && whole;
        ::close(child.from);
        ::waitpid(child.id, nullptr, 0);
        all.simulated_s += times[0];
        all.processor_s += times[1];
        all.collapsed.insert(all.collapsed.end(), collapsed.begin(), collapsed.end());
    }
    if (!whole)
        throw std::runtime_error(contender.engine + " (" + contender.setting +
                                 ") gave no result in a process of its own");
    return all;
}

} // namespace stylobate::peers
