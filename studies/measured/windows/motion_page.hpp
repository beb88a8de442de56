#pragma once
/// Windows in motion as a part of a page: measured blocks over simulated ones.
///
/// The drawing in which windows are shown in motion: the blocks of all tracks over each other.

#include "io/store/result_store.hpp"
#include "studies/measured/windows/window_motion.hpp"
#include "studies/report/animation.hpp"
#include "studies/report/document.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// A track in the drawing.
struct MotionLayer {
    std::size_t track = 0;
    std::string name;      ///< "measured", "calibrated baseline"
    std::string look;      ///< class of the page's style: measured blocks are outlined, those of models filled
    std::size_t first = 0; ///< block of the drawing that is its first one
};

/// The blocks of the drawing are the fixed ones, and then those of each layer.
class MotionStage {
public:
    /// @pre the motion has a window, and no fault; it outlives the stage
    explicit MotionStage(const WindowMotions& motion);

    const AnimationStage& scale() const { return scale_; }
    const std::vector<AnimatedBlock>& blocks() const { return blocks_; }
    /// From the bottom of the drawing to its top, where the measured blocks are.
    const std::vector<MotionLayer>& layers() const { return layers_; }

    /// How many times as large displacements from rest are drawn, so that they are seen beside the size of the blocks:
    /// 1, 2, 5, 10, 20, 50 or 100; the same in all windows.
    double larger() const { return larger_; }
    /// How many times as large differences between the blocks of a model and the measured ones are drawn, at least as
    /// many: so that they are seen in the first window and stay in the drawing in all.
    double apart() const { return apart_; }
    /// (blocks of the drawing) where they rest, from the middle of the ground [px], upwards.
    const std::vector<std::array<double, 2>>& rest_px() const { return rest_px_; }

    /// A window, its blocks being those of the drawing above its ground, at as many even times as it has samples: those
    /// of the samples where they are even to 2 % of their spacing, and linear between two samples elsewhere.
    Trajectory trajectory(const WindowMotion& window) const;

    /// The sample at which a corner of the first model is farthest from the measured one; the last one where none is
    /// known.
    static std::size_t farthest(const WindowMotions& motion, const WindowMotion& window);

    /// Where a block of the drawing is drawn: from the middle and from the ground, upwards [px], and its rotation
    /// [rad]. That of a model against the measured one, where that is known.
    std::array<double, 3> drawn(const Trajectory& trajectory, std::size_t sample, std::size_t block) const;

private:
    void choose_sizes();

    std::size_t fixed() const { return motion_.blocks.size() - free_; }

    const WindowMotions& motion_;
    const std::size_t free_;
    double ground_m_ = 0; ///< as the places count: above the table
    AnimationStage scale_;
    std::vector<MotionLayer> layers_;
    std::vector<AnimatedBlock> blocks_;
    std::vector<std::size_t> shown_; ///< (blocks of the drawing) which of the motion's
    std::vector<std::array<double, 2>> rest_px_;
    double larger_ = 1, apart_ = 1;
};

/// Adds the player of the animations (windows.js), a picture of a moment of each window, and a table of their errors;
/// the latter two need no script.
/// @pre the motion has a window, and no fault
void add_motion(Document& page, const WindowMotions& motion);

/// Why there is none though windows were simulated. @param code_version that wrote the file
std::string no_motion_words(const std::string& file, const std::string& code_version);

// ---- A moment of each window side by side: what is printed, and seen where no scripts run.

} // namespace stylobate
