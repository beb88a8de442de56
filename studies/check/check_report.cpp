#include "studies/check/check_report.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/words.hpp"
#include "io/plots/plot_structure.hpp"
#include "studies/report/json.hpp"
#include "studies/report/left_out.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

/// What the second run of the pilot is.
std::string finer_text(const Study& study)
{
    std::string text = study.contact.form == ContactForm::rigid ? "steps a quarter as long" : "steps half as long";
    if (study.chose("run.precision"))
        text += ", in double precision";
    if (study.chose("run.step_bound"))
        text += ", by the bound of the blocks";
    if (study.chose("contact.normal_stiffness_n_m2"))
        text += ", ten times the stiffness";
    return text;
}

std::string bytes_text(double bytes)
{
    return bytes < 1e6   ? fmt::format("{:.0f} kB", bytes / 1e3)
           : bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6)
                         : fmt::format("{:.3g} GB", bytes / 1e9);
}

/// "3 to 5", or "3" of both alike.
std::string between_text(const Between& between, const char* format)
{
    const std::string low = fmt::format(fmt::runtime(format), between.low),
                      high = fmt::format(fmt::runtime(format), between.high);
    return low == high ? low : low + " to " + high;
}

std::string cells_text(const Study& study)
{
    const StudyDesign design = study.design();
    if (study.surface)
        return fmt::format(
            " ({} {} x {} PGAs{}{})", study.surface->rows().count, study.surface->row_quantity().plural,
            study.surface->pga_m_s2.count, study.surface->adaptive ? "" : fmt::format(" x {}", study.realizations),
            design.replica_set ? fmt::format(", each with {} replicas", design.replica_set->kinds.size()) : "");
    if (design.motions)
        return fmt::format(" ({} motions x {} intensities x {})", design.motions->motions, design.columns,
                           study.realizations);
    return "";
}

std::string trial_text(const CheckReport& r)
{
    const Trial& trial = *r.trial;
    const TrialShares shares = trial.shares();
    std::string text = fmt::format("trial: {} in {:.2g} s with {} threads of {}", counted(trial.count(), "realization"),
                                   trial.seconds, r.run.threads, to_string(r.run.isa));
    if (shares.valid > 0)
        text += fmt::format("; {:.3g} of them collapsed",
                            static_cast<double>(shares.collapsed) / static_cast<double>(shares.valid));
    if (!r.time)
        return text + "\ntime: unknown. The trial was stopped.\n";
    const RunTime& time = *r.time;
    if (trial.unfinished)
        return text +
               fmt::format("\ntime: at most {}: {} steps in a realization, at {} steps a second with each thread. "
                           "Not all of the first realizations ended in the trial; a longer one (--trial-seconds) "
                           "shows how soon they end.\n",
                           seconds_text(time.range_s().high), between_text(time.steps, "{:.3g}"),
                           rate_text(1 / trial.lane_s_per_step));
    text += fmt::format("; {} steps each\n", between_text(time.steps, "{:.0f}"));
    const Between range = time.range_s();
    if (time.at_most)
        text += fmt::format(
            "time: at most about {}; {} if all {} realizations are run and take as long as those of the trial. "
            "Which ones are run depends on what they do, and the run ends when it knows enough.\n",
            seconds_text(range.high), seconds_text(time.seconds()), r.size.realizations);
    else
        text += fmt::format("time: about {} ({} to {}), {:.2g} block-steps\n", seconds_text(time.seconds()),
                            seconds_text(range.low), seconds_text(range.high), time.block_steps);
    constexpr double busy = 0.85;
    if (const double share = trial.share_of_processor(); share < busy && trial.seconds > 0.5)
        text += fmt::format("      on an idle machine; the threads of the trial had {:.0f} % of the processor\n",
                            100 * share);
    return text;
}

std::string pilot_text(const CheckReport& r)
{
    const NumericsCheck& check = *r.pilot;
    const auto n = static_cast<double>(check.realizations);
    const double wanted = r.study.run.accuracy.value_or(0);
    std::string text = fmt::format("pilot: {} of them, {:.3g} of these collapsed; with {} {:.3g}\n", check.realizations,
                                   n > 0 ? static_cast<double>(check.collapsed) / n : 0, finer_text(r.study),
                                   n > 0 ? static_cast<double>(check.finer) / n : 0);
    text += fmt::format(
        "error of the numerics: {:+.4f} ± {:.4f} of the collapse probability (difference of the two, and its "
        "standard error); the finer run took {:.2g} times as long\n",
        check.difference, check.sd, check.seconds > 0 ? check.finer_seconds / check.seconds : 0);
    if (r.missed())
        text += fmt::format("run.accuracy = {:g} is not reached: give a smaller one.\n", wanted);
    else if (wanted > 0 && check.sd > wanted)
        text += fmt::format("The pilot is too small to see an error of {:g}: --pilot {:.0f} would.\n", wanted,
                            n * std::pow(check.sd / wanted, 2) * 4);
    return text;
}

Json between_json(const Between& between)
{
    return Json::object().member("low", between.low).member("high", between.high);
}

} // namespace

bool CheckReport::missed() const
{
    const double wanted = study.run.accuracy.value_or(0);
    return pilot && wanted > 0 && std::fabs(pilot->difference) - 2 * pilot->sd > wanted;
}

std::string check_text(const CheckReport& r)
{
    const Study& study = r.study;
    std::string text =
        fmt::format("{}: a study of kind \"{}\"; contact.form = \"{}\"\n", r.file,
                    word_for(study_kind_names, study.kind), word_for(contact_form_names, study.contact.form));
    if (r.picture)
        text += fmt::format("picture: {}\n", *r.picture);
    text +=
        fmt::format("run: {}{}{} of {} blocks, {} of them free\n", r.size.at_most ? "at most " : "",
                    counted(r.size.realizations, "realization"), cells_text(study), r.size.blocks, r.size.free_blocks);
    text += fmt::format(
        "steps: of {} s; about {} in a realization that runs to the time limit; at most {:.2g} block-steps\n",
        between_text(r.size.step_s, "{:.3g}"), between_text(r.size.longest_steps, "{:.0f}"), r.size.most_block_steps);
    for (const NumericsChoice& choice : study.chosen)
        text += fmt::format("chosen: {} = {}: {}\n", choice.key, choice.value, choice.reason);
    if (r.trial)
        text += trial_text(r);
    text += fmt::format("memory: about {}\nresults file: {}{}\n", bytes_text(r.memory_bytes),
                        r.size.at_most || (r.size.trajectory_bytes > 0 && !r.trial) ? "at most about " : "about ",
                        bytes_text(r.size.file_bytes));
    if (r.notice)
        text += *r.notice + "\n";
    if (r.counted)
        text += fmt::format("interval: {}\n", width_text(study, *r.counted));
    if (const std::optional<FirstMode>& mode = r.free.mode)
        text += fmt::format("first mode: {:.3g} Hz, damping ratio {:.2g} % (contacts closed, nothing drawn)\n",
                            mode->frequency_hz, 100 * mode->damping_ratio);
    if (r.free.decay)
        text += fmt::format("free rocking: {}\n", decay_text(*r.free.decay));
    for (const WeakSpot& spot : r.weak)
        text += fmt::format("weak: {}: {}\n  {}\n", spot.name, spot.text, spot.todo);
    if (r.weak.empty())
        text += "weak: nothing was found.\n";
    for (const std::string& line : r.not_looked_for)
        text += fmt::format("not looked for: {}\n", line);
    text += left_out_text(study) + "\n";
    if (r.pilot)
        text += pilot_text(r);
    else
        text += fmt::format("pilot: none; {}\n", *r.why_no_pilot);
    return text + law_share_text(r.laws, r.pilot ? &*r.pilot : nullptr, r.file);
}

Json check_json(const CheckReport& r)
{
    const Study& study = r.study;
    Json chosen = Json::list(), weak = Json::list();
    for (const NumericsChoice& choice : study.chosen)
        chosen.item(
            Json::object().member("key", choice.key).member("value", choice.value).member("reason", choice.reason));
    for (const WeakSpot& spot : r.weak)
        weak.item(Json::object().member("name", spot.name).member("text", spot.text).member("todo", spot.todo));
    Json json = Json::object();
    json.member("kind", word_for(study_kind_names, study.kind))
        .member("form", word_for(contact_form_names, study.contact.form))
        .member("chosen", chosen)
        .member("realizations", r.size.realizations)
        .member("realizations_at_most", r.size.at_most)
        .member("cells", r.size.cells)
        .member("blocks", r.size.blocks)
        .member("free_blocks", r.size.free_blocks)
        .member("step_s", between_json(r.size.step_s))
        .member("longest_steps", between_json(r.size.longest_steps))
        .member("most_block_steps", r.size.most_block_steps)
        .member("memory_bytes", r.memory_bytes)
        .member("file_bytes", r.size.file_bytes)
        .member("threads", r.run.threads)
        .member("simd", to_string(r.run.isa));
    if (r.counted)
        json.member("counted_trials", *r.counted).member("worst_half_width", worst_half_width(*r.counted));
    if (r.picture)
        json.member("picture", *r.picture);
    if (r.notice)
        json.member("notice", *r.notice);
    if (r.trial) {
        const TrialShares shares = r.trial->shares();
        json.member("trial", Json::object()
                                 .member("realizations", r.trial->count())
                                 .member("whole", r.trial->whole())
                                 .member("valid", shares.valid)
                                 .member("collapsed", shares.collapsed)
                                 .member("seconds", r.trial->seconds)
                                 .member("processor_seconds", r.trial->processor_s)
                                 .member("share_of_processor", r.trial->share_of_processor()));
    }
    if (r.time)
        json.member("time", Json::object()
                                .member("seconds", r.time->seconds())
                                .member("range_s", between_json(r.time->range_s()))
                                .member("at_most", r.time->at_most)
                                .member("processor_seconds", r.time->processor_s)
                                .member("block_steps", r.time->block_steps)
                                .member("steps", between_json(r.time->steps)));
    if (const std::optional<FirstMode>& mode = r.free.mode)
        json.member(
            "first_mode",
            Json::object().member("frequency_hz", mode->frequency_hz).member("damping_ratio", mode->damping_ratio));
    if (const std::optional<RockingDecay>& decay = r.free.decay) {
        Json free = Json::object();
        free.member("slenderness_rad", decay->slenderness_rad).member("released", 0.5).member("returned", decay->law);
        if (decay->rigid)
            free.member("returned_rigid", *decay->rigid);
        json.member("free_rocking", free.member("returned_housner", decay->housner));
    }
    json.member("warnings", Json::list(r.warnings))
        .member("weak_spots", weak)
        .member("not_looked_for", Json::list(r.not_looked_for))
        .member("left_out", left_out_text(study));
    if (r.pilot) {
        const NumericsCheck& check = *r.pilot;
        const auto n = static_cast<double>(check.realizations);
        json.member("mean_step_s", check.step_s)
            .member("pilot", check.realizations)
            .member("collapse_probability", n > 0 ? static_cast<double>(check.collapsed) / n : 0)
            .member("error_of_the_numerics", check.difference)
            .member("its_standard_error", check.sd)
            .member("realizations_per_second", check.seconds > 0 ? n / check.seconds : 0)
            .member("accuracy_missed", r.missed());
    } else {
        json.member("why_no_pilot", *r.why_no_pilot);
    }
    json.member("contact_law", law_share_json(r.laws));
    return json;
}

void draw_study(const Study& study, const std::string& file, const std::filesystem::path& picture)
{
    plot_structure(study, study.title.value_or(std::filesystem::path(file).stem().string()), picture);
}

} // namespace stylobate
