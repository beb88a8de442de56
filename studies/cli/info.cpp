/// `stylobate info`: the program and this machine, or a file, kind by kind.

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_file.hpp"
#include "io/records/record.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/cli/command.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/decisions/compare/law_runs.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/report/json.hpp"
#include "studies/report/left_out.hpp"
#include "studies/results/study_facts.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace stylobate {

namespace {

/// The report on a file: text for people, members for programs.
struct Told {
    std::string text; ///< follows "FILE: "
    Json json = Json::object();
    bool unfinished = false;
    bool has_risk = true; ///< of a comparison: whether `risk` takes it
};

const char* word_of(Severity severity)
{
    return severity == Severity::warning ? "warning" : "note";
}

Json json_of(const std::vector<Finding>& findings)
{
    Json list = Json::list();
    for (const Finding& finding : findings)
        list.item(Json::object()
                      .member("severity", word_of(finding.severity))
                      .member("place", finding.place)
                      .member("text", finding.text));
    return list;
}

/// What findings of one kind have in common, whatever run and numbers they name:
/// "run 004, blocks/x_m, block 2" -> "blocks/x_m, block ".
std::string kind_of(const Finding& finding)
{
    const std::size_t comma = finding.place.find(", ");
    const bool in_run = finding.place.starts_with("run ") && comma != std::string::npos;
    std::string kind = finding.place.substr(in_run ? comma + 2 : 0) + ": " + finding.text;
    std::erase_if(kind, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
    return word_of(finding.severity) + kind;
}

/// Warnings before notes, and kinds with few findings before those with many, which a property of the whole campaign
/// makes. Of a kind with many only the first.
/// @param all print every finding
std::string text_of(const std::vector<Finding>& findings, bool all)
{
    constexpr std::size_t few = 3;
    std::map<std::string, std::vector<const Finding*>> by_kind;
    for (const Finding& finding : findings)
        by_kind[kind_of(finding)].push_back(&finding);
    std::vector<std::vector<const Finding*>> kinds;
    for (const auto& [kind, found] : by_kind)
        kinds.push_back(found);
    std::ranges::sort(kinds, {}, [](const auto& kind) {
        return std::tuple(kind.front()->severity != Severity::warning, kind.size(), kind.front());
    });
    std::string text;
    for (const auto& kind : kinds) {
        const std::size_t shown = all || kind.size() <= few ? kind.size() : 1;
        for (std::size_t i = 0; i < shown; ++i)
            text += fmt::format("{}: {}: {}\n", word_of(kind[i]->severity), kind[i]->place, kind[i]->text);
        if (shown < kind.size())
            text += fmt::format("  and {} more of this kind; --all prints them\n", kind.size() - shown);
    }
    return text;
}

/// Reasons why a verb does not take the file as it stands ("refused": "run: ..."), or what of it can hardly be meant
/// ("warning").
void add_lines(const char* word, const char* member, const std::vector<std::string>& texts, Told& told)
{
    for (const std::string& text : texts)
        told.text += fmt::format("{}: {}\n", word, text);
    told.json.member(member, Json::list(texts));
}

/// "VERB: MESSAGE", without the name of the file that the message begins with.
std::string refusal(const std::string& verb, const InputError& error, const std::string& file)
{
    std::string message = error.what();
    if (message.starts_with(file + ": "))
        message.erase(0, file.size() + 2);
    return verb + ": " + message;
}

std::vector<std::string> refusals_of(const Campaign& campaign, const std::string& file)
{
    if (!campaign.tests.empty()) // it is their story that is told then
        return {};
    try {
        campaign_scales(campaign);
    } catch (const InputError& error) {
        return {refusal("diagnose", error, file)};
    }
    return {};
}

void tell_campaign(const std::string& file, bool all, Told& told)
{
    const Campaign campaign = read_campaign(file);
    std::set<int> motions;
    std::size_t collapsed = 0;
    double seconds = 0;
    for (const MeasuredRun& run : campaign.runs) {
        motions.insert(run.motion_id);
        collapsed += run.collapsed.value_or(false);
        seconds += run.time_s.empty() ? 0 : run.time_s.back() - run.time_s.front();
    }
    std::map<std::string, std::size_t> tests; // of each kind
    for (const MeasuredRun& run : campaign.tests)
        ++tests[to_string(run.test)];
    std::vector<std::string> test_counts;
    for (const auto& [kind, count] : tests)
        test_counts.push_back(fmt::format("{} {}", count, kind));
    told.json.member("holds", "measured campaign")
        .member("specimen", campaign.specimen.name)
        .member("blocks", campaign.specimen.blocks())
        .member("joints", campaign.specimen.joints.size())
        .member("runs", campaign.runs.size())
        .member("tests", campaign.tests.size())
        .member("motions", motions.size())
        .member("collapsed", collapsed)
        .member("duration_s", seconds)
        .member("findings", json_of(campaign.findings));
    told.text = fmt::format("a measured campaign\nspecimen \"{}\": {} blocks, {} joints\n{} runs of {} motions, {:.4g} "
                            "s in all; {} collapsed\n{}{}",
                            campaign.specimen.name, campaign.specimen.blocks(), campaign.specimen.joints.size(),
                            campaign.runs.size(), motions.size(), seconds, collapsed,
                            tests.empty() ? "" : fmt::format("tests of joints: {}\n", fmt::join(test_counts, ", ")),
                            text_of(campaign.findings, all));
    add_lines("refused", "refused", refusals_of(campaign, file), told);
}

void tell_outcomes(const std::string& file, bool all, Told& told)
{
    const OutcomeTable table = read_outcomes(file);
    std::set<int> motions;
    std::size_t fell = 0;
    for (const MeasuredOutcome& row : table.rows) {
        motions.insert(row.motion_id);
        fell += row.fell;
    }
    told.json.member("holds", "measured outcomes")
        .member("tests", table.rows.size())
        .member("motions", motions.size())
        .member("fell", fell)
        .member("findings", json_of(table.findings));
    told.text = fmt::format("measured outcomes\n{} tests of {} motions: {} fell, {} stood\n{}", table.rows.size(),
                            motions.size(), fell, table.rows.size() - fell, text_of(table.findings, all));
}

/// The conventions of the study, and the band over contact laws or the command that measures it.
void tell_conventions_and_laws(const std::string& file, const ResultHeader& header, Told& told)
{
    std::optional<Study> study;
    try {
        study = parse_study(header.study_toml, file + " (its study)");
    } catch (const InputError&) { // of another version: all else is known of it
        return;
    }
    const std::string conventions = conventions_text(*study);
    told.text += fmt::format("conventions: {}\n{}\n", conventions, left_out_text(*study));
    told.json.member("conventions", conventions).member("left_out", left_out_text(*study));
    const std::optional<LawBand> band = law_band_beside(file, *study, header);
    told.text += band ? law_band_text(*band) : law_advice(*study) + "\n";
    if (band)
        told.json.member("contact_laws", law_band_json(*band));
}

void tell_result(const std::string& file, Told& told)
{
    const ResultReader reader(file);
    const ResultHeader& header = reader.header();
    const std::uint64_t done = reader.done();
    told.json.member("holds", "results")
        .member("kind", header.kind)
        .member("seed", header.seed)
        .member("code_version", header.code_version)
        .member("build", header.build.value_or(""))
        .member("study_crc32", fmt::format("{:08x}", study_crc32_of(header)))
        .member("realizations", header.total)
        .member("done", done)
        .member("complete", reader.complete());
    if (!header.shard.whole())
        told.json.member("shard", header.shard.text());
    const std::string what = header.kind == "replay" ? fmt::format("realization {} of a study, run again with its "
                                                                   "trajectory",
                                                                   header.first)
                                                     : "results of a study of kind " + header.kind;
    told.text =
        fmt::format("{}, seed {}, by stylobate {}{}\n{} of {} realizations, {}\n", what, header.seed,
                    header.code_version, header.build ? fmt::format(" ({})", *header.build) : "", done, header.total,
                    reader.complete()      ? "complete"
                    : header.shard.whole() ? "unfinished"
                                           : "shard " + header.shard.text());
    told.unfinished = !reader.complete();
    if (told.unfinished)
        told.text += fmt::format("stylobate run STUDY.toml {}-o {}: continues it with the study stored in it\n",
                                 header.shard.whole() ? "" : "--shard " + header.shard.text() + " ", file);
    if (!told.unfinished)
        tell_conventions_and_laws(file, header, told);
    add_lines("warning", "warnings", header.warnings, told);
}

void tell_diagnosis(const std::string& file, Told& told)
{
    const Diagnosis d = read_diagnosis(file);
    Json causes = Json::list();
    for (const Candidate* cause : named_causes(d))
        causes.item(Json::object().member("name", cause->mechanism).member("place", cause->place));
    told.json.member("holds", "diagnosis")
        .member("measured", d.measured_file)
        .member("specimen", d.specimen)
        .member("runs", d.runs)
        .member("code_version", d.code_version)
        .member("verdict", to_string(d.verdict))
        .member("causes", causes);
    told.text = fmt::format("a diagnosis of {} ({}), by stylobate {}\n{}. {}\n", d.measured_file,
                            counted(d.runs, "run"), d.code_version, verdict_heading(d), verdict_words(d)) +
                left_out_text(2) + "\n";
    told.json.member("left_out", left_out_text(2));
}

void tell_comparison(const std::string& file, Told& told)
{
    const Comparison comparison = read_comparison(file);
    told.text = fmt::format("a comparison of studies of kind '{}', by stylobate {}\n{}", comparison.kind,
                            comparison.code_version, comparison_text(comparison));
    told.json = comparison_json(comparison);
    try {
        check_has_risk(comparison, file);
    } catch (const InputError&) {
        told.has_risk = false;
    }
    told.json.member("holds", "comparison").member("code_version", comparison.code_version);
}

void tell_calibration(const std::string& file, Told& told)
{
    const StoredCalibration c = read_calibration(file);
    Json parameters = Json::list();
    told.text = fmt::format("a calibration with the {} of {}, by stylobate {}\nbest contact form: {}\n", c.evidence,
                            c.measured, c.code_version, c.best_form);
    for (const FittedParameter& p : c.best().parameters) {
        parameters.item(Json::object()
                            .member("key", p.key)
                            .member("value", p.value)
                            .member("low", p.low)
                            .member("high", p.high)
                            .member("determined", p.determined)
                            .member("effective", p.effective)
                            .member("note", p.note));
        told.text += fmt::format("  {:<36} {:>11.4g}   {}{}{}\n", p.key, p.value, interval_words(p),
                                 p.note.empty() ? "" : "   ", p.note);
    }
    told.text += left_out_text(2) + "\n";
    told.json.member("holds", "calibration")
        .member("measured", c.measured)
        .member("evidence", c.evidence)
        .member("best_form", c.best_form)
        .member("code_version", c.code_version)
        .member("parameter_sets", c.parameter_sets)
        .member("parameters", parameters)
        .member("left_out", left_out_text(2));
}

void tell_risk(const std::string& file, Told& told)
{
    const AnyRisk risk = read_any_risk(file);
    const bool change = std::holds_alternative<RiskChange>(risk);
    const std::string version = std::visit([](const auto& one) { return one.code_version; }, risk);
    const std::string what = change ? "risk estimate of a comparison" : "risk estimate";
    told.json.member("holds", what)
        .member("code_version", version)
        .member(change ? "risk_change" : "risk", risk_json(risk));
    told.text = fmt::format("a {}, by stylobate {}\n{}", what, version, risk_text(risk));
}

void tell_study(const CommonOptions& options, const std::string& file, Told& told)
{
    const Study study = read_study(file, options.set);
    const StudyDesign design = study.design();
    told.json.member("holds", "study")
        .member("kind", word_for(study_kind_names, study.kind))
        .member("seed", study.seed)
        .member("realizations", design.most);
    told.text = fmt::format("a study of kind {}, {}{}, seed {}\n", word_for(study_kind_names, study.kind),
                            design.selected ? "at most " : "", counted(design.most, "realization"), study.seed);
    for (const auto& [what, is] : study_facts(study)) {
        std::string key = what;
        std::transform(key.begin(), key.end(), key.begin(), [](char c) {
            return c == ' ' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c;
        });
        told.json.member(key, is);
        told.text += fmt::format("  {}: {}\n", what, is);
    }
    const std::string conventions = conventions_text(study);
    told.json.member("conventions", conventions).member("left_out", left_out_text(study));
    told.text += fmt::format("  Conventions: {}\n  {}\n", conventions, left_out_text(study));
    std::vector<std::string> warnings, refusals;
    std::vector<Implausibility> found;
    try {
        found = LoadedStudy::from_file(file, options.set).implausibilities();
    } catch (const InputError& error) { // without its motions
        refusals.push_back(refusal("run", error, file));
        found = implausibilities(study);
    }
    for (const Implausibility& one : found)
        if (one.refused)
            refusals.push_back(fmt::format("run: {} If it is intended: study.allow = [\"{}\"].", one.text, one.check));
        else
            warnings.push_back(one.text);
    add_lines("refused", "refused", refusals, told);
    add_lines("warning", "warnings", warnings, told);
}

void tell_record(const std::string& file, const RecognisedFile& known, Told& told)
{
    told.json.member("holds", "record").member("format", *known.detail);
    told.text = describe(known) + "\n";
    std::vector<Record> records;
    std::vector<std::string> refusals;
    try {
        records = read_records(file, "");
    } catch (const InputError& error) { // it lacks its unit, for example: it is a record nevertheless
        refusals.push_back(refusal("record", error, file));
    }
    add_lines("refused", "refused", refusals, told);
    Json components = Json::list();
    for (const Record& record : records) {
        double pga = 0;
        for (const double a : record.acceleration_m_s2)
            pga = std::max(pga, std::abs(a));
        components.item(Json::object()
                            .member("component", record.component)
                            .member("samples", record.acceleration_m_s2.size())
                            .member("dt_s", record.dt_s)
                            .member("pga_m_s2", pga));
        told.text += fmt::format("  component {}: {} samples at {} s, PGA {:.4g} m/s2\n", record.component,
                                 record.acceleration_m_s2.size(), record.dt_s, pga);
    }
    told.json.member("components", components);
    told.text += "To use it in a study: excitation.kind = \"record\" and excitation.file.\n";
}

/// What a file is, what it holds, and what can be done with it; as JSON with --json.
/// @throws InputError if there is no such file, if it is damaged, or if its content is wrong
void print_file(const CommonOptions& options, const std::string& file, bool all)
{
    const RecognisedFile known = recognise(file);
    if (known.kind != FileKind::study)
        check_no_settings(options.set, file);
    Told told;
    switch (known.kind) {
    case FileKind::study:
        tell_study(options, file, told);
        break;
    case FileKind::results:
        tell_result(file, told);
        break;
    case FileKind::diagnosis:
        tell_diagnosis(file, told);
        break;
    case FileKind::comparison:
        tell_comparison(file, told);
        break;
    case FileKind::calibration:
        tell_calibration(file, told);
        break;
    case FileKind::risk:
        tell_risk(file, told);
        break;
    case FileKind::outcomes:
        tell_outcomes(file, all, told);
        break;
    case FileKind::record:
        tell_record(file, known, told);
        break;
    case FileKind::table:
    case FileKind::functions:
    case FileKind::picture:
    case FileKind::page:
        told.json.member("holds", describe(known));
        told.text = describe(known) + "\nstylobate writes such files and does not read them.\n";
        break;
    case FileKind::campaign:
        tell_campaign(file, all, told);
        break;
    case FileKind::unknown:
        if (!std::filesystem::exists(file))
            throw InputError(file, 0, "there is no such file");
        throw InputError(file, 0,
                         "is not a file that stylobate reads: a study (TOML), results, a comparison, a diagnosis, a "
                         "calibration or a risk estimate (HDF5), a measured campaign (HDF5 or a folder with "
                         "campaign.toml), measured "
                         "outcomes (CSV with a column 'fell'), or a record of ground motion.\n  io/FORMAT.md has the "
                         "layouts.");
    }
    std::vector<FileUse> uses = uses_of(known, file);
    if (!told.has_risk)
        std::erase_if(uses, [](const FileUse& use) { return use.verb == "risk"; });
    std::erase_if(uses, [&](const FileUse& use) { return use.verb == (told.unfinished ? "report" : "merge"); });
    if (options.json) {
        Json verbs = Json::list();
        for (const FileUse& use : uses)
            verbs.item(use.verb);
        fmt::print("{}\n", told.json.member("file", file).member("verbs", verbs).text());
        return;
    }
    fmt::print("{}: {}", file, told.text);
    for (const FileUse& use : uses)
        fmt::print("{}: {}\n", use.command, use.purpose);
}

} // namespace

int info_command(const CommonOptions& options, const std::optional<std::string>& file, bool all,
                 const std::optional<std::string>& mpi)
{
    if (file) {
        print_file(options, *file, all);
        return exit_done;
    }
    const std::vector<Isa> usable = usable_isas();
    const CudaDevices gpus = cuda_devices();
    if (options.json) {
        Json sets = Json::list();
        for (const Isa isa : usable)
            sets.item(to_string(isa));
        fmt::print("{}\n", Json::object()
                               .member("version", code_version())
                               .member("simd", sets)
                               .member("simd_used", to_string(options.isa()))
                               .member("lanes", kernels(options.isa()).lanes)
                               .member("threads", options.thread_count())
                               .member("gpu", !gpus.names.empty())
                               .member("gpus", Json::list(gpus.names))
                               .member("mpi", mpi.has_value())
                               .member("mpi_library", mpi.value_or(""))
                               .member("machine", machine_json(machine_facts()))
                               .text());
        return exit_done;
    }
    fmt::print("stylobate {}\n{}", code_version(), machine_text(machine_facts()));
    fmt::print("instruction sets: ");
    for (const Isa isa : usable)
        fmt::print("{} ", to_string(isa));
    fmt::print("(used: {}, {} realizations in a register)\n", to_string(options.isa()), kernels(options.isa()).lanes);
    fmt::print("threads: {}\n", options.thread_count());
    for (const std::string& name : gpus.names)
        fmt::print("GPU: {}\n", name);
    if (gpus.names.empty())
        fmt::print("GPU: none ({})\n", gpus.reason);
    fmt::print("MPI: {}\n", mpi.value_or("none (this program was built without it)"));
    return exit_done;
}

} // namespace stylobate
