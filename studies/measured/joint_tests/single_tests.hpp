#pragma once
/// The estimators of each test; `estimates.cpp` chooses among them. Each has its equation, its error and what it is
/// blind to at the top of its file.

#include "studies/measured/joint_tests/estimates.hpp"

namespace stylobate {

struct TestEstimators {
    std::vector<Estimate> (*of)(const Specimen& specimen, std::span<const MeasuredRun> runs);
    std::vector<EstimatorName> names;
};

const TestEstimators& pull_estimators();
const TestEstimators& board_estimators();
const TestEstimators& tilt_estimators();
const TestEstimators& push_estimators();
const TestEstimators& drop_estimators();
const TestEstimators& slide_estimators();
const TestEstimators& rest_estimators();

} // namespace stylobate
