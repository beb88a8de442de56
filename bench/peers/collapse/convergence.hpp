#pragma once
/// How a collapse probability converges with the step, of each contender against its own finest step, on the same
/// draws; and what a draw costs at the step at which it has converged.

#include "bench/peers/collapse/cell_contender.hpp"

#include <array>
#include <optional>

namespace stylobate::peers {

// Draws on several cores: in processes and not in threads, because not every engine may be used by several threads.

/// The draws begin .. end - 1, in equal parts in `processes` processes (1: in this one).
/// @pre no other thread runs
/// @throws std::runtime_error if a process ends without a result
Draws run_forked(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end,
                 int processes);

/// What a probability may be off its scheme's own limit.
inline constexpr std::array collapse_targets{0.05, 0.02};

struct Level {
    double step_s = 0;
    Draws draws;
    double probability() const;
    double rate() const; ///< realizations of 10 s per second of processor time; one that collapses counts by its time
};

/// A contender in a cell: the same draws at all of its levels.
struct CellRun {
    std::vector<Level> levels; ///< coarse to fine
    double spent_s = 0;        ///< of processor time
    std::size_t draws() const { return levels.empty() ? 0 : levels.front().draws.collapsed.size(); }
};

/// Difference of two probabilities from paired draws, with its standard error. Where no draw differs, the error is that
/// of one that does.
struct Difference {
    double value = 0, error = 0;
};

/// a less b, over the draws that both have.
/// @pre both have one at least
Difference paired_difference(const std::vector<char>& a, const std::vector<char>& b);

/// Against the finest level.
Difference level_error(const CellRun& run, std::size_t level);

/// Root mean square of the errors over cells, less what their standard errors make of it; 0 where that is more.
/// `bound` is what two standard errors of the mean square add to it.
struct PooledError {
    double value = 0, bound = 0;
};
PooledError pooled(const std::vector<Difference>& errors);

/// The coarsest level at which the errors pooled over all cells are within a target, and at all finer ones.
/// The two finest levels of each cell take no part: errors there are too small by a half and more if they go with the
/// step.
struct Converged {
    std::size_t level = 0;
    PooledError error;
    double rate = 0; ///< over all cells
    /// Whether the error is within the target even with two standard errors.
    bool resolved = false;
};
/// @param cells at least one
std::optional<Converged> converged(const std::vector<CellRun>& cells, double target);

struct CollapseOptions {
    double budget_s = 30;      ///< of processor time for a contender in a cell, about
    std::uint64_t draws = 512; ///< at most
    std::uint64_t batch = 32;  ///< draws that are run at a time, at all levels
    int processes = 1;
    double minutes = 1e9; ///< no work begins after so long by the clock
};

struct CollapseScan {
    CellContender contender;
    std::vector<CellRun> cells; ///< (cells)
};

/// The contender and cell that has had the least processor time is always next, so that what else the machine does
/// falls on all alike, and all have had about as much when the clock ends it. The first batch is run at ever finer
/// steps until the next one would take more than a third of the budget; further batches at these steps, as long as the
/// budget lasts.
/// @throws std::runtime_error if the clock leaves a contender without a step in a cell
/// @param said takes a line for each piece of work that is done
std::vector<CollapseScan> scan_collapses(const std::vector<CellContender>& contenders, const std::vector<Cell>& cells,
                                         const CollapseOptions& options,
                                         const std::function<void(const std::string&)>& said);

} // namespace stylobate::peers
