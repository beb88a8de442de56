#pragma once
/// The laboratory in the loop: from the tests of single joints that a campaign has, and what the first diagnosis
/// believes, to a story (`test_story.hpp`) and the test to do next.
///
/// **Start here.**

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/loop/sequence.hpp"
#include "studies/measured/loop/simulated_samples.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace stylobate {

struct LoopOptions {
    SamplePlan plan;
    std::optional<std::filesystem::path> cache; ///< of the simulated tests; nullopt: none is kept
    std::size_t planned = 1;                    ///< tests that are proposed: 1, or 3 of a plan without data
    RunOptions run;
    /// Told of the simulated tests: rows done, rows in all; may be empty.
    std::function<void(std::uint64_t, std::uint64_t)> progress{};
};

/// What the first diagnosis believes of joints and blocks: a prior, and no evidence. Its probabilities, where it has
/// some; else its gains, which are no likelihood of independent data and count by half.
std::vector<PriorShare> prior_shares(const Diagnosis& diagnosis);

/// @param contacts about which healthy laws are drawn (the study of the first diagnosis)
/// @param shares   as `prior_shares`
/// @return nothing if the observer stopped it: the rows so far are kept in the cache
/// @throws InputError if no joint of the specimen can be tested by itself
std::optional<TestStory> laboratory_loop(const Campaign& campaign, const Study& contacts,
                                         const std::vector<PriorShare>& shares, const LoopOptions& options,
                                         Observer& observer);

/// The specimen with the runs of tests ("pull", ...) at every joint that can be tested by itself, without measurements:
/// to be followed by a table, or to be performed by a virtual laboratory.
Campaign planned_campaign(const Campaign& campaign, const std::vector<std::string>& tests);

/// What the laboratory does in a test, a line each: what to clamp, remove and tape, strokes, speeds, angles, repeats.
std::vector<std::string> sheet_of(const Specimen& specimen, const Laboratory& laboratory, RunKind kind,
                                  const std::vector<int>& joints);

} // namespace stylobate
