/// `stylobate report`: a result, a diagnosis or a calibration as one page.

#include "studies/report.hpp"

#include "io/atomic_file.hpp"
#include "studies/console.hpp"
#include "studies/diagnosis/calibration_file.hpp"
#include "studies/diagnosis/diagnosis_file.hpp"
#include "studies/file_kind.hpp"
#include "studies/json.hpp"
#include "studies/output_path.hpp"
#include "studies/result_picture.hpp"

#include <fmt/format.h>

namespace stylobate {

int report_command(const CommonOptions& options, const std::string& file, std::string output)
{
    check_kind(file, "report");
    check_output(file, output);
    if (output.empty())
        output = beside(file, ".html").string();
    std::string page;
    std::vector<std::string> warnings;
    const FileKind kind = recognise(file).kind;
    if (kind == FileKind::diagnosis) {
        page = diagnosis_page(read_diagnosis(file), file).text();
    } else if (kind == FileKind::calibration) {
        page = calibration_page(read_calibration(file), file).text();
    } else {
        const ResultReader reader(file);
        check_complete(reader, file);
        const AtomicFile writable(output); // refuses before the pictures are drawn
        page = result_page(options, reader, file, warnings).text();
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
