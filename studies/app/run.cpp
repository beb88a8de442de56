/// `stylobate run`: from a study file to a results file.

#include "ensemble/engine/executor.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/store/result_store.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/run_report.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/results/kinds.hpp"
#include "studies/results/run_store.hpp"
#include "studies/results/run_study.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

namespace stylobate {

namespace {

/// Where results go unless the user says: beside nothing, in the working folder, under the study's name.
std::string default_results(const std::string& study)
{
    return std::filesystem::path(study).stem().string() + ".h5";
}

/// Nothing is left to run: reports what the run would have, as far as the file has it.
int report_finished(const CommonOptions& options, const std::string& results, const Study& study, const RunOptions& run,
                    Kind& kind)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    Progress progress{.seconds = unknown, .rate = unknown, .occupancy = unknown};
    const ResultReader reader(results);
    progress.done = progress.total = reader.done();
    reader.for_each_row([&](const ResultRow& row) {
        kind.add(row);
        progress.collapsed += row.outcome.state == State::collapsed;
        progress.invalid += row.outcome.state == State::invalid;
    });
    if (const Tally* tally = reader.tally()) {
        kind.add(*tally);
        progress.collapsed = tally->all_reached(static_cast<std::size_t>(LimitState::collapse));
        progress.invalid = tally->all_invalid();
    }
    kind.restore(reader);
    kind.share(progress);
    if (!options.json && !options.quiet)
        fmt::print("{}: already complete. (Remove the file to run the study again.)\n", results);
    return report_run(options, {results, study, kind, progress, run, true});
}

} // namespace

int run_command(const CommonOptions& options, const std::string& study, std::string results)
{
    if (results.empty())
        results = default_results(study);
    check_kind(study, "run");
    check_option_kind(results, FileKind::results, "-o");
    const LoadedStudy loaded = LoadedStudy::from_file(study, options.set);
    const ResultHeader header = loaded.result_header();
    const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
    if (const std::string why = kind->needs_processor(); options.backend == "cuda" && !why.empty())
        throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study, why));
    const std::vector<std::string> warnings = loaded.warnings(study);
    const std::string notice = kind->prepare(loaded.experiment(), study);
    const RunOptions run = options.run_options();
    const bool found = std::filesystem::exists(results);
    if (!found) // else it has been done before the file was made
        check_realizations(loaded.sampler(), *kind);
    else if (ResultWriter::is_finished(results, header))
        return report_finished(options, results, loaded.study(), run, *kind);

    std::unique_ptr<RunStore> store;
    StudyRun ran;
    {
        Console console(options.quiet); // from here on an interrupt leaves a file that can be continued
        store = open_store(results, header, found);
        for (const std::string& warning : warnings) // now that nothing is refused any more
            console.warn(warning);
        if (!options.quiet && !notice.empty())
            fmt::print(stderr, "{}\n", notice);
        store->give_to(*kind);
        ran = run_study(loaded.experiment(), *kind, *store, run, console);
    }
    if (ran.complete) {
        kind->conclude();
        store->finish(*kind);
    } else {
        store->flush();
    }
    store.reset();
    return report_run(options, {results, loaded.study(), *kind, ran.progress, run, ran.complete});
}

} // namespace stylobate
