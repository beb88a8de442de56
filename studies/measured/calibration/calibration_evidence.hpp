#pragma once
/// What parameter sets are judged by: histories in windows, or outcomes in ensembles.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/measured/calibration/outcome_tests.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace stylobate {

/// Of some studies, one after the other.
using Predictions = std::vector<std::vector<double>>;

/// Candidates are added, and kept with what they predict; their scores are asked for as often as needed.
class CalibrationEvidence {
public:
    virtual ~CalibrationEvidence() = default;

    /// (units) what is scored: which run of the campaign each belongs to.
    virtual const std::vector<std::size_t>& runs() const = 0;

    /// How many have been added.
    virtual std::size_t candidates() const = 0;

    /// Predicts with each study. @return false if the observer stopped it: then none was added
    virtual bool add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer)
    {
        const std::optional<Predictions> made = predict(candidates, options, observer);
        return made && take(*made);
    }
    /// What each study predicts, as numbers from which all its scores follow. Nothing: the observer stopped it
    virtual std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                               Observer& observer) = 0;

    /// (units) scores of a candidate by its own scales, fitted to the runs that are `used` (of the campaign; empty:
    /// all).
    virtual std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const = 0;
    /// (units) scores of a candidate by the scales of another one.
    virtual std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const = 0;

    virtual SimulationCount cost() const = 0;

    /// Adds candidates whose predictions are known. @return false if these are none of this evidence: then none is
    /// added
    virtual bool take(const Predictions& predictions) = 0;
    /// How many candidates were taken from what an interrupted calibration has left.
    virtual std::size_t restored() const { return 0; }
};

/// Null where no run has a history that a model could track.
std::unique_ptr<CalibrationEvidence> history_evidence(const Campaign& campaign, const std::vector<std::size_t>& runs,
                                                      double window_s);
/// How a specimen differs from its plan, as far as that is known: what is drawn where a study draws nothing.
std::vector<Perturbation> tolerances(const Specimen& specimen);

/// Null where there are no tests.
/// @param ensemble realizations of each shaking and candidate
std::unique_ptr<CalibrationEvidence> outcome_evidence(OutcomeTests tests, std::vector<Perturbation> perturbations,
                                                      std::uint64_t ensemble);

} // namespace stylobate
