/// `stylobate diagnose`: from a measured campaign to a diagnosis.

#include "studies/workflow/diagnose.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/cli/command.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_file.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_json.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

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

/// The command that makes the same diagnosis.
std::string command_of(const CommonOptions& options, const DiagnosisRequest& request, const std::string& study,
                       const std::string& output)
{
    std::string command = "stylobate diagnose " + shell_word(request.measured);
    if (!study.empty())
        command += " --study " + shell_word(study);
    for (const std::string& setting : options.set)
        command += " --set " + shell_word(setting);
    return command + fmt::format(" -o {} --nulls {} --seed {}", shell_word(output), request.nulls, request.seed);
}

} // namespace

int diagnose_command(const CommonOptions& options, DiagnosisRequest request, const std::string& study,
                     const std::string& wanted)
{
    const std::string output =
        given(wanted).value_or(std::filesystem::path(request.measured).stem().string() + "_diagnosis.h5");
    const std::string without_ending = std::filesystem::path(output).replace_extension().string();
    request.settings = options.set;
    request.start_name = given(study).value_or("--set");
    request.extension = without_ending + "_extended.toml";
    request.cache = without_ending + "_campaigns.txt";
    request.check_outputs = [&] {
        check_output(request.measured, output, options.force);
        check_output(request.measured, request.extension, options.force);
        AtomicFile::check(output);
    };
    together(options.ranks, [&] { request.start = start_study(options, request.measured, "diagnose", study); });
    Console console(options.quiet || !options.leads());
    std::optional<Diagnosis> diagnosis = diagnose_measured(request, options, console);
    if (!options.leads()) // it has simulated its part of the campaigns
        return diagnosis ? exit_done : exit_interrupted;
    if (!diagnosis) {
        console.note(std::filesystem::exists(request.cache)
                         ? "Interrupted. The same command continues: the simulated campaigns are kept in " +
                               request.cache.string() + "."
                         : "Interrupted before a simulated campaign was kept. The same command begins anew.");
        return exit_interrupted;
    }
    diagnosis->command = command_of(options, request, study, output);
    if (!diagnosis->extended_study.empty()) {
        write_whole(request.extension, diagnosis->extended_study);
        diagnosis->extended_study_file = request.extension.string();
    }
    write_diagnosis(*diagnosis, output);
    print(
        options, [&] { return diagnosis_text(*diagnosis); }, [&] { return diagnosis_json(*diagnosis); });
    std::fflush(stdout); // before the line on standard error
    console.note(fmt::format("Diagnosis: {}. A page of it: stylobate report {}", output, output));
    return exit_done;
}

} // namespace stylobate
