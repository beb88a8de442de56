/// `stylobate report`: a result or a diagnosis as one page.

#include "studies/report.hpp"

#include "io/atomic_file.hpp"
#include "studies/console.hpp"
#include "studies/diagnosis/diagnosis_file.hpp"
#include "studies/json.hpp"
#include "studies/output_path.hpp"

#include <fmt/format.h>

namespace stylobate {

int report_command(const CommonOptions& options, const std::string& file, std::string output)
{
    check_output(file, output);
    const bool diagnosed = is_diagnosis(file);
    if (output.empty())
        output = beside(file, ".html").string();
    AtomicFile target(output); // refuses before any work is done
    if (diagnosed) {
        target.write(diagnosis_page(read_diagnosis(file), file).text());
    } else {
        std::vector<std::string> warnings;
        target.write(result_page(options, ResultReader(file), file, warnings).text());
        Console console(options.quiet);
        for (const std::string& warning : warnings)
            console.warn(warning);
    }
    target.commit();
    if (options.json)
        fmt::print("{}\n", Json::object().member("written", output).text());
    else if (!options.quiet)
        fmt::print("{}\n", output);
    return exit_done;
}

} // namespace stylobate
