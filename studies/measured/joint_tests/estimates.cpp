#include "studies/measured/joint_tests/estimates.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/measured/joint_tests/single_tests.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

const TestEstimators* estimators_of(RunKind kind)
{
    switch (kind) {
    case RunKind::pull:
        return &pull_estimators();
    case RunKind::board:
        return &board_estimators();
    case RunKind::tilt:
        return &tilt_estimators();
    case RunKind::push:
        return &push_estimators();
    case RunKind::drop:
        return &drop_estimators();
    case RunKind::slide:
        return &slide_estimators();
    case RunKind::rest:
        return &rest_estimators();
    case RunKind::shake:
        break;
    }
    return nullptr;
}

double floor_of(const Estimate& estimate, const LaboratoryFloor& floor)
{
    const LaboratoryFloor& per = estimate.per_floor;
    return std::hypot(std::hypot(per.friction * floor.friction, per.geometry_m * floor.geometry_m),
                      std::hypot(per.force * floor.force, per.damping * floor.damping));
}

} // namespace

std::vector<Estimate> estimates(const Specimen& specimen, std::span<const MeasuredRun> runs,
                                const LaboratoryFloor& floor)
{
    if (runs.empty())
        return {};
    for (const MeasuredRun& run : runs)
        if (run.test != runs.front().test || run.joint != runs.front().joint)
            throw InputError("run " + run.name + " is another test, or on another joint, than run " +
                             runs.front().name + ".\n  Give the runs of one test on one joint together.");
    const TestEstimators* estimators = estimators_of(runs.front().test);
    if (!estimators || !runs.front().joint)
        return {};
    const int joint = *runs.front().joint;
    if (joint < 0 || joint >= static_cast<int>(specimen.joints.size()))
        throw InputError("run " + runs.front().name + " is a test of joint " + std::to_string(joint) +
                         ", the specimen has " + std::to_string(specimen.joints.size()) + ".\n  Correct the joint.");
    std::vector<Estimate> found = estimators->of(specimen, runs);
    std::erase_if(found, [](const Estimate& e) { return !std::isfinite(e.value) || !std::isfinite(e.sd); });
    for (Estimate& estimate : found) {
        estimate.joint = joint;
        estimate.floor_sd = floor_of(estimate, floor);
    }
    return found;
}

const std::vector<EstimatorName>& estimator_names(RunKind kind)
{
    static const std::vector<EstimatorName> none;
    const TestEstimators* estimators = estimators_of(kind);
    return estimators ? estimators->names : none;
}

} // namespace stylobate
