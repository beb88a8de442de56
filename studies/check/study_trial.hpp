#pragma once
/// A trial of a study: a fair sample of its realizations, run to their ends with the threads and the instruction set
/// that the run would use, for what the run takes and for what it would show.

#include "ensemble/experiment.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace stylobate {

/// A realization that the trial has run.
struct TrialRealization {
    std::uint64_t index = 0;
    std::uint64_t cell = 0; ///< `Study::cell`
    State state = State::stood;
    std::uint64_t steps = 0;
    double step_s = 0;
    double end_s = 0; ///< simulated
    /// When its time was over it had not come to rest, and had at least the energy that topples the weakest part of it
    /// (`Scales::barrier_j`): it may still fall.
    bool cut_off = false;
    bool at_rest = false; ///< `Outcome::at_rest`
};

/// Realizations that are stepped together: all of a study, or of one with twins a range of them.
struct TrialPart {
    std::uint64_t total = 0; ///< realizations of the part
    std::vector<TrialRealization> run;
    /// Of one realization in full registers [s]: the processor time of the trial times the share of its lanes that were
    /// busy, over the number of realizations. The last realizations of a short run leave lanes empty, of a long one
    /// they are few.
    double processor_s = 0;
    double processor_sd = 0; ///< its standard error, by the scatter of the steps
};

/// Of the realizations that were not set aside, and of those that fell.
struct TrialShares {
    std::uint64_t valid = 0, collapsed = 0;
};
TrialShares shares_of(const TrialPart& part);

struct Trial {
    std::vector<TrialPart> parts;
    double seconds = 0;     ///< elapsed
    double processor_s = 0; ///< of all threads
    int threads = 1;
    std::uint64_t lanes = 1;    ///< of all threads
    bool unfinished = false;    ///< not even the first realizations of every part have ended in time
    double lane_s_per_step = 0; ///< of an unfinished one: processor time of a step of one realization [s]
    std::uint64_t count() const;
    TrialShares shares() const;
    /// Whether it has run all that the study has.
    bool whole() const;
    /// What the threads were given of the processor; below 1 where others use the machine.
    double share_of_processor() const;
};

/// Which realizations it runs does not depend on the machine, only how many: those of `TrialOrder`, from the first one
/// on, as many as end in the time. Of a rare event those are independent draws, its first ones.
///
/// @param seconds it is to take; with realizations so long that the first ones do not end within four times that, it
///                ends unfinished
/// @param trajectories so many of a single study are recorded; the others are followed too
/// @return what had been run when the observer asked to stop
Trial try_study(const Experiment& experiment, const RunOptions& options, double seconds, std::uint64_t trajectories,
                Observer& observer);

/// Which realizations a trial runs: an order of all of them, always the same, of which every beginning is spread evenly
/// over the study, however short it is. (`RunOrder` is fair in whole blocks only, which a trial of a slow study does
/// not reach.)
///
/// Point n of the order is the n-th point of an additive recurrence over rows, columns and the realizations of a cell,
/// frac(1/2 + n / g), frac(1/2 + n / g^2), ... with g the real root of g^(d+1) = g + 1, d the number of these that are
/// more than one: the golden ratio for one, the plastic number for two (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018; for one dimension Knuth, "The Art of Computer Programming", volume 3, section 6.4). A
/// realization that has been taken is replaced by the next one of its cell, in a full cell by one of the next cell.
class TrialOrder {
public:
    /// @param begin, end indices: all realizations of the study, or a range of whole cells of it (`ReplicaRange`)
    TrialOrder(const Study& study, std::uint64_t begin, std::uint64_t end);

    /// The next ones, ascending; fewer where fewer are left.
    std::vector<std::uint64_t> next(std::uint64_t count);
    std::uint64_t taken() const { return taken_.size(); }
    std::uint64_t total() const { return end_ - begin_; }

private:
    std::uint64_t begin_, end_;
    std::array<std::uint64_t, 3> counts_{1, 1, 1}; ///< rows, columns, realizations of a cell
    std::array<double, 3> step_{0, 0, 0};
    std::uint64_t point_ = 0;
    std::unordered_set<std::uint64_t> taken_;
};

} // namespace stylobate
