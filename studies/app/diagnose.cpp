/// `stylobate diagnose`: from a measured campaign to a diagnosis.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/calibration/calibration.hpp"
#include "studies/cluster/together.hpp"
#include "studies/diagnosis/decision/pipeline.hpp"
#include "studies/diagnosis/findings/diagnosis_file.hpp"
#include "studies/diagnosis/findings/diagnosis_json.hpp"
#include "studies/diagnosis/findings/diagnosis_text.hpp"
#include "studies/diagnosis/findings/fingerprint.hpp"
#include "studies/diagnosis/laws/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace stylobate {

namespace {

/// As a shell takes it for one word.
std::string shell_word(const std::string& word)
{
    const std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace

int diagnose_command(const CommonOptions& options, const std::string& measured, const std::string& study_file,
                     std::string output, const DiagnoseOptions& wanted)
{
    if (output.empty())
        output = std::filesystem::path(measured).stem().string() + "_diagnosis.h5";
    const std::filesystem::path beside = std::filesystem::path(output).parent_path();
    const std::string stem = std::filesystem::path(output).stem().string();
    DiagnosisOptions how;
    how.extension = beside / (stem + "_extended.toml");
    how.cache = beside / (stem + "_campaigns.txt");
    how.seed = static_cast<std::uint64_t>(wanted.seed);
    how.plan = EnsemblePlan::with(static_cast<std::uint64_t>(wanted.nulls));
    Campaign campaign;
    Study study;
    together(options.ranks, [&] { // before anything is written
        check_kind(measured, "diagnose");
        check_option_kind(study_file, FileKind::study, "--study");
        campaign = read_campaign(measured);
        study = study_file.empty()
                    ? parse_study(default_study(campaign).text, "the default start study of a diagnosis", options.set)
                    : read_study(study_file, options.set);
        demand_double(study, study_file.empty() ? "--set" : study_file, "a diagnosis");
        how.run = options.run_options();
        track_scales(campaign); // refuses data that cannot be diagnosed
        if (how.run.leads()) {
            check_output(measured, output, options.force);
            check_output(measured, how.extension, options.force);
            check_cache(how);
            const AtomicFile writable(output);
        }
    });
    if (!how.run.leads()) { // simulates its part of the campaigns; rank 0 reports the results
        Console silent(true);
        return diagnose(
                   campaign, study, how, [](const std::string&) {}, silent)
                   ? exit_done
                   : exit_interrupted;
    }
    Console console(options.quiet);
    const auto tell = [&](const std::string& line) { note(options.quiet, line); };
    StopOnly observer(console); // no progress: `tell` prints the stages
    std::optional<Diagnosis> diagnosis = diagnose(campaign, study, how, tell, observer);
    if (!diagnosis) {
        tell(std::filesystem::exists(how.cache)
                 ? "Interrupted. The same command continues: the simulated campaigns are kept in " +
                       how.cache.string() + "."
                 : "Interrupted before a simulated campaign was kept. The same command begins anew.");
        return exit_interrupted;
    }
    diagnosis->measured_fingerprint = fingerprint(measured);
    diagnosis->command = "stylobate diagnose " + shell_word(measured);
    if (!study_file.empty())
        diagnosis->command += " --study " + shell_word(study_file);
    for (const std::string& setting : options.set)
        diagnosis->command += " --set " + shell_word(setting);
    diagnosis->command += fmt::format(" -o {} --nulls {} --seed {}", shell_word(output), wanted.nulls, wanted.seed);
    if (!diagnosis->extended_study.empty()) {
        AtomicFile file(how.extension);
        file.write(diagnosis->extended_study);
        file.commit();
        diagnosis->extended_study_file = how.extension.string();
    }
    write_diagnosis(*diagnosis, output);
    if (options.json)
        fmt::print("{}\n", diagnosis_json(*diagnosis).text());
    else
        fmt::print("{}", diagnosis_text(*diagnosis));
    std::fflush(stdout); // before the line on standard error
    tell(fmt::format("Diagnosis: {}. A page of it: stylobate report {}", output, output));
    return exit_done;
}

} // namespace stylobate
