#include "studies/app/run_report.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/report/json.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

void print_json(const CommonOptions& options, const RunReport& r)
{
    const Progress& p = r.progress;
    Json json = Json::object();
    json.member("kind", word_for(study_kind_names, r.study.kind))
        .member("results", r.results)
        .member("complete", r.complete && r.shard.whole())
        .member("realizations", p.done)
        .member("total", p.total)
        .member("collapsed", p.collapsed)
        .member("invalid", p.invalid)
        .member("collapse_probability", p.share) // of the whole study, from a fair sample of it
        .member("collapse_lower", p.share_lower)
        .member("collapse_upper", p.share_upper)
        .member("seconds", p.seconds)
        .member("realizations_per_second", p.rate)
        .member("block_steps_per_second", p.seconds == 0 ? 0.0 : static_cast<double>(p.block_steps) / p.seconds)
        .member("occupancy", p.occupancy)
        .member("backend", options.backend)
        .member("simd", to_string(r.run.isa))
        .member("threads", r.run.threads);
    if (r.run.ranks)
        json.member("ranks", static_cast<std::uint64_t>(r.run.ranks->size()));
    if (!r.shard.whole())
        json.member("shard", r.shard.text()).member("shard_complete", r.complete);
    json.member("conventions", conventions_text(r.study));
    if (r.kind.draws_plainly())
        json.member("limit_states", r.kind.limits_json());
    if (r.complete && r.shard.whole())
        r.kind.add_to(json);
    if (r.laws)
        json.member("contact_laws", law_band_json(*r.laws));
    else if (r.laws_interrupted)
        json.member("contact_laws", Json::object().member("complete", false));
    fmt::print("{}\n", json.text());
}

void print_text(const RunReport& r)
{
    const Progress& p = r.progress;
    fmt::print("{}: {}{} realizations{}, {} collapsed, {} invalid", r.results, p.done,
               p.open_end ? "" : fmt::format(" of {}", p.total), r.shard.whole() ? "" : " of shard " + r.shard.text(),
               p.collapsed, p.invalid);
    if (p.seconds > 0)
        fmt::print("; {} with {}{} threads of {}, {} realizations/s", duration_text(p.seconds),
                   r.run.ranks ? fmt::format("{} ranks of ", r.run.ranks->size()) : "", r.run.threads,
                   r.run.devices.empty() ? to_string(r.run.isa) : "the host and " + r.run.devices.front()->name(),
                   rate_text(p.rate));
    fmt::print("\n");
    if (r.complete && r.shard.whole()) {
        fmt::print("{}conventions: {}\n", r.kind.text(), conventions_text(r.study));
        if (r.laws_interrupted)
            fmt::print(
                "Interrupted; the study is complete, its runs under other contact laws are not. The same command "
                "continues them.\n");
        else
            fmt::print("{}", r.laws ? law_band_text(*r.laws) : law_advice(r.study) + "\n");
        return;
    }
    if (!std::isnan(p.share)) // without those that have not ended because they take long
        fmt::print("  in the whole study {:.3g} % collapse ({:.3g} to {:.3g}, 95 % interval)\n", 100 * p.share,
                   100 * p.share_lower, 100 * p.share_upper);
    fmt::print("conventions: {}\n", conventions_text(r.study));
    if (r.merged)
        fmt::print("Partial: `stylobate run STUDY.toml -o {}` computes the missing realizations.\n", r.results);
    else if (r.complete)
        fmt::print("The shard is complete. `stylobate merge` joins it with the others.\n");
    else
        fmt::print("Interrupted; {} realizations are kept. The same command continues the run.\n", p.done);
}

} // namespace

std::string too_many_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total, const std::string& results)
{
    if (invalid == 0 || static_cast<double>(invalid) / static_cast<double>(total) <= study.run.max_invalid_fraction)
        return {};
    return fmt::format("{} of {} realizations are invalid, more than run.max_invalid_fraction = {} allows. `stylobate "
                       "replay {} --realization I` repeats one of them; a smaller run.step_fraction may help.",
                       invalid, total, study.run.max_invalid_fraction, results);
}

int report_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total, const std::string& results)
{
    const std::string message = too_many_invalid(study, invalid, total, results);
    if (message.empty())
        return exit_done;
    say_error(message);
    return exit_invalid;
}

int report_invalid(const WholeRuns& studies)
{
    for (const auto& study : studies)
        if (const int status = report_invalid(study->study(), study->invalid(), study->done(), study->results()))
            return status;
    return exit_done;
}

void check_can_run(const CommonOptions& options, const WholeRuns& studies)
{
    for (const auto& study : studies)
        if (const std::string why = study->needs_processor(); options.backend == "cuda" && !why.empty())
            throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study->name(), why));
    for (const auto& study : studies)
        try {
            study->check_drawn();
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", study->name(), error.what()));
        }
}

bool run_all(const CommonOptions& options, const WholeRuns& studies, Console& console)
{
    for (std::size_t i = 0; i < studies.size(); ++i) {
        WholeRun& study = *studies[i];
        if (!study.finished())
            note(options.quiet, fmt::format("{} ({} of {})", study.name(), i + 1, studies.size()));
        if (console.stop_requested() || !study.run(options.run_options(), console))
            return false;
    }
    return true;
}

int report_run(const CommonOptions& options, const RunReport& r)
{
    if (options.json)
        print_json(options, r);
    else
        print_text(r);
    if (r.merged && !r.complete)
        return exit_done; // by --partial
    if (!r.complete || r.laws_interrupted)
        return exit_interrupted;
    return report_invalid(r.study, r.progress.invalid, r.progress.total, r.results);
}

} // namespace stylobate
