/// `stylobate report`: a result, a diagnosis or a calibration as one page.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/calibration/calibration_page.hpp"
#include "studies/diagnosis/findings/diagnosis_file.hpp"
#include "studies/diagnosis/findings/diagnosis_page.hpp"
#include "studies/report/json.hpp"
#include "studies/results/result_page.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

/// A page is HTML, whatever its name says; one that says something else is a slip.
void check_ending(const std::string& output)
{
    const std::string ending = std::filesystem::path(output).extension().string();
    if (!ending.empty() && ending != ".html" && ending != ".htm")
        throw InputError(fmt::format(
            "-o {}: a page is written as HTML only.\n  Give a name with .html; a browser can print it to PDF.",
            output));
}

} // namespace

int report_command(const CommonOptions& options, const std::string& file, std::string output, const std::string& title)
{
    check_kind(file, "report");
    if (output.empty())
        output = beside(file, ".html").string();
    check_output(file, output, options.force);
    check_ending(output);
    std::string page;
    std::vector<std::string> warnings;
    const FileKind kind = recognise(file).kind;
    if ((kind == FileKind::diagnosis || kind == FileKind::calibration) && !options.set.empty())
        throw InputError(fmt::format("--set {}: {} is a {} and contains no study whose keys could be set",
                                     options.set.front(), file,
                                     kind == FileKind::diagnosis ? "diagnosis" : "calibration"));
    if (kind == FileKind::diagnosis) {
        page = diagnosis_page(read_diagnosis(file), file, title).text();
    } else if (kind == FileKind::calibration) {
        page = calibration_page(read_calibration(file), file, title).text();
    } else {
        const Results results(file, options.set);
        check_complete(results.reader(), file);
        const AtomicFile writable(output); // refuses before the pictures are drawn
        page = result_page(results, options.isa(), title, warnings).text();
    }
    AtomicFile target(output);
    target.write(page);
    target.commit();
    Console console(options.quiet);
    for (const std::string& warning : warnings)
        console.warn(warning);
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", output).text());
    else if (!options.quiet)
        fmt::print("{}\n", output);
    return exit_done;
}

} // namespace stylobate
