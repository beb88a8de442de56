#include "studies/report/animation.hpp"

#include "ensemble/model/structure.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/placed_solid.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

bool is_top(const std::vector<PlacedBlock>& blocks, std::size_t block)
{
    return std::none_of(blocks.begin(), blocks.end(), [&](const PlacedBlock& other) {
        return other.column >= 0 && other.column == blocks[block].column && other.y_m > blocks[block].y_m;
    });
}

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

AnimationStage animation_stage_in_space(const std::vector<PlacedBlock>& blocks)
{
    const double infinite = std::numeric_limits<double>::infinity();
    double left = infinite, right = -infinite, back = infinite, front = -infinite, top = 0;
    for (const PlacedBlock& block : blocks) {
        const double half_x = std::max(1.0, block.top_ratio) * block.width_m / 2;
        const double half_z = std::max(1.0, block.top_ratio) * block.depth_m / 2;
        left = std::min(left, block.x_m() - half_x);
        right = std::max(right, block.x_m() + half_x);
        back = std::min(back, block.z_m() - half_z);
        front = std::max(front, block.z_m() + half_z);
        top = std::max(top, block.top());
    }
    constexpr double most_height = 270, most_width = 330, margin = 45;
    AnimationStage stage;
    const double radius = std::hypot(right - left, front - back) / 2;
    const double reach = radius + 1.05 * top; // as in the plane
    stage.px_m = std::min({most_height / top, most_width / (2 * radius), stage.width_px / 2 / reach});
    stage.middle_m = (left + right) / 2;
    stage.middle_z_m = (back + front) / 2;
    stage.pivot_px = std::ceil(top * stage.px_m / 2);
    stage.reach_px = std::ceil((radius + 0.35 * top) * stage.px_m);
    // the ground from above; the structure and the near corner of the ground as the view is at first
    constexpr double sine = 0.343, cosine = 0.939;
    const double near = stage.pivot_px * cosine + std::numbers::sqrt2 * stage.reach_px * sine;
    stage.height_px = 2 * std::ceil(std::max({stage.reach_px + 10, stage.pivot_px + margin, near + 10}));
    stage.ground_px = stage.height_px / 2 + stage.pivot_px;
    return stage;
}

namespace {

/// Writes the numbers of an animation.
class AnimationBytes {
public:
    AnimationBytes(const AnimationStage& stage, std::size_t samples, std::size_t stride)
        : farthest_(farthest_px / stage.quantum_px), stride_(stride), values_(samples)
    {
    }

    /// @param quanta not below 0   @returns what is written
    double add_size(double quanta)
    {
        const auto size = static_cast<std::uint64_t>(rounded(quanta, 1));
        bytes_.add(size);
        return static_cast<double>(size);
    }
    /// @param value_at of a sample of the trajectory [quanta]
    template <class F>
    void add_series(const F& value_at)
    {
        std::int64_t before = 0;
        for (std::size_t k = 0; k < values_.size(); ++k)
            before = values_[k] = rounded(value_at(k * stride_), before);
        bytes_.add_series(values_);
    }
    std::string text() const { return base64(bytes_.bytes()); }

private:
    std::int64_t rounded(double value, std::int64_t before) const
    {
        return std::isfinite(value) ? std::llround(std::clamp(value, -farthest_, farthest_)) : before;
    }

    double farthest_;
    std::size_t stride_;
    std::vector<std::int64_t> values_;
    NumberBytes bytes_;
};

void add_planar(AnimationBytes& bytes, const Trajectory& t, const AnimationStage& stage)
{
    std::vector<double> half_diagonal; // [quanta], of the rounded sizes: the reader has no others
    for (std::size_t b = 0; b < t.blocks(); ++b) {
        const Rectangle block = rectangle_of(t, 0, b);
        const double width = bytes.add_size(block.half_width / stage.quantum_m());
        const double height = bytes.add_size(block.half_height / stage.quantum_m());
        half_diagonal.push_back(std::hypot(width, height));
    }
    for (std::size_t b = 0; b < t.blocks(); ++b) {
        bytes.add_series([&](std::size_t k) { return (rectangle_of(t, k, b).x - stage.middle_m) / stage.quantum_m(); });
        bytes.add_series([&](std::size_t k) { return rectangle_of(t, k, b).y / stage.quantum_m(); });
        bytes.add_series([&](std::size_t k) { return rectangle_of(t, k, b).turned_rad * half_diagonal[b]; });
    }
    bytes.add_series([&](std::size_t k) { return t["base_x_m"][k] / stage.quantum_m(); });
}

void add_spatial(AnimationBytes& bytes, const Trajectory& t, const AnimationStage& stage)
{
    const double quantum = stage.quantum_m();
    std::vector<double> half_diagonal; // [quanta], of the rounded sizes
    for (std::size_t b = 0; b < t.blocks(); ++b) {
        const SolidShape shape = shape_of(t, b);
        SolidShape rounded;
        rounded.half_height = bytes.add_size(shape.half_height / quantum);
        rounded.bottom.x = bytes.add_size(shape.bottom.x / quantum);
        rounded.bottom.z = bytes.add_size(shape.bottom.z / quantum);
        rounded.top.x = bytes.add_size(shape.top.x / quantum);
        rounded.top.z = bytes.add_size(shape.top.z / quantum);
        half_diagonal.push_back(rounded.half_diagonal());
    }
    const SpacePoint origin = {stage.middle_m, 0, stage.middle_z_m};
    const std::size_t samples = t.time_s.size();
    std::vector<SpacePoint> turns(samples);
    for (std::size_t b = 0; b < t.blocks(); ++b) {
        SpacePoint before = {};
        for (std::size_t k = 0; k < samples; ++k) {
            turns[k] = solid_of(t, k, b).attitude.rotation_vector(before);
            if (std::isfinite(turns[k][0] + turns[k][1] + turns[k][2]))
                before = turns[k];
        }
        for (std::size_t c = 0; c < 3; ++c)
            bytes.add_series([&](std::size_t k) { return (solid_of(t, k, b).middle[c] - origin[c]) / quantum; });
        for (std::size_t c = 0; c < 3; ++c)
            bytes.add_series([&](std::size_t k) { return turns[k][c] * half_diagonal[b]; });
    }
    for (const char* channel : {"base_x_m", "base_y_m", "base_z_m"})
        bytes.add_series([&](std::size_t k) { return t[channel][k] / quantum; });
}

} // namespace

Animation animation_of(const Trajectory& t, const AnimationStage& stage, std::size_t stride)
{
    Animation animation;
    animation.index = t.index;
    animation.samples = (t.time_s.size() + stride - 1) / stride;
    AnimationBytes bytes(stage, animation.samples, stride);
    if (is_spatial(t))
        add_spatial(bytes, t, stage);
    else
        add_planar(bytes, t, stage);
    animation.data = bytes.text();
    return animation;
}

std::string ascending_text(const std::vector<double>& sorted_s, double quantum_s)
{
    NumberBytes bytes;
    std::uint64_t before = 0;
    for (const double time_s : sorted_s) {
        const auto time = static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) / quantum_s));
        bytes.add(time - before);
        before = time;
    }
    return base64(bytes.bytes());
}

Json animation_store(const AnimationStage& stage, double rate_hz, const std::vector<AnimatedBlock>& blocks,
                     const std::optional<SpaceLooks>& looks)
{
    Json names = Json::list(), look = Json::list();
    for (const AnimatedBlock& block : blocks) {
        names.item(block.name);
        look.item(block.look);
    }
    Json store = Json::object();
    store.member("rate_hz", rate_hz)
        .member("px_m", stage.px_m)
        .member("quantum_px", stage.quantum_px)
        .member("width", stage.width_px)
        .member("height", stage.height_px)
        .member("ground", stage.ground_px)
        .member("blocks", names)
        .member("look", look);
    if (looks)
        store.member("dimensions", std::size_t{3})
            .member("pivot", stage.pivot_px)
            .member("reach", stage.reach_px)
            .member("round", Json::brief(looks->round))
            .member("orbits", Json::brief(looks->orbits));
    return store;
}

} // namespace stylobate
