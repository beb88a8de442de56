#pragma once
/// Windows to be shown in motion: which ones, and the measured and simulated blocks in them.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/measured/windows/window_motion.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// As in files and pages, in the order of `BlockCoordinate`.
inline constexpr const char* coordinate_names[coordinate_count] = {"x", "y", "theta"};

/// Errors of a model in a window, by block of the specimen and coordinate: root mean square of the residuals, each
/// counted as at most 100.
using WindowExcess = std::map<std::pair<int, BlockCoordinate>, double>;

/// (windows)
std::vector<WindowExcess> excess_of(const WindowComparison& comparison, const WindowResiduals& residuals,
                                    const SpecimenStructure& built);

struct ChosenWindow {
    WindowPlace place;
    WindowChoice choice = WindowChoice::worst;
    std::uint64_t rank = 0; ///< of its error among all windows that have one; 1: the largest
    std::uint64_t ranked = 0;
};

inline constexpr std::size_t most_shown_windows = 5;
inline constexpr std::size_t most_shown_samples = 240; ///< of a window: 4 s of a film, in slow motion
inline constexpr double shown_windows_mb = 1;          ///< 1e6 bytes of the file that keeps them

/// By its largest error the worst window of all; the median one; the worst ones of other runs, the worst run first. A
/// window without errors (nothing was seen) is left out. Of equal errors the earlier window comes first.
/// @param excess (windows)
std::vector<ChosenWindow> choose_windows(const std::vector<WindowPlace>& windows,
                                         const std::vector<WindowExcess>& excess);

/// A model whose motion is shown.
struct ShownModel {
    std::string name;         ///< of its track
    const Campaign& campaign; ///< with the base motion that drives it
    ModelVariant variant;
};

/// Follows every model in the chosen windows. Of a window at most `most_shown_samples` are kept, evenly spaced, the
/// last one among them; windows that do not fit into the budget are left out, the last ones first. The first two are
/// always there, with fewer samples where the budget wants it.
/// @param models  at least one; all places count against the base motion of the first one's campaign
/// @param windows of the comparison that has chosen them
/// @param cost    added to
/// @param observer hears of no progress
/// @return nothing where no window was chosen, or the observer stopped it
std::optional<WindowMotions> window_motions(const std::vector<ChosenWindow>& chosen,
                                            const std::vector<ShownModel>& models, const WindowOptions& windows,
                                            const RunOptions& options, SimulationCount& cost, Observer& observer,
                                            double budget_mb = shown_windows_mb);

} // namespace stylobate
