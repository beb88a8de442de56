#include "studies/results/kept_animations.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "ensemble/planar/fastening.hpp"
#include "io/files/suggest.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/report/json.hpp"
#include "studies/report/words.hpp"
#include "studies/results/result_picture.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace stylobate {
namespace {

struct Choice {
    std::vector<std::uint64_t> indices; ///< in the order in which they are made
    std::size_t cells = 0;              ///< of a surface: in how many both fates occur; else 0
};

/// The first realizations of a cell that fell, and the first that did not.
struct Fates {
    std::vector<std::uint64_t> fell, stood;
    bool mixed() const { return !fell.empty() && !stood.empty(); }
    void add(const ResultRow& row, std::uint64_t each)
    {
        if (row.outcome.state == State::invalid)
            return;
        std::vector<std::uint64_t>& of = row.outcome.state == State::collapsed ? fell : stood;
        if (of.size() < each)
            of.push_back(row.index);
    }
};

Choice choose_by_cells(const std::vector<ResultRow>& trials, std::size_t cells, std::uint64_t each)
{
    std::vector<Fates> all(cells);
    for (const ResultRow& row : trials)
        if (row.cell < cells)
            all[row.cell].add(row, each);
    Choice choice;
    choice.cells = static_cast<std::size_t>(std::ranges::count_if(all, &Fates::mixed));
    const RunOrder order(cells);
    // what fell comes first: where the budget is too small for all, each mixed cell has one rather than some have both
    for (std::uint64_t k = 0; k < each; ++k)
        for (const auto of : {&Fates::fell, &Fates::stood})
            for (std::uint64_t place = 0; place < cells; ++place)
                if (const Fates& cell = all[order.index(place)]; cell.mixed() && k < (cell.*of).size())
                    choice.indices.push_back((cell.*of)[k]);
    for (std::uint64_t place = 0; place < cells; ++place)
        if (const Fates& cell = all[order.index(place)]; !cell.mixed())
            for (const std::vector<std::uint64_t>* of : {&cell.fell, &cell.stood})
                if (!of->empty())
                    choice.indices.push_back(of->front());
    return choice;
}

/// A motion at an intensity under which some structures fell and some did not; nullopt: there is none.
std::optional<std::uint64_t> first_mixed_cell(const std::vector<ResultRow>& trials)
{
    std::map<std::uint64_t, Fates> cells;
    for (const ResultRow& row : trials)
        cells[row.cell].add(row, 1);
    const auto found = std::ranges::find_if(cells, [](const auto& cell) { return cell.second.mixed(); });
    return found == cells.end() ? std::nullopt : std::optional(found->first);
}

Choice choose(const Results& results, std::uint64_t each)
{
    const ResultHeader& header = results.header();
    const std::size_t cells = header.cells();
    const std::vector<ResultRow>& trials = results.trials();
    if (cells > 0)
        return choose_by_cells(trials, cells, each);
    Choice choice;
    if (header.kind == "single" || header.kind == "replay") {
        for (std::size_t i = 0; i < std::min<std::size_t>(first_shown, trials.size()); ++i)
            if (trials[i].outcome.state != State::invalid)
                choice.indices.push_back(trials[i].index);
        for (const std::uint64_t index : results.reader().trajectory_indices())
            if (std::ranges::find(choice.indices, index) == choice.indices.end() &&
                results.reader().row(index).outcome.state != State::invalid)
                choice.indices.push_back(index);
        return choice;
    }
    const std::optional<std::uint64_t> cell = header.motions.names.empty() ? std::nullopt : first_mixed_cell(trials);
    Fates all;
    for (const ResultRow& row : trials)
        if (!cell || row.cell == *cell)
            all.add(row, each);
    choice.indices = all.fell;
    choice.indices.insert(choice.indices.end(), all.stood.begin(), all.stood.end());
    return choice;
}

/// Makes the animations of a choice one after the other, in parallel, until the budget or the time is used up.
class Making {
public:
    Making(const Results& results, Isa isa, const AnimationOptions& options, Observer& observer)
        : results_(results), isa_(isa), options_(options), observer_(observer),
          stored_(results.reader().trajectory_indices()), stride_(animation_stride(results.study())),
          kept_(animations_for(results.study()))
    {
    }

    KeptAnimations make(const Choice& choice)
    {
        const auto start = std::chrono::steady_clock::now();
        const auto passed = [&] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        const std::vector<std::uint64_t>& indices = choice.indices;
        bool full = false, late = false;
        const std::size_t at_once = 2 * static_cast<std::size_t>(options_.threads);
        for (std::size_t done = 0; done < indices.size() && !full && !observer_.stop_requested();) {
            if (done > 0 && passed() > options_.seconds) {
                late = true;
                break;
            }
            const std::size_t end = std::min(done + at_once, indices.size());
            full = !add(std::span(indices).subspan(done, end - done));
            done = end;
            Progress progress{.done = done, .total = indices.size(), .seconds = passed()};
            progress.rate = static_cast<double>(done) / std::max(progress.seconds, 1e-9);
            observer_.progress(progress);
        }
        tell(choice, full, late);
        std::ranges::sort(kept_.list, {}, [](const Animation& a) { return std::pair(a.cell, a.index); });
        return std::move(kept_);
    }

private:
    Animation one(std::uint64_t index, const Trajectory& trajectory) const
    {
        Animation animation = animation_of(trajectory, kept_.stage, stride_);
        const ResultRow row = results_.reader().row(index);
        animation.cell = row.cell;
        animation.state = row.outcome.state;
        animation.frequency_hz = row.frequency_hz;
        animation.pga_m_s2 = row.pga_m_s2;
        animation.motion = motion_words(results_, row).value_or("");
        animation.fall_time_s = row.outcome.fall_time_s;
        if (results_.study().structure.spatial())
            animation.azimuth_rad = row.outcome.fall_azimuth_rad;
        return animation;
    }

    bool is_stored(std::uint64_t index) const { return std::ranges::binary_search(stored_, index); }

    /// @returns false once one does not fit any more
    bool add(std::span<const std::uint64_t> indices)
    {
        std::vector<Trajectory> followed(indices.size());
        if (!std::ranges::all_of(indices, [&](std::uint64_t index) { return is_stored(index); })) {
            const Experiment& experiment = results_.experiment();
            const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(options_.threads));
            tbb::task_arena(options_.threads).execute([&] {
                in_parallel(std::size_t{0}, indices.size(), [&](std::size_t i) {
                    if (!is_stored(indices[i]))
                        followed[i] = trace(experiment, indices[i], isa_).trajectory;
                });
            });
        }
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (is_stored(indices[i])) // the file is read by one thread
                followed[i] = results_.reader().trajectory(indices[i]);
            Animation animation = one(indices[i], followed[i]);
            constexpr double beside_mb = 200e-6; // of its text
            last_mb_ = static_cast<double>(animation.data.size()) / 1e6 + beside_mb;
            if (mb_ + last_mb_ > options_.budget_mb)
                return false;
            mb_ += last_mb_;
            kept_.list.push_back(std::move(animation));
        }
        return true;
    }

    /// What was kept, and why not more.
    void tell(const Choice& choice, bool full, bool late)
    {
        const std::size_t kept = kept_.list.size(), all = choice.indices.size();
        if (full && kept == 0) {
            const std::string small =
                fmt::format("an animation of these results has {:.3g} MB at {:.3g} Hz, more than "
                            "the budget of {:g} MB.\n  Give --animate-mb {:.3g} or more, or "
                            "--animate 0 for none.",
                            last_mb_, kept_.rate_hz, options_.budget_mb, std::ceil(last_mb_ * 1e3) / 1e3);
            if (options_.wanted)
                throw InputError(fmt::format("{}: {}", results_.file(), small));
            kept_.warning = "no animations: " + small;
            return;
        }
        std::set<std::uint64_t> cells;
        for (const Animation& animation : kept_.list)
            cells.insert(animation.cell);
        if (all == 0)
            kept_.words = "No animations: there are no valid realizations.";
        else if (is_surface())
            kept_.words =
                fmt::format("Animations: {} realizations in {} of {} cells (at most {} that fell and {} that "
                            "did not in each of the {} cells that have both, one in each other cell)",
                            kept, cells.size(), results_.header().cells(), options_.each, options_.each, choice.cells);
        else
            kept_.words = fmt::format("Animations: {} of {}", kept, counted(all, "chosen realization"));
        if (all == 0)
            return;
        *kept_.words +=
            fmt::format("; {:.3g} Hz, {:.2g} MB of a budget of {:g} MB.", kept_.rate_hz, mb_, options_.budget_mb);
        if (full)
            *kept_.words += " The budget is used up: --animate-mb sets another one.";
        if (late)
            *kept_.words += fmt::format(" The time of {} is used up: --animate-seconds sets another one.",
                                        duration_text(options_.seconds));
    }

    bool is_surface() const { return results_.header().cells() > 0; }

    const Results& results_;
    const Isa isa_;
    const AnimationOptions& options_;
    Observer& observer_;
    const std::vector<std::uint64_t> stored_;
    const std::size_t stride_;
    double mb_ = 0, last_mb_ = 0;
    KeptAnimations kept_;
};

/// Why no realization of these results can be shown; nullopt: they can.
std::optional<std::string> why_none(const Results& results)
{
    if (const std::optional<std::string> why = results.kind().why_no_replay())
        return why;
    if (!results.header().has_rows())
        return "has no rows of realizations (output.realizations = \"none\"), of which some could be chosen";
    return std::nullopt;
}

} // namespace

KeptAnimations keep_animations(const Results& results, Isa isa, const AnimationOptions& options, Observer& observer)
{
    KeptAnimations none;
    if (options.each == 0) {
        none.words = "No animations were asked for (--animate 0).";
        return none;
    }
    if (const std::optional<std::string> why = why_none(results)) {
        if (options.wanted)
            throw InputError(fmt::format("{}: no animations can be made: {}.\n  Leave out --animate and its limits.",
                                         results.file(), *why));
        none.words =
            fmt::format("No animations: {} {}.", std::filesystem::path(results.file()).filename().string(), *why);
        return none;
    }
    try {
        return Making(results, isa, options, observer).make(choose(results, options.each));
    } catch (const InputError& error) { // the record is missing, or another one
        if (options.wanted)
            throw;
        none.warning = fmt::format("no animations: {}", error.what());
        return none;
    }
}

std::size_t animation_stride(const Study& study)
{
    return std::max<std::size_t>(
        1, static_cast<std::size_t>(std::ceil(study.output.trajectory_rate_hz / animation_rate_hz - 1e-9)));
}

KeptAnimations animations_for(const Study& study)
{
    KeptAnimations none;
    const std::vector<PlacedBlock> blocks = lay_out(study.structure).blocks;
    none.stage = study.structure.spatial() ? animation_stage_in_space(blocks) : animation_stage(blocks);
    none.rate_hz = study.output.trajectory_rate_hz / static_cast<double>(animation_stride(study));
    return none;
}

namespace {

/// As player.js describes them: in pixels and seconds.
Json fastenings_json(const std::vector<Fastening>& all, const AnimationStage& stage)
{
    const auto end = [&](const FastenedPoint& point) {
        const double x = (point.x_m - (point.block ? 0 : stage.middle_m)) * stage.px_m;
        return fmt::format("[{},{:.6g},{:.6g}]", point.block ? static_cast<int>(*point.block) : -1, x,
                           point.y_m * stage.px_m);
    };
    Json list = Json::list();
    for (const Fastening& fastening : all) {
        Json one = Json::object();
        one.member_as_is("at", end(fastening.at));
        if (fastening.other) {
            list.item(one.member_as_is("to", end(*fastening.other)));
            continue;
        }
        one.member("right", fastening.from_the_right());
        if (const BlockMechanisms& rod = fastening.rod; fastening.only_pushes())
            one.member_as_is("tip", fmt::format("[{:.6g},{:.6g},{:.6g},{:.6g}]", rod.rod_speed_m_s * stage.px_m,
                                                rod.rod_start_s, rod.rod_travel_m * stage.px_m, rod.rod_laboratory));
        list.item(one);
    }
    return list;
}

} // namespace

std::string animations_json(const KeptAnimations& kept, const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const std::vector<PlacedBlock>& placed = layout.blocks;
    std::vector<AnimatedBlock> blocks;
    SpaceLooks looks;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const PlacedBlock& block = placed[i];
        const bool epistyle = block.role == BlockRole::epistyle;
        blocks.push_back({block.name, block.fixed ? "fixed" : epistyle ? "lintel" : "stone"});
        looks.round.push_back(block.shape == Shape::round ? 1 : block.echinus_part > 0 ? 2 : 0);
        if (!block.fixed && is_top(placed, i))
            looks.orbits.push_back(i);
    }
    Json list = Json::list();
    for (const Animation& animation : kept.list) {
        Json falls = Json::list();
        for (std::size_t block = 0; block < animation.fall_time_s.size(); ++block)
            if (animation.fall_time_s[block] >= 0)
                falls.item_as_is(fmt::format("[{},{:.6g}]", block, animation.fall_time_s[block]));
        Json one = Json::object();
        one.member("index", animation.index)
            .member("cell", animation.cell)
            .member("state", to_string(animation.state))
            .member_as_is("frequency_hz", fmt::format("{:.6g}", animation.frequency_hz))
            .member_as_is("pga_m_s2", fmt::format("{:.6g}", animation.pga_m_s2))
            .member("samples", animation.samples)
            .member("falls", falls);
        if (!animation.motion.empty())
            one.member("motion", animation.motion);
        if (std::isfinite(animation.azimuth_rad))
            one.member_as_is("azimuth_rad", fmt::format("{:.6g}", animation.azimuth_rad));
        list.item(one.member("data", animation.data));
    }
    return animation_store(kept.stage, kept.rate_hz, blocks,
                           study.structure.spatial() ? std::optional(std::move(looks)) : std::nullopt)
        .member("fastenings", fastenings_json(fastenings(study.mechanisms, study.contact.friction, layout), kept.stage))
        .member("list", list)
        .text();
}

} // namespace stylobate
