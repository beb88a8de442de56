#include "studies/workflow/run_report.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

Json run_json(const RunReport& r)
{
    const Progress& p = r.progress;
    const Study& study = r.run->study();
    Json json = Json::object();
    json.member("kind", word_for(study_kind_names, study.kind))
        .member("results", r.results)
        .member("complete", r.whole())
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
        .member("backend", r.backend)
        .member("simd", to_string(r.options.isa))
        .member("threads", r.options.threads);
    if (r.options.ranks)
        json.member("ranks", static_cast<std::uint64_t>(r.options.ranks->size()));
    if (!r.shard().whole())
        json.member("shard", r.shard().text()).member("shard_complete", r.complete);
    json.member("conventions", conventions_text(study));
    if (r.run->kind().draws_plainly())
        json.member("limit_states", r.run->kind().limits_json());
    if (r.whole())
        r.run->kind().add_to(json);
    if (r.laws)
        json.member("contact_laws", law_band_json(*r.laws));
    else if (r.laws_interrupted)
        json.member("contact_laws", Json::object().member("complete", false));
    return json;
}

std::string run_text(const RunReport& r)
{
    const Progress& p = r.progress;
    const Study& study = r.run->study();
    std::string text = fmt::format("{}: {}{} realizations{}, {} collapsed, {} invalid", r.results, p.done,
                                   p.open_end ? "" : fmt::format(" of {}", p.total),
                                   r.shard().whole() ? "" : " of shard " + r.shard().text(), p.collapsed, p.invalid);
    if (p.seconds > 0)
        text += fmt::format(
            "; {} with {}{} threads of {}, {} realizations/s", duration_text(p.seconds),
            r.options.ranks ? fmt::format("{} ranks of ", r.options.ranks->size()) : "", r.options.threads,
            r.options.devices.empty() ? to_string(r.options.isa) : "the host and " + r.options.devices.front()->name(),
            rate_text(p.rate));
    text += "\n";
    if (r.whole()) {
        text += fmt::format("{}conventions: {}\n", r.run->kind().text(), conventions_text(study));
        if (r.laws_interrupted)
            return text + "Interrupted; the study is complete, its runs under other contact laws are not. The same "
                          "command continues them.\n";
        return text + (r.laws ? law_band_text(*r.laws) : law_advice(study) + "\n");
    }
    if (!std::isnan(p.share)) // without those that have not ended because they take long
        text += fmt::format("  in the whole study {:.3g} % collapse ({:.3g} to {:.3g}, 95 % interval)\n", 100 * p.share,
                            100 * p.share_lower, 100 * p.share_upper);
    text += fmt::format("conventions: {}\n", conventions_text(study));
    if (r.merged)
        return text +
               fmt::format("Partial: `stylobate run STUDY.toml -o {}` computes the missing realizations.\n", r.results);
    if (r.complete)
        return text + "The shard is complete. `stylobate merge` joins it with the others.\n";
    return text + fmt::format("Interrupted; {} realizations are kept. The same command continues the run.\n", p.done);
}

std::optional<std::string> RunReport::too_many_invalid() const
{
    if (!complete || laws_interrupted)
        return std::nullopt;
    const auto own = stylobate::too_many_invalid(run->study(), progress.invalid, progress.total, results);
    return own ? own : law_invalid;
}

std::optional<std::string> too_many_invalid(const Study& study, std::uint64_t invalid, std::uint64_t total,
                                            const std::string& results)
{
    if (invalid == 0 || static_cast<double>(invalid) / static_cast<double>(total) <= study.run.max_invalid_fraction)
        return std::nullopt;
    return fmt::format("{} of {} realizations are invalid, more than run.max_invalid_fraction = {} allows. `stylobate "
                       "replay {} --realization I` repeats one of them; a smaller run.step_fraction may help.",
                       invalid, total, study.run.max_invalid_fraction, results);
}

std::optional<std::string> too_many_invalid(const StudyRuns& studies)
{
    for (const auto& study : studies)
        if (auto message = too_many_invalid(study->study(), study->invalid(), study->done(), study->results()))
            return message;
    return std::nullopt;
}

void check_can_run(const StudyRuns& studies, const std::string& backend)
{
    for (const auto& study : studies)
        if (const std::string why = study->kind().needs_processor(); backend == "cuda" && !why.empty())
            throw InputError(fmt::format("--backend cuda: {} {}. Leave --backend out.", study->name(), why));
    for (const auto& study : studies)
        try {
            study->check_drawn();
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", study->name(), error.what()));
        }
}

bool run_all(const StudyRuns& studies, const RunOptions& options, WorkObserver& observer)
{
    for (std::size_t i = 0; i < studies.size(); ++i) {
        StudyRun& study = *studies[i];
        if (!study.finished())
            observer.note(fmt::format("{} ({} of {})", study.name(), i + 1, studies.size()));
        if (observer.stop_requested() || !study.run(options, observer).complete)
            return false;
    }
    return true;
}

} // namespace stylobate
