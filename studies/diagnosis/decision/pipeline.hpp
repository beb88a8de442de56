#pragma once
/// A diagnosis from beginning to end. `docs/diagnosis.md` explains the stages; each is a file of this folder.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "studies/diagnosis/decision/decision.hpp"
#include "studies/diagnosis/ensemble_fit/campaign_ensemble.hpp"
#include "studies/diagnosis/findings/diagnosis.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace stylobate {

struct DiagnosisOptions {
    std::uint64_t seed = 1;
    std::uint64_t nulls = 32; ///< campaigns with nothing hidden
    bool windows = false;     ///< whether free windows judge causes too: slow, and they depend on the contact form
    bool statistics =
        false;         ///< whether simulated campaigns with labels judge joints and blocks (statistics_verdict.hpp)
    EnsemblePlan plan; ///< of these
    std::filesystem::path cache;     ///< of the null distribution; empty: none is kept
    std::filesystem::path extension; ///< where the extended study goes; empty: nowhere
    DecisionRule rule;
    RunOptions run;
};

/// Told what is being done, one line at a time.
using Tell = std::function<void(const std::string&)>;

/// @param study contacts to begin with; its structure is replaced by the specimen's
/// @return nothing if the observer stopped it: the null distribution is kept in the cache, and the same call continues
/// @throws InputError if the campaign cannot be diagnosed at all
std::optional<Diagnosis> diagnose(const Campaign& campaign, const Study& study, const DiagnosisOptions& options,
                                  const Tell& tell, Observer& observer);

} // namespace stylobate
