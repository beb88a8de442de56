/// `stylobate report`: a result, a comparison, a diagnosis, a calibration or a risk estimate as one page.

#include "studies/workflow/report.hpp"
#include "studies/cli/command.hpp"
#include "studies/workflow/output_path.hpp"

namespace stylobate {

int report_command(const CommonOptions& options, PageRequest request, const std::string& output)
{
    request.output = given(output).value_or(beside(request.file, ".html").string());
    request.settings = options.set;
    request.force = options.force;
    Console console(options.quiet);
    if (!make_page(request, options, console)) {
        console.warn("interrupted: no page was written");
        return exit_interrupted;
    }
    print_written(options, *request.output);
    return exit_done;
}

} // namespace stylobate
