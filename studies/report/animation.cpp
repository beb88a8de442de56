#include "studies/report/animation.hpp"

#include "ensemble/model/structure.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

/// Farther than any drawing is wide: what flies off is not followed beyond.
constexpr double farthest_px = 1e5;

/// Bytes of whole numbers.
class NumberBytes {
public:
    void add(std::uint64_t value)
    {
        for (; value >= 128; value >>= 7)
            bytes_ += static_cast<char>((value & 127) | 128);
        bytes_ += static_cast<char>(value);
    }
    void add_signed(std::int64_t value) { add(coded(value)); }

    /// The first value, and the differences from one to the next.
    void add_series(const std::vector<std::int64_t>& values)
    {
        add_signed(values.front());
        for (std::size_t i = 1; i < values.size();) {
            std::size_t run = 0;
            while (i + run < values.size() && values[i + run] == values[i - 1])
                ++run;
            if (run > 0) {
                add(0);
                add(run);
                i += run;
            } else {
                add_signed(values[i] - values[i - 1]);
                ++i;
            }
        }
    }

    const std::string& bytes() const { return bytes_; }

private:
    static std::uint64_t coded(std::int64_t value)
    {
        return value < 0 ? 2 * static_cast<std::uint64_t>(-value) - 1 : 2 * static_cast<std::uint64_t>(value);
    }
    std::string bytes_;
};

} // namespace

AnimationStage animation_stage(const std::vector<PlacedBlock>& blocks)
{
    double left = std::numeric_limits<double>::infinity(), right = -left, top = 0;
    for (const PlacedBlock& block : blocks) {
        left = std::min(left, block.left());
        right = std::max(right, block.right());
        top = std::max(top, block.top());
    }
    constexpr double most_height = 290, most_width = 330, above = 40, below = 30;
    AnimationStage stage;
    // what topples to a side lies about its height away
    const double reach = (right - left) / 2 + 1.05 * top;
    stage.px_m = std::min({most_height / top, most_width / (right - left), stage.width_px / 2 / reach});
    stage.middle_m = (left + right) / 2;
    stage.ground_px = std::ceil(above + std::max(top * stage.px_m, 120.0));
    stage.height_px = stage.ground_px + below;
    return stage;
}

Animation animation_of(const Trajectory& t, const AnimationStage& stage, std::size_t stride)
{
    const std::size_t blocks = t.blocks();
    Animation animation;
    animation.index = t.index;
    animation.samples = (t.time_s.size() + stride - 1) / stride;
    const double farthest = farthest_px / stage.quantum_px;
    const auto rounded = [&](double value, std::int64_t before) {
        return std::isfinite(value) ? std::llround(std::clamp(value, -farthest, farthest)) : before;
    };
    NumberBytes bytes;
    std::vector<double> half_diagonal; // [quanta], of the rounded sizes: the reader has no others
    for (std::size_t b = 0; b < blocks; ++b) {
        const Rectangle block = rectangle_of(t, 0, b);
        const auto width = static_cast<std::uint64_t>(rounded(block.half_width / stage.quantum_m(), 1));
        const auto height = static_cast<std::uint64_t>(rounded(block.half_height / stage.quantum_m(), 1));
        bytes.add(width);
        bytes.add(height);
        half_diagonal.push_back(std::hypot(static_cast<double>(width), static_cast<double>(height)));
    }
    std::vector<std::int64_t> values(animation.samples);
    const auto add = [&](auto value_at) {
        std::int64_t before = 0;
        for (std::size_t k = 0; k < values.size(); ++k)
            before = values[k] = rounded(value_at(k * stride), before);
        bytes.add_series(values);
    };
    for (std::size_t b = 0; b < blocks; ++b) {
        add([&](std::size_t k) { return (rectangle_of(t, k, b).x - stage.middle_m) / stage.quantum_m(); });
        add([&](std::size_t k) { return rectangle_of(t, k, b).y / stage.quantum_m(); });
        add([&](std::size_t k) { return rectangle_of(t, k, b).turned_rad * half_diagonal[b]; });
    }
    add([&](std::size_t k) { return t["base_x_m"][k] / stage.quantum_m(); });
    animation.data = base64(bytes.bytes());
    return animation;
}

Json animation_store(const AnimationStage& stage, double rate_hz, const std::vector<AnimatedBlock>& blocks)
{
    Json names = Json::list(), look = Json::list();
    for (const AnimatedBlock& block : blocks) {
        names.item(block.name);
        look.item(block.look);
    }
    return Json::object()
        .member("rate_hz", rate_hz)
        .member("px_m", stage.px_m)
        .member("quantum_px", stage.quantum_px)
        .member("width", stage.width_px)
        .member("height", stage.height_px)
        .member("ground", stage.ground_px)
        .member("blocks", names)
        .member("look", look);
}

} // namespace stylobate
