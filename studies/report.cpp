/// `stylobate report`: a result or a diagnosis as one page.

#include "studies/report.hpp"

#include "io/atomic_file.hpp"
#include "studies/console.hpp"
#include "studies/diagnosis/diagnosis_file.hpp"
#include "studies/json.hpp"
#include "studies/output_path.hpp"
#include "studies/result_picture.hpp"

#include <fmt/format.h>

namespace stylobate {

int report_command(const CommonOptions& options, const std::string& file, std::string output)
{
    check_output(file, output);
    if (output.empty())
        output = beside(file, ".html").string();
    std::string page;
    std::vector<std::string> warnings;
    if (is_diagnosis(file)) {
        page = diagnosis_page(read_diagnosis(file), file).text();
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
