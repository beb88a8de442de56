#include "studies/measured/diagnosis/wrong_windows.hpp"

#include "ensemble/tracking/specimen.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/measured/windows/window_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace stylobate {

namespace {

constexpr double beyond = 2;        // scales: noise and 20 ms of the local motion
constexpr std::size_t pictured = 2; // runs whose worst block is shown
constexpr std::size_t before = 4;   // windows before the worst one, and as many after it
constexpr double noise_band = 2;    // standard deviations

/// Windows in which one coordinate of a block is off, one after the other.
struct Stretch {
    std::size_t run = 0;
    int block = 0; ///< of the specimen
    int coordinate = 0;
    std::size_t first = 0, last = 0; ///< windows
    std::size_t worst = 0;
    double excess = 0; ///< of the worst
};

std::vector<Stretch> stretches_of(const std::vector<WindowPlace>& windows, const std::vector<WindowExcess>& excess)
{
    std::vector<Stretch> done;
    std::map<std::tuple<std::size_t, int, int>, Stretch> open;
    const auto close = [&](auto it) {
        done.push_back(it->second);
        return open.erase(it);
    };
    for (std::size_t w = 0; w < windows.size(); ++w)
        for (const auto& [what, value] : excess[w]) {
            const auto coordinate = static_cast<int>(what.second);
            const auto key = std::tuple{windows[w].run, what.first, coordinate};
            auto it = open.find(key);
            const bool follows = it != open.end() && windows[w].start_s <= windows[it->second.last].end_s + 1e-6;
            if (it != open.end() && (value < beyond || !follows)) {
                close(it);
                it = open.end();
            }
            if (value < beyond)
                continue;
            if (it == open.end())
                it = open.emplace(key, Stretch{windows[w].run, what.first, coordinate, w, w, w, 0}).first;
            Stretch& stretch = it->second;
            stretch.last = w;
            if (value > stretch.excess) {
                stretch.worst = w;
                stretch.excess = value;
            }
        }
    for (auto it = open.begin(); it != open.end();)
        it = close(it);
    std::stable_sort(done.begin(), done.end(), [](const Stretch& a, const Stretch& b) { return a.excess > b.excess; });
    return done;
}

/// What a number is drawn in.
struct Unit {
    const char* name;
    double per_si;
};

Unit unit_of(BlockCoordinate coordinate, double largest)
{
    if (coordinate == BlockCoordinate::theta)
        return largest < 0.1 ? Unit{"mrad", 1000} : Unit{"rad", 1};
    return largest < 1 ? Unit{"mm", 1000} : Unit{"m", 1};
}

/// One coordinate of a block about its worst window: what was seen with its noise, what the baseline makes of it.
DiagnosisFigure curve_figure(const Stretch& stretch, const std::string& run, BlockCoordinate coordinate,
                             const std::vector<std::size_t>& windows, const std::vector<WindowPlace>& places,
                             const std::vector<WindowCurve>& curves, const std::vector<WindowExcess>& excess)
{
    const auto c = static_cast<std::size_t>(coordinate);
    double largest = 0;
    for (const WindowCurve& curve : curves)
        for (const auto* values : {&curve.seen[c], &curve.model[c]})
            for (const double value : *values)
                largest = std::isfinite(value) ? std::max(largest, std::fabs(value)) : largest;
    const Unit unit = unit_of(coordinate, largest);
    const bool known_noise = std::isfinite(curves.front().noise_sd[c]) && curves.front().noise_sd[c] > 0;
    FigureSeries seen{known_noise ? fmt::format("measured, ± {:g} sd of the noise", noise_band) : "measured",
                      SeriesKind::line,
                      {},
                      {},
                      {},
                      {}};
    FigureSeries model{"calibrated baseline, restarted in each window", SeriesKind::line, {}, {}, {}, {}};
    FigureSeries wrong{"error above noise and a short lag", SeriesKind::spans, {}, {}, {}, {}};
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const WindowCurve& curve = curves[k];
        for (std::size_t i = 0; i < curve.time_s.size(); ++i) {
            seen.x.push_back(curve.time_s[i]);
            seen.y.push_back(unit.per_si * curve.seen[c][i]);
            if (known_noise) {
                seen.low.push_back(unit.per_si * (curve.seen[c][i] - noise_band * curve.noise_sd[c]));
                seen.high.push_back(unit.per_si * (curve.seen[c][i] + noise_band * curve.noise_sd[c]));
            }
            model.x.push_back(curve.time_s[i]);
            model.y.push_back(unit.per_si * curve.model[c][i]);
        }
        model.x.push_back(places[windows[k]].end_s); // a gap: the next one starts anew
        model.y.push_back(std::numeric_limits<double>::quiet_NaN());
        const auto found = excess[windows[k]].find({stretch.block, coordinate});
        if (found == excess[windows[k]].end() || found->second < beyond)
            continue;
        const WindowPlace& place = places[windows[k]];
        if (!wrong.y.empty() && place.start_s <= wrong.y.back() + 1e-6) {
            wrong.y.back() = place.end_s;
        } else {
            wrong.x.push_back(place.start_s);
            wrong.y.push_back(place.end_s);
        }
    }
    DiagnosisFigure figure;
    figure.place = FigurePlace::wrong;
    figure.title = fmt::format("Run {}, {}, {}.", run, block_words(stretch.block),
                               coordinate == BlockCoordinate::theta ? "rotation" : "horizontal displacement");
    figure.caption = "Measured and simulated motion. The simulation starts from the measured motion at the beginning "
                     "of each window and runs freely to its end; grey: windows with significant errors.";
    figure.x_label = "time, the cameras' clock [s]";
    figure.y_label =
        fmt::format("{} [{}]", coordinate == BlockCoordinate::theta ? "rotation" : "displacement", unit.name);
    figure.series = {std::move(seen), std::move(model)};
    if (!wrong.x.empty())
        figure.series.push_back(std::move(wrong));
    return figure;
}

/// The windows about the worst one of a stretch, of its run.
std::vector<std::size_t> windows_about(const Stretch& stretch, const std::vector<WindowPlace>& places)
{
    std::vector<std::size_t> windows;
    const std::size_t from = stretch.worst - std::min(stretch.worst, before);
    for (std::size_t w = from; w < std::min(stretch.worst + before + 1, places.size()); ++w)
        if (places[w].run == stretch.run)
            windows.push_back(w);
    return windows;
}

} // namespace

WrongWindows wrong_windows(const Campaign& campaign, const Study& baseline, std::size_t most, const RunOptions& options,
                           SimulationCount& count, Observer& observer)
{
    WrongWindows found;
    const SpecimenStructure built = build_specimen(campaign.specimen);
    WindowComparison comparison(campaign, {});
    const std::vector<WindowPlace>& places = comparison.windows();
    if (places.empty())
        return found;
    ModelVariant variant;
    variant.study = baseline;
    const std::vector<WindowResiduals> residuals = comparison.residuals({variant}, options, observer);
    if (!residuals.empty()) {
        const std::vector<WindowExcess> excess = excess_of(comparison, residuals.front(), built);
        const std::vector<Stretch> stretches = stretches_of(places, excess);
        found.shown = choose_windows(places, excess);
        std::set<std::size_t> shown; // the blocks of a run are off together
        for (const Stretch& s : stretches) {
            const std::string& run = campaign.runs[s.run].name;
            if (found.stretches.size() < most)
                found.stretches.push_back({run, s.block, coordinate_names[s.coordinate], places[s.first].start_s,
                                           places[s.last].end_s, s.excess});
            if (s.block < 0 || shown.size() == pictured || !shown.insert(s.run).second)
                continue;
            const std::vector<std::size_t> windows = windows_about(s, places);
            const std::vector<WindowCurve> curves = comparison.curves(
                variant, windows, {static_cast<std::size_t>(built.block[static_cast<std::size_t>(s.block)])}, options,
                observer);
            if (curves.empty())
                break;
            for (const BlockCoordinate coordinate : {BlockCoordinate::x, BlockCoordinate::theta})
                found.figures.push_back(curve_figure(s, run, coordinate, windows, places, curves, excess));
        }
    }
    count += comparison.cost();
    return found;
}

} // namespace stylobate
