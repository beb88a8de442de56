#pragma once
/// How well free windows predict the slip of the joints, and nothing else: how blocks rotate depends on the contacts of
/// the model, of which nobody knows the right ones; how far they slip depends on friction first.
///
///   slip of a joint = (x + h theta) of the upper block's lower face - (x - h theta) of the lower block's upper face
///   score = sum of log t_4(r / (k s)) - log(k s),   s = noise + a part of the slip that was seen in the window
///
/// k, one for each joint, is fitted to what is scored.

#include "ensemble/tracking/specimen.hpp"
#include "studies/calibration/calibration_windows.hpp"
#include "studies/diagnosis/laws/track.hpp"

#include <vector>

namespace stylobate {

class SlipScore {
public:
    SlipScore(const Campaign& campaign, const SpecimenStructure& built, const WindowComparison& comparison,
              const TrackScales& scales);

    /// (windows) log scores of residuals as `WindowComparison::residuals` gives them, by their own k.
    std::vector<double> operator()(const WindowResiduals& residuals) const;

private:
    /// One slip that is scored: from which residuals of its window.
    struct Slip {
        std::size_t window, joint;
        /// Places among the window's residuals, -1: fixed; with what their values count [m per scale].
        struct Part {
            std::size_t at;
            double factor;
        };
        std::vector<Part> parts;
        double scale; ///< s [m]
    };
    std::vector<Slip> slips_;
    std::size_t windows_ = 0, joints_ = 0;
};

} // namespace stylobate
