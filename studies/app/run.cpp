/// `stylobate run`: from a study file to a results file.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/plots/plot_surface.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_names.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/experiment/block_names.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/trajectory.hpp"
#include "studies/kinds/adaptive/run_adaptive.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"
#include "studies/kinds/rare/run_rare.hpp"
#include "studies/kinds/replicas/run_twins.hpp"
#include "studies/kinds/replicas/twins_text.hpp"
#include "studies/kinds/sensitivity/sensitivity.hpp"
#include "studies/kinds/single/kept_trajectories.hpp"
#include "studies/kinds/surface/run_counted.hpp"
#include "studies/kinds/surface/surface.hpp"
#include "studies/report/json.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>

namespace stylobate {

namespace {

/// Where results go unless the user says: beside nothing, in the working folder, under the study's name.
std::string default_results(const std::string& study)
{
    return std::filesystem::path(study).stem().string() + ".h5";
}

/// Draws every realization once, so that one that cannot be run (a fixed step above its bound, drums drawn off each
/// other) is refused before anything is written. It costs less than a hundredth of running them. Of a study of rare
/// events a number of plain draws: where its chains will lead nobody knows.
void check_realizations(const LoadedStudy& loaded)
{
    const std::uint64_t total = loaded.study().rare ? 10 * loaded.study().rare->samples : loaded.study().total();
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, total, 256), [&](const auto& range) {
        for (std::uint64_t index = range.begin(); index != range.end(); ++index)
            loaded.sampler().realization(index);
    });
}

/// What is counted of the rows: cell by cell, and over all of them. Twins are no further trials.
struct Counts {
    SurfaceCounts cells;
    LimitCounts limits;
    std::uint64_t originals;
    void add(const ResultRow& row)
    {
        if (row.index >= originals)
            return;
        cells.add(row);
        limits.add(row);
    }
};

/// Counts what an earlier part of the run has done. (Only while no row is being added.)
/// @param outcomes    of an adaptive surface, else null
/// @param sensitivity of a sensitivity study, else null
/// @param rare        of a study of rare events, else null
void count_done(const std::string& results, Counts& counts, CellOutcomes* outcomes, SensitivityOutcomes* sensitivity,
                RareOutcomes* rare)
{
    ResultReader(results).for_each_row([&](const ResultRow& row) {
        counts.add(row);
        if (outcomes)
            outcomes->add(row);
        if (sensitivity)
            sensitivity->add(row);
        if (rare)
            rare->add(row);
    });
}

std::uint64_t free_blocks(const Realization& realization)
{
    return static_cast<std::uint64_t>(std::count_if(realization.blocks.begin(), realization.blocks.end(),
                                                    [](const Block& block) { return !block.fixed; }));
}

/// @param kept the trajectories of the first so many are kept
Progress run_single(const LoadedStudy& loaded, Isa isa, std::uint64_t kept, ResultWriter& writer, Counts& counts,
                    Observer& observer)
{
    const auto begin = std::chrono::steady_clock::now();
    std::uint64_t run_now = 0;
    Progress progress;
    progress.total = loaded.study().total();
    progress.occupancy = 1.0 / kernels(isa).lanes; // followed one by one
    for (std::uint64_t index = 0; index < progress.total && !observer.stop_requested(); ++index) {
        std::optional<State> state = writer.state(index);
        if (!state) {
            const FollowedRealization f = follow(loaded.experiment(), index, isa);
            const ResultRow row = result_row(loaded.study(), f.realization, f.outcome);
            if (index < kept)
                writer.add(f.trajectory); // before its row: where the row is, it is
            writer.add(row);
            counts.add(row);
            state = f.outcome.state;
            ++run_now;
            progress.block_steps += free_blocks(f.realization) * f.outcome.steps;
        }
        ++progress.done;
        progress.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        progress.rate = static_cast<double>(run_now) / progress.seconds;
        progress.collapsed += state == State::collapsed;
        progress.invalid += state == State::invalid;
        estimate_share(progress, progress.done - progress.invalid, progress.collapsed);
        observer.progress(progress);
    }
    return progress;
}

/// All realizations of a study of any other kind but a rare one.
/// @param sensitivity of a sensitivity study, else null
Progress run_many(const LoadedStudy& loaded, const RunOptions& options, ResultWriter& writer, Counts& counts,
                  SensitivityOutcomes* sensitivity, Observer& observer)
{
    RunPlan plan;
    plan.total = loaded.study().total();
    plan.mark_done([&](std::uint64_t index) { return writer.state(index); });
    plan.sink = [&](const Realization& realization, const Outcome& outcome) {
        const ResultRow row = result_row(loaded.study(), realization, outcome);
        writer.add(row);
        counts.add(row);
        if (sensitivity)
            sensitivity->add(row);
    };
    return run_ensemble(loaded.experiment(), options, plan, observer);
}

/// @param fair whether all cells have equally many realizations; else the shares among all mean nothing
Json share_json(const Share& share, bool fair)
{
    if (!fair)
        return Json::object().member("count", share.count);
    return Json::object()
        .member("count", share.count)
        .member("probability", share.probability)
        .member("lower", share.lower)
        .member("upper", share.upper);
}

std::string share_text(const Share& share)
{
    return fmt::format("{} ({:.3g} %, {:.3g} to {:.3g})", share.count, 100 * share.probability, 100 * share.lower,
                       100 * share.upper);
}

/// The blocks that fell first in some realization, those that did so most often before the others.
std::vector<std::size_t> first_fallen(const LimitCounts& counts)
{
    std::vector<std::size_t> blocks;
    for (std::size_t i = 0; i < counts.first().size(); ++i)
        if (counts.first()[i] > 0)
            blocks.push_back(i);
    std::stable_sort(blocks.begin(), blocks.end(),
                     [&](std::size_t a, std::size_t b) { return counts.first()[a] > counts.first()[b]; });
    return blocks;
}

/// What became of the valid realizations, over all cells of a surface.
Json limits_json(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest, bool fair)
{
    Json first = Json::list();
    for (const std::size_t block : first_fallen(counts))
        first.item(Json::object()
                       .member("block", block)
                       .member("name", names[block])
                       .member("share", share_json(counts.share_first(block), fair)));
    Json json = Json::object();
    json.member("trials", counts.trials()).member("interval", counts.interval());
    for (std::size_t i = 0; i < limit_state_names().size(); ++i)
        if (const auto limit = static_cast<LimitState>(i); limit != LimitState::total || to_rest)
            json.member(limit_state_names()[i], share_json(counts.share(limit), fair));
    json.member("first_fallen", first)
        .member("first_fallen_together", share_json(counts.share_first_together(), fair))
        .member("median_collapse_time_s", counts.median_collapse_time_s());
    if (to_rest)
        json.member("median_total_collapse_time_s", counts.median_total_collapse_time_s());
    return json;
}

/// The same of an adaptive surface: all cells have the same weight, however many realizations they have.
void print_mean(const SurfaceTable& table, const LimitCounts& counts, const std::vector<std::string>& names)
{
    const SurfaceMean mean = mean_of(table);
    fmt::print("  mean of the surface {:.3g} +- {:.2g} % collapsed (standard error; each cell has the same weight)",
               100 * mean.value, 100 * mean.error);
    std::string list;
    for (const std::size_t block : first_fallen(counts))
        list += fmt::format("{}{}: {}", list.empty() ? "" : ", ", names[block], counts.first()[block]);
    if (!list.empty())
        fmt::print("\n  first to fall, of the realizations that were run: {}", list);
    fmt::print("\n");
}

void print_limits(const LimitCounts& counts, const std::vector<std::string>& names, bool to_rest)
{
    const Share collapsed = counts.share(LimitState::collapse);
    fmt::print("  collapsed {}", share_text(collapsed));
    if (collapsed.count > 0)
        fmt::print(", median time {:.3g} s", counts.median_collapse_time_s());
    if (const Share unseated = counts.share(LimitState::unseated); unseated.count > 0)
        fmt::print("; unseated {}", share_text(unseated));
    if (to_rest) {
        const Share total = counts.share(LimitState::total);
        fmt::print("; total collapse {}", share_text(total));
        if (total.count > 0)
            fmt::print(", median time {:.3g} s", counts.median_total_collapse_time_s());
    }
    fmt::print("; in brackets: share and its {}\n", describe_interval(counts.interval()));
    const std::vector<std::size_t> first = first_fallen(counts);
    constexpr std::size_t most = 5;
    std::string list;
    for (std::size_t k = 0; k < std::min(most, first.size()); ++k)
        list += fmt::format("{}{}: {}", k > 0 ? ", " : "", names[first[k]], share_text(counts.share_first(first[k])));
    if (first.size() > most)
        list += fmt::format(" and {} others", first.size() - most);
    if (counts.first_together() > 0)
        list += fmt::format("{}several at the same step: {}", list.empty() ? "" : "; ",
                            share_text(counts.share_first_together()));
    if (!list.empty())
        fmt::print("  first to fall: {}\n", list);
}

Json adaptive_json(const SurfaceTable& table)
{
    double widest = 0;
    for (std::size_t cell = 0; cell < table.lower.size(); ++cell)
        widest = std::max(widest, (table.upper[cell] - table.lower[cell]) / 2);
    const SurfaceMean mean = mean_of(table);
    return Json::object()
        .member("mean_probability", mean.value)
        .member("mean_standard_error", mean.error)
        .member("half_width", table.half_width)
        .member("widest", widest)
        .member("rounds", table.rounds)
        .member("borrowing_cells", static_cast<std::uint64_t>(
                                       std::count(table.method.begin(), table.method.end(), IntervalMethod::surface)))
        .member("uniform_realizations", table.lower.size() * uniform_trials(table.half_width, adaptive_level));
}

/// What is said of a whole study beside its counts; what it has not is null.
struct Findings {
    const SurfaceTable* adaptive = nullptr;
    const Fragility* fragility = nullptr;
    const SensitivityTable* sensitivity = nullptr;
    const RareTable* rare = nullptr;
    const Twins* twins = nullptr;
};

/// @param found of a complete study
void report(const CommonOptions& options, const LoadedStudy& loaded, const std::string& results, const Progress& p,
            const LimitCounts& counts, const RunOptions& run, bool complete, const Findings& found)
{
    const bool adaptive = loaded.study().surface && loaded.study().surface->adaptive;
    const std::vector<std::string> names = block_names(loaded.study());
    const bool to_rest = loaded.study().outcome.follow == Follow::rest;
    const std::string kind = word_for(study_kind_names, loaded.study().kind);
    if (options.json) {
        Json json = Json::object();
        json.member("kind", kind)
            .member("results", results)
            .member("complete", complete)
            .member("realizations", p.done)
            .member("total", p.total)
            .member("collapsed", p.collapsed)
            .member("invalid", p.invalid)
            .member("collapse_probability", p.share) // of the whole study, from a fair sample of it
            .member("collapse_lower", p.share_lower)
            .member("collapse_upper", p.share_upper)
            .member("seconds", p.seconds)
            .member("realizations_per_second", p.rate)
            .member("block_steps_per_second", p.seconds == 0 ? 0.0 : static_cast<double>(p.block_steps) / p.seconds)
            .member("occupancy", p.occupancy)
            .member("backend", options.backend)
            .member("simd", to_string(run.isa))
            .member("threads", run.threads);
        if (!loaded.study().rare) // whose realizations lean to the collapse
            json.member("limit_states", limits_json(counts, names, to_rest, !adaptive));
        if (found.adaptive)
            json.member("adaptive", adaptive_json(*found.adaptive));
        if (found.fragility)
            json.member("fragility", fragility_json(*found.fragility));
        if (found.sensitivity)
            json.member("sensitivity", sensitivity_json(*found.sensitivity));
        if (found.rare)
            json.member("rare", rare_json(*found.rare));
        if (found.twins)
            json.member("twins", twins_json(*found.twins));
        fmt::print("{}\n", json.text());
    } else if (!options.quiet) {
        fmt::print("{}: {}{} realizations, {} collapsed, {} invalid", results, p.done,
                   p.open_end ? "" : fmt::format(" of {}", p.total), p.collapsed, p.invalid);
        if (p.seconds > 0)
            fmt::print("; {} with {} threads of {}, {} realizations/s", duration_text(p.seconds), run.threads,
                       run.devices.empty() ? to_string(run.isa) : "the host and " + run.devices.front()->name(),
                       rate_text(p.rate));
        fmt::print("\n");
        if (found.adaptive)
            fmt::print("  {}\n", describe_adaptive(*found.adaptive));
        if (found.adaptive)
            print_mean(*found.adaptive, counts, names);
        else if (complete && counts.trials() > 0 && !loaded.study().rare)
            print_limits(counts, names, to_rest);
        if (found.fragility)
            fmt::print("{}", fragility_text(*found.fragility));
        if (found.sensitivity)
            fmt::print("{}", sensitivity_text(*found.sensitivity));
        if (found.rare)
            for (const std::string& sentence : rare_sentences(*found.rare))
                fmt::print("  {}\n", sentence);
        if (found.twins)
            fmt::print("{}", twins_text(*found.twins));
        if (!complete && !std::isnan(p.share)) // without those that have not ended because they take long
            fmt::print("  in the whole study {:.3g} % collapse ({:.3g} to {:.3g}, 95 % interval)\n", 100 * p.share,
                       100 * p.share_lower, 100 * p.share_upper);
        if (!complete)
            fmt::print("Interrupted; {} realizations are kept. The same command continues where this one stopped.\n",
                       p.done);
    }
}

/// What to add to a study that is meant as it stands.
std::string allow_text(const std::string& check)
{
    return fmt::format("study.allow = [\"{}\"]", check);
}

/// What is doubtful about a study, as sentences.
/// @throws InputError with the reason if it is too far from what can be meant
std::vector<std::string> warnings_of(const LoadedStudy& loaded, const std::string& file)
{
    std::vector<std::string> warnings;
    for (const Doubt& doubt : loaded.doubts()) {
        if (doubt.refused)
            throw InputError(fmt::format("{}: {}\n  If it is meant: {}.", file, doubt.text, allow_text(doubt.check)));
        warnings.push_back(fmt::format("{} If it is meant: {}.", doubt.text, allow_text(doubt.check)));
    }
    return warnings;
}

/// @throws InputError for a study that no device runs
void demand_of_device(const Study& study, const std::string& file)
{
    const auto refuse = [&file](const char* why) {
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", file, why));
    };
    if (study.kind == StudyKind::single)
        refuse("is of kind \"single\", whose realizations are followed step by step on the processor");
    if (study.twins)
        refuse("has [twins], some of which are the processor's (run.precision)");
    if (study.run.precision == Precision::single)
        refuse("asks for run.precision = \"single\", which is the processor's");
}

/// Reports a run, and what was found once it is complete, from its file.
/// @returns the exit status
int conclude(const CommonOptions& options, const LoadedStudy& loaded, const std::string& results, const Progress& p,
             const LimitCounts& counts, const RunOptions& run, bool complete)
{
    const Study& study = loaded.study();
    std::optional<SurfaceTable> adaptive;
    std::optional<SensitivityTable> indices;
    std::optional<RareTable> rare;
    std::optional<Fragility> fragility;
    std::optional<Twins> twins;
    if (complete) {
        const ResultReader reader(results);
        if (study.surface && study.surface->adaptive)
            adaptive = reader.surface();
        if (study.sensitivity)
            indices = reader.sensitivity();
        if (study.rare)
            rare = reader.rare();
        if (study.twins)
            twins = twins_of(reader, results);
        if (study.fragility)
            fragility = fragility_of(reader, results);
    }
    report(options, loaded, results, p, counts, run, complete,
           {adaptive ? &*adaptive : nullptr, fragility ? &*fragility : nullptr, indices ? &*indices : nullptr,
            rare ? &*rare : nullptr, twins ? &*twins : nullptr});
    if (!complete)
        return exit_interrupted;
    const double invalid = static_cast<double>(p.invalid) / static_cast<double>(p.total);
    if (invalid > study.run.max_invalid_fraction) {
        fmt::print(stderr,
                   "stylobate: {} of {} realizations are invalid, more than run.max_invalid_fraction = {} allows. "
                   "`stylobate replay {} --realization I` runs one again; a smaller run.step_fraction may help.\n",
                   p.invalid, p.total, study.run.max_invalid_fraction, results);
        return exit_invalid;
    }
    return exit_done;
}

/// Nothing is left to run: what the run would have said, as far as the file has it.
int conclude_finished(const CommonOptions& options, const LoadedStudy& loaded, const std::string& results,
                      const RunOptions& run, Counts& counts)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Progress progress{.seconds = unknown, .rate = unknown, .occupancy = unknown};
    {
        const ResultReader reader(results);
        progress.done = progress.total = reader.done();
        reader.for_each_row([&](const ResultRow& row) {
            counts.add(row);
            progress.collapsed += row.outcome.state == State::collapsed;
            progress.invalid += row.outcome.state == State::invalid;
        });
        if (const Tally* tally = reader.tally()) {
            counts.limits = LimitCounts(*tally);
            progress.collapsed = tally->all_reached(static_cast<std::size_t>(LimitState::collapse));
            progress.invalid = tally->all_invalid();
        }
    }
    const Study& study = loaded.study();
    if (study.surface && study.surface->adaptive)
        set_share(progress, mean_of(ResultReader(results).surface()));
    else if (!study.rare)
        estimate_share(progress, counts.limits.trials(), counts.limits.share(LimitState::collapse).count);
    if (!options.json && !options.quiet)
        fmt::print("{}: complete already, nothing is left to run. (Remove it to run the study again.)\n", results);
    return conclude(options, loaded, results, progress, counts.limits, run, true);
}

} // namespace

int run_command(const CommonOptions& options, const std::string& study, std::string results)
{
    if (results.empty())
        results = default_results(study);
    check_kind(study, "run");
    check_option_kind(results, FileKind::results, "-o");
    const LoadedStudy loaded = LoadedStudy::from_file(study, options.set);
    if (options.backend == "cuda")
        demand_of_device(loaded.study(), study);
    const std::vector<std::string> warnings = warnings_of(loaded, study);
    const bool is_single = loaded.study().kind == StudyKind::single, is_surface = loaded.study().surface.has_value();
    const KeptTrajectories trajectories = is_single ? plan_trajectories(loaded, study) : KeptTrajectories{};
    const RunOptions run = options.run_options();
    const bool found = std::filesystem::exists(results);
    if (!found) // else it has been done before the file was made
        check_realizations(loaded);
    const ResultHeader header = loaded.result_header();
    const bool finished = found && ResultWriter::is_finished(results, header);
    Counts counts{SurfaceCounts(header.frequency_hz, header.pga_m_s2),
                  LimitCounts(header.block_names.size(), cells_of_motion(loaded.study())), loaded.study().originals()};
    const bool adaptive = is_surface && loaded.study().surface->adaptive;
    if (finished)
        return conclude_finished(options, loaded, results, run, counts);
    CellOutcomes outcomes(header.frequency_hz.size(), header.pga_m_s2.size(), loaded.study().realizations);
    std::optional<SensitivityOutcomes> of_factors;
    if (loaded.study().sensitivity)
        of_factors.emplace(loaded.study(), header.input_names);
    SensitivityOutcomes* const sensitivity = of_factors ? &*of_factors : nullptr;
    const bool is_rare = loaded.study().rare.has_value();
    RareOutcomes rare_outcomes;
    std::optional<RareTable> rare;
    std::unique_ptr<ResultWriter> writer;
    Progress progress;
    std::optional<SurfaceTable> table;
    std::vector<FollowedTwin> followed;
    bool complete = false;
    {
        Console console(options.quiet); // from here on an interrupt leaves a file that can be continued
        if (header.has_rows())
            writer = found ? ResultWriter::resume(results, header) : ResultWriter::create(results, header);
        for (const std::string& warning : warnings) // now that nothing is refused any more
            console.warn(warning);
        if (!options.quiet && !trajectories.words.empty())
            fmt::print(stderr, "{}\n", trajectories.words);
        if (writer && found) // the file is ours now: no other run adds to it in between
            count_done(results, counts, adaptive ? &outcomes : nullptr, sensitivity,
                       is_rare ? &rare_outcomes : nullptr);
        const auto sink = [&](const ResultRow& row) {
            writer->add(row);
            counts.add(row);
        };
        if (!writer) {
            CountedRun ran = run_counted(loaded, run, results, found, console);
            progress = ran.progress;
            complete = ran.complete;
            counts.limits = std::move(ran.limits);
        } else if (is_rare) {
            RareRun ran = run_rare(loaded, run, rare_outcomes, sink, console);
            progress = ran.progress;
            complete = ran.complete;
            if (complete)
                rare = std::move(ran.table);
        } else if (loaded.study().twins) {
            TwinsRun ran = run_twins(loaded, run, *writer, sink, console);
            progress = ran.progress;
            followed = std::move(ran.followed);
            complete = ran.complete;
            if (complete)
                table = counts.cells.table();
        } else if (adaptive) {
            AdaptiveRun ran = run_adaptive(loaded, run, outcomes, sink, console);
            progress = ran.progress;
            table = std::move(ran.table);
            complete = ran.complete;
        } else {
            progress = is_single ? run_single(loaded, run.isa, trajectories.count, *writer, counts, console)
                                 : run_many(loaded, run, *writer, counts, sensitivity, console);
            complete = progress.done == progress.total;
            if (complete && is_surface)
                table = counts.cells.table();
        }
    }
    std::optional<SensitivityTable> indices;
    if (complete && sensitivity)
        indices = sensitivity->table();
    std::optional<Fragility> fragility;
    std::optional<FragilityTable> curves;
    if (complete && loaded.study().fragility) {
        fragility = fragility_of(ResultReader(results), results);
        curves = fragility_table(*fragility);
    }
    if (writer && complete)
        writer->finish(table ? &*table : nullptr, indices ? &*indices : nullptr, rare ? &*rare : nullptr,
                       followed.empty() ? nullptr : &followed, curves ? &*curves : nullptr);
    else if (writer)
        writer->flush();
    writer.reset();
    return conclude(options, loaded, results, progress, counts.limits, run, complete);
}

} // namespace stylobate
