#pragma once
/// Inference from the survival of a structure: counts of the realizations that agree with what is known of it, and what
/// follows from them. The statistics are those of `ensemble/estimators/past`.

#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/estimators/past/exclusion.hpp"
#include "ensemble/estimators/past/hazard_update.hpp"
#include "ensemble/estimators/past/past_likelihood.hpp"
#include "ensemble/estimators/past/past_posterior.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The state that comes nearest to the observed one.
struct NearestState {
    std::uint64_t index = 0; ///< of the realization
    double distance = 0;     ///< in tolerances
    std::size_t cell = 0;
    std::size_t worst = 0; ///< the value that differs most, of `Survival::measured`
    double found = 0;      ///< that value, of the mirror image where that is nearer
};

/// Counts, in any order of the rows.
class SurvivalCounts {
public:
    SurvivalCounts(const Study& study, const ResultHeader& header);
    void add(const ResultRow& row);

    const PastAxes& axes() const { return axes_; }
    const MeasuredState& measured() const { return measured_; }
    /// Of the values that were measured: "drum 2 on drum 1 [m]".
    const std::vector<std::string>& names() const { return names_; }
    /// (motions) Of the structures under each motion, cell by cell.
    const std::vector<MotionTally>& motions() const { return motions_; }
    /// (cells) A sum over the structures of a cell.
    std::vector<std::uint64_t> sums(std::uint32_t MotionTally::*part) const;
    /// Of those that agree, how many still moved at the end.
    std::uint64_t moving() const { return moving_; }
    const std::optional<NearestState>& nearest() const { return nearest_; }

    /// A realization that stands.
    struct Standing {
        std::uint64_t index = 0;
        std::size_t cell = 0;
        std::vector<double> value; ///< that were measured, and their counterparts
    };
    /// In the order of the realizations.
    std::vector<Standing> standing() const;

private:
    /// A value of a final state.
    struct Place {
        bool rotation = false;  ///< of a block, else the displacement of a joint
        std::size_t number = 0; ///< of the block or joint
        friend bool operator==(const Place&, const Place&) = default;
    };
    void find_counterparts(const Layout& layout);

    const Study& study_;
    PastAxes axes_;
    MeasuredState measured_;
    std::vector<std::string> names_;
    std::vector<Place> places_; ///< that were measured, and then their counterparts that were not
    std::vector<MotionTally> motions_;
    std::uint64_t moving_ = 0;
    std::vector<Standing> standing_;
    std::optional<NearestState> nearest_;
};

/// The mean over the motions of each cell of a share of every motion; motions without one are left out.
/// @param motions (cells x motions of a cell)   @param most realizations of a cell
std::vector<CellCount> cell_means(std::size_t cells, std::size_t motions, double most,
                                  const std::function<std::optional<double>(std::size_t motion)>& share);

/// What follows from one likelihood.
struct PastAnswer {
    std::vector<Exclusion> by_events; ///< over the frequencies, of a past of 1, 2, ... events
    PastPosterior posterior;
};

struct Survival {
    PastAxes axes;
    std::string prior; ///< in words
    double level = 0.95;
    std::uint64_t realizations = 0, valid = 0, stand = 0, agree = 0, moving = 0; ///< moving: of those that agree
    bool state_measured = false;                           ///< else that it stands is all that is known
    std::vector<std::uint64_t> trials, standing, agreeing; ///< (cells)
    MeasuredState measured;
    std::vector<std::string> names; ///< of the measured values
    std::optional<NearestState> nearest;

    // where a realization agrees
    std::optional<PastAnswer> past;              ///< of a structure that was chosen before its fate was known
    std::vector<Exclusion> by_frequency;         ///< of one event
    std::uint64_t built = 1, standing_alike = 1; ///< of those that were built alike
    std::optional<PastAnswer> alike;             ///< given that so many of them stand; none: it is alone
    std::vector<ExclusionCoverage> coverage;     ///< (ni) of the exclusion by one event; none: not calibrated
    std::optional<MonumentTest> monuments;
    // with a hazard and a time
    std::optional<HazardUpdate> rates;
    double years = 0, sigma_ln = 0;
    std::optional<IntensityRange> hazard_points; ///< none: a power law

    /// Whether the past can be inferred at all.
    bool judged() const { return past.has_value(); }
};

/// Exclusions and posterior. @param thresholds (events)
PastAnswer past_answer(const PastLikelihood& likelihood, const std::vector<RatioThresholds>& thresholds,
                       const PriorDensity& prior, double level);

/// What simulated monuments say of the study.
struct MonumentJudgement {
    std::vector<RatioThresholds> thresholds; ///< (events)
    std::optional<MonumentTest> test;        ///< none: nothing was measured, or monuments = 0
};
/// @param trials (cells)
MonumentJudgement judge_monuments(const PastAxes& axes, const std::vector<double>& trials,
                                  const StandingStates& standing, const MeasuredState& measured,
                                  const SurvivalSpec& spec, std::uint64_t seed);

/// The density of a study's prior, over the logarithm of the intensity.
PriorDensity prior_density(const SurvivalSpec& spec);
/// "flat in ln PGA from 1 to 12 m/s2"
std::string prior_words(const SurvivalSpec& spec, const std::vector<double>& pga_m_s2);

/// @pre all rows have been added
Survival survival_of(const Study& study, const SurvivalCounts& counts);

} // namespace stylobate
