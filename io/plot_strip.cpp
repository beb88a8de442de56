#include "io/plot_strip.hpp"

#include "ensemble/input_error.hpp"
#include "io/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>

namespace stylobate {
namespace {

constexpr std::size_t least_snapshots = 2;
constexpr std::size_t most_snapshots = 16;

/// What a length is drawn in.
struct Unit {
    const char* name;
    double per_metre;
};

/// @param largest length to be drawn [m]
Unit unit_for(double largest)
{
    return largest < 1 ? Unit{"mm", 1000} : Unit{"m", 1};
}

/// The title of a vertical axis, at the same place beside each plot however long its tics' labels are.
std::string axis_title(const char* what, const Unit& unit, double bottom, double top)
{
    return fmt::format("set label '{} [{}]' at screen 0.017, screen {} center rotate by 90\n", what, unit.name,
                       (bottom + top) / 2);
}

/// The largest of 1, 2, 5, 10, 20... that is not above `length` (> 0).
double round_step(double length)
{
    const double decade = std::pow(10.0, std::floor(std::log10(length)));
    return decade * (length >= 5 * decade ? 5 : length >= 2 * decade ? 2 : 1);
}

/// Samples up to the first that is not finite.
/// @throws InputError as `plot_strip`
std::size_t finite_samples(const Trajectory& t)
{
    const std::size_t blocks = t.blocks();
    const std::size_t samples = t.time_s.size();
    if (t.half_height_m.size() != blocks || t.base_x_m.size() != samples || t.x_m.size() != samples * blocks ||
        t.y_m.size() != samples * blocks || t.theta_rad.size() != samples * blocks)
        throw InputError(fmt::format("the trajectory of realization {} has tables of different sizes: it is damaged.\n"
                                     "  Replay the realization into a new file.",
                                     t.index));
    for (std::size_t i = 0; i < blocks; ++i)
        if (!(t.half_width_m[i] > 0 && t.half_height_m[i] > 0) ||
            !std::isfinite(t.half_width_m[i] * t.half_height_m[i]))
            throw InputError(fmt::format("block {} of realization {} is {} m by {} m: the trajectory is damaged.\n"
                                         "  Replay the realization into a new file.",
                                         i, t.index, 2 * t.half_width_m[i], 2 * t.half_height_m[i]));
    std::size_t good = 0;
    const auto finite = [&](std::size_t s) {
        bool all = std::isfinite(t.time_s[s]) && std::isfinite(t.base_x_m[s]);
        for (std::size_t k = s * blocks; k < (s + 1) * blocks; ++k)
            all = all && std::isfinite(t.x_m[k]) && std::isfinite(t.y_m[k]) && std::isfinite(t.theta_rad[k]);
        return all;
    };
    while (good < samples && finite(good))
        ++good;
    if (good == 0 || blocks == 0)
        throw InputError(
            fmt::format("the trajectory of realization {} has no sample to draw.\n  Replay the realization, "
                        "and see that output.trajectory_rate_hz is high enough.",
                        t.index));
    return good;
}

/// The blocks that are drawn as drums, and which of them are fixed to the base.
struct Drums {
    std::vector<std::size_t> drawn; ///< indices of blocks
    std::vector<bool> fixed;        ///< for each of `drawn`
};

Drums find_drums(const Trajectory& t, std::size_t samples)
{
    const std::size_t blocks = t.blocks();
    Drums drums;
    for (std::size_t i = 0; i < blocks; ++i) {
        const double top = t.y_m[i] + t.half_height_m[i];
        if (top <= 1e-6 * t.half_height_m[i])
            continue; // the ground
        bool moves = false;
        for (std::size_t s = 1; s < samples && !moves; ++s)
            moves = t.x_m[s * blocks + i] != t.x_m[i] || t.y_m[s * blocks + i] != t.y_m[i] ||
                    t.theta_rad[s * blocks + i] != t.theta_rad[i];
        drums.drawn.push_back(i);
        drums.fixed.push_back(!moves);
    }
    if (drums.drawn.empty())
        throw InputError(fmt::format("the trajectory of realization {} has no block above its base (y = 0).\n"
                                     "  Heights are to be counted from the top of the base, in metres.",
                                     t.index));
    // In a column where nothing moves nothing can be told.
    if (std::all_of(drums.fixed.begin(), drums.fixed.end(), [](bool f) { return f; }))
        drums.fixed.assign(drums.fixed.size(), false);
    return drums;
}

struct Corner {
    double x;
    double y;
};

std::array<Corner, 4> corners(const Trajectory& t, std::size_t sample, std::size_t block)
{
    const std::size_t k = sample * t.blocks() + block;
    const double c = std::cos(t.theta_rad[k]);
    const double s = std::sin(t.theta_rad[k]);
    std::array<Corner, 4> found{};
    constexpr std::array<std::array<int, 2>, 4> signs{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const double u = signs[i][0] * t.half_width_m[block];
        const double v = signs[i][1] * t.half_height_m[block];
        found[i] = {t.x_m[k] + c * u - s * v, t.y_m[k] + s * u + c * v};
    }
    return found;
}

/// How far the blocks are from where they started, in all.
double departure(const Trajectory& t, std::size_t sample, std::size_t from)
{
    const std::size_t blocks = t.blocks();
    double sum = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::size_t a = sample * blocks + i;
        const std::size_t b = from * blocks + i;
        sum += std::hypot(t.x_m[a] - t.x_m[b], t.y_m[a] - t.y_m[b]) +
               std::abs(t.theta_rad[a] - t.theta_rad[b]) * t.half_height_m[i];
    }
    return sum;
}

std::vector<std::size_t> choose_samples(const Trajectory& t, std::size_t samples, std::size_t snapshots)
{
    if (snapshots < least_snapshots || snapshots > most_snapshots)
        throw InputError(fmt::format("{} snapshots are outside [{}, {}].\n  Ask for 8, for example.", snapshots,
                                     least_snapshots, most_snapshots));
    if (samples <= snapshots) {
        std::vector<std::size_t> all(samples);
        for (std::size_t s = 0; s < samples; ++s)
            all[s] = s;
        return all;
    }
    // The clock of the stretches runs a quarter with the time, the rest with the way that the blocks have gone.
    std::vector<double> way(samples, 0.0);
    for (std::size_t s = 1; s < samples; ++s)
        way[s] = way[s - 1] + departure(t, s, s - 1);
    const auto clock = [&](std::size_t s) {
        const double share = static_cast<double>(s) / static_cast<double>(samples - 1);
        return way.back() > 0 ? 0.25 * share + 0.75 * way[s] / way.back() : share;
    };
    std::vector<std::size_t> chosen{0};
    std::size_t s = 1;
    const auto stretches = static_cast<double>(snapshots - 1);
    for (std::size_t k = 1; k + 1 < snapshots; ++k) {
        const std::size_t latest = samples - snapshots + k; // leaves a sample for each stretch to come
        std::size_t best = s;
        double farthest = -1;
        do {
            const double d = departure(t, s, 0);
            // In a column at rest the end of the stretch, so that the times are even.
            if (d >= farthest) {
                farthest = d;
                best = s;
            }
            ++s;
        } while (s <= latest && clock(s) <= static_cast<double>(k) / stretches);
        chosen.push_back(best);
    }
    chosen.push_back(samples - 1);
    return chosen;
}

/// The rectangle of the strip in the picture, in parts of it.
struct Frame {
    double left = 0.1;
    double right = 0.985;
    double bottom = 0.475;
    double top = 0.865;
};

/// Script of the strip: the snapshots side by side, one scale for both axes.
std::string strip_script(const Trajectory& t, const Drums& drums, const std::vector<std::size_t>& chosen,
                         PictureSize size)
{
    const Frame frame;
    // What each snapshot needs.
    std::vector<double> left(chosen.size());
    std::vector<double> right(chosen.size());
    double low = 0;
    double high = 0;
    double widest = 0;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        left[n] = std::numeric_limits<double>::infinity();
        right[n] = -left[n];
        for (const std::size_t block : drums.drawn) {
            widest = std::max(widest, 2 * t.half_width_m[block]);
            for (const Corner& c : corners(t, chosen[n], block)) {
                left[n] = std::min(left[n], c.x);
                right[n] = std::max(right[n], c.x);
                low = std::min(low, c.y);
                high = std::max(high, c.y);
            }
        }
    }
    const double overhang = std::max(0.15 * widest, 0.02 * (high - low));
    double needed = 0;
    for (std::size_t n = 0; n < chosen.size(); ++n)
        needed += right[n] - left[n] + 2 * overhang;
    const auto count = static_cast<double>(chosen.size());
    const double least_gap = 0.5 * overhang;
    const double slab = 0.035 * (high - low);
    const double height = 1.03 * (high - low) + slab;

    // One scale, and what is left of the width goes between the snapshots.
    const double pixels_x = (frame.right - frame.left) * size.width;
    const double pixels_y = (frame.top - frame.bottom) * size.height;
    const double scale = std::min(pixels_x / (needed + least_gap * count), pixels_y / height);
    const double width = pixels_x / scale;
    const double gap = (width - needed) / count;
    const Unit unit = unit_for(pixels_y / scale);

    std::string free_drums = "$free << EOD\n";
    std::string fixed_drums = "$fixed << EOD\n";
    std::string base = "$base << EOD\n";
    std::string labels;
    const auto rectangle = [&](const std::array<Corner, 4>& c, double shift) {
        std::string text;
        for (std::size_t i = 0; i <= 4; ++i)
            text += fmt::format("{} {}\n", (c[i % 4].x + shift) * unit.per_metre, c[i % 4].y * unit.per_metre);
        return text + '\n';
    };
    const double span = t.time_s[chosen.back()] - t.time_s[chosen.front()];
    const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(span, 1e-9)))), 0, 6);
    double narrowest = width;
    for (std::size_t n = 0; n < chosen.size(); ++n)
        narrowest = std::min(narrowest, right[n] - left[n] + 2 * overhang + gap);
    const double label_font = std::min(21.0, 1.4 * narrowest * scale / (decimals + 5));
    double cursor = gap / 2;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
        const double cell = right[n] - left[n] + 2 * overhang;
        const double shift = cursor + overhang - left[n];
        for (std::size_t d = 0; d < drums.drawn.size(); ++d)
            (drums.fixed[d] ? fixed_drums : free_drums) += rectangle(corners(t, chosen[n], drums.drawn[d]), shift);
        base += rectangle({{{cursor, -slab}, {cursor + cell, -slab}, {cursor + cell, 0}, {cursor, 0}}}, 0);
        labels +=
            fmt::format("set label '{:.{}f} s' at first {}, screen {} center font ',{:.1f}'\n", t.time_s[chosen[n]],
                        decimals, (cursor + cell / 2) * unit.per_metre, frame.bottom - 0.022, label_font);
        cursor += cell + gap;
    }
    std::string script = free_drums + "EOD\n" + fixed_drums + "EOD\n" + base + "EOD\n" + labels;
    script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
                          "set tmargin at screen {}\nset xrange [0:{}]\nset yrange [{}:{}]\n",
                          frame.left, frame.right, frame.bottom, frame.top, width * unit.per_metre,
                          (low - slab) * unit.per_metre, (low - slab + pixels_y / scale) * unit.per_metre);
    script += "set border 2 linewidth 0.8\nset ytics out nomirror\nunset xtics\n";
    script += axis_title("height", unit, frame.bottom, frame.top);
    script += "plot ";
    const auto layer = [&](const char* name, const char* fill, const char* line) {
        script += fmt::format("{0} with filledcurves closed fillcolor rgb '{1}' fillstyle solid 1 noborder, "
                              "{0} with lines linecolor rgb '{2}' linewidth 0.7",
                              name, fill, line);
    };
    layer("$base", "#6f6f6f", "#6f6f6f");
    if (std::find(drums.fixed.begin(), drums.fixed.end(), true) != drums.fixed.end()) {
        script += ", ";
        layer("$fixed", "#a89a7d", "#4a3b24");
    }
    script += ", ";
    layer("$free", "#ead9b5", "#4a3b24");
    return script + '\n';
}

/// A panel of one displacement over time.
struct Panel {
    const char* name; ///< of its data
    const char* label;
    const char* colour;
    double bottom; ///< in parts of the picture
    double top;
    bool has_time_axis;
};

std::string panel_script(const Panel& panel, const Trajectory& t, const std::vector<std::size_t>& chosen,
                         const std::vector<double>& displacement_m)
{
    const auto [least_m, most_m] = std::minmax_element(displacement_m.begin(), displacement_m.end());
    const Unit unit = unit_for(std::max(std::abs(*least_m), std::abs(*most_m)));
    const double least = *least_m * unit.per_metre;
    const double most = *most_m * unit.per_metre;
    const double span = most > least ? most - least : std::max(1.0, std::abs(most));
    std::string script = fmt::format("{} << EOD\n", panel.name);
    for (std::size_t s = 0; s < displacement_m.size(); ++s)
        fmt::format_to(std::back_inserter(script), "{} {}\n", t.time_s[s], displacement_m[s] * unit.per_metre);
    script += fmt::format("EOD\n{}marks << EOD\n", panel.name);
    for (const std::size_t s : chosen)
        script += fmt::format("{} {}\n", t.time_s[s], displacement_m[s] * unit.per_metre);
    script += "EOD\n";

    const Frame frame;
    script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\n"
                          "set tmargin at screen {}\n",
                          frame.left, frame.right, panel.bottom, panel.top);
    const double first = t.time_s.front();
    const double last = t.time_s[displacement_m.size() - 1];
    script += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", first, last > first ? last : first + 1,
                          least - 0.06 * span, most + 0.06 * span);
    script += fmt::format("set border 3 linewidth 0.8\nset ytics out nomirror {}\nset xtics out nomirror {}\n"
                          "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.5\n",
                          round_step(span / 2.4), panel.has_time_axis ? "format '%g'" : "format ''");
    script += "unset label\n" + axis_title(panel.label, unit, panel.bottom, panel.top);
    if (panel.has_time_axis)
        script += "set xlabel 'time [s]' offset 0,0.3\n";
    script += fmt::format("plot {0} with lines linecolor rgb '{1}' linewidth 1, {0}marks with points pointtype 7 "
                          "pointsize 1.2 linecolor rgb '{1}'\n",
                          panel.name, panel.colour);
    return script;
}

std::string subtitle(const Trajectory& t, const Drums& drums, std::size_t samples)
{
    const auto fixed = std::count(drums.fixed.begin(), drums.fixed.end(), true);
    std::string text = fmt::format("{} {}", drums.drawn.size(), drums.drawn.size() == 1 ? "drum" : "drums");
    if (fixed > 0)
        text += fmt::format(", {} fixed (darker)", fixed);
    text += " · drawn to scale in the frame of the base";
    if (samples < t.time_s.size())
        text += fmt::format(" · not finite after {:.4g} s", t.time_s[samples - 1]);
    return text;
}

} // namespace

std::vector<std::size_t> snapshot_samples(const Trajectory& trajectory, std::size_t snapshots)
{
    return choose_samples(trajectory, finite_samples(trajectory), snapshots);
}

void plot_strip(const Trajectory& trajectory, const std::string& title, const std::filesystem::path& png,
                std::size_t snapshots)
{
    const std::size_t samples = finite_samples(trajectory);
    const std::vector<std::size_t> chosen = choose_samples(trajectory, samples, snapshots);
    const Drums drums = find_drums(trajectory, samples);
    const PictureSize size;

    const std::size_t blocks = trajectory.blocks();
    const std::size_t top = drums.drawn.back();
    std::vector<double> top_m(samples);
    for (std::size_t s = 0; s < samples; ++s)
        top_m[s] = trajectory.x_m[s * blocks + top] - trajectory.x_m[top];
    const std::vector<double> base_m(trajectory.base_x_m.begin(),
                                     trajectory.base_x_m.begin() + static_cast<std::ptrdiff_t>(samples));

    std::string script = "set multiplot\nunset key\n" + gnuplot_heading(title, subtitle(trajectory, drums, samples)) +
                         strip_script(trajectory, drums, chosen, size);
    script += panel_script({"$top", "top", "#0072b2", 0.275, 0.415, false}, trajectory, chosen, top_m);
    script += panel_script({"$ground", "base", "#d55e00", 0.095, 0.235, true}, trajectory, chosen, base_m);
    script += "unset multiplot\n";
    run_gnuplot(script, size, png);
}

} // namespace stylobate
