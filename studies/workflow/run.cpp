#include "studies/workflow/run.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/run_order.hpp"
#include "io/files/file_handle.hpp"
#include "io/keys/words.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/together.hpp"
#include "studies/decisions/compare/law_runs.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/kinds/kind.hpp"
#include "studies/report/left_out.hpp"
#include "studies/report/words.hpp"
#include "studies/results/kinds.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

namespace stylobate {

namespace {

/// A file, and what it has.
struct ShardFile {
    std::string file;
    Shard shard;  ///< that it is meant for; all: it is itself joined, or a run that was interrupted
    DoneSet done; ///< by places in the order of the run
};

/// @throws InputError if it is no unfinished results file of a study with shards
void check_is_part(const ResultReader& reader, const std::string& file)
{
    const ResultHeader& header = reader.header();
    if (header.kind == "replay")
        throw InputError(file, 0, "is one realization that was run again, and no shard of a study.");
    if (header.selected)
        throw InputError(file, 0, "is of a study whose realizations are chosen by what others did. It has no shards.");
    if (reader.complete())
        throw InputError(file, 0, "is already complete: nothing is to be merged with it.");
}

/// Why a study cannot run on a device; empty: it can.
std::optional<std::string> needs_processor(const Study& study, const Kind& kind)
{
    if (study.structure.spatial())
        return "has structure.dimensions = 3, whose steps are computed on the processor";
    return kind.needs_processor();
}

} // namespace

Json run_json(const RunReport& r)
{
    const Progress& p = r.progress;
    const Study& study = r.run->study();
    Json json = Json::object();
    json.member("kind", word_for(study_kind_names, study.kind))
        .member("results", r.results)
        .member("complete", r.whole())
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
        .member("backend", r.backend)
        .member("simd", to_string(r.options.isa))
        .member("threads", r.options.threads);
    if (r.options.ranks)
        json.member("ranks", static_cast<std::uint64_t>(r.options.ranks->size()));
    if (!r.shard().whole())
        json.member("shard", r.shard().text()).member("shard_complete", r.complete);
    json.member("conventions", conventions_text(study)).member("left_out", left_out_text(study));
    if (r.run->kind().draws_plainly())
        json.member("limit_states", r.run->kind().limits_json());
    if (r.whole())
        r.run->kind().add_to(json);
    if (r.laws)
        json.member("contact_laws", law_band_json(*r.laws));
    else if (r.laws_interrupted)
        json.member("contact_laws", Json::object().member("complete", false));
    return json;
}

std::string run_text(const RunReport& r)
{
    const Progress& p = r.progress;
    const Study& study = r.run->study();
    std::string text = fmt::format("{}: {}{} realizations{}, {} collapsed, {} invalid", r.results, p.done,
                                   p.open_end ? "" : fmt::format(" of {}", p.total),
                                   r.shard().whole() ? "" : " of shard " + r.shard().text(), p.collapsed, p.invalid);
    if (p.seconds > 0)
        text += fmt::format(
            "; {} with {}{} threads of {}, {} realizations/s", duration_text(p.seconds),
            r.options.ranks ? fmt::format("{} ranks of ", r.options.ranks->size()) : "", r.options.threads,
            r.options.devices.empty() ? to_string(r.options.isa) : "the host and " + r.options.devices.front()->name(),
            rate_text(p.rate));
    text += "\n";
    if (r.whole()) {
        text +=
            fmt::format("{}conventions: {}\n{}\n", r.run->kind().text(), conventions_text(study), left_out_text(study));
        if (r.laws_interrupted)
            return text + "Interrupted; the study is complete, its runs under other contact laws are not. The same "
                          "command continues them.\n";
        return text + (r.laws ? law_band_text(*r.laws) : law_advice(study) + "\n");
    }
    if (!std::isnan(p.share)) // without those that have not ended because they take long
        text += fmt::format("  in the whole study {:.3g} % collapse ({:.3g} to {:.3g}, 95 % interval)\n", 100 * p.share,
                            100 * p.share_lower, 100 * p.share_upper);
    text += fmt::format("conventions: {}\n{}\n", conventions_text(study), left_out_text(study));
    if (r.merged)
        return text +
               fmt::format("Partial: `stylobate run STUDY.toml -o {}` computes the missing realizations.\n", r.results);
    if (r.complete)
        return text + "The shard is complete. `stylobate merge` joins it with the others.\n";
    return text + fmt::format("Interrupted; {} realizations are kept. The same command continues the run.\n", p.done);
}

std::optional<std::string> RunReport::too_many_invalid() const
{
    if (!complete || laws_interrupted)
        return std::nullopt;
    const auto own = stylobate::too_many_invalid(run->study(), progress.invalid, progress.total, results);
    return own ? own : law_invalid;
}

std::optional<std::string> too_many_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total,
                                            const std::string& results)
{
    if (invalid == 0 || static_cast<double>(invalid) / static_cast<double>(total) <= study.run.max_invalid_fraction)
        return std::nullopt;
    return fmt::format("{} of {} realizations are invalid, more than run.max_invalid_fraction = {} allows. `stylobate "
                       "replay {} --realization I` repeats one of them; a smaller run.step_fraction may help.",
                       invalid, total, study.run.max_invalid_fraction, results);
}

std::optional<std::string> too_many_invalid(const StudyRuns& studies)
{
    for (const auto& study : studies)
        if (auto message = too_many_invalid(study->study(), study->invalid(), study->done(), study->results()))
            return message;
    return std::nullopt;
}

void check_can_run(const StudyRuns& studies, const std::string& backend)
{
    for (const auto& study : studies)
        if (const auto why = needs_processor(study->study(), study->kind()); backend == "cuda" && why)
            throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study->name(), *why));
    for (const auto& study : studies)
        try {
            study->check_drawn();
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", study->name(), error.what()));
        }
}

bool run_all(const StudyRuns& studies, const RunOptions& options, WorkObserver& observer)
{
    for (std::size_t i = 0; i < studies.size(); ++i) {
        StudyRun& study = *studies[i];
        if (!study.finished())
            observer.note(fmt::format("{} ({} of {})", study.name(), i + 1, studies.size()));
        if (observer.stop_requested() || !study.run(options, observer).complete)
            return false;
    }
    return true;
}

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
    if (const auto why = kind->why_no_shards(); !shard.whole() && why)
        throw InputError(fmt::format("--shard {}: {} {}. Run it without --shard.", shard.text(), study, *why));
    if (const auto why = kind->why_no_ranks(); machine.ranks && why)
        throw InputError(fmt::format("--mpi: {} {}. Run it without --mpi.", study, *why));
    if (const auto why = needs_processor(loaded.study(), *kind); machine.backend == "cuda" && why)
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study, *why));
}

/// What its user should know of a run, beside its warnings.
std::optional<std::string> notice_of(const StudyRun& run, const RunRequest& request)
{
    std::optional<std::string> notice = run.notice();
    if (const auto variants = read_variant_names(request.study, request.settings); !variants.empty())
        notice = fmt::format("{}{} has [variants] ({}), which run leaves out: it computes the base alone. stylobate "
                             "compare {} computes them all.",
                             notice ? *notice + "\n" : "", request.study, fmt::join(variants, ", "), request.study);
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

/// A message of what is missing, with the commands that compute it.
/// @param done, total realizations that there are, and of the study
std::string missing_text(const std::vector<ShardFile>& files, const Kind& kind, std::uint64_t done, std::uint64_t total)
{
    constexpr std::size_t most = 10; // lines
    std::vector<std::string> lines;
    std::set<std::uint64_t> numbers, of;
    for (const ShardFile& part : files) {
        of.insert(part.shard.of);
        numbers.insert(part.shard.number);
        const std::uint64_t size = kind.size_of(part.shard);
        const std::uint64_t has = part.done.all().end;
        if (!part.shard.whole() && has < size)
            lines.push_back(fmt::format("{0} lacks {1} of the {2} realizations of shard {3}: stylobate run STUDY.toml "
                                        "--shard {3} -o {0}",
                                        part.file, size - has, size, part.shard.text()));
    }
    if (of.size() == 1 && *of.begin() > 1)
        for (Shard shard{1, *of.begin()}; shard.number <= shard.of && lines.size() <= most; ++shard.number)
            if (!numbers.contains(shard.number) && kind.size_of(shard) > 0)
                lines.push_back(
                    fmt::format("shard {0} has no file: stylobate run STUDY.toml --shard {0}", shard.text()));
    if (lines.size() > most) {
        lines.resize(most);
        lines.emplace_back("and others");
    }
    std::string text = fmt::format("{} of {} realizations are missing.\n", total - done, total);
    for (const std::string& line : lines)
        text += "  " + line + "\n";
    return text + "  Give --partial to join what there is; `run` then computes the rest.";
}

/// @param header of the study
/// @throws InputError if it is no part of this study, or of another version
ShardFile read_shard_file(const std::string& file, const ResultHeader& header)
{
    const ResultReader reader(file);
    check_is_part(reader, file);
    const ResultHeader& found = reader.header();
    if (const auto other = study_difference(found, false, header))
        throw InputError(file, 0, "is of another study than the first file: " + *other + ".");
    if (found.code_version != header.code_version)
        throw InputError(file, 0,
                         fmt::format("was begun by version {} and this is version {}. Merge shards with the version "
                                     "that has made all of them.",
                                     found.code_version, header.code_version));
    if (reader.counted())
        return {file, found.shard, *reader.counted()};
    const RunOrder order(header.total);
    ShardFile part{file, found.shard, DoneSet(order)};
    reader.for_each_row([&](const ResultRow& row) {
        const State state = row.outcome.state;
        part.done.add(order.place(row.index), state == State::collapsed, state == State::invalid);
    });
    return part;
}

/// All that the files have together.
/// @throws InputError if two of them have the same realization
DoneSet joined(const std::vector<ShardFile>& files, const RunOrder& order)
{
    DoneSet all(order);
    for (const ShardFile& part : files) {
        if (const std::optional<std::uint64_t> place = all.common(part.done)) {
            const auto owner =
                std::find_if(files.begin(), files.end(), [&](const ShardFile& p) { return p.done.has(*place); });
            throw InputError(fmt::format("{} and {} both have realization {}. Leave one of them out.", owner->file,
                                         part.file, order.index(*place)));
        }
        all.add(part.done);
    }
    return all;
}

} // namespace

RunReport run_study_file(const RunRequest& request, const Machine& machine, WorkObserver& observer)
{
    const std::string results =
        request.results ? *request.results : default_results(request.study, shard_of(request.shard));
    RunReport report{.results = results, .run = nullptr, .backend = machine.backend};
    std::unique_ptr<StudyRun> run;
    std::optional<std::string> notice;
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
        if (notice)
            observer.note(*notice);
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
    auto checked = std::make_unique<StudyRun>(std::move(loaded), header, first, std::nullopt);
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
