#pragma once
/// What parameter sets are judged by: histories in windows, or outcomes in ensembles.
///
/// Predictions of a portion of parameter sets as bytes: kept in a file while a calibration runs, and shared among
/// processes.
///
/// What costs time are the predictions; all that follows from them is done again, and has the same bits.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/run/ranks.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/measured/calibration/outcome_tests.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
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

/// Evidence by another one.
class EvidenceBy : public CalibrationEvidence {
public:
    explicit EvidenceBy(std::unique_ptr<CalibrationEvidence> inner) : inner_(std::move(inner)) {}

    const std::vector<std::size_t>& runs() const override { return inner_->runs(); }
    std::size_t candidates() const override { return inner_->candidates(); }
    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override
    {
        return inner_->own_scores(candidate, used);
    }
    std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const override
    {
        return inner_->scores(candidate, scales_of);
    }
    SimulationCount cost() const override
    {
        SimulationCount cost = inner_->cost();
        return cost += elsewhere_;
    }
    bool take(const Predictions& predictions) override { return inner_->take(predictions); }

protected:
    std::unique_ptr<CalibrationEvidence> inner_;
    SimulationCount elsewhere_; ///< spent by other processes, or before an interrupt
};

/// Evidence that is kept in a file, so that an interrupted calibration goes on where it was. Each portion of parameter
/// sets is one record, with a checksum; a record that was cut, and whatever comes after it, is made anew.
class KeptEvidence : public EvidenceBy {
public:
    /// @param key  of what the predictions depend on beside the studies: a file with another key is begun anew
    /// @throws InputError if the file cannot be written, another calibration is writing it, or it has other content
    KeptEvidence(std::unique_ptr<CalibrationEvidence> inner, std::filesystem::path file, const std::string& key);
    ~KeptEvidence() override;

    bool add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer) override;
    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override;
    std::size_t restored() const override { return restored_; }

    /// Parameter sets that the file holds.
    std::size_t kept() const;
    /// Removes the file: it is no longer needed.
    void remove();

private:
    struct File;
    std::unique_ptr<File> file_;
    std::size_t restored_ = 0;
};

/// Evidence whose predictions several processes make: each takes a part of a portion. This is that of rank 0, which
/// searches; the others `serve_evidence` until it is destroyed.
class SharedEvidence : public EvidenceBy {
public:
    SharedEvidence(std::unique_ptr<CalibrationEvidence> inner, Ranks& ranks)
        : EvidenceBy(std::move(inner)), ranks_(ranks)
    {
    }
    ~SharedEvidence() override;

    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override;

private:
    Ranks& ranks_;
};

/// Predicts what rank 0 asks for, until it asks for nothing more.
void serve_evidence(Ranks& ranks, CalibrationEvidence& evidence, const RunOptions& options, Observer& observer);

} // namespace stylobate
