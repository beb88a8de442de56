#pragma once
/// A diagnosis from beginning to end. `docs/diagnosis.md` explains the stages; each is a file of this folder.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"
#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace stylobate {

struct DiagnosisOptions {
    std::uint64_t seed = 1;
    /// Simulated campaigns; no nulls: none are simulated, and only direct tests of base, sensors and rest name a cause.
    EnsemblePlan plan;
    std::optional<std::filesystem::path> cache; ///< of the simulated campaigns; nullopt: none is kept
    DecisionRule rule;
    RunOptions run;
    /// Told of the simulated campaigns, in words and counts; may be empty.
    std::function<void(const std::string& line, const Progress&)> campaigns{};
};

/// Told what is being done, one line at a time.
using Tell = std::function<void(const std::string&)>;

/// @throws InputError if the file of the cache keeps something else. `diagnose` does so too, later than some callers
/// want to know it
void check_cache(const DiagnosisOptions& options);

/// @param study contacts to begin with; its structure is replaced by the specimen's
/// @return nothing if the observer stopped it: the simulated campaigns are kept in the cache, and the same call
/// continues
/// @throws InputError if the campaign cannot be diagnosed at all
std::optional<Diagnosis> diagnose(const Campaign& campaign, const Study& study, const DiagnosisOptions& options,
                                  const Tell& tell, Observer& observer);

} // namespace stylobate
