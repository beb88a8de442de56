/// `stylobate info`, about the program or about a file, and the options that say what to run on.

#include "ensemble/input_error.hpp"
#include "io/file_handle.hpp"
#include "io/measured_file.hpp"
#include "io/measured_outcomes.hpp"
#include "io/result_store.hpp"
#include "studies/command.hpp"
#include "studies/diagnosis/calibration_file.hpp"
#include "studies/diagnosis/diagnosis_file.hpp"
#include "studies/diagnosis/diagnosis_words.hpp"
#include "studies/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <span>

namespace stylobate {
namespace {

/// Results and diagnoses begin with a seal, before their HDF5 part.
bool is_sealed(const std::filesystem::path& file)
{
    constexpr std::string_view seal = "stylobate seal";
    const FileHandle handle = FileHandle::open(file, false);
    std::array<char, seal.size()> begin{};
    if (handle.size() < begin.size())
        return false;
    handle.read(0, std::as_writable_bytes(std::span(begin)));
    return std::string_view(begin.data(), begin.size()) == seal;
}

Json json_of(const std::vector<Finding>& findings)
{
    Json list = Json::list();
    for (const Finding& finding : findings)
        list.item(Json::object()
                      .member("severity", finding.severity == Severity::warning ? "warning" : "note")
                      .member("place", finding.place)
                      .member("text", finding.text));
    return list;
}

void print(const std::vector<Finding>& findings)
{
    for (const Severity severity : {Severity::warning, Severity::note})
        for (const Finding& finding : findings)
            if (finding.severity == severity)
                fmt::print("{}: {}: {}\n", severity == Severity::warning ? "warning" : "note", finding.place,
                           finding.text);
}

int info_of_campaign(const CommonOptions& options, const std::string& file)
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
    if (options.json) {
        fmt::print("{}\n", Json::object()
                               .member("holds", "measured campaign")
                               .member("file", file)
                               .member("specimen", campaign.specimen.name)
                               .member("blocks", campaign.specimen.blocks())
                               .member("joints", campaign.specimen.joints.size())
                               .member("runs", campaign.runs.size())
                               .member("motions", motions.size())
                               .member("collapsed", collapsed)
                               .member("duration_s", seconds)
                               .member("findings", json_of(campaign.findings))
                               .text());
        return exit_done;
    }
    fmt::print("{}: a measured campaign\n", file);
    fmt::print("specimen \"{}\": {} blocks, {} joints\n", campaign.specimen.name, campaign.specimen.blocks(),
               campaign.specimen.joints.size());
    fmt::print("{} runs of {} motions, {:.4g} s in all; {} collapsed\n", campaign.runs.size(), motions.size(), seconds,
               collapsed);
    print(campaign.findings);
    return exit_done;
}

int info_of_outcomes(const CommonOptions& options, const std::string& file)
{
    const OutcomeTable table = read_outcomes(file);
    std::set<int> motions;
    std::size_t fell = 0;
    for (const MeasuredOutcome& row : table.rows) {
        motions.insert(row.motion_id);
        fell += row.fell;
    }
    if (options.json) {
        fmt::print("{}\n", Json::object()
                               .member("holds", "measured outcomes")
                               .member("file", file)
                               .member("tests", table.rows.size())
                               .member("motions", motions.size())
                               .member("fell", fell)
                               .member("findings", json_of(table.findings))
                               .text());
        return exit_done;
    }
    fmt::print("{}: measured outcomes\n{} tests of {} motions: {} fell, {} stood\n", file, table.rows.size(),
               motions.size(), fell, table.rows.size() - fell);
    print(table.findings);
    return exit_done;
}

int info_of_result(const CommonOptions& options, const std::string& file)
{
    const ResultReader reader(file);
    const ResultHeader& header = reader.header();
    const std::uint64_t rows = reader.done();
    if (options.json) {
        fmt::print("{}\n", Json::object()
                               .member("holds", "results")
                               .member("file", file)
                               .member("kind", header.kind)
                               .member("seed", header.seed)
                               .member("code_version", header.code_version)
                               .member("realizations", header.total)
                               .member("done", rows)
                               .member("complete", reader.complete())
                               .text());
        return exit_done;
    }
    fmt::print("{}: results of a study of kind {}, seed {}, by stylobate {}\n{} of {} realizations, {}\n", file,
               header.kind, header.seed, header.code_version, rows, header.total,
               reader.complete() ? "complete" : "unfinished");
    return exit_done;
}

int info_of_diagnosis(const CommonOptions& options, const std::string& file)
{
    const Diagnosis d = read_diagnosis(file);
    if (options.json) {
        Json causes = Json::list();
        for (const Candidate* cause : named_causes(d))
            causes.item(Json::object().member("name", cause->mechanism).member("place", cause->place));
        fmt::print("{}\n", Json::object()
                               .member("holds", "diagnosis")
                               .member("file", file)
                               .member("measured", d.measured_file)
                               .member("specimen", d.specimen)
                               .member("runs", d.runs)
                               .member("code_version", d.code_version)
                               .member("verdict", to_string(d.verdict))
                               .member("causes", causes)
                               .text());
        return exit_done;
    }
    fmt::print("{}: a diagnosis of {} ({}), by stylobate {}\n{}. {}\nA page of it: stylobate report {}\n", file,
               d.measured_file, count_words(d.runs, "run", "runs"), d.code_version, verdict_heading(d),
               verdict_words(d), file);
    return exit_done;
}

int info_of_calibration(const CommonOptions& options, const std::string& file, const CalibrationSummary& c)
{
    if (options.json) {
        Json parameters = Json::list();
        for (std::size_t i = 0; i < c.keys.size(); ++i)
            parameters.item(Json::object()
                                .member("key", c.keys[i])
                                .member("value", c.value[i])
                                .member("low", c.low[i])
                                .member("high", c.high[i]));
        fmt::print("{}\n", Json::object()
                               .member("holds", "calibration")
                               .member("file", file)
                               .member("measured", c.measured)
                               .member("evidence", c.evidence)
                               .member("best_form", c.best_form)
                               .member("code_version", c.code_version)
                               .member("parameter_sets", c.parameter_sets)
                               .member("parameters", parameters)
                               .text());
        return exit_done;
    }
    fmt::print("{}: a calibration with the {} of {}, by stylobate {}\nbest contact form: {}\n", file, c.evidence,
               c.measured, c.code_version, c.best_form);
    for (std::size_t i = 0; i < c.keys.size(); ++i)
        fmt::print("  {:<36} {:>11.4g}   95 % from {:.4g} to {:.4g}\n", c.keys[i], c.value[i], c.low[i], c.high[i]);
    return exit_done;
}

int info_of_file(const CommonOptions& options, const std::string& file)
{
    std::error_code ignored;
    if (std::filesystem::path(file).extension() == ".csv")
        return info_of_outcomes(options, file);
    if (std::filesystem::is_directory(file, ignored))
        return info_of_campaign(options, file);
    if (is_sealed(file))
        return is_diagnosis(file) ? info_of_diagnosis(options, file) : info_of_result(options, file);
    if (const std::optional<CalibrationSummary> calibration = read_calibration_summary(file))
        return info_of_calibration(options, file, *calibration);
    return info_of_campaign(options, file);
}

} // namespace

Isa CommonOptions::isa() const
{
    if (simd == "auto")
        return best_isa();
    Isa isa{};
    const std::vector<Isa> usable = usable_isas();
    if (parse_isa(simd, isa) && std::find(usable.begin(), usable.end(), isa) != usable.end())
        return isa;
    std::string names;
    for (const Isa other : usable)
        names += std::string(names.empty() ? "" : ", ") + to_string(other);
    throw InputError(fmt::format("--simd {}: not on this machine; it has {}", simd, names));
}

int CommonOptions::thread_count() const
{
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

RunOptions CommonOptions::run_options() const
{
    RunOptions options{isa(), thread_count()};
    if (backend == "cuda")
        options.devices = open_cuda_devices();
    return options;
}

int info_command(const CommonOptions& options, const std::string& file)
{
    if (!file.empty())
        return info_of_file(options, file);
    const std::vector<Isa> usable = usable_isas();
    const CudaDevices gpus = cuda_devices();
    if (options.json) {
        Json devices = Json::list();
        for (const std::string& name : gpus.names)
            devices.item(name);
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
                               .member("gpus", devices)
                               .member("mpi", false)
                               .text());
        return exit_done;
    }
    fmt::print("stylobate {}\n", code_version());
    fmt::print("instruction sets: ");
    for (const Isa isa : usable)
        fmt::print("{} ", to_string(isa));
    fmt::print("(used: {}, {} realizations in a register)\n", to_string(options.isa()), kernels(options.isa()).lanes);
    fmt::print("threads: {}\n", options.thread_count());
    for (const std::string& name : gpus.names)
        fmt::print("GPU: {}\n", name);
    if (gpus.names.empty())
        fmt::print("GPU: none ({})\n", gpus.reason);
    fmt::print("MPI: not in this version\n");
    return exit_done;
}

} // namespace stylobate
