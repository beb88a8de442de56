#include "studies/measured/calibration/calibration_text.hpp"

#include "io/keys/words.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/windows/motion_page.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/left_out.hpp"
#include "studies/report/words.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stylobate {

namespace {

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

Json form_json(const StoredForm& form)
{
    const PairedGain& gain = form.held_out;
    return Json::object()
        .member("form", form.name)
        .member("parameters", json_list(form.parameters, parameter_json))
        .member("score", form.score)
        .member("nominal_score", form.nominal_score)
        .member("held_out_gain",
                Json::object().member("nats", gain.total).member("low", gain.low).member("high", gain.high))
        .member("runs", json_list(form.runs, run_json));
}

} // namespace

std::string calibration_cost(const Calibration& c)
{
    return fmt::format("{} parameter sets{}, {} runs and {} windows simulated in {}", c.parameter_sets,
                       c.restored_sets > 0 ? fmt::format(" ({} of them from an earlier run)", c.restored_sets) : "",
                       c.simulations, c.window_simulations, duration_text(c.seconds));
}

std::string calibration_progress(const std::string& stage, const Progress& p)
{
    const std::optional<double> left = p.seconds_left();
    return fmt::format("{}: {} of at most {} parameter sets{}", stage, p.done, p.total,
                       left ? fmt::format(", at most {} left", duration_text(*left)) : "");
}

Json calibration_json(const Calibration& c)
{
    const StoredCalibration whole = stored(c);
    Json json = json_of(whole, {"measured", "evidence", "best_form"});
    json.member("forms", json_list(whole.forms, form_json))
        .member("notes", Json::list(c.notes))
        .member("left_out", left_out_text(2))
        .member("parameter_sets", c.parameter_sets)
        .member("restored_sets", c.restored_sets);
    return add_members(json, whole, {"simulations", "window_simulations", "block_steps", "seconds"});
}

std::string calibrated_text(const Calibration& calibration, const std::string& measured)
{
    const FormCalibration& best = calibration.forms[calibration.best];
    std::string text = fmt::format("# Calibrated with {}, contact form {}, by stylobate {}.\n",
                                   std::filesystem::path(measured).filename().string(),
                                   word_for(contact_form_names, best.form), code_version());
    for (const FittedParameter& p : best.parameters)
        text += fmt::format("# {} = {:.5g}, {}{}{}\n", p.key, p.value, interval_words(p), p.note.empty() ? "" : ": ",
                            p.note);
    return text + "\n" + best.study.text;
}

namespace {

constexpr std::size_t most_runs = 40;      ///< of the table of runs; the file has all
constexpr double strong_correlation = 0.5; ///< is named

std::string parameter_text(double value)
{
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–";
}

std::string signed_number(double value)
{
    return std::isfinite(value) ? fmt::format("{:+.1f}", value) : "–";
}

/// Of a file or a folder, without the way to it.
std::string name_of(const std::string& measured)
{
    const std::string name = std::filesystem::path(measured).filename().string();
    return name.empty() ? measured : name;
}

std::string interval(const FittedParameter& p)
{
    return p.determined || p.effective ? fmt::format("{:.4g} to {:.4g}", p.low, p.high) : "–";
}

/// "better", "worse", or undecided.
std::string held_out_words(const PairedGain& gain)
{
    return gain.low > 0    ? "it predicts them better than the start study"
           : gain.high < 0 ? "it predicts them worse than the start study"
                           : "these data show no difference from the start study";
}

std::string gain_text(const PairedGain& gain)
{
    if (gain.groups == 0)
        return "not asked for";
    const std::string range = std::isfinite(gain.low) && std::isfinite(gain.high)
                                  ? fmt::format(" ({:+.1f} to {:+.1f})", gain.low, gain.high)
                                  : ", without an interval: too few motions";
    return fmt::format("{:+.1f}{}", gain.total, range);
}

const char* unit_of_evidence(const StoredCalibration& c)
{
    return c.evidence == "outcomes" ? "runs" : "windows";
}

/// The parameters of a contact form, and which of them replace each other.
void add_form(const StoredForm& form, Document& page)
{
    HtmlTable table{"lrrrrnl",
                    {"parameter", "start", "calibrated", "95 % interval", "searched", "", ""},
                    {},
                    "Contact form " + form.name};
    for (const FittedParameter& p : form.parameters)
        table.rows.push_back({code(p.key), parameter_text(p.start), parameter_text(p.value), interval(p),
                              fmt::format("{:.4g} to {:.4g}", p.from, p.to),
                              p.determined  ? tag("good", "determined")
                              : p.effective ? tag("warn", "effective")
                                            : tag("warn", "not determined"),
                              p.note});
    page.table(table);
    std::vector<std::string> pairs;
    const std::size_t n = form.parameters.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            if (const double r = form.correlation[i * n + j]; std::abs(r) > strong_correlation)
                pairs.push_back(fmt::format("{} and {} ({:+.2f})", form.parameters[i].key, form.parameters[j].key, r));
    if (!pairs.empty())
        page.note("Strongly correlated and therefore partly interchangeable: " + list_words(pairs) + ".");
}

/// What the console shows, and the first part of the page.
void add_calibration(const StoredCalibration& c, Document& page)
{
    const StoredForm& best = c.best();
    const std::size_t all = best.parameters.size();
    const auto known = static_cast<std::size_t>(std::ranges::count_if(best.parameters, &FittedParameter::determined));
    const PairedGain& gain = best.held_out;
    const bool helps = gain.groups > 0 && gain.low > 0, hurts = gain.groups > 0 && gain.high < 0;
    page.box(hurts                   ? "bad"
             : helps && known == all ? "good"
                                     : "warn",
             fmt::format("Determined: {} of {}", known, all),
             fmt::format("These data determine {}. {}",
                         known < all ? fmt::format("{} of {} fitted parameters",
                                                   known == 0 ? "none" : fmt::format("{}", known), all)
                         : all == 1  ? "the fitted parameter"
                                     : fmt::format("all {} fitted parameters", all),
                         gain.groups == 0 ? "The calibrated study was not tested on held-out motions."
                                          : fmt::format("On held-out motions, {}.", held_out_words(gain))));
    for (const StoredForm& form : c.forms)
        add_form(form, page);
    HtmlTable table{"lrrrl",
                    {"form", "score minus that of the start study [nat]", "on held-out motions [nat] (95 %)",
                     unit_of_evidence(c), ""},
                    {},
                    "Gain by each contact form"};
    for (const StoredForm& form : c.forms) {
        std::size_t units = 0;
        for (const RunScore& run : form.runs)
            units += run.units;
        table.rows.push_back({form.name, signed_number(form.score - form.nominal_score), gain_text(form.held_out),
                              fmt::format("{}", units),
                              &form == &best && c.forms.size() > 1 ? tag("good", "best") : Html()});
    }
    page.table(table);
    if (!c.notes.empty()) {
        page.heading("Data that could not be used");
        page.list({c.notes.begin(), c.notes.end()});
    }
}

class CalibrationPage {
public:
    CalibrationPage(const StoredCalibration& calibration, const std::string& file,
                    const std::optional<std::string>& title)
        : c_(calibration), best_(calibration.best()), file_(file),
          page_(title.value_or("Calibration: " + name_of(c_.measured)),
                fmt::format("With the {} of {}. Made by stylobate {}.", c_.evidence, c_.measured, c_.code_version))
    {
    }

    Document page()
    {
        result();
        profiles();
        runs();
        motion();
        method();
        again();
        return page_;
    }

private:
    void result()
    {
        page_.section("Result");
        add_calibration(c_, page_);
        page_.note("Scores are log likelihoods of the data, in nats: 1 nat more means 2.7 times as likely. The gain on "
                   "held-out motions is the score of each motion with the parameters fitted to the other motions, "
                   "minus its score with the start study.");
        page_.note(
            "The value of a parameter that is not determined is not a measurement. An effective parameter belongs to "
            "this model with its contact form: its interval is that of the model's value, and an interval that reaches "
            "an end of the searched range may extend beyond it. A parameter without an interval keeps the value of the "
            "study.");
        page_.note(c_.forms.size() > 1 ? "The best form is the one with the best prediction of held-out motions. If "
                                         "the intervals overlap widely, these data do not distinguish the forms."
                                       : "Only this form was fitted; --form all compares them.");
        add_left_out(page_, 2);
    }

    void profiles()
    {
        if (std::all_of(best_.parameters.begin(), best_.parameters.end(),
                        [](const FittedParameter& p) { return p.profile.empty(); }))
            return;
        page_.section("Profiles");
        page_.paragraph("The best score with one parameter held at a value and all others free, minus the score of the "
                        "calibrated study. Where a curve is flat the data do not constrain the parameter. Scores are "
                        "noisy: a point above 0 is a parameter set whose score lies above the smooth fit by chance.");
        for (const FittedParameter& p : best_.parameters) {
            if (p.profile.empty())
                continue;
            std::vector<ProfilePoint> points = p.profile;
            std::sort(points.begin(), points.end(),
                      [](const ProfilePoint& a, const ProfilePoint& b) { return a.value < b.value; });
            FigureSeries line{"profile", SeriesKind::line, {}, {}, {}, {}},
                marks{"", SeriesKind::points, {}, {}, {}, {}};
            FigureSeries ends{"ends of the 95 % interval", SeriesKind::line, {}, {}, {}, {}};
            double least = 0, most = 0;
            for (const ProfilePoint& point : points) {
                line.x.push_back(point.value);
                line.y.push_back(point.score);
                least = std::min(least, std::isfinite(point.score) ? point.score : 0);
                most = std::max(most, std::isfinite(point.score) ? point.score : 0);
            }
            marks.x = line.x;
            marks.y = line.y;
            ends.x = {p.low, p.low, p.low, p.high, p.high};
            ends.y = {least, most, std::nan(""), most, least};
            Figure figure;
            figure.title = p.key;
            figure.x_label = p.key;
            figure.y_label = "score [nat]";
            figure.x_log = p.from > 0 && p.to > 5 * p.from;
            figure.series = {ends, line, marks};
            Html caption = Html::ready("<b>" + html_escaped(p.key) + "</b> ");
            caption += fmt::format("{} (95 %: {}){}", parameter_text(p.value), interval(p),
                                   p.determined  ? "."
                                   : p.effective ? "; effective."
                                                 : "; not determined.");
            page_.figure(figure_svg(figure), caption);
        }
    }

    void runs()
    {
        page_.section("Runs");
        HtmlTable table{
            "lrrrrr", {"run", "motion", unit_of_evidence(c_), "start [nat]", "calibrated [nat]", "gain [nat]"}, {}, ""};
        for (std::size_t i = 0; i < std::min(best_.runs.size(), most_runs); ++i) {
            const RunScore& run = best_.runs[i];
            table.rows.push_back({run.run, fmt::format("{}", run.motion_id), fmt::format("{}", run.units),
                                  parameter_text(run.nominal), parameter_text(run.calibrated),
                                  signed_number(run.calibrated - run.nominal)});
        }
        page_.table(table);
        page_.note(fmt::format(
            "Each run is scored with parameters that were fitted without its own motion.{}",
            best_.runs.size() > most_runs
                ? fmt::format(" The first {} of {} runs; the file contains all of them.", most_runs, best_.runs.size())
                : ""));
    }

    void motion()
    {
        if (c_.evidence == "outcomes")
            return;
        page_.section("Windows");
        if (c_.motion && !c_.motion->windows.empty())
            add_motion(page_, *c_.motion);
        else
            page_.note(no_motion_words(file_, c_.code_version));
    }

    void method()
    {
        page_.section("Method and cost");
        page_.paragraph(c_.evidence == "outcomes"
                            ? "Evidence: the outcome of each test (fell or stood), compared with the share of falls in "
                              "a small ensemble of realizations."
                            : "Evidence: the measured histories, window by window: each window is simulated from its "
                              "measured state and compared with the measurement.");
        page_.paragraph(fmt::format("The scores scatter about the smooth fit by {:.2g} nats.", best_.roughness));
        page_.paragraph(fmt::format("{} parameter sets, {} runs and {} windows simulated, {:.3g} block-steps, in {}.",
                                    c_.parameter_sets, c_.simulations, c_.window_simulations,
                                    static_cast<double>(c_.block_steps), duration_text(c_.seconds)));
    }

    void again()
    {
        page_.section("Reproduction");
        page_.facts(
            {{"Measured data", c_.measured}, {"Program", "stylobate " + c_.code_version}, {"This calibration", file_}});
        page_.paragraph("With the first of the studies below as START.toml:");
        std::string forms;
        for (const StoredForm& form : c_.forms)
            forms += (forms.empty() ? "" : ",") + form.name;
        page_.block(fmt::format("stylobate calibrate {} --study START.toml --form {}\n", c_.measured, forms));
        page_.heading("The start study");
        page_.block(c_.start_toml);
        page_.heading("The calibrated study");
        page_.block(best_.study_toml);
    }

    const StoredCalibration& c_;
    const StoredForm& best_;
    const std::string file_;
    Document page_;
};

} // namespace

Document calibration_page(const StoredCalibration& calibration, const std::string& file,
                          const std::optional<std::string>& title)
{
    return CalibrationPage(calibration, std::filesystem::path(file).filename().string(), title).page();
}

std::string calibration_text(const Calibration& calibration)
{
    Document page;
    add_calibration(stored(calibration), page);
    return console_text(page) + left_out_text(2) + "\n"; // the model of every calibration is planar
}

} // namespace stylobate
