#pragma once
/// One structure under one shaking, or a few of them, followed one by one with their trajectories; and a realization of
/// any study that was run again.

#include "studies/kinds/kind.hpp"
#include "studies/kinds/single/kept_trajectories.hpp"

namespace stylobate {

class SingleKind : public Kind {
public:
    using Kind::Kind;

    static bool fits(const Study& study) { return study.kind == StudyKind::single; }
    std::string needs_processor() const override
    {
        return "is of kind \"single\", whose realizations are followed step by step on the processor";
    }
    std::string why_no_ranks() const override
    {
        return "is of kind \"single\", whose realizations are followed step by step in one process";
    }
    std::string prepare(const Experiment& experiment, const std::string& file) override
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
