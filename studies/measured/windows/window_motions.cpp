#include "studies/measured/windows/window_motions.hpp"

#include "ensemble/model/observer.hpp"
#include "ensemble/model/structure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <tuple>

namespace stylobate {
namespace {

constexpr double most_square = 1e4; ///< of a residual

/// The worst of a window's errors.
struct Largest {
    int block = -1;
    std::string coordinate;
    std::optional<double> excess;
};

Largest largest_of(const WindowExcess& excess)
{
    Largest largest;
    for (const auto& [what, value] : excess)
        if (!largest.excess || value > *largest.excess)
            largest = {what.first, coordinate_names[static_cast<std::size_t>(what.second)], value};
    return largest;
}

/// Those of the specimen in their order, then the fixed ones.
std::vector<ShownBlock> shown_blocks(const SpecimenStructure& built)
{
    const Layout layout = lay_out(built.structure);
    std::vector<ShownBlock> shown;
    const auto add = [&](const PlacedBlock& block, ShownBlockKind kind) {
        shown.push_back({kind, block.width_m / 2, block.height_m / 2, block.x_m() + built.origin_x_m,
                         block.y_m + built.origin_y_m});
    };
    for (const int place : built.block) {
        const PlacedBlock& block = layout.blocks[static_cast<std::size_t>(place)];
        add(block, block.role == BlockRole::epistyle ? ShownBlockKind::epistyle : ShownBlockKind::drum);
    }
    for (const PlacedBlock& block : layout.blocks)
        if (block.fixed)
            add(block, ShownBlockKind::fixed);
    return shown;
}

/// Number of samples of a window that are kept.
std::size_t kept_samples(std::size_t all, std::size_t most)
{
    const std::size_t stride = (all + most - 1) / most;
    return (all + stride - 1) / stride;
}

std::size_t samples_in(const MeasuredRun& run, const WindowPlace& place)
{
    return static_cast<std::size_t>(std::ranges::count_if(run.time_s, [&](double t) {
        const double since_s = t - run.time_s.front();
        return since_s > place.free_s && since_s <= place.end_s - place.start_s + place.free_s;
    }));
}

/// What the file has of a moment [bytes]: numbers and the row of what they belong to.
std::size_t sample_bytes(std::size_t blocks, std::size_t tracks)
{
    return 3 * sizeof(double) + tracks * blocks * 4 * sizeof(double);
}

/// As many of the first windows as the budget holds, two at least.
std::vector<ChosenWindow> within_budget(const Campaign& campaign, const std::vector<ChosenWindow>& chosen,
                                        std::size_t bytes_a_sample, std::size_t most_samples, double budget_mb)
{
    std::vector<ChosenWindow> kept;
    double bytes = 0;
    for (const ChosenWindow& window : chosen) {
        const std::size_t all = samples_in(campaign.runs[window.place.run], window.place);
        bytes += static_cast<double>(kept_samples(all, most_samples) * bytes_a_sample);
        if (kept.size() >= 2 && bytes > 1e6 * budget_mb)
            break;
        kept.push_back(window);
    }
    return kept;
}

class Filming {
public:
    Filming(const SpecimenStructure& built, const std::vector<ChosenWindow>& chosen, std::size_t most_samples)
        : built_(built), chosen_(chosen), most_samples_(most_samples), blocks_(shown_blocks(built)),
          windows_(chosen.size())
    {
        for (const int place : built.block)
            order_.push_back(static_cast<std::size_t>(place));
        // a comparison has its windows by run and time
        by_time_.resize(chosen.size());
        std::iota(by_time_.begin(), by_time_.end(), std::size_t{0});
        std::ranges::sort(by_time_, {},
                          [&](std::size_t i) { return std::tuple(chosen[i].place.run, chosen[i].place.free_s); });
    }

    /// @return false if the observer stopped it
    bool add(const ShownModel& model, const WindowOptions& windows, const RunOptions& options, SimulationCount& cost,
             Observer& observer)
    {
        WindowOptions which = windows;
        which.runs.clear();
        for (const std::size_t i : by_time_) {
            which.places.push_back(chosen_[i].place);
            which.runs.push_back(chosen_[i].place.run);
        }
        WindowComparison comparison(model.campaign, which);
        std::vector<std::size_t> all(comparison.windows().size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        const std::vector<WindowResiduals> residuals = comparison.residuals({model.variant}, options, observer);
        const std::vector<WindowCurve> curves = comparison.curves(model.variant, all, order_, options, observer);
        cost += comparison.cost();
        if (residuals.empty() || curves.size() != all.size() || all.size() != chosen_.size())
            return false;
        const std::vector<WindowExcess> excess = excess_of(comparison, residuals.front(), built_);
        for (std::size_t w = 0; w < all.size(); ++w) {
            WindowMotion& window = windows_[by_time_[w]];
            if (window.tracks.empty())
                begin(window, chosen_[by_time_[w]], model.campaign, curves[w]);
            window.tracks.push_back(track(model.name, largest_of(excess[w]), curves[w], curves[w].model, window));
        }
        return true;
    }

    WindowMotions take() { return {std::move(blocks_), std::move(windows_)}; }

private:
    /// The window without its models.
    void begin(WindowMotion& window, const ChosenWindow& chosen, const Campaign& campaign, const WindowCurve& curve)
    {
        window.choice = chosen.choice;
        window.run = campaign.runs[chosen.place.run].name;
        window.from_s = chosen.place.start_s;
        window.to_s = chosen.place.end_s;
        window.rank = chosen.rank;
        window.ranked = chosen.ranked;
        for (const std::size_t k : kept(curve))
            window.samples.push_back({curve.time_s[k], curve.base_m[k]});
        window.tracks.push_back(track("measured", {}, curve, curve.seen, window));
    }

    std::vector<std::size_t> kept(const WindowCurve& curve) const
    {
        const std::size_t n = curve.time_s.size(), samples = kept_samples(n, most_samples_);
        const std::size_t stride = (n + most_samples_ - 1) / most_samples_;
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < samples; ++i)
            rows.push_back(n - 1 - (samples - 1 - i) * stride);
        return rows;
    }

    MotionTrack track(const std::string& model, const Largest& largest, const WindowCurve& curve,
                      const std::array<std::vector<double>, coordinate_count>& moved, const WindowMotion& window) const
    {
        MotionTrack track{model, largest.excess, largest.block, largest.coordinate, {}};
        const std::vector<std::size_t> rows = kept(curve);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t b = 0; b < order_.size(); ++b) {
                const std::size_t at = rows[i] * order_.size() + b;
                // a model may be driven by another base motion than the measured one
                const double base_m = curve.base_m[rows[i]] - window.samples[i].base_x_m;
                track.places.push_back(
                    {curve.stood_x_m[b] + moved[0][at] + base_m, blocks_[b].rest_y_m + moved[1][at], moved[2][at]});
            }
        return track;
    }

    const SpecimenStructure& built_;
    const std::vector<ChosenWindow>& chosen_;
    const std::size_t most_samples_;
    std::vector<ShownBlock> blocks_;
    std::vector<WindowMotion> windows_;
    std::vector<std::size_t> order_;   ///< (blocks of the specimen) in the layout
    std::vector<std::size_t> by_time_; ///< the chosen ones by run and time
};

} // namespace

std::vector<WindowExcess> excess_of(const WindowComparison& comparison, const WindowResiduals& residuals,
                                    const SpecimenStructure& built)
{
    std::map<int, int> block_of; // of the layout -> of the specimen
    for (std::size_t b = 0; b < built.block.size(); ++b)
        block_of[built.block[b]] = static_cast<int>(b);
    std::vector<WindowExcess> excess;
    for (std::size_t w = 0; w < residuals.size(); ++w) {
        std::map<std::pair<int, BlockCoordinate>, std::pair<double, int>> square;
        for (std::size_t k = 0; k < residuals[w].size(); ++k) {
            const SeenValue& seen = comparison.seen(w)[k];
            auto& [sum, n] = square[{block_of[static_cast<int>(seen.block)], seen.coordinate}];
            sum += std::min(std::pow(residuals[w][k], 2), most_square);
            ++n;
        }
        excess.emplace_back();
        for (const auto& [what, sum] : square)
            excess.back()[what] = std::sqrt(sum.first / sum.second);
    }
    return excess;
}

std::vector<ChosenWindow> choose_windows(const std::vector<WindowPlace>& windows,
                                         const std::vector<WindowExcess>& excess)
{
    std::vector<std::size_t> order;
    std::vector<double> error(windows.size(), 0);
    for (std::size_t w = 0; w < windows.size(); ++w)
        if (const Largest largest = largest_of(excess[w]); largest.excess) {
            error[w] = *largest.excess;
            order.push_back(w);
        }
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t w) { return error[w]; });
    std::vector<ChosenWindow> chosen;
    std::set<std::size_t> runs;
    const std::size_t middle = order.size() / 2;
    for (std::size_t i = 0; i < order.size() && chosen.size() < most_shown_windows; ++i) {
        if (!runs.insert(windows[order[i]].run).second)
            continue;
        chosen.push_back({windows[order[i]], WindowChoice::worst, i + 1, order.size()});
        if (i == 0 && middle > 0)
            chosen.push_back({windows[order[middle]], WindowChoice::typical, middle + 1, order.size()});
    }
    // the worst window of a run may be the median one, too
    std::erase_if(chosen, [&](const ChosenWindow& window) {
        return window.choice == WindowChoice::worst && window.rank == middle + 1 && middle > 0;
    });
    return chosen;
}

std::optional<WindowMotions> window_motions(const std::vector<ChosenWindow>& chosen,
                                            const std::vector<ShownModel>& models, const WindowOptions& windows,
                                            const RunOptions& options, SimulationCount& cost, Observer& observer,
                                            double budget_mb)
{
    const Campaign& measured = models.front().campaign;
    const SpecimenStructure built = build_specimen(measured.specimen);
    const std::size_t bytes = sample_bytes(built.block.size(), models.size() + 1);
    const auto half = static_cast<std::size_t>(0.5e6 * budget_mb) / bytes; // the first two fit in any case
    const std::size_t most_samples = std::clamp<std::size_t>(half, 2, most_shown_samples);
    const std::vector<ChosenWindow> kept = within_budget(measured, chosen, bytes, most_samples, budget_mb);
    if (kept.empty())
        return std::nullopt;
    Filming filming(built, kept, most_samples);
    StopOnly stop_only(observer);
    for (const ShownModel& model : models)
        if (!filming.add(model, windows, options, cost, stop_only))
            return std::nullopt;
    return filming.take();
}

} // namespace stylobate
