#include "studies/workflow/run.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/file_handle.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/shard_files.hpp"
#include "studies/cluster/together.hpp"
#include "studies/decisions/compare/law_runs.hpp"
#include "studies/results/kinds.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace stylobate {

namespace {

/// The default results file: in the working folder, with the name of the study.
std::string default_results(const std::string& study, const Shard& shard)
{
    return std::filesystem::path(study).stem().string() +
           (shard.whole() ? "" : fmt::format("_{}_of_{}", shard.number, shard.of)) + ".h5";
}

/// @throws InputError if there is no such part of a study
Shard shard_of(const std::optional<std::string>& text)
{
    if (!text)
        return {};
    const std::optional<Shard> shard = Shard::from_text(*text);
    if (!shard)
        throw InputError(fmt::format("--shard {}: give the number of the part and that of all parts, such as 3/8: 1/8 "
                                     "to 8/8, of at most {} parts",
                                     *text, Shard::most));
    return *shard;
}

/// @throws InputError if the study cannot be run on this machine, or in parts
void check_can_run(const LoadedStudy& loaded, const std::string& study, const Shard& shard, const Machine& machine)
{
    const ResultHeader header = loaded.result_header();
    const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
    if (const std::string why = kind->why_no_shards(); !shard.whole() && !why.empty())
        throw InputError(fmt::format("--shard {}: {} {}. Run it without --shard.", shard.text(), study, why));
    if (const std::string why = kind->why_no_ranks(); machine.ranks && !why.empty())
        throw InputError(fmt::format("--mpi: {} {}. Run it without --mpi.", study, why));
    if (const std::string why = kind->needs_processor(); machine.backend == "cuda" && !why.empty())
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study, why));
}

/// What its user should know of a run, beside its warnings.
std::string notice_of(const StudyRun& run, const RunRequest& request)
{
    std::string notice = run.notice();
    if (const auto variants = read_variant_names(request.study, request.settings); !variants.empty())
        notice += fmt::format("{}{} has [variants] ({}), which run leaves out: it computes the base alone. stylobate "
                              "compare {} computes them all.",
                              notice.empty() ? "" : "\n", request.study, fmt::join(variants, ", "), request.study);
    return notice;
}

/// The study under other contact laws, once it is complete. @param asked null: those that are there
void run_laws(RunReport& report, LawRuns* asked, WorkObserver& observer)
{
    if (!report.whole())
        return;
    if (!asked) {
        report.laws = law_band_beside(report.results, report.run->study(), report.run->header());
        return;
    }
    observer.begin();
    report.laws_interrupted = !run_all(asked->runs(), report.options, observer);
    if (report.laws_interrupted)
        return;
    report.laws = asked->conclude();
    report.law_invalid = too_many_invalid(asked->runs());
}

} // namespace

RunReport run_study_file(const RunRequest& request, const Machine& machine, WorkObserver& observer)
{
    const std::string results =
        request.results ? *request.results : default_results(request.study, shard_of(request.shard));
    RunReport report{.results = results, .run = nullptr, .backend = machine.backend};
    std::unique_ptr<StudyRun> run;
    std::string notice;
    together(machine.ranks, [&] {
        check_kind(request.study, "run");
        check_option_kind(results, FileKind::results, "-o");
        const Shard shard = shard_of(request.shard);
        LoadedStudy loaded = LoadedStudy::from_file(request.study, request.settings);
        check_can_run(loaded, request.study, shard, machine);
        report.options = machine.run_options();
        run = std::make_unique<StudyRun>(std::move(loaded), request.study, results, shard, machine.ranks);
        notice = notice_of(*run, request);
    });
    run->agree();
    std::unique_ptr<LawRuns> laws;
    if (request.laws) {
        laws = std::make_unique<LawRuns>(run->loaded(), request.study, results);
        check_can_run(laws->runs(), machine.backend);
        if (!laws->finished())
            observer.note(laws->costs());
    }
    if (run->finished()) {
        if (machine.leads())
            report.progress = run->restore();
        report.complete = report.was_complete = true;
    } else {
        together(machine.ranks, [&] { run->check_drawn(); });
        observer.begin();
        together(machine.ranks, [&] { run->open(); });
        for (const std::string& warning : run->warnings()) // now that nothing is refused any more
            observer.warn(warning);
        if (!notice.empty())
            observer.note(notice);
        RunEnd end = run->run(report.options, observer);
        report.progress = end.progress;
        report.complete = end.complete;
    }
    report.run = std::move(run);
    if (machine.leads())
        run_laws(report, laws.get(), observer);
    return report;
}

std::optional<RunReport> merge_shards(const MergeRequest& request, const Machine& machine, WorkObserver& observer)
{
    for (const std::string& file : request.files) {
        check_kind(file, "merge");
        check_output(file, request.output, request.force);
    }
    const std::string& first = request.files.front();
    ResultHeader header;
    {
        const ResultReader reader(first);
        check_is_part(reader, first);
        header = reader.header();
    }
    header.shard = {};
    header.code_version = code_version(); // what is made of the rows is made by this one
    header.build = code_build();
    const Study study = parse_study(header.study_toml, first + " (its study)");
    LoadedStudy loaded = LoadedStudy::from_results(study, header, first, request.settings);
    const std::filesystem::path unready = request.output + ".merging";
    auto checked = std::make_unique<StudyRun>(std::move(loaded), header, first, "");
    const RunOptions options = machine.run_options();

    std::vector<ShardFile> parts;
    for (const std::string& file : request.files)
        parts.push_back(read_shard_file(file, header));
    const DoneSet all = joined(parts, RunOrder(header.total));
    const DoneSet::Part there = all.all(), sample = all.sample();
    const bool complete = there.end == header.total;
    if (!complete && !request.partial)
        throw InputError(missing_text(parts, checked->kind(), there.end, header.total));

    // nothing is refused any more
    observer.begin();
    std::filesystem::remove(unready);
    const Temporary temporary(unready);
    std::unique_ptr<StudyRun> run = std::move(checked); // closed before its file is removed
    RunReport report{
        .results = request.output,
        .run = nullptr,
        .options = options,
        .backend = machine.backend,
        .progress = {.done = there.end, .total = header.total, .collapsed = there.collapsed, .invalid = there.invalid},
        .complete = complete,
        .merged = true};
    estimate_share(report.progress, sample.end - sample.invalid, sample.collapsed);
    run->open(open_store(unready.string(), header, false));
    for (const std::string& file : request.files) {
        if (observer.stop_requested())
            return std::nullopt;
        run->take(ResultReader(file));
    }
    if (complete) { // nothing is left to run; what follows on the realizations is
        const RunEnd end = run->run(options, observer);
        if (!end.complete)
            return std::nullopt;
        report.progress = end.progress;
    } else {
        run->keep();
    }
    rename_over(unready, request.output);
    report.run = std::move(run);
    return report;
}

} // namespace stylobate
