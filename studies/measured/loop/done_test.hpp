#pragma once
/// A test that was done, by the names of its estimators: what a sequence keeps, whatever the columns of its signatures
/// are.

#include "studies/measured/loop/sequence.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct NamedEstimate {
    std::string name; ///< of the estimator
    int joint = 0;
    double value = 0; ///< NaN: the test gave none
    friend bool operator==(const NamedEstimate&, const NamedEstimate&) = default;
};

struct DoneTest {
    RunKind test = RunKind::pull;
    std::optional<int> joint; ///< nullopt: at all joints
    std::vector<NamedEstimate> estimates;
    friend bool operator==(const DoneTest&, const DoneTest&) = default;
};

/// The finite estimates in the columns of the signatures.
/// @throws InputError for an estimate that has no column
std::vector<SeenEstimate> seen_estimates(const Signatures& signatures, const DoneTest& test);
/// The same of several, in their order.
std::vector<SeenEstimate> seen_estimates(const Signatures& signatures, const std::vector<DoneTest>& tests);

/// "push at joint 2", "pull at all joints"
std::string test_words(RunKind test, const std::optional<int>& joint);

} // namespace stylobate
