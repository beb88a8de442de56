#pragma once
/// Where a study is weak: choices that are allowed and plausible (`plausible.hpp` looks for what is not), but with
/// which its answer says little or depends on the numerics. Each is a pure function of the study, its motions and a
/// trial.

#include "ensemble/sampling/plausible.hpp"
#include "studies/check/rocking_decay.hpp"
#include "studies/check/run_cost.hpp"
#include "studies/check/study_trial.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct WeakSpot {
    std::string name; ///< "below_limit"
    std::string text; ///< what and why, with its figures: sentences
    std::string todo; ///< a sentence
};

/// All that are found, in the order of docs/check.md.
/// @param implausibilities of the same study, so that nothing is said twice   @param trial null: none was run
/// @param free of the same study; null: not looked at
std::vector<WeakSpot> weak_spots(const LoadedStudy& loaded, const std::vector<Implausibility>& implausibilities,
                                 const Trial* trial, const FreeMotion* free = nullptr);

/// What `weak_spots` cannot look for in this study, and why: sentences.
std::vector<std::string> not_looked_for(const LoadedStudy& loaded, const Trial* trial, const FreeMotion& free);

/// "Released from 0.5 of ...": a sentence.
std::string decay_text(const RockingDecay& decay);

/// Part of its static capacity that a monolith of the height and weight of a column loses on a bed of the study's K_N,
/// against a rigid bed: 3 t* h / b with t* = (sqrt(2 W / K_N) / (6 h))^(2/3), b and h half its width and height, W the
/// weight on the bed (own derivation, compared with runs in docs/verification.md). The largest over the columns.
double capacity_lost(const Study& study);

/// Of how many independent trials a study counts each probability: the realizations of a cell, of a single study all,
/// of a fragility study the ground motions, equal ones once. Nothing where it does not count so.
std::optional<std::uint64_t> counted_trials(const LoadedStudy& loaded);

/// Half the width of the 95 % interval (Jeffreys) to which so many runs fix a probability near 0.5.
double worst_half_width(std::uint64_t realizations);

/// "32 runs of a cell fix a probability near 0.5 to ±0.17 (95 %)", for the `counted_trials` of the study.
std::string width_text(const Study& study, std::uint64_t trials);

/// Rows of a surface in which the probability rises from nearly none to nearly all between two neighbours.
struct Jumps {
    std::uint64_t rows = 0;    ///< in which both are seen,
    std::uint64_t jumping = 0; ///< and in which they are neighbours
};
/// @param valid, collapsed (rows x columns) of a trial. A cell counts as nearly none (all) if at most a tenth (at least
/// nine tenths) of its realizations fell and the 95 % interval excludes 0.3 (0.7).
Jumps jumps_of(const std::vector<std::uint64_t>& valid, const std::vector<std::uint64_t>& collapsed,
               std::size_t columns);

} // namespace stylobate
