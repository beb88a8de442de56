/// `stylobate bench`: the speed of this machine.

#include "studies/workflow/bench/bench.hpp"
#include "studies/cli/command.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

namespace stylobate {

int bench_command(const CommonOptions& options, double seconds, bool markdown)
{
    Console console = options.console("bench");
    const std::optional<BenchReport> report = run_bench({seconds}, options, console);
    if (!report) {
        say("Interrupted; nothing is printed.\n");
        return console.end(exit_interrupted);
    }
    print(
        options,
        [&] {
            return markdown ? bench_markdown(*report)
                            : fmt::format("stylobate {}\n{}", code_version(), bench_text(*report));
        },
        [&] { return bench_json(*report).member("version", code_version()); });
    return console.end(exit_done);
}

} // namespace stylobate
