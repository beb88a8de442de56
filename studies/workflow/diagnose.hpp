#pragma once
/// A diagnosis of a measured campaign, from its file to what the simulation gets wrong.

#include "studies/measured/diagnosis/pipeline.hpp"
#include "studies/workflow/workflow.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct DiagnosisRequest {
    std::string measured;
    std::vector<std::string> tests{}; ///< files with further tests of its joints, in the order in which they were done
    std::optional<Study> start{};     ///< contacts to begin with; none: a bed of stone
    std::string start_name = "study"; ///< for messages
    std::vector<std::string> settings{}; ///< of the start where none is given
    std::uint64_t nulls = 192;           ///< healthy campaigns that are simulated near the measured contact law
    std::uint64_t seed = 1;              ///< of what is drawn in them
    std::optional<std::filesystem::path> cache{};       ///< `DiagnosisOptions::cache`
    std::optional<std::filesystem::path> tests_cache{}; ///< `LoopOptions::cache`
    std::optional<std::filesystem::path> next_test{};   ///< file for the runs of the proposed test; nullopt: none
    bool plan = false;             ///< tests of single joints are proposed; shake runs are not needed
    std::uint64_t specimens = 128; ///< healthy ones that go through simulated tests of single joints; they do so for a
                                   ///< plan, and where the campaign has such tests
    std::function<void()> check_outputs{}; ///< called where nothing else is refused any more; may be empty
};

/// Collective, of all ranks of the machine; rank 0 has the diagnosis. The stages are notes.
/// @returns nothing if the observer has asked to stop
/// @throws InputError if the campaign cannot be read or diagnosed
std::optional<Diagnosis> diagnose_measured(const DiagnosisRequest& request, const Machine& machine,
                                           WorkObserver& observer);

} // namespace stylobate
