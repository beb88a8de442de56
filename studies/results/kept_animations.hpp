#pragma once
/// Which realizations a page shows in motion, and their animations.

#include "ensemble/model/observer.hpp"
#include "kernels/isa.hpp"
#include "studies/report/animation.hpp"
#include "studies/results/results.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

inline constexpr double usual_animation_mb = 3;        ///< of the animations of a page together
inline constexpr double usual_animation_seconds = 120; ///< for their realizations, which are run again
inline constexpr double animation_rate_hz = 60;        ///< at most: the trajectories of a study may have more samples

/// Of a study whose page draws its motion: the number of its first realizations that are shown, as pictures and in
/// motion.
inline constexpr std::uint64_t first_shown = 3;

struct AnimationOptions {
    std::uint64_t each = 1;                   ///< N that fell and N that stood, of each cell that has both; 0: none
    double budget_mb = usual_animation_mb;    ///< 1e6 bytes of the page, > 0
    double seconds = usual_animation_seconds; ///< after that none is begun any more
    bool wanted = false; ///< the user has asked: what cannot be had is an error then, and else a note
    int threads = 1;
};

struct KeptAnimations {
    AnimationStage stage;
    double rate_hz = 0;
    std::vector<Animation> list;        ///< by cell and index
    std::optional<std::string> words;   ///< what was kept and what was not, for the page; nullopt: none
    std::optional<std::string> warning; ///< why there are none though there might be; nullopt: nothing is wrong
};

/// Those that the file keeps as trajectories, and those that are run again: of a surface by cells, of other studies
/// over all realizations. Of a surface those that fell in cells with both fates come first, then those that did not,
/// then one of each other cell. Cells have their turns in an order that spreads them over the surface, so that a budget
/// that is too small leaves gaps that are small. The choice does not depend on the threads; where the time is up it
/// depends on the machine, which the words state.
/// @pre the run is complete
/// @param observer hears of the progress, and may stop it: what is returned then is not complete
/// @throws InputError if they are wanted and cannot be had: the study has no realizations that can be run again, the
///         results have no rows, the record is missing, or the budget is smaller than one animation
KeptAnimations keep_animations(const Results& results, Isa isa, const AnimationOptions& options, Observer& observer);

/// Without animations: the stage and the rate of those of a study.
KeptAnimations animations_for(const Study& study);
/// An animation has one of this many samples of a trajectory of the study.
std::size_t animation_stride(const Study& study);

/// For the script of the page (player.js).
std::string animations_json(const KeptAnimations& kept, const Study& study);

} // namespace stylobate
