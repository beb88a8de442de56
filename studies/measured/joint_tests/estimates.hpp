#pragma once
/// Numbers that a test of one joint gives, each with the standard deviation of its measurement. They are made from
/// forces, angles and times alone: no contact law is in them. Their equations stand at the top of the file of each
/// test.
///
/// **Start here** to read a test; `procedures.hpp` to plan one.

#include "ensemble/model/campaign.hpp"

#include <span>
#include <string>
#include <vector>

namespace stylobate {

/// How well a laboratory repeats itself: 1 sigma between joints or days, beside the noise of the sensors.
struct LaboratoryFloor {
    double friction = 0.015;  ///< relative
    double geometry_m = 1e-4; ///< of a bearing's end, or of a centre of mass
    double force = 0.015;     ///< relative
    double damping = 0.05;    ///< relative, of the energy that a fall leaves
};

struct Estimate {
    std::string name; ///< "pull.friction", of `estimator_names`
    int joint = 0;
    double value = 0;
    double sd = 0;                            ///< of the measurement alone: noise and number of samples
    LaboratoryFloor per_floor = {0, 0, 0, 0}; ///< change of the value with each of the floor's numbers
    double floor_sd = 0;                      ///< by the floor that `estimates` was given; not in `sd`
};

struct EstimatorName {
    std::string name;
    std::string unit; ///< empty: a ratio, or the natural logarithm of one
    std::string what;
    std::string blind_to;        ///< causes that leave it as it is
    std::string depends_on = {}; ///< what it varies with: "speed", "path", "place", "time", "direction"; empty: nothing
    bool of_the_law = false;     ///< moved at all joints alike by stiffness and damping of the beds, and by no cause
};

/// The estimates of one test on one joint. What the runs do not give (nothing slid or turned, a collapse, gaps) is
/// left out; so an empty answer means that the test has to be done again.
/// @param runs all of one kind and joint, as `planned_runs` has them, in any order
/// @throws InputError where the runs are of several kinds or joints, or the specimen has no such joint
std::vector<Estimate> estimates(const Specimen& specimen, std::span<const MeasuredRun> runs,
                                const LaboratoryFloor& floor = {});

/// All estimates that a test can give; none for `shake`.
const std::vector<EstimatorName>& estimator_names(RunKind kind);

} // namespace stylobate
