/// `stylobate run` and `stylobate merge`: from a study file, or from the results of its parts, to a results file.

#include "ensemble/model/input_error.hpp"
#include "ensemble/run/executor.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/app/run_report.hpp"
#include "studies/cluster/shard_files.hpp"
#include "studies/cluster/together.hpp"
#include "studies/decisions/laws/law_runs.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_store.hpp"
#include "studies/results/run_study.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

namespace stylobate {

namespace {

/// The default results file: in the working folder, with the name of the study.
std::string default_results(const std::string& study, const Shard& shard)
{
    return std::filesystem::path(study).stem().string() +
           (shard.whole() ? "" : fmt::format("_{}_of_{}", shard.number, shard.of)) + ".h5";
}

/// The part of the study by --shard. @throws InputError if there is no such part
Shard shard_of(const std::string& text)
{
    if (text.empty())
        return {};
    const std::optional<Shard> shard = Shard::from_text(text);
    if (!shard)
        throw InputError(fmt::format("--shard {}: give the number of the part and that of all parts, such as 3/8: 1/8 "
                                     "to 8/8, of at most {} parts",
                                     text, Shard::most));
    return *shard;
}

/// Adds the rows of a finished file to the kind. @returns what the run would have reported, as far as the file has it
Progress finished_progress(const std::string& results, Kind& kind)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Progress progress{.seconds = unknown, .rate = unknown, .occupancy = unknown};
    const ResultReader reader(results);
    progress.done = progress.total = reader.done();
    reader.for_each_row([&](const ResultRow& row) {
        kind.add(row);
        progress.collapsed += row.outcome.state == State::collapsed;
        progress.invalid += row.outcome.state == State::invalid;
    });
    if (const Tally* tally = reader.tally()) {
        kind.add(*tally);
        progress.collapsed = tally->all_reached(static_cast<std::size_t>(LimitState::collapse));
        progress.invalid = tally->all_invalid();
    }
    kind.restore(reader);
    kind.share(progress);
    return progress;
}

/// The study under other contact laws. @throws InputError if it cannot be run under them
std::unique_ptr<LawRuns> prepare_laws(const CommonOptions& options, const LoadedStudy& study, const std::string& file,
                                      const std::string& results)
{
    auto laws = std::make_unique<LawRuns>(study, file, results);
    check_can_run(options, laws->runs());
    if (!laws->finished())
        note(options.quiet, laws->costs());
    return laws;
}

/// Prints the report of a study. @pre its file is closed   @param laws null: the study is not run under other laws
/// @returns the exit status
int report_with_laws(const CommonOptions& options, RunReport report, const ResultHeader& header, LawRuns* laws)
{
    const bool whole = report.complete && report.shard.whole();
    if (whole && laws) {
        Console console(options.quiet);
        report.laws_interrupted = !run_all(options, laws->runs(), console);
        if (!report.laws_interrupted)
            report.laws = laws->conclude();
    } else if (whole) {
        report.laws = law_band_beside(report.results, report.study, header);
    }
    const int status = report_run(options, report);
    return status == exit_done && laws ? report_invalid(laws->runs()) : status;
}

/// What is known of a run before anything is written.
struct Prepared {
    Prepared(const CommonOptions& options, const std::string& study, const Shard& shard)
        : loaded(LoadedStudy::from_file(study, options.set)), header(loaded.result_header())
    {
        header.shard = shard;
        kind = make_kind(loaded.study(), header);
    }

    const LoadedStudy loaded;
    ResultHeader header;
    std::unique_ptr<Kind> kind;
    std::vector<std::string> warnings;
    std::string notice;
    RunOptions run;
    std::string file; ///< of the results: "begun", or "finished" where nothing is left to run; empty: there is none
};

/// @throws InputError if the study cannot be run so
std::unique_ptr<Prepared> prepare(const CommonOptions& options, const std::string& study, const std::string& results,
                                  const std::string& shard_text)
{
    check_kind(study, "run");
    check_option_kind(results, FileKind::results, "-o");
    const Shard shard = shard_of(shard_text);
    auto all = std::make_unique<Prepared>(options, study, shard);
    Kind& kind = *all->kind;
    if (const std::string why = kind.why_no_shards(); !shard.whole() && !why.empty())
        throw InputError(fmt::format("--shard {}: {} {}. Run it without --shard.", shard.text(), study, why));
    if (const std::string why = kind.why_no_ranks(); options.ranks && !why.empty())
        throw InputError(fmt::format("--mpi: {} {}. Run it without --mpi.", study, why));
    if (const std::string why = kind.needs_processor(); options.backend == "cuda" && !why.empty())
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study, why));
    all->warnings = all->loaded.warnings(study);
    all->notice = kind.prepare(all->loaded.experiment(), study);
    if (const auto variants = read_variant_names(study, options.set); !variants.empty())
        all->notice += fmt::format("{}{} has [variants] ({}), which run leaves out: it computes the base alone. "
                                   "stylobate compare {} computes them all.",
                                   all->notice.empty() ? "" : "\n", study, fmt::join(variants, ", "), study);
    all->run = options.run_options();
    if (all->run.leads() && std::filesystem::exists(results))
        all->file = ResultWriter::is_finished(results, all->header) ? "finished" : "begun";
    return all;
}

} // namespace

int run_command(const CommonOptions& options, const std::string& study, std::string results,
                const std::string& shard_text, bool with_laws)
{
    if (results.empty())
        results = default_results(study, shard_of(shard_text));
    std::unique_ptr<Prepared> prepared;
    together(options.ranks, [&] { prepared = prepare(options, study, results, shard_text); });
    const LoadedStudy& loaded = prepared->loaded;
    Kind& kind = *prepared->kind;
    const RunOptions& run = prepared->run;
    const Shard shard = prepared->header.shard;
    const std::string file = run.ranks ? run.ranks->of_first(prepared->file) : prepared->file;
    const std::unique_ptr<LawRuns> laws = with_laws ? prepare_laws(options, loaded, study, results) : nullptr;
    RunReport report{.results = results, .study = loaded.study(), .kind = kind, .run = run};
    if (file == "finished") {
        if (!run.leads())
            return exit_done;
        report.progress = finished_progress(results, kind);
        report.complete = true;
        if (!options.json && !options.quiet)
            fmt::print("{}: already complete. (Remove the file to run the study again.)\n", results);
        return report_with_laws(options, report, prepared->header, laws.get());
    }
    if (file.empty()) // else it has been done before the file was made; each rank looks at a part
        together(run.ranks,
                 [&] { check_realizations(loaded.sampler(), kind, run.ranks ? part_of(*run.ranks) : shard); });

    std::unique_ptr<RunStore> store;
    StudyRun ran;
    {
        Console console(options.quiet || !run.leads()); // from here on an interrupt leaves a file to be continued
        together(options.ranks,
                 [&] { store = run.leads() ? open_store(results, prepared->header, !file.empty()) : no_store(); });
        if (run.leads()) // now that nothing is refused any more
            for (const std::string& warning : prepared->warnings)
                console.warn(warning);
        if (run.leads() && !prepared->notice.empty())
            note(options.quiet, prepared->notice);
        store->give_to(kind);
        ran = run_study(loaded.experiment(), kind, *store, run, console, shard);
    }
    if (!run.leads())
        return ran.complete ? exit_done : exit_interrupted;
    if (ran.complete && shard.whole()) {
        kind.conclude();
        store->finish(kind);
    } else {
        store->flush();
    }
    store.reset();
    report.progress = ran.progress;
    report.complete = ran.complete;
    report.shard = shard;
    return report_with_laws(options, report, prepared->header, laws.get());
}

int merge_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& output,
                  bool partial)
{
    for (const std::string& file : files) {
        check_kind(file, "merge");
        check_output(file, output, options.force);
    }
    ResultHeader header;
    {
        const ResultReader first(files.front());
        check_is_part(first, files.front());
        header = first.header();
    }
    header.shard = {};
    header.code_version = code_version(); // what is made of the rows is made by this one
    header.build = code_build();
    const Study study = parse_study(header.study_toml, files.front() + " (its study)");
    const LoadedStudy loaded = LoadedStudy::from_results(study, header, files.front(), options.set);
    const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
    kind->prepare(loaded.experiment(), files.front());
    const RunOptions run = options.run_options();

    std::vector<ShardFile> parts;
    for (const std::string& file : files)
        parts.push_back(read_shard_file(file, header));
    const DoneSet all = joined(parts, RunOrder(header.total));
    const DoneSet::Part there = all.all(), sample = all.sample();
    if (there.end < header.total && !partial)
        throw InputError(missing_text(parts, *kind, there.end, header.total));

    // nothing is refused any more
    Console console(options.quiet);
    const std::filesystem::path unready = output + ".merging";
    std::filesystem::remove(unready);
    const Temporary temporary(unready);
    std::unique_ptr<RunStore> store = open_store(unready.string(), header, false);
    StudyRun ran{{.done = there.end, .total = header.total, .collapsed = there.collapsed, .invalid = there.invalid},
                 there.end == header.total};
    estimate_share(ran.progress, sample.end - sample.invalid, sample.collapsed);
    bool stopped = false;
    for (const std::string& file : files) {
        if (stopped = console.stop_requested(); stopped)
            break;
        store->add(ResultReader(file));
    }
    if (ran.complete && !stopped) { // nothing is left to run; what follows on the realizations is
        store->give_to(*kind);
        ran = run_study(loaded.experiment(), *kind, *store, run, console);
        stopped = !ran.complete;
    }
    if (stopped) {
        say("Interrupted; nothing was written.\n");
        return exit_interrupted;
    }
    if (ran.complete) {
        kind->conclude();
        store->finish(*kind);
    } else {
        store->give_to(*kind);
        store->flush();
    }
    store.reset();
    rename_over(unready, output);
    return report_run(options, {.results = output,
                                .study = loaded.study(),
                                .kind = *kind,
                                .run = run,
                                .progress = ran.progress,
                                .complete = ran.complete,
                                .merged = true});
}

} // namespace stylobate
