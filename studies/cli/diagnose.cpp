/// `stylobate calibrate` and `stylobate diagnose`: contact parameters, and the causes of errors, from measured data.

#include "studies/workflow/diagnose.hpp"
#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cli/command.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/workflow/calibrate.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <cstdio>
#include <filesystem>

namespace stylobate {

int calibrate_command(const CommonOptions& options, CalibrationRequest request, const std::optional<std::string>& study,
                      const std::optional<std::string>& output)
{
    const std::filesystem::path measured(request.measured);
    const std::string stem =
        (measured.has_stem() ? measured : measured.parent_path()).stem().string(); // of a folder too
    const std::string results = output.value_or(stem + "_calibration.h5");
    const std::string without_ending = std::filesystem::path(results).replace_extension().string();
    const std::string calibrated = (output ? without_ending : stem) + "_calibrated.toml";
    request.settings = options.set;
    request.start_name = study.value_or("--set");
    request.kept = without_ending + "_sets.bin";
    request.check_outputs = [&] {
        check_output(request.measured, results, options.force);
        check_output(request.measured, calibrated, options.force);
        AtomicFile::check(calibrated);
        AtomicFile::check(results);
    };
    together(options.ranks, [&] { request.start = start_study(options, request.measured, "calibrate", study); });
    Console console = options.console("calibrate");
    const CalibrationEnd end = calibrate_measured(request, options, console);
    if (!options.leads()) // it has predicted what rank 0 requested
        return exit_done;
    const Calibration& found = end.found;
    if (!found.complete) {
        console.note(fmt::format(
            "Interrupted: {} of at most {} parameter sets are kept in {}. The same command continues from there.",
            found.kept_sets, end.planned, request.kept->string()));
        return console.end(exit_interrupted);
    }
    const std::string text = calibrated_text(found, request.measured);
    parse_study(text, calibrated); // what is written is a study
    AtomicFile study_file(calibrated);
    study_file.write(text);
    write_results(end, results);
    study_file.commit();
    print(
        options,
        [&] {
            return fmt::format("{}{}: {}\n{}: the calibrated study\n", calibration_text(found), results,
                               calibration_cost(found), calibrated);
        },
        [&] { return calibration_json(found).member("results", results).member("calibrated_study", calibrated); });
    return console.end(exit_done);
}

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

/// The command that makes the same diagnosis.
std::string command_of(const CommonOptions& options, const DiagnosisRequest& request,
                       const std::optional<std::string>& study, const std::string& output)
{
    std::string command = "stylobate diagnose " + shell_word(request.measured);
    if (study)
        command += " --study " + shell_word(*study);
    for (const std::string& setting : options.set)
        command += " --set " + shell_word(setting);
    if (!request.tests.empty())
        command += " --tests";
    for (const std::string& file : request.tests)
        command += " " + shell_word(file);
    if (request.specimens != DiagnosisRequest{}.specimens)
        command += fmt::format(" --specimens {}", request.specimens);
    if (request.plan)
        command += " --plan";
    return command + fmt::format(" -o {} --nulls {} --seed {}", shell_word(output), request.nulls, request.seed);
}

} // namespace

int diagnose_command(const CommonOptions& options, DiagnosisRequest request, const std::optional<std::string>& study,
                     const std::optional<std::string>& wanted)
{
    const std::string output =
        wanted.value_or(std::filesystem::path(request.measured).stem().string() + "_diagnosis.h5");
    const std::string without_ending = std::filesystem::path(output).replace_extension().string();
    request.settings = options.set;
    request.start_name = study.value_or("--set");
    const std::string extended = without_ending + "_extended.toml";
    request.cache = without_ending + "_campaigns.txt";
    request.next_test = without_ending + "_next_test.h5";
    request.tests_cache = without_ending + "_tests.txt";
    request.check_outputs = [&] {
        check_output(request.measured, output, options.force);
        check_output(request.measured, extended, options.force);
        check_output(request.measured, request.next_test->string(), options.force);
        for (const std::string& file : request.tests) // where the plan may have been measured
            for (const std::string& made : {output, extended, request.next_test->string()})
                check_output(file, made, options.force);
        AtomicFile::check(output);
    };
    together(options.ranks, [&] { request.start = start_study(options, request.measured, "diagnose", study); });
    Console console = options.console("diagnose");
    std::optional<Diagnosis> diagnosis = diagnose_measured(request, options, console);
    if (!options.leads()) // it has simulated its part of the campaigns
        return diagnosis ? exit_done : exit_interrupted;
    if (!diagnosis) {
        std::vector<std::string> kept;
        for (const auto& file : {request.cache, request.tests_cache})
            if (std::filesystem::exists(*file))
                kept.push_back(file->string());
        console.note(kept.empty()
                         ? "Interrupted before anything that was simulated was kept. The same command begins anew."
                         : "Interrupted. The same command continues: what was simulated is kept in " +
                               list_words(kept) + ".");
        return console.end(exit_interrupted);
    }
    diagnosis->command = command_of(options, request, study, output);
    if (diagnosis->extended_study) {
        write_whole(extended, *diagnosis->extended_study);
        diagnosis->extended_study_file = extended;
    }
    write_diagnosis(*diagnosis, output);
    print(
        options, [&] { return diagnosis_text(*diagnosis); }, [&] { return diagnosis_json(*diagnosis); });
    std::fflush(stdout); // before the line on standard error
    console.note(fmt::format("Diagnosis: {}. A page of it: stylobate report {}", output, output));
    return console.end(exit_done);
}

} // namespace stylobate
