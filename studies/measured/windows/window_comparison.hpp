#pragma once
/// Models compared with measured histories, window by window (`ensemble/tracking/tracking.hpp`).

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/tracking_score.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace stylobate {

/// The nominal realization of a study's contacts and mechanisms in a structure: nothing drawn, nothing shaken yet.
Realization nominal_realization(const Study& variant, const StructureSpec& structure);

/// A model that is to predict a campaign.
struct ModelVariant {
    Study study; ///< its contacts and mechanisms; its structure is the specimen's, its excitation and perturbations do
                 ///< not matter here
    /// Changes the realization, its blocks being where they stood in the run; empty: not. The index is of the campaign.
    std::function<void(Realization&, std::size_t run)> change = {};
};

/// Where a window lies.
struct WindowPlace {
    std::size_t run = 0; ///< of the campaign
    double start_s = 0;  ///< the cameras' clock
    double end_s = 0;
    double free_s = 0; ///< its start in the time of the base motion
};

struct WindowOptions {
    double window_s = 0;           ///< length; 0: by the size of the drums (`tracking_scales`)
    std::vector<std::size_t> runs; ///< of the campaign; empty: all
    /// These windows only, which a comparison with the same length has chosen, ascending in each run; empty: all that
    /// follow from the base motion.
    std::vector<WindowPlace> places;
};

/// What a variant is off by: residuals over their scale s (`SeenValue`) of every window.
using WindowResiduals = std::vector<std::vector<double>>;

/// Blocks in a window, at every sample of the cameras.
struct WindowCurve {
    std::vector<double> time_s; ///< (nt) the cameras' clock
    std::vector<double> base_m; ///< (nt) displacement of the base, as measured
    /// (nt x blocks) by coordinate, as displacements from where they stood: measured, and as a variant predicts them
    /// from the window's start, in the frame of the base. NaN: not seen, or no longer finite.
    std::array<std::vector<double>, coordinate_count> seen, model;
    std::array<double, coordinate_count> noise_sd{}; ///< of a sample
    std::vector<double> stood_x_m;                   ///< (blocks) where they stood in the run, as measured
};

/// A campaign made ready to be predicted: base motions, smoothed histories, windows. Made once, used for many models.
class WindowComparison {
public:
    /// Runs without histories, or whose base motion is not known, are omitted.
    /// @throws InputError if the specimen cannot be built
    WindowComparison(const Campaign& campaign, const WindowOptions& options);

    const std::vector<WindowPlace>& windows() const { return places_; }
    const TrackingScales& scales() const { return scales_; }

    /// Runs every variant over all windows, in lockstep. @return (variants x windows); empty if the observer stopped it
    /// @throws InputError if a variant cannot be built
    std::vector<WindowResiduals> residuals(const std::vector<ModelVariant>& variants, const RunOptions& options,
                                           Observer& observer);

    /// The motion behind the residuals.
    /// @param windows ascending   @param blocks of the layout, in the order in which the curves have them
    /// @return in the order of the windows; empty if the observer stopped it
    std::vector<WindowCurve> curves(const ModelVariant& variant, const std::vector<std::size_t>& windows,
                                    const std::vector<std::size_t>& blocks, const RunOptions& options,
                                    Observer& observer);

    /// Scales k fitted to a variant, of the runs in `runs` (of the campaign; empty: all).
    ResidualScales fit_scales(const WindowResiduals& residuals, const std::vector<std::size_t>& runs = {}) const;
    /// (windows) log scores
    std::vector<double> scores(const WindowResiduals& residuals, const ResidualScales& scales) const;
    /// What each residual of a window is of.
    const std::vector<SeenValue>& seen(std::size_t window) const { return values_[window]; }

    /// What was simulated so far.
    const SimulationCount& cost() const { return cost_; }

private:
    struct Run {
        std::size_t index = 0; ///< of the campaign
        std::shared_ptr<const Motion> base;
        SeenRun seen;
        std::shared_ptr<const Targets> targets;
        std::shared_ptr<const std::vector<FreeWindow>> windows;
        std::size_t first = 0; ///< of its windows among all
    };
    TrackingJob job_of(const Run& run, const ModelVariant& variant) const;
    std::vector<SeenWindow> windows_in(const Run& run, const WindowOptions& options) const;
    WindowCurve measured_curve(const Run& run, std::size_t window, const std::vector<std::size_t>& chosen,
                               FreeWindow& read) const;
    TrackingReport tracked(const std::vector<TrackingJob>& jobs, const RunOptions& options, Observer& observer);

    StructureSpec structure_;
    std::vector<double> plan_x_m_; ///< (blocks)
    TrackingScales scales_;
    std::vector<Run> runs_;
    std::vector<WindowPlace> places_;
    std::vector<std::vector<SeenValue>> values_; ///< (windows)
    SimulationCount cost_;
};

/// A paired difference with its interval.
struct PairedGain {
    double total = 0; ///< sum of score_b - score_a over the windows [nats]
    double low = 0;   ///< 95 % interval of it, from how it differs between the motions (Student's t), or between the
    double high = 0;  ///< windows where there are fewer than 4 motions
    std::size_t groups = 0;
};

/// @param group (windows) what may be taken as independent: windows of one motion share a group
PairedGain paired_gain(const std::vector<double>& score_a, const std::vector<double>& score_b,
                       const std::vector<std::size_t>& group);

} // namespace stylobate
