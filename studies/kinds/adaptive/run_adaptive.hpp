#pragma once
/// An adaptive surface: rounds of realizations until every cell's interval is narrow enough
/// (ensemble/estimators/surface/adaptive.hpp).

#include "ensemble/engine/executor.hpp"
#include "ensemble/estimators/surface/adaptive.hpp"
#include "io/store/result_store.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <functional>
#include <optional>
#include <string>

namespace stylobate {

/// What became of the realizations of each cell, in their order, as far as they have been run.
class CellOutcomes {
public:
    CellOutcomes(std::size_t frequencies, std::size_t pgas, std::uint64_t most)
        : rows_(frequencies), columns_(pgas), most_(most), state_(frequencies * pgas)
    {
    }
    /// @pre the row is the surface's
    void add(const ResultRow& row);
    bool has(std::uint64_t index) const;
    State state(std::uint64_t index) const { return *state_[index / most_][index % most_]; }
    /// The valid ones among the first so many of each cell (cells). @pre all of those have been added
    SurfaceTrials trials(const std::vector<std::uint64_t>& asked) const;

private:
    std::size_t rows_, columns_;
    std::uint64_t most_; ///< indices of a cell
    std::vector<std::vector<std::optional<State>>> state_;
};

struct AdaptiveRun {
    Progress progress;
    bool complete = false;
    std::optional<SurfaceTable> table; ///< once it is complete
};

/// Runs what is left. Rounds that have been run are gone through again, by the outcomes that are there: the next ones
/// are the same as without an interruption.
///
/// @param outcomes those that are there; the new ones are added
/// @param sink     takes the new rows
AdaptiveRun run_adaptive(const LoadedStudy& loaded, const RunOptions& options, CellOutcomes& outcomes,
                         const std::function<void(const ResultRow&)>& sink, Observer& observer);

/// Mean of the cells' probabilities, each cell with the same weight however many realizations it has, and its standard
/// error. (The share among all realizations leans to the cells that took more of them.)
struct SurfaceMean {
    double value = 0, error = 0;
};
SurfaceMean mean_of(const SurfaceTable& table);
/// The mean as the progress' share, and the interval of 1.96 standard errors.
void set_share(Progress& progress, const SurfaceMean& mean);

/// What was reached with how many realizations, as a sentence.
std::string describe_adaptive(const SurfaceTable& table);

} // namespace stylobate
