#pragma once
/// The next test of a single joint: the one that lets the belief in what acts grow most per cost, among the tests that
/// the laboratory can do. The expectation is over estimates that the present belief predicts, with common random
/// numbers for all tests. The entropy of the belief (Lindley, "On a measure of the information provided by an
/// experiment", Annals of Mathematical Statistics 27 (1956) 986) is told beside it. It also falls where causes are
/// excluded that were hardly believed in.

#include "studies/measured/loop/sequence.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

/// A test that may be done.
struct TestOption {
    RunKind test = RunKind::pull;
    std::optional<int> joint;          ///< nullopt: at all joints, one after the other
    double cost = 1;                   ///< above 0, in any unit
    std::optional<std::string> cannot; ///< why the laboratory cannot do it; nullopt: it can
    friend bool operator==(const TestOption&, const TestOption&) = default;
};

/// What is expected of a test.
struct RatedTest {
    TestOption option;
    double entropy_fall = 0;             ///< of the belief, expected [nats]
    double belief_gain = 0;              ///< of what acts, expected, where something acts; times the belief in that
    double per_cost = 0;                 ///< of it
    std::optional<std::string> left_out; ///< why it is no choice; nullopt: it is one
};

struct ChoiceSettings {
    int draws = 256; ///< of the estimates of a test
    std::uint64_t seed = 1;
};

/// What the specimen may turn out to be, once a test is done: a model for each. A test tells of the law too: damping at
/// a joint hides among all laws, and shows among those that bounce as this specimen will be seen to. Empty: the present
/// model.
using Prospects = std::function<std::vector<SequenceModel>(const TestOption&)>;

/// Used columns of a test, in their order.
std::vector<Eigen::Index> columns_of(const Signatures& signatures, const TestOption& option);

/// The belief after estimates in certain columns, in addition to those seen.
struct ExpectedBelief {
    double entropy = 0; ///< [nats]
    double in_truth =
        0; ///< mean over what acts of the belief in its mechanism at its place; a healthy specimen counts 0
};

/// A pure function of its arguments.
ExpectedBelief expected_belief(const SequenceModel& model, std::span<const SeenEstimate> seen,
                               const std::vector<Eigen::Index>& columns, const ChoiceSettings& settings);

/// All options, the best first, those that are no choice last: the laboratory cannot do them, they give no estimate
/// in more than a quarter of the simulated specimens, no cause shows in them, or they are expected to tell
/// nothing.
std::vector<RatedTest> rated_tests(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                   const std::vector<TestOption>& options, const ChoiceSettings& settings = {},
                                   const Prospects& prospects = {});

/// The test to do next. After a doubtful result (`SequenceJudgement::doubtful`) it is among the repeat of the last test
/// and the tests in which the group of the suspected cause shows.
/// @param rated as of `rated_tests`   @return nothing where no test is a choice
std::optional<RatedTest> chosen_test(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                     const std::vector<RatedTest>& rated);

/// Tests to be done together, before any estimate is known: one after the other is added that lets the belief in what
/// acts grow most per cost, given the outcome of those before it. Their falls are those beside the ones before.
std::vector<RatedTest> planned_tests(const SequenceModel& model, const std::vector<TestOption>& options,
                                     std::size_t count, const ChoiceSettings& settings = {},
                                     const Prospects& prospects = {});

} // namespace stylobate
