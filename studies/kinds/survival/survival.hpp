#pragma once
/// Inference from the survival of a structure: counts of the realizations that agree with what is known of it, and what
/// follows from them. The statistics are those of `ensemble/estimators/past`.

#include "ensemble/estimators/past/exclusion.hpp"
#include "ensemble/estimators/past/final_state.hpp"
#include "ensemble/estimators/past/hazard_update.hpp"
#include "ensemble/estimators/past/past_posterior.hpp"
#include "ensemble/estimators/past/simulated_monuments.hpp"
#include "ensemble/model/study.hpp"
#include "io/store/result_store.hpp"

#include <cstdint>
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
    /// (cells) Valid realizations and those of them that agree, that stand, that collapsed.
    const std::vector<CellCount>& agree() const { return agree_; }
    std::vector<CellCount> stand() const;
    const std::vector<CellCount>& collapse() const { return collapse_; }
    /// Of those that agree, how many still moved at the end.
    std::uint64_t moving() const { return moving_; }
    const std::optional<NearestState>& nearest() const { return nearest_; }
    /// In the order of the realizations.
    StandingStates standing() const;

private:
    struct Standing {
        std::uint64_t index = 0;
        std::size_t cell = 0;
        std::vector<double> value;
    };
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
    std::vector<CellCount> agree_, collapse_;
    std::uint64_t moving_ = 0;
    std::vector<Standing> standing_;
    std::optional<NearestState> nearest_;
};

struct Survival {
    PastAxes axes;
    std::string prior; ///< in words
    double level = 0.95;
    std::uint64_t realizations = 0, valid = 0, stand = 0, agree = 0, moving = 0; ///< moving: of those that agree
    bool state_measured = false; ///< else that it stands is all that is known
    std::vector<CellCount> agreeing, standing;
    MeasuredState measured;
    std::vector<std::string> names; ///< of the measured values
    std::optional<NearestState> nearest;

    // where a realization agrees
    std::vector<Exclusion> by_events;    ///< mean over the frequencies, of a past of 1, 2, ... events
    std::vector<Exclusion> by_frequency; ///< of one event
    std::optional<PastPosterior> posterior;
    std::optional<MonumentTest> monuments;
    // with a hazard and a time
    std::optional<HazardUpdate> rates;
    double years = 0, sigma_ln = 0;
    std::optional<IntensityRange> hazard_points; ///< none: a power law

    /// Whether the past can be inferred at all.
    bool judged() const { return agree > 0; }
};

/// The density of a study's prior, over the logarithm of the intensity.
PriorDensity prior_density(const SurvivalSpec& spec);
/// "flat in ln PGA from 1 to 12 m/s2"
std::string prior_words(const SurvivalSpec& spec, const std::vector<double>& pga_m_s2);

/// @pre all rows have been added
Survival survival_of(const Study& study, const SurvivalCounts& counts);

} // namespace stylobate
