#pragma once
/// The search itself: from a scan of the whole range to a quadratic form about the best point, and profiles.

#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/calibration/calibration_evidence.hpp"
#include "studies/measured/calibration/calibration_surface.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Receives the progress of a search.
class SearchProgress {
public:
    virtual ~SearchProgress() = default;
    /// What is being done, in words.
    virtual void stage(const std::string& what) = 0;
    /// So many parameter sets were done since the last call.
    virtual void advance(std::size_t done) = 0;
    /// So many that were planned will not be needed.
    virtual void spare(std::size_t sets) = 0;
};

/// One calibration: one contact form, one set of keys.
class CalibrationSearch {
public:
    /// @param nominal the study as it was given, which the result is compared with
    /// @param start what the keys' values are put into
    /// @param keys may be none: then what `start` has is compared, and nothing is searched
    CalibrationSearch(Study nominal, Study start, std::vector<FitKey> keys, const CalibrationOptions& options,
                      CalibrationEvidence& evidence, const RunOptions& run, Observer& observer,
                      SearchProgress& progress);

    /// Parameter sets that a search with these options tries.
    static std::size_t planned(std::size_t keys, const CalibrationOptions& options, std::size_t folds);

    /// @param fold (units) which part is left out together; 0 .. folds - 1
    /// @return nothing if the observer stopped it
    std::optional<FormCalibration> run(const std::vector<std::size_t>& fold, std::size_t folds);

private:
    struct Tried {
        UnitPoint at;
        std::size_t candidate;
        double own = 0; ///< score by its own scales
    };

    double value(std::size_t key, double unit) const;
    Study study_at(const UnitPoint& point) const;
    bool try_points(const std::vector<UnitPoint>& points);
    std::size_t best_tried() const;
    /// Points of the last rounds within a number of deviations of the surface, with their scores by the scales of the
    /// best.
    std::vector<ScoredPoint> scored(const std::vector<std::size_t>& tried) const;
    bool begin(FormCalibration& result);
    void conclude(FormCalibration& result) const;
    bool refine();
    bool fit();
    bool profiles(FormCalibration& result);
    void judge(FittedParameter& parameter, std::size_t i) const;
    bool hold_out(FormCalibration& result, const std::vector<std::size_t>& fold, std::size_t folds);

    const Study nominal_, start_;
    const std::vector<FitKey> keys_;
    const CalibrationOptions& options_;
    CalibrationEvidence& evidence_;
    const RunOptions& run_;
    Observer& observer_;
    SearchProgress& progress_;
    std::vector<Tried> tried_;
    std::vector<std::vector<double>> held_; ///< (keys) values of each profile, in the range
    std::vector<std::size_t> near_;         ///< of `tried_`: those that the surface is fitted to
    std::size_t nominal_candidate_ = 0;     ///< of the evidence: the study as it was given
    std::size_t reference_ = 0;             ///< candidate whose scales all are scored by
    std::size_t drawn_ = 0;                 ///< points of the sequence that have been used
    ScoreSurface surface_;
};

} // namespace stylobate
