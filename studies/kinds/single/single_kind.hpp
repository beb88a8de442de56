#pragma once
/// One structure under one shaking, or a few of them, followed one by one with their trajectories; and a realization of
/// any study that was run again.

#include "studies/kinds/kind.hpp"

#include <cstdint>
#include <string>

namespace stylobate {

/// Which trajectories a single study keeps, and how large they will be, before anything runs.
struct KeptTrajectories {
    std::uint64_t count = 0; ///< number of realizations, the first ones
    double each_mb = 0; ///< at most, of one [1e6 bytes]: until the end of the shaking and of what is watched after it
    double mb = 0;      ///< of all that are kept
    /// What was chosen and how to choose otherwise; nullopt where all are kept and small.
    std::optional<std::string> words;
};

/// Bytes of a trajectory in a results file: in a sample the time, the base and the pose of each block.
/// @param dimensions of the structure, 2 or 3
std::uint64_t trajectory_bytes(int dimensions, std::uint64_t samples, std::uint64_t blocks);

/// By `output.trajectories` and `output.most_mb`. Realizations differ in length; the longest of the first 32 stands for
/// all, and those that fall earlier take less.
/// @param file of the study, for the message
/// @throws InputError if the requested trajectories are larger than `output.most_mb`, with the estimate and what to set
KeptTrajectories plan_trajectories(const Experiment& experiment, const std::string& file);

class SingleKind : public Kind {
public:
    using Kind::Kind;

    static bool fits(const Study& study) { return study.kind == StudyKind::single; }
    std::optional<std::string> needs_processor() const override
    {
        return "is of kind \"single\", whose realizations are followed step by step on the processor";
    }
    std::optional<std::string> why_no_ranks() const override
    {
        return "is of kind \"single\", whose realizations are followed step by step in one process";
    }
    std::optional<std::string> prepare(const Experiment& experiment, const std::string& file) override
    {
        kept_ = plan_trajectories(experiment, file);
        return kept_.words;
    }
    std::uint64_t trajectories() const override { return kept_.count; }
    bool prepares_file_alone() const override { return true; }
    bool plan(Rounds& rounds) override { return rounds.trace(kept_.count); }
    /// A copy of a trial, run again, stands alone.
    bool is_trial(std::uint64_t index) const override { return header_.total == 1 || Kind::is_trial(index); }

private:
    KeptTrajectories kept_;
};

} // namespace stylobate
