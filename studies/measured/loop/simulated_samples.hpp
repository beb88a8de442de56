#pragma once
/// The tables of `signatures.hpp` from the kernel: specimens with widely varied healthy laws, and specimens in which
/// one cause acts, go through all tests, and their estimates are made as those of measured runs.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"
#include "studies/measured/joint_tests/estimates.hpp"
#include "studies/measured/loop/tested_causes.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace stylobate {

/// The runs of one test on one joint, planned or as a laboratory did them.
struct PlannedTest {
    RunKind kind = RunKind::pull;
    int joint = 0;
    std::vector<MeasuredRun> runs; ///< without measurements
};

struct SamplePlan {
    std::uint64_t seed = 1;
    std::uint64_t healthy = 128;      ///< specimens
    std::uint64_t of_each_cause = 16; ///< with the laws and the scatter of the first healthy ones
    LawFamily family;
    LaboratoryFloor floor;
};

struct SimulatedSamples {
    TestSamples samples;
    SimulationCount cost;
    std::uint64_t cached = 0; ///< rows that the file had
    bool complete = false;    ///< false: the observer stopped it
};

/// All tests of these kinds at these joints, as the laboratory would do them.
std::vector<PlannedTest> planned_tests_of(const Specimen& specimen, const Laboratory& laboratory,
                                          const std::vector<RunKind>& kinds, const std::vector<int>& joints);

/// @param about    contacts about which healthy laws are drawn
/// @param cache    file that keeps the rows, so that an interrupted call continues; nullopt: none
/// @param progress called with (rows done, rows in all)
/// @throws InputError if there is a file that keeps something else
SimulatedSamples simulated_samples(const Specimen& specimen, const Study& about, const std::vector<PlannedTest>& tests,
                                   const std::vector<LoopCause>& causes, const SamplePlan& plan,
                                   const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer);

} // namespace stylobate
