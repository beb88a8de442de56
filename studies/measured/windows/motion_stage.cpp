#include "studies/measured/windows/motion_stage.hpp"

#include "ensemble/model/structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace stylobate {
namespace {

constexpr double farthest_px = 50; ///< that a corner is drawn away from where it rests, or half of the widest block
constexpr double apart_px = 25;    ///< that it is drawn away from the measured one in the first window, or a quarter
constexpr double inside_px = 60;   ///< the same in any window
constexpr double even = 0.02;      ///< of the spacing of samples

constexpr double sizes[] = {100, 50, 20, 10, 5, 2};

/// The largest of the sizes, or 1, that leaves a length within its room.
double size_within(double length_px, double room_px)
{
    const auto* const found = std::ranges::find_if(sizes, [&](double size) { return size * length_px <= room_px; });
    return found == std::end(sizes) ? 1 : *found;
}

/// How far a corner moves at the most [m]; 0 where one of the places is not known.
double moved(const BlockPlace& a, const BlockPlace& b, const ShownBlock& block)
{
    const double turned = (b.theta_rad - a.theta_rad) * std::hypot(block.half_width_m, block.half_height_m);
    const double most = std::max({std::abs(b.x_m - a.x_m), std::abs(b.y_m - a.y_m), std::abs(turned)});
    return std::isfinite(b.x_m + a.x_m + b.y_m + a.y_m + turned) ? most : 0;
}

/// The sample before the k-th of as many even times, and the share of the way to the next one.
std::pair<std::size_t, double> place_of(const std::vector<MotionSample>& samples, std::size_t k)
{
    const std::size_t n = samples.size();
    const double first = samples.front().time_s;
    const double spacing = (samples.back().time_s - first) / static_cast<double>(n - 1);
    const double time = first + static_cast<double>(k) * spacing;
    if (std::abs(samples[k].time_s - time) <= even * spacing)
        return {k, 0};
    const auto after = std::ranges::upper_bound(samples, time, {}, &MotionSample::time_s);
    const auto row = std::clamp<std::ptrdiff_t>(after - samples.begin() - 1, 0, static_cast<std::ptrdiff_t>(n) - 2);
    const MotionSample &a = samples[static_cast<std::size_t>(row)], &b = samples[static_cast<std::size_t>(row) + 1];
    return {static_cast<std::size_t>(row), std::clamp((time - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0)};
}

} // namespace

MotionStage::MotionStage(const WindowMotions& motion) : motion_(motion), free_(motion.free_blocks())
{
    ground_m_ = std::numeric_limits<double>::infinity();
    for (const ShownBlock& block : motion.blocks)
        ground_m_ = std::min(ground_m_, block.rest_y_m - block.half_height_m);
    std::vector<PlacedBlock> placed;
    for (const ShownBlock& block : motion.blocks) {
        PlacedBlock& at = placed.emplace_back();
        at.width_m = 2 * block.half_width_m;
        at.height_m = 2 * block.half_height_m;
        at.axis_m = block.rest_x_m;
        at.y_m = block.rest_y_m - ground_m_;
    }
    scale_ = animation_stage(placed);

    for (std::size_t b = free_; b < motion.blocks.size(); ++b) {
        shown_.push_back(b);
        blocks_.push_back({"fixed block", "fixed"});
    }
    const std::vector<MotionTrack>& tracks = motion.windows.front().tracks;
    for (std::size_t i = 1; i <= tracks.size(); ++i) {
        const std::size_t track = i % tracks.size(); // the measured one is the last
        std::string name = model_words(tracks[track].model);
        if (name.starts_with("the "))
            name = name.substr(4);
        layers_.push_back({track, name, track == 0 ? "measured" : fmt::format("model{}", track), shown_.size()});
        for (std::size_t b = 0; b < free_; ++b) {
            shown_.push_back(b);
            blocks_.push_back({fmt::format("block {}", b), layers_.back().look});
        }
    }
    for (const std::size_t b : shown_)
        rest_px_.push_back({(motion.blocks[b].rest_x_m - scale_.middle_m) * scale_.px_m,
                            (motion.blocks[b].rest_y_m - ground_m_) * scale_.px_m});
    choose_sizes();
}

void MotionStage::choose_sizes()
{
    double from_rest = 0, widest = 0;
    std::vector<double> from_measured; // (windows)
    for (std::size_t b = 0; b < free_; ++b)
        widest = std::max(widest, 2 * motion_.blocks[b].half_width_m);
    for (const WindowMotion& window : motion_.windows) {
        double& apart = from_measured.emplace_back(0);
        for (const MotionTrack& track : window.tracks)
            for (std::size_t i = 0; i < track.places.size(); ++i) {
                const ShownBlock& block = motion_.blocks[i % free_];
                from_rest = std::max(from_rest, moved({block.rest_x_m, block.rest_y_m, 0}, track.places[i], block));
                apart = std::max(apart, moved(window.tracks.front().places[i], track.places[i], block));
            }
    }
    const double px_m = scale_.px_m;
    larger_ = size_within(from_rest * px_m, std::min(farthest_px, widest * px_m / 2));
    apart_ =
        std::max(larger_, std::min(size_within(from_measured.front() * px_m, std::min(apart_px, widest * px_m / 4)),
                                   size_within(*std::ranges::max_element(from_measured) * px_m, inside_px)));
}

std::size_t MotionStage::farthest(const WindowMotions& motion, const WindowMotion& window)
{
    const std::size_t free = motion.free_blocks();
    std::size_t sample = window.samples.size() - 1;
    double most = 0;
    for (std::size_t i = 0; i < window.tracks[1].places.size(); ++i)
        if (const double apart = moved(window.tracks[0].places[i], window.tracks[1].places[i], motion.blocks[i % free]);
            apart > most) {
            most = apart;
            sample = i / free;
        }
    return sample;
}

Trajectory MotionStage::trajectory(const WindowMotion& window) const
{
    const std::size_t n = window.samples.size();
    Trajectory t;
    for (const std::size_t b : shown_) {
        t.half_width_m.push_back(motion_.blocks[b].half_width_m);
        t.half_height_m.push_back(motion_.blocks[b].half_height_m);
    }
    for (std::size_t k = 0; k < n; ++k) {
        const auto [row, share] = place_of(window.samples, k);
        const std::size_t next = share > 0 ? row + 1 : row; // at a sample its neighbour does not count, known or not
        const auto between = [share = share](double a, double b) { return a + share * (b - a); };
        t.time_s.push_back(between(window.samples[row].time_s, window.samples[next].time_s));
        t.base_x_m.push_back(between(window.samples[row].base_x_m, window.samples[next].base_x_m));
        const auto add = [&](double x_m, double y_m, double theta_rad) {
            t.x_m.push_back(x_m);
            t.y_m.push_back(y_m - ground_m_);
            t.theta_rad.push_back(theta_rad);
        };
        for (std::size_t b = free_; b < motion_.blocks.size(); ++b)
            add(motion_.blocks[b].rest_x_m, motion_.blocks[b].rest_y_m, 0);
        for (const MotionLayer& layer : layers_)
            for (std::size_t b = 0; b < free_; ++b) {
                const std::vector<BlockPlace>& places = window.tracks[layer.track].places;
                const BlockPlace &a = places[row * free_ + b], &c = places[next * free_ + b];
                add(between(a.x_m, c.x_m), between(a.y_m, c.y_m), between(a.theta_rad, c.theta_rad));
            }
    }
    return t;
}

std::array<double, 3> MotionStage::drawn(const Trajectory& t, std::size_t sample, std::size_t block) const
{
    const std::size_t first = sample * t.blocks(), measured_first = layers_.back().first;
    const auto larger = [&](std::size_t b) -> std::array<double, 3> {
        const std::size_t at = first + b;
        const auto [rest_x, rest_y] = rest_px_[b];
        return {rest_x + larger_ * ((t.x_m[at] - scale_.middle_m) * scale_.px_m - rest_x),
                rest_y + larger_ * (t.y_m[at] * scale_.px_m - rest_y), larger_ * t.theta_rad[at]};
    };
    std::array<double, 3> place = larger(block);
    if (block < fixed() || block >= measured_first)
        return place;
    const std::size_t measured = measured_first + (block - fixed()) % free_;
    if (!is_known(t, first + measured))
        return place;
    const std::array<double, 3> from = larger(measured);
    for (std::size_t c = 0; c < 3; ++c)
        place[c] = from[c] + apart_ / larger_ * (place[c] - from[c]);
    return place;
}

std::string model_words(const std::string& model)
{
    return model == "baseline"     ? "the calibrated baseline"
           : model == "extended"   ? "the extended study"
           : model == "calibrated" ? "the calibrated study"
           : model == "start"      ? "the start study"
                                   : model;
}

std::string choice_words(const WindowMotion& window)
{
    return window.choice == WindowChoice::typical ? "typical: the median"
           : window.rank == 1                     ? "worst of all"
                                                  : "worst of its run";
}

bool is_known(const Trajectory& trajectory, std::size_t place)
{
    return std::isfinite(trajectory.x_m[place]) && std::isfinite(trajectory.y_m[place]) &&
           std::isfinite(trajectory.theta_rad[place]);
}

} // namespace stylobate
