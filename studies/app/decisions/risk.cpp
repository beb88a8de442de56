/// `stylobate risk`: how often a monument reaches its limit states, and how likely that is over years.

#include "studies/decisions/risk/risk.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/hazard/hazard_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/decisions/compare/comparison_file.hpp"
#include "studies/decisions/risk/risk_change.hpp"
#include "studies/decisions/risk/risk_change_file.hpp"
#include "studies/decisions/risk/risk_change_text.hpp"
#include "studies/decisions/risk/risk_file.hpp"
#include "studies/decisions/risk/risk_text.hpp"
#include "studies/decisions/risk/sequences.hpp"
#include "studies/kinds/fragility/fragility_kind.hpp"
#include "studies/results/results.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace stylobate {

namespace {

const FragilityKind& fragility_kind(const Results& results)
{
    const auto* kind = dynamic_cast<const FragilityKind*>(&results.kind());
    if (!kind)
        throw InputError(results.file(), 0,
                         fmt::format("is the result of a study of kind '{}'; a risk is of a fragility study.\n  "
                                     "stylobate new fragility: writes one to begin with",
                                     results.header().kind));
    check_complete(results.reader(), results.file());
    return *kind;
}

RiskOptions checked(const RiskCommandOptions& wanted)
{
    RiskOptions options;
    if (!wanted.years.empty())
        options.years = wanted.years;
    for (const double years : options.years)
        if (!(years > 0 && years <= 1e6))
            throw InputError(fmt::format("--years {}: is outside (0, 1e6].\n  Give years such as 50,100.", years));
    if (!(wanted.level > 0.5 && wanted.level < 1))
        throw InputError(fmt::format("--level {}: is outside (0.5, 1).\n  Give a level such as 0.9.", wanted.level));
    if (!(wanted.most_outside >= 0 && wanted.most_outside <= 1))
        throw InputError(fmt::format("--most-outside {}: is no share in [0, 1].", wanted.most_outside));
    options.level = wanted.level;
    options.most_outside = wanted.most_outside;
    options.state = wanted.state;
    return options;
}

/// Histories are run again, which a comparison cannot: it has counts of realizations, and no realization.
void check_no_sequences(const std::string& file, const RiskCommandOptions& wanted)
{
    if (wanted.sequences > 0)
        throw InputError(
            fmt::format("--sequences: {} is a comparison; histories are of one study.\n  Give its results: "
                        "stylobate risk RESULTS.h5 --hazard HAZARD --sequences {}",
                        file, wanted.sequences));
}

int risk_of_change(const CommonOptions& options, const std::string& file, const std::string& output,
                   const RiskCommandOptions& wanted)
{
    const RiskOptions asked = checked(wanted);
    check_no_sequences(file, wanted);
    check_no_settings(options.set, file);
    const Comparison comparison = read_comparison(file);
    check_has_risk(comparison, file);
    const HazardModel hazard = read_hazard(wanted.hazard, comparison.measure, wanted.site);
    AtomicFile::check(output);
    RiskChange change = risk_change_of(comparison, file, hazard, asked);
    change.comparison_file = std::filesystem::path(file).filename().string();
    change.code_version = code_version();
    write_risk_change(change, output);
    if (options.json)
        fmt::print("{}\n", risk_change_json(change).member("written", output).text());
    else
        fmt::print("{}{}\n", risk_change_text(change), output);
    return exit_done;
}

} // namespace

int risk_command(const CommonOptions& options, const std::string& file, const RiskCommandOptions& wanted)
{
    check_kind(file, "risk");
    const std::string output = wanted.output.empty() ? beside(file, "_risk.h5").string() : wanted.output;
    check_output(file, output, options.force);
    for (const std::string& hazard : wanted.hazard)
        check_not_input(hazard, output);
    if (recognise(file).kind == FileKind::comparison)
        return risk_of_change(options, file, output, wanted);
    const RiskOptions asked = checked(wanted);
    const RunOptions run = options.run_options();
    const Results results(file, options.set);
    fragility_kind(results);
    const HazardModel hazard = read_hazard(wanted.hazard, measure_of(*results.study().fragility), wanted.site);
    if (wanted.sequences > 0)
        check_sequences(results);
    AtomicFile::check(output);
    const auto& kind = dynamic_cast<const FragilityKind&>(results.concluded());
    Risk risk;
    try {
        risk = risk_of(kind.fragility(), hazard, asked);
    } catch (const InputError& error) {
        const std::string what = error.what();
        throw InputError(what.starts_with("--") ? what : file + ": " + what);
    }
    risk.fragility_file = std::filesystem::path(file).filename().string();
    risk.title = results.title();
    risk.study_text = results.study().text;
    risk.code_version = code_version();
    if (wanted.sequences > 0) {
        SequenceOptions sequences;
        sequences.histories = wanted.sequences;
        sequences.years = asked.years.back();
        sequences.level = asked.level;
        sequences.threshold = wanted.threshold;
        sequences.pause_s = wanted.pause_s;
        sequences.seed = wanted.seed;
        Console console(options.quiet);
        const std::optional<SequenceRisk> found = simulate_sequences(results, risk, sequences, run, console);
        if (!found) {
            console.warn(fmt::format("interrupted: '{}' was not written", output));
            return exit_interrupted;
        }
        risk.sequences = found;
    }
    write_risk(risk, output);
    if (options.json)
        fmt::print("{}\n", risk_json(risk).member("written", output).text());
    else
        fmt::print("{}{}\n", risk_text(risk), output);
    return exit_done;
}

} // namespace stylobate
