/// `stylobate calibrate`: contact parameters from measured response.

#include "studies/workflow/calibrate.hpp"
#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cli/command.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/workflow/file_kind.hpp"
#include "studies/workflow/output_path.hpp"

#include <filesystem>

namespace stylobate {

int calibrate_command(const CommonOptions& options, CalibrationRequest request, const std::string& study,
                      const std::string& output)
{
    const std::filesystem::path measured(request.measured);
    const std::string stem =
        (measured.has_stem() ? measured : measured.parent_path()).stem().string(); // of a folder too
    const std::string results = given(output).value_or(stem + "_calibration.h5");
    const std::string without_ending = std::filesystem::path(results).replace_extension().string();
    const std::string calibrated = (output.empty() ? stem : without_ending) + "_calibrated.toml";
    request.settings = options.set;
    request.start_name = given(study).value_or("--set");
    request.kept = without_ending + "_sets.bin";
    request.check_outputs = [&] {
        check_output(request.measured, results, options.force);
        check_output(request.measured, calibrated, options.force);
        AtomicFile::check(calibrated);
        AtomicFile::check(results);
    };
    together(options.ranks, [&] { request.start = start_study(options, request.measured, "calibrate", study); });
    Console console(options.quiet || !options.leads());
    const CalibrationEnd end = calibrate_measured(request, options, console);
    if (!options.leads()) // it has predicted what rank 0 requested
        return exit_done;
    const Calibration& found = end.found;
    if (!found.complete) {
        console.note(fmt::format(
            "Interrupted: {} of at most {} parameter sets are kept in {}. The same command continues from there.",
            found.kept_sets, end.planned, request.kept.string()));
        return exit_interrupted;
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
    return exit_done;
}

} // namespace stylobate
