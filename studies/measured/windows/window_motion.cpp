#include "studies/measured/windows/window_motion.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

std::size_t WindowMotions::free_blocks() const
{
    return static_cast<std::size_t>(
        std::ranges::count_if(blocks, [](const ShownBlock& block) { return block.kind != ShownBlockKind::fixed; }));
}

std::optional<std::string> WindowMotions::fault() const
{
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    for (const ShownBlock& block : blocks)
        if (!positive(block.half_width_m) || !positive(block.half_height_m) || !std::isfinite(block.rest_x_m) ||
            !std::isfinite(block.rest_y_m))
            return "a block that is shown in motion has no size or no place";
    const std::size_t free = free_blocks();
    if (!std::ranges::is_partitioned(blocks,
                                     [](const ShownBlock& block) { return block.kind != ShownBlockKind::fixed; }))
        return "of the blocks that are shown in motion a fixed one is not at the end";
    for (const WindowMotion& window : windows) {
        if (free == 0 || window.samples.size() < 2 || window.tracks.size() < 2 ||
            window.tracks.front().model != "measured")
            return "a window in motion lacks samples, blocks, a model or what was measured";
        if (!std::ranges::equal(window.tracks, windows.front().tracks, {}, &MotionTrack::model, &MotionTrack::model))
            return "the windows in motion are of different models";
        for (std::size_t k = 0; k < window.samples.size(); ++k)
            if (!std::isfinite(window.samples[k].time_s) || !std::isfinite(window.samples[k].base_x_m) ||
                (k > 0 && !(window.samples[k].time_s > window.samples[k - 1].time_s)))
                return "the samples of a window in motion do not ascend in time";
        for (const MotionTrack& track : window.tracks)
            if (track.places.size() != window.samples.size() * free)
                return "the places of a window in motion are not as many as its samples and blocks";
    }
    return std::nullopt;
}

} // namespace stylobate
