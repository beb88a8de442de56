/// `stylobate run` and `stylobate merge`: from a study file, or from the results of its parts, to a results file.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/app/run_report.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_store.hpp"
#include "studies/results/run_study.hpp"
#include "studies/results/shard_files.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <optional>

namespace stylobate {

namespace {

/// Where results go unless the user says: beside nothing, in the working folder, under the study's name.
std::string default_results(const std::string& study, const Shard& shard)
{
    return std::filesystem::path(study).stem().string() +
           (shard.whole() ? "" : fmt::format("_{}_of_{}", shard.number, shard.of)) + ".h5";
}

/// The part of the study that is asked for. @throws InputError if there is no such part
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

/// Nothing is left to run: reports what the run would have, as far as the file has it.
int report_finished(const CommonOptions& options, const std::string& results, const Study& study, const RunOptions& run,
                    Kind& kind)
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
    if (!options.json && !options.quiet)
        fmt::print("{}: already complete. (Remove the file to run the study again.)\n", results);
    return report_run(options, {results, study, kind, progress, run, true});
}

} // namespace

int run_command(const CommonOptions& options, const std::string& study, std::string results,
                const std::string& shard_text)
{
    const Shard shard = shard_of(shard_text);
    if (results.empty())
        results = default_results(study, shard);
    check_kind(study, "run");
    check_option_kind(results, FileKind::results, "-o");
    const LoadedStudy loaded = LoadedStudy::from_file(study, options.set);
    ResultHeader header = loaded.result_header();
    header.shard = shard;
    const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
    if (const std::string why = kind->why_no_shards(); !shard.whole() && !why.empty())
        throw InputError(fmt::format("--shard {}: {} {}. Run it without --shard.", shard.text(), study, why));
    if (const std::string why = kind->needs_processor(); options.backend == "cuda" && !why.empty())
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study, why));
    const std::vector<std::string> warnings = loaded.warnings(study);
    const std::string notice = kind->prepare(loaded.experiment(), study);
    const RunOptions run = options.run_options();
    const bool found = std::filesystem::exists(results);
    if (!found) // else it has been done before the file was made
        check_realizations(loaded.sampler(), *kind, shard);
    else if (ResultWriter::is_finished(results, header))
        return report_finished(options, results, loaded.study(), run, *kind);

    std::unique_ptr<RunStore> store;
    StudyRun ran;
    {
        Console console(options.quiet); // from here on an interrupt leaves a file that can be continued
        store = open_store(results, header, found);
        for (const std::string& warning : warnings) // now that nothing is refused any more
            console.warn(warning);
        if (!options.quiet && !notice.empty())
            say(notice + "\n");
        store->give_to(*kind);
        ran = run_study(loaded.experiment(), *kind, *store, run, console, shard);
    }
    if (ran.complete && shard.whole()) {
        kind->conclude();
        store->finish(*kind);
    } else {
        store->flush();
    }
    store.reset();
    return report_run(options, {results, loaded.study(), *kind, ran.progress, run, ran.complete, shard});
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
    return report_run(options, {output, loaded.study(), *kind, ran.progress, run, ran.complete, {}, true});
}

} // namespace stylobate
