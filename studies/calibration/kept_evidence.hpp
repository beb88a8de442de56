#pragma once
/// Evidence that is kept in a file while a calibration runs, so that an interrupted one goes on where it was.
///
/// What costs time are the predictions; all that follows from them is done again, and has the same bits. Each portion
/// of parameter sets is one record, with a checksum; a record that was cut, and whatever comes after it, is made anew.

#include "studies/calibration/calibration_evidence.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace stylobate {

class KeptEvidence : public CalibrationEvidence {
public:
    /// @param key  of what the predictions depend on beside the studies: a file with another key is begun anew
    /// @throws InputError if the file cannot be written, another calibration is writing it, or it has other content
    KeptEvidence(std::unique_ptr<CalibrationEvidence> inner, std::filesystem::path file, const std::string& key);
    ~KeptEvidence() override;

    const std::vector<std::size_t>& runs() const override;
    std::size_t candidates() const override;
    bool add(const std::vector<Study>& candidates, const RunOptions& options, Observer& observer) override;
    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override;
    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override;
    std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const override;
    EvidenceCost cost() const override;
    bool take(const Predictions& predictions) override;
    std::size_t restored() const override;

    /// Parameter sets that the file holds.
    std::size_t kept() const;
    /// Removes the file: it is no longer needed.
    void remove();

private:
    struct File;
    std::unique_ptr<CalibrationEvidence> inner_;
    std::unique_ptr<File> file_;
};

} // namespace stylobate
