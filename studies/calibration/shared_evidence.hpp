#pragma once
/// Evidence whose predictions several processes make: each takes a part of a portion of parameter sets.

#include "ensemble/ranks/ranks.hpp"
#include "studies/calibration/calibration_evidence.hpp"

#include <memory>

namespace stylobate {

/// That of rank 0, which searches; the others `serve_evidence` until it is destroyed.
class SharedEvidence : public CalibrationEvidence {
public:
    SharedEvidence(std::unique_ptr<CalibrationEvidence> inner, Ranks& ranks);
    ~SharedEvidence() override;

    const std::vector<std::size_t>& runs() const override { return inner_->runs(); }
    std::size_t candidates() const override { return inner_->candidates(); }
    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override;
    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override
    {
        return inner_->own_scores(candidate, used);
    }
    std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const override
    {
        return inner_->scores(candidate, scales_of);
    }
    EvidenceCost cost() const override;
    bool take(const Predictions& predictions) override { return inner_->take(predictions); }

private:
    std::unique_ptr<CalibrationEvidence> inner_;
    Ranks& ranks_;
    EvidenceCost elsewhere_; ///< what the others have spent
};

/// Predicts what rank 0 asks for, until it asks for nothing more.
void serve_evidence(Ranks& ranks, CalibrationEvidence& evidence, const RunOptions& options, Observer& observer);

} // namespace stylobate
