/// `stylobate calibrate`: contact parameters from measured response.

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_outcomes.hpp"
#include "io/study/study_file.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/app/output_path.hpp"
#include "studies/calibration/calibration.hpp"
#include "studies/calibration/calibration_file.hpp"
#include "studies/diagnosis/findings/fingerprint.hpp"
#include "studies/report/json.hpp"
#include "studies/report/words.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

namespace stylobate {

namespace {

const char* form_name(ContactForm form)
{
    return word_for(contact_form_names, form);
}

/// The contact forms of "--form area,points", or all of them.
std::vector<ContactForm> forms_of(const std::vector<std::string>& words)
{
    std::vector<ContactForm> forms;
    for (const std::string& word : words)
        for (const auto& name : contact_form_names)
            if (word == name.word || word == "all")
                forms.push_back(name.value);
    return forms;
}

/// Progress in parameter sets; a wish to stop is the console's to notice.
class CalibrationConsole : public Observer {
public:
    explicit CalibrationConsole(bool quiet) : console_(quiet), quiet_(quiet) {}

    void stage(const std::string& what) { stage_ = what; }

    void progress(const Progress& p) override
    {
        planned_ = p.total;
        if (quiet_ || p.done == 0 || (p.seconds < next_s_ && p.done < p.total))
            return;
        next_s_ = p.seconds + between_lines_s;
        fmt::print(stderr, "{}: {} of at most {} parameter sets{}\n", stage_, p.done, p.total,
                   p.rate > 0
                       ? fmt::format(", at most {} left", duration_text(static_cast<double>(p.total - p.done) / p.rate))
                       : "");
    }
    std::uint64_t planned() const { return planned_; }
    void warn(const std::string& text) override { console_.warn(text); }
    bool stop_requested() override { return console_.stop_requested(); }

private:
    static constexpr double between_lines_s = 10;
    Console console_;
    const bool quiet_;
    double next_s_ = between_lines_s;
    std::uint64_t planned_ = 0;
    std::string stage_;
};

/// What the measured data are known by: the file, and the motions that a table names.
std::string data_key(const std::filesystem::path& measured, const std::optional<OutcomeTable>& table)
{
    std::string key = fingerprint(measured);
    std::set<std::string> files;
    if (table)
        for (const MeasuredOutcome& row : table->rows)
            if (!row.motion_file.empty() && files.insert(row.motion_file).second)
                key += " " + fingerprint(measured.parent_path() / row.motion_file);
    return key;
}

/// The contact's keys without those that are held, and those of --fit, which replace them where they are the same.
std::vector<FitKey> keys_of(const Study& study, const CalibrateOptions& wanted)
{
    std::vector<FitKey> keys = contact_keys(study);
    for (const std::string& hold : wanted.hold) {
        const auto found = std::find_if(keys.begin(), keys.end(), [&](const FitKey& k) { return k.key == hold; });
        if (found == keys.end()) {
            std::string known;
            for (const FitKey& key : keys)
                known += (known.empty() ? "" : ", ") + key.key;
            throw InputError(
                fmt::format("--hold {}: it is not fitted, so it cannot be held; fitted parameters: {}", hold, known));
        }
        keys.erase(found);
    }
    for (const std::string& text : wanted.fit) {
        const FitKey key = fit_key(study, text);
        const auto same = std::find_if(keys.begin(), keys.end(), [&](const FitKey& k) { return k.key == key.key; });
        if (same == keys.end())
            keys.push_back(key);
        else
            *same = key;
    }
    if (keys.empty())
        throw InputError("--hold: nothing is left to be fitted; name fewer keys");
    return keys;
}

/// What is written beside the result: the study with the calibrated values, which `stylobate run` takes.
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

Json parameter_json(const FittedParameter& p)
{
    Json json = Json::object();
    json.member("key", p.key)
        .member("start", p.start)
        .member("value", p.value)
        .member("low", p.low)
        .member("high", p.high)
        .member("range_low", p.from)
        .member("range_high", p.to)
        .member("determined", p.determined)
        .member("effective", p.effective)
        .member("bounded_below", p.bounded_below)
        .member("bounded_above", p.bounded_above)
        .member("note", p.note);
    return json;
}

Json gain_json(const PairedGain& gain)
{
    return Json::object().member("nats", gain.total).member("low", gain.low).member("high", gain.high);
}

Json form_json(const FormCalibration& form)
{
    Json parameters = Json::list(), runs = Json::list();
    for (const FittedParameter& p : form.parameters)
        parameters.item(parameter_json(p));
    for (const RunScore& run : form.runs)
        runs.item(Json::object()
                      .member("run", run.run)
                      .member("motion_id", run.motion_id)
                      .member("units", run.units)
                      .member("nominal_score", run.nominal)
                      .member("calibrated_score", run.calibrated));
    return Json::object()
        .member("form", form_name(form.form))
        .member("parameters", parameters)
        .member("score", form.score)
        .member("nominal_score", form.nominal_score)
        .member("held_out_gain", gain_json(form.held_out))
        .member("runs", runs);
}

void print_json(const Calibration& c, const std::string& results, const std::string& study)
{
    Json forms = Json::list();
    for (const FormCalibration& form : c.forms)
        forms.item(form_json(form));
    Json json = Json::object();
    json.member("measured", c.measured)
        .member("evidence", c.from_outcomes ? "outcomes" : "histories")
        .member("best_form", form_name(c.forms[c.best].form))
        .member("forms", forms)
        .member("notes", Json::list(c.notes))
        .member("parameter_sets", c.parameter_sets)
        .member("restored_sets", c.restored_sets)
        .member("simulations", c.simulations)
        .member("window_simulations", c.window_simulations)
        .member("block_steps", c.block_steps)
        .member("seconds", c.seconds)
        .member("results", results)
        .member("calibrated_study", study);
    fmt::print("{}\n", json.text());
}

void print_form(const FormCalibration& form, bool from_outcomes)
{
    fmt::print("contact form {}\n  {:<36} {:>11} {:>11}\n", form_name(form.form), "", "start", "calibrated");
    for (const FittedParameter& p : form.parameters)
        fmt::print("  {:<36} {:>11.4g} {:>11.4g}   {}\n      {}\n", p.key, p.start, p.value, interval_words(p), p.note);
    if (form.held_out.groups == 0)
        return;
    std::size_t units = 0;
    for (const RunScore& run : form.runs)
        units += run.units;
    fmt::print("  on held-out motions: score {:+.1f} nats above that of the start study in {} {} (95 % from {:+.1f} to "
               "{:+.1f}): {}\n",
               form.held_out.total, units, from_outcomes ? "runs" : "windows", form.held_out.low, form.held_out.high,
               form.held_out.low > 0    ? "better prediction"
               : form.held_out.high < 0 ? "worse prediction"
                                        : "no significant difference");
}

void print_text(const Calibration& c, const std::string& results, const std::string& study)
{
    for (const FormCalibration& form : c.forms)
        print_form(form, c.from_outcomes);
    if (c.forms.size() > 1)
        fmt::print("best on held-out motions: {}\n", form_name(c.forms[c.best].form));
    for (const std::string& note : c.notes)
        fmt::print("note: {}\n", note);
    fmt::print("{}: {} parameter sets{}, {} runs and {} windows simulated in {}\n{}: the calibrated study\n", results,
               c.parameter_sets,
               c.restored_sets > 0 ? fmt::format(" ({} of them from an earlier run)", c.restored_sets) : "",
               c.simulations, c.window_simulations, duration_text(c.seconds), study);
}

} // namespace

int calibrate_command(const CommonOptions& options, const std::string& measured, const CalibrateOptions& wanted)
{
    check_kind(measured, "calibrate");
    check_option_kind(wanted.study, FileKind::study, "--study");
    const std::filesystem::path given = std::filesystem::path(measured);
    const std::string stem = (given.has_stem() ? given : given.parent_path()).stem().string(); // of a folder too
    const std::string results = wanted.output.empty() ? stem + "_calibration.h5" : wanted.output;
    const std::string calibrated =
        wanted.output.empty() ? stem + "_calibrated.toml"
                              : std::filesystem::path(results).replace_extension().string() + "_calibrated.toml";
    std::optional<OutcomeTable> table;
    Campaign campaign;
    std::error_code ignored;
    if (given.extension() == ".csv" && !std::filesystem::is_directory(given, ignored))
        table = read_outcomes(given);
    else
        campaign = read_campaign(measured);
    Study start;
    if (wanted.study.empty() && table) {
        throw InputError(measured, 0,
                         "a table of outcomes does not describe the structure.\n  Give the structure, and the "
                         "parameters of the shaking that the table omits, by --study STUDY.toml.");
    } else if (wanted.study.empty()) {
        start = default_study(campaign);
        start = parse_study(start.text, "the default start study of a calibration", options.set);
    } else {
        start = read_study(wanted.study, options.set);
    }
    demand_double(start, wanted.study.empty() ? "--set" : wanted.study, "a calibration");
    CalibrationOptions search;
    search.keys = keys_of(start, wanted);
    search.forms = forms_of(wanted.forms);
    search.outcomes = wanted.outcomes;
    search.held_out = wanted.held_out;
    const RunOptions run{options.isa(), options.thread_count()};
    // before the work is done, not after it, it is known that both can be written
    check_output(measured, results, options.force);
    check_output(measured, calibrated, options.force);
    AtomicFile study_file(calibrated), results_file(results);
    search.kept = std::filesystem::path(results).replace_extension().string() + "_sets.bin";
    search.kept_key = data_key(given, table);
    CalibrationConsole console(options.quiet);
    search.stage = [&](const std::string& what) { console.stage(what); };
    const Calibration found =
        table ? calibrate(*table, start, search, run, console) : calibrate(campaign, start, search, run, console);
    if (!found.complete) {
        if (!options.quiet)
            fmt::print(
                stderr,
                "Interrupted: {} of at most {} parameter sets are kept in {}. The same command continues from there.\n",
                found.kept_sets, console.planned(), search.kept.string());
        return exit_interrupted;
    }
    const std::string text = calibrated_text(found, measured);
    parse_study(text, calibrated); // what is written is a study
    write_calibration(found, start, code_version(), results_file.temporary());
    study_file.write(text);
    results_file.commit();
    study_file.commit();
    if (options.json)
        print_json(found, results, calibrated);
    else if (!options.quiet)
        print_text(found, results, calibrated);
    return exit_done;
}

} // namespace stylobate
