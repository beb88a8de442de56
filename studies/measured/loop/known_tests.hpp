#pragma once
/// What the tests of a specimen have given so far, and the model that follows: of the simulated healthy specimens those
/// count whose contact law is like the measured one, as far as the tests have shown it.

#include "studies/measured/joint_tests/estimates.hpp"
#include "studies/measured/loop/sequence.hpp"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace stylobate {

class KnownTests {
public:
    /// @param samples, prior are referred to, and must outlive this
    KnownTests(const TestSamples& samples, const SequencePrior& prior) : samples_(samples), prior_(prior) {}

    void add(Eigen::Index column, const Estimate& estimate);
    /// A test was done at a joint, whatever it gave: what it did not give is not expected of its repeat.
    void done(RunKind test, int joint) { done_.emplace_back(test, joint); }
    bool was_done(RunKind test) const;
    std::span<const SeenEstimate> seen() const { return seen_; }

    SequenceModel model() const { return model_with(values()); }
    /// What the specimen may turn out to be, once a test is done: models of specimens like some of those that are like
    /// it now, at the middles of quarters of what the test shows of their law. Empty: it shows nothing of that.
    std::vector<SequenceModel> models_after(RunKind test) const;

private:
    using Values = std::vector<std::pair<Eigen::Index, double>>;
    Values values() const;
    SequenceModel model_with(const Values& values) const;
    void add_own_scatter(Signatures& signatures) const;

    const TestSamples& samples_;
    const SequencePrior& prior_;
    std::vector<SeenEstimate> seen_;
    std::map<Eigen::Index, double> own_sd_; ///< the largest error that an estimate in a column says of itself
    std::vector<std::pair<RunKind, int>> done_;
};

} // namespace stylobate
