/// `stylobate run` and `stylobate merge`, from a study file or the results of its parts to a results file; `stylobate
/// report`, from any file to a page.

#include "studies/workflow/run.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/cli/command.hpp"
#include "studies/workflow/output_path.hpp"
#include "studies/workflow/report.hpp"

namespace stylobate {

namespace {

/// Prints what a run has come to. @returns the exit status
int print_run(const CommonOptions& options, const RunReport& report)
{
    if (report.was_complete && !options.json && !options.quiet)
        fmt::print("{}: already complete. (Remove the file to run the study again.)\n", report.results);
    print(
        options, [&] { return run_text(report); }, [&] { return run_json(report); });
    return report.interrupted() ? exit_interrupted : report_invalid(report.too_many_invalid());
}

} // namespace

int run_command(const CommonOptions& options, const std::string& study, const std::optional<std::string>& results,
                const std::optional<std::string>& shard, bool laws)
{
    Console console = options.console("run");
    const RunReport report = run_study_file({study, options.set, results, shard, laws}, options, console);
    if (!options.leads())
        return report.complete ? exit_done : exit_interrupted;
    return console.end(print_run(options, report), report.progress);
}

int merge_command(const CommonOptions& options, const std::vector<std::string>& files, const std::string& output,
                  bool partial)
{
    Console console = options.console("merge");
    const auto report = merge_shards({files, output, partial, options.force, options.set}, options, console);
    if (!report) {
        say("Interrupted; nothing was written.\n");
        return console.end(exit_interrupted);
    }
    return console.end(print_run(options, *report), report->progress);
}

int report_command(const CommonOptions& options, PageRequest request, const std::optional<std::string>& output)
{
    request.output = output.value_or(beside(request.file, ".html").string());
    request.settings = options.set;
    request.force = options.force;
    Console console = options.console("report");
    if (!make_page(request, options, console)) {
        console.warn("interrupted: no page was written");
        return console.end(exit_interrupted);
    }
    print_written(options, *request.output);
    return console.end(exit_done);
}

} // namespace stylobate
