#include "studies/measured/calibration/calibration_text.hpp"

#include "io/keys/words.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/report/words.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

namespace {

const char* form_name(ContactForm form)
{
    return word_for(contact_form_names, form);
}

Json parameter_json(const FittedParameter& p)
{
    Json json =
        json_of(p, {"key", "start", "value", "low", "high", "range_low", "range_high", "determined", "effective"});
    return json.member("bounded_below", p.bounded_below)
        .member("bounded_above", p.bounded_above)
        .member("note", p.note);
}

Json run_json(const RunScore& run)
{
    return json_of(run, {{"run", "name"}, "motion_id", "units", "nominal_score", "calibrated_score"});
}

Json form_json(const FormCalibration& form)
{
    const PairedGain& gain = form.held_out;
    return Json::object()
        .member("form", form_name(form.form))
        .member("parameters", json_list(form.parameters, parameter_json))
        .member("score", form.score)
        .member("nominal_score", form.nominal_score)
        .member("held_out_gain",
                Json::object().member("nats", gain.total).member("low", gain.low).member("high", gain.high))
        .member("runs", json_list(form.runs, run_json));
}

std::string form_text(const FormCalibration& form, bool from_outcomes)
{
    std::string text =
        fmt::format("contact form {}\n  {:<36} {:>11} {:>11}\n", form_name(form.form), "", "start", "calibrated");
    for (const FittedParameter& p : form.parameters)
        text += fmt::format("  {:<36} {:>11.4g} {:>11.4g}   {}\n      {}\n", p.key, p.start, p.value, interval_words(p),
                            p.note);
    if (form.held_out.groups == 0)
        return text;
    std::size_t units = 0;
    for (const RunScore& run : form.runs)
        units += run.units;
    text += fmt::format(
        "  on held-out motions: score {:+.1f} nats above that of the start study in {} {} ({:+.1f} to {:+.1f}, "
        "95 %): {}\n",
        form.held_out.total, units, from_outcomes ? "runs" : "windows", form.held_out.low, form.held_out.high,
        form.held_out.low > 0    ? "better prediction"
        : form.held_out.high < 0 ? "worse prediction"
                                 : "no significant difference");
    return text;
}

} // namespace

std::string calibration_text(const Calibration& c)
{
    std::string text;
    for (const FormCalibration& form : c.forms)
        text += form_text(form, c.from_outcomes);
    if (c.forms.size() > 1)
        text += fmt::format("best on held-out motions: {}\n", form_name(c.forms[c.best].form));
    for (const std::string& note : c.notes)
        text += fmt::format("note: {}\n", note);
    return text;
}

std::string calibration_cost(const Calibration& c)
{
    return fmt::format("{} parameter sets{}, {} runs and {} windows simulated in {}", c.parameter_sets,
                       c.restored_sets > 0 ? fmt::format(" ({} of them from an earlier run)", c.restored_sets) : "",
                       c.simulations, c.window_simulations, duration_text(c.seconds));
}

std::string calibration_progress(const std::string& stage, const Progress& p)
{
    return fmt::format(
        "{}: {} of at most {} parameter sets{}", stage, p.done, p.total,
        p.rate > 0 ? fmt::format(", at most {} left", duration_text(static_cast<double>(p.total - p.done) / p.rate))
                   : "");
}

Json calibration_json(const Calibration& c)
{
    return Json::object()
        .member("measured", c.measured)
        .member("evidence", c.from_outcomes ? "outcomes" : "histories")
        .member("best_form", form_name(c.forms[c.best].form))
        .member("forms", json_list(c.forms, form_json))
        .member("notes", Json::list(c.notes))
        .member("parameter_sets", c.parameter_sets)
        .member("restored_sets", c.restored_sets)
        .member("simulations", c.simulations)
        .member("window_simulations", c.window_simulations)
        .member("block_steps", c.block_steps)
        .member("seconds", c.seconds);
}

std::string calibrated_text(const Calibration& calibration, const std::string& measured)
{
    const FormCalibration& best = calibration.forms[calibration.best];
    std::string text =
        fmt::format("# Calibrated with {}, contact form {}, by stylobate {}.\n",
                    std::filesystem::path(measured).filename().string(), form_name(best.form), code_version());
    for (const FittedParameter& p : best.parameters)
        text += fmt::format("# {} = {:.5g}, {}{}{}\n", p.key, p.value, interval_words(p), p.note.empty() ? "" : ": ",
                            p.note);
    return text + "\n" + best.study.text;
}

} // namespace stylobate
