#include "studies/cli/command.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/decisions/compare/comparison_text.hpp"
#include "studies/workflow/output_path.hpp"
#include "studies/workflow/past.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace stylobate {

namespace {

int search_study(const CommonOptions& options, const ComparisonRequest& request,
                 const std::optional<std::string>& picture)
{
    if (!are_study_files(request.files))
        throw InputError(fmt::format("--search: {} is a result; give the study file", request.files.front()));
    if (request.files.size() > 1)
        throw InputError(
            fmt::format("--search: takes one study file with [optimise], not {} files", request.files.size()));
    if (request.adaptive)
        throw InputError("--adaptive: does not go with --search, whose points are run whole");
    Console console = options.console("compare");
    const SearchEnd end = search_study_file({request.files.front(), options.set, picture, request.level, options.force},
                                            options, console);
    print(
        options,
        [&] {
            return end.result ? search_text(*end.result)
                              : "Interrupted; what was run is kept. The same command continues the search.\n";
        },
        [&] {
            return (end.result ? search_json(*end.result) : Json::object()).member("complete", end.result.has_value());
        });
    return console.end(end.result ? report_invalid(end.invalid) : exit_interrupted);
}

int compare_command(const CommonOptions& options, ComparisonRequest request, const std::optional<std::string>& wanted)
{
    const std::string output =
        wanted.value_or(std::filesystem::path(request.files.front()).stem().string() + "_comparison.h5");
    request.settings = options.set;
    request.folder = std::filesystem::path(output).parent_path().string();
    request.output = output;
    request.force = options.force;
    Console console = options.console("compare");
    const ComparisonEnd end = compare_files(request, options, console);
    if (!end.comparison) {
        print(
            options,
            [&] {
                return fmt::format("Interrupted; {} of {} realizations are kept. The same command continues the "
                                   "comparison.\n",
                                   end.done, end.total);
            },
            [&] {
                return Json::object()
                    .member("comparison", output)
                    .member("complete", false)
                    .member("realizations", end.done)
                    .member("total", end.total);
            });
        return console.end(exit_interrupted);
    }
    print(
        options, [&] { return fmt::format("{}: {}", output, comparison_text(*end.comparison)); },
        [&] { return comparison_json(*end.comparison).member("comparison", output).member("complete", true); });
    return console.end(report_invalid(end.invalid));
}

int past_command(const CommonOptions& options, const std::vector<std::string>& files,
                 const std::optional<std::string>& picture)
{
    const CombinedPast past = past_of_files(files, picture, options.force);
    print(
        options, [&] { return combined_text(past) + (picture ? *picture + "\n" : ""); },
        [&] {
            Json json = combined_json(past);
            return picture ? json.member("written", *picture) : json;
        });
    return exit_done;
}

int risk_command(const CommonOptions& options, RiskRequest request, const std::optional<std::string>& wanted)
{
    const std::string output = wanted.value_or(beside(request.file, "_risk.h5").string());
    request.settings = options.set;
    request.output = output;
    request.force = options.force;
    Console console = options.console("risk");
    const std::optional<AnyRisk> risk = estimate_risk(request, options, console);
    if (!risk) {
        console.warn(fmt::format("interrupted: '{}' was not written", output));
        return console.end(exit_interrupted);
    }
    print(
        options, [&] { return risk_text(*risk) + output + "\n"; },
        [&] { return risk_json(*risk).member("written", output); });
    return console.end(exit_done);
}

} // namespace

void DecisionVerbs::add_compare()
{
    auto* compare = app_.add_subcommand(
        "compare", "what interventions change: studies run under the same draws and the same shaking, differences "
                   "of all limit states with paired intervals; continues unfinished results");
    compare
        ->add_option("STUDY", compare_.files,
                     "study files, the base first (one alone: its [variants]); or finished results of them")
        ->required();
    add_word(*compare, "-o,--output", output_,
             "the comparison (default: the base's name with _comparison.h5); the results of the studies "
             "go beside it, under their names");
    compare->add_option("--level", compare_.level, "confidence of intervals and verdicts")
        ->check(CLI::Range(0.5, 0.9999))
        ->capture_default_str();
    auto* adaptive =
        compare->add_option("--adaptive", compare_.adaptive,
                            "largest number of pairs of each variant of a surface, run in rounds where the "
                            "difference is undecided (default: all pairs)");
    compare
        ->add_option("--margin", compare_.margin,
                     "adaptive: a cell is decided, too, where its difference is shown to be smaller than this")
        ->check(CLI::Range(0.001, 0.5))
        ->capture_default_str()
        ->needs(adaptive);
    compare->add_flag("--search", search_,
                      "search the values of [optimise] for which the limit state is least probable, or least "
                      "frequent over a hazard; -o FILE.png: a picture");
    add_all(*compare, options_, {"cpu", "cuda"});
    compare->callback([this] {
        status_ = search_ ? search_study(options_, compare_, output_) : compare_command(options_, compare_, output_);
    });
}

void DecisionVerbs::add_past()
{
    auto* past = app_.add_subcommand(
        "past", "the past shaking of a site, from the results of survival studies of several of its structures");
    past->add_option("RESULTS", files_, "results of survival studies, of two structures or more")->required();
    add_word(*past, "-o,--output", output_, "picture of their likelihoods: .png, .svg or .pdf (default: none)");
    add_force(*past, options_);
    add_common(*past, options_);
    past->callback([this] { status_ = past_command(options_, files_, output_); });
}

void DecisionVerbs::add_risk()
{
    auto* risk = app_.add_subcommand(
        "risk", "how often limit states are reached, and how likely over years: a fragility study over a hazard; of a "
                "comparison of fragility studies also what the variants change");
    risk->add_option("FILE", risk_.file, "results of a fragility study, or a comparison of fragility studies (HDF5)")
        ->required();
    risk->add_option("--hazard", risk_.hazard,
                     "hazard curve: a table (CSV), OpenQuake's CSV or NRML (several: mean and fractiles), or a "
                     "power law such as k0=1e-4,k=2.5,measure=pga_g,sigma_ln=0.5")
        ->required()
        ->take_all()
        ->allow_extra_args(false);
    add_word(*risk, "--site", risk_.site, "site of several in the hazard: LON,LAT or its number from 0");
    risk->add_option("--years", risk_.years, "years for the probabilities (default: 50,100)")->delimiter(',');
    risk->add_option("--level", risk_.level, "level of the intervals")->capture_default_str();
    add_word(*risk, "--state", risk_.state, "one limit state of the study (default: all)");
    risk->add_option("--most-outside", risk_.most_outside,
                     "largest share of a frequency from outside of the intensities of study or hazard")
        ->capture_default_str();
    auto* sequences =
        risk->add_option("--sequences", risk_.sequences,
                         "number of histories of the last of --years to simulate, with the damage carried along")
            ->check(CLI::Range(0LL, 10000000LL));
    risk->add_option("--threshold", risk_.threshold,
                     "their weakest earthquake, in the SI unit of the measure (default: by the results)")
        ->needs(sequences);
    risk->add_option("--pause", risk_.pause_s, "seconds of rest between them (default: until the structure rests)")
        ->check(CLI::Range(0.0, 1000.0))
        ->needs(sequences);
    risk->add_option("--seed", risk_.seed, "seed of the histories")
        ->check(CLI::Range(0LL, 999999999999LL))
        ->needs(sequences);
    add_word(*risk, "-o,--output", output_, "the estimate (HDF5; default: the name of FILE with _risk.h5)");
    add_all(*risk, options_);
    risk->callback([this] { status_ = risk_command(options_, risk_, output_); });
}

} // namespace stylobate
