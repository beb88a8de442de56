#pragma once
/// Tests of single joints, simulated by the kernel: a planned run performed on a specimen with drawn contacts, sizes
/// and causes, and seen by the cameras and the force gauge of the laboratory.
///
/// Many subjects go through the lanes of the registers together. What a subject is, is a pure function of (seed,
/// number), as that of a virtual campaign (`virtual_campaign.hpp`); the noise of a run depends on its name beside.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stylobate {

/// A specimen on which tests are simulated.
struct TestSubject {
    std::uint64_t number = 0;       ///< of the draws of its friction, widths and masses
    std::optional<HealthyLaw> law;  ///< of its contacts; nullopt: those of the study
    std::vector<SizedCause> causes; ///< that act; none: it is healthy
};

/// What sensors and hands do not know, where a planned run does not state it: 1 sigma.
struct TestSensors {
    double camera_m = 5e-5;
    double camera_rad = 1e-3;
    double force_n = 0.02;
    double gain = 0.005;     ///< of a force gauge, relative; one for each run
    double tilt_rad = 5e-4;  ///< of the inclinometer
    double level_rad = 1e-3; ///< how level a body hangs on its thread
};

struct SimulatedTests {
    std::vector<std::vector<MeasuredRun>> runs; ///< (subjects)(planned)
    SimulationCount cost;
    bool complete = false; ///< false: the observer stopped it
};

/// @param about   contacts of the study, and how long a step is; its structure is the specimen's
/// @param planned tests of joints without measurements (`MeasuredRun::joint`)
/// @throws InputError, naming the run, for what `joint_bench` refuses
SimulatedTests simulated_tests(const Specimen& specimen, const Study& about, std::span<const MeasuredRun> planned,
                               std::span<const TestSubject> subjects, std::uint64_t seed, const RunOptions& options,
                               Observer& observer, const TestSensors& sensors = {});

} // namespace stylobate
