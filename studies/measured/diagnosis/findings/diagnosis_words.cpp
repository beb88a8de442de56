#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include "ensemble/model/mechanism_spec.hpp"
#include "io/files/suggest.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_fields.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

std::string number_words(MaybeReal value)
{
    return value && !std::isnan(*value) ? fmt::format("{:.3g}", *value) : "not known";
}

namespace {

/// As many digits as make both ends of an interval differ, 3 to 6.
int digits_of(MaybeReal low, MaybeReal high)
{
    if (!low || !high || !(*high > *low))
        return 3;
    const double most = std::max(std::fabs(*low), std::fabs(*high));
    return std::clamp(1 + static_cast<int>(std::ceil(std::log10(most / (*high - *low)))), 3, 6);
}

} // namespace

std::optional<std::string> interval_words(MaybeReal low, MaybeReal high)
{
    if (!low && !high)
        return std::nullopt;
    if (!low)
        return "up to " + number_words(high);
    const int digits = digits_of(low, high);
    return high ? fmt::format("{:.{}g} to {:.{}g}", *low, digits, *high, digits) : number_words(low) + " or more";
}

std::string estimate_words(MaybeReal value, MaybeReal low, MaybeReal high, const std::string& unit)
{
    std::string text =
        value && !std::isnan(*value) ? fmt::format("{:.{}g}", *value, digits_of(low, high)) : number_words(value);
    if (value && !unit.empty())
        text += " " + unit;
    const std::optional<std::string> interval = interval_words(low, high);
    return interval ? text + " (" + *interval + ")" : text;
}

std::string probability_words(MaybeReal p)
{
    if (p && *p >= 0 && *p < 0.001)
        return "< 0.001";
    if (p && *p > 0.999 && *p < 1)
        return "> 0.999";
    return p ? fmt::format("{:.2g}", *p) : "not known";
}

std::string block_words(int block)
{
    return block < 0 ? "the base" : fmt::format("block {}", block);
}

std::string mechanism_words(const std::string& mechanism)
{
    for (const MechanismRule& rule : mechanism_rules())
        if (mechanism == rule.name)
            return rule.says;
    return mechanism;
}

std::string place_words(const std::string& place)
{
    return place == "all" ? "everywhere" : place == "base" ? "at the base" : "at " + place;
}

std::string parameter_words(const CalibratedParameter& parameter)
{
    if (parameter.determined)
        return parameter.note;
    return "not determined by these data" + (parameter.note.empty() ? "" : ": " + parameter.note);
}

std::string wrong_words(const Diagnosis& diagnosis)
{
    std::string text = "Excess: error of the calibrated baseline in short windows that start from the measured state, "
                       "in units of the error caused by noise and a lag of some milliseconds (root mean square of the "
                       "worst window; values of 2 and above are listed).";
    if (diagnosis.verdict == Verdict::none)
        text += " Part of it is due to the contacts and the scatter of specimens.";
    if (best_candidate(diagnosis))
        text += " No tested cause explains the rest significantly better than the null distribution.";
    return text;
}

std::string nats_words()
{
    return "A gain is given in nats, the unit of log likelihood: with 1 nat the cause makes the measured data 2.7 "
           "times as probable as the baseline does, with 3 nats 20 times, with 10 nats 22,000 times.";
}

std::string chance_words(const Diagnosis& diagnosis)
{
    std::string text = "p is the p-value of the gain: the share of simulated null campaigns (without a hidden effect) "
                       "that reach it.";
    if (!named_causes(diagnosis).empty())
        text += " A candidate with a small p is not named if the named cause explains the same data better.";
    return text;
}

bool compared_with_nulls(const Diagnosis& diagnosis)
{
    return std::any_of(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                       [](const Candidate& c) { return c.p || c.null95; });
}

namespace {

/// "friction of joint 0 x 0.63", "corner loss at joint 2, 0.2 m"
std::string candidate_words(const Candidate& c)
{
    std::string kind = c.mechanism == "tie" ? "a force of unknown kind" : c.mechanism;
    std::ranges::replace(kind, '_', ' ');
    const std::string text =
        c.mechanism == "joint_friction" ? "friction of " + c.place : kind + " " + place_words(c.place);
    if (!c.size)
        return text;
    const std::string size = fmt::format("{:.3g}", *c.size);
    return text + (!c.unit.empty()          ? ", " + size + " " + c.unit
                   : c.parameter == "ratio" ? " x " + size
                                            : ", " + c.parameter + " " + size);
}

} // namespace

std::string verdict_heading(const Diagnosis& diagnosis)
{
    switch (diagnosis.verdict) {
    case Verdict::none: {
        const Candidate* best = best_candidate(diagnosis);
        return best ? fmt::format("No cause identified; best candidate: {} (p = {:.2g})", candidate_words(*best),
                                  *best->p)
                    : "No cause identified";
    }
    case Verdict::named: {
        std::vector<std::string> names;
        for (const Candidate* cause : named_causes(diagnosis))
            if (std::find(names.begin(), names.end(), cause->mechanism) == names.end())
                names.push_back(cause->mechanism);
        return names.empty() ? "A cause is named" : "The cause: " + list_words(names);
    }
    default:
        return named_causes(diagnosis).empty() ? "An error that no known mechanism explains"
                                               : "A cause, and an error that no known mechanism explains";
    }
}

std::optional<std::string> gain_words(const ModelGain& gain)
{
    if (!gain.error_before || !gain.error_after)
        return std::nullopt;
    const std::string unit = gain.unit.empty() ? "" : " " + gain.unit;
    std::string text = fmt::format("On {} held out from the search, the error changes from {:.3g}{} to {:.3g}{}",
                                   gain.runs_left_out.empty() ? "runs" : counted(gain.runs_left_out.size(), "run"),
                                   *gain.error_before, unit, *gain.error_after, unit);
    if (gain.low || gain.high)
        text += fmt::format(" (95 % interval {})", *interval_words(gain.low, gain.high));
    if (gain.low && gain.high)
        text += *gain.low > *gain.error_before    ? ": worse prediction"
                : *gain.high < *gain.error_before ? ": better prediction"
                                                  : ": no significant gain on these runs";
    if (gain.floor)
        text += fmt::format("; repeats of one motion differ by {:.3g}{}", *gain.floor, unit);
    return text + ".";
}

std::optional<std::string> collapse_words(const ModelGain& gain)
{
    if (!gain.collapse)
        return std::nullopt;
    const CollapsePrediction& c = *gain.collapse;
    std::string text =
        fmt::format("Of {} with a known outcome, the baseline predicts {} correctly and the extended model {}",
                    counted(c.runs, "run"), c.right_before, c.right_after);
    if (c.score_before && c.score_after)
        text += fmt::format("; the Brier score changes from {:.3g} to {:.3g}", *c.score_before, *c.score_after);
    return text + "." + (c.text ? " " + *c.text : "");
}

std::string cost_words(const DiagnosisCost& cost)
{
    std::string text =
        fmt::format("{} simulations of whole runs and {} of windows, {:.3g} block steps, in {:.3g} s", cost.simulations,
                    cost.window_simulations, static_cast<double>(cost.block_steps), cost.seconds);
    if (cost.threads > 0)
        text += " with " + counted(static_cast<std::uint64_t>(cost.threads), "thread");
    if (cost.lockstep_speedup)
        text += fmt::format("; lockstep is {:.3g} times as fast as sequential realizations", *cost.lockstep_speedup);
    return text + ".";
}

namespace {

/// An item of `causes`.
Json cause(const Candidate* c)
{
    return json_of(*c, {{"name", "mechanism"}, "place", "probability", "parameter", "size", "low", "high"});
}

Json candidate(const Candidate& c)
{
    Json json = cause(&c);
    return add_members(json, c, {"unit", "neutral", "gain_nats", "null95", "p", "decision", "why", "evidence"});
}

Json data_test(const DataTest& t)
{
    return json_of(t, {"name", "place", "value", "sd", "threshold", "unit", "outcome", {"text", "sentence"}});
}

} // namespace

Json diagnosis_json(const Diagnosis& d)
{
    Json json = json_of(d, {"verdict"});
    json.member("causes", json_list(named_causes(d), cause));
    add_members(json, d, {"indistinguishable", "unexplained", "wrong", "gain"});
    if (d.tests && !d.tests->next.empty())
        json.member("next_test", Json::object()
                                     .member("excitation", d.tests->next.front())
                                     .member("separates", Json::list(d.indistinguishable)));
    else
        json.member_as_is("next_test", "null");
    if (d.extended_study_file)
        json.member("extended_study", *d.extended_study_file);
    else
        json.member_as_is("extended_study", "null");
    add_members(json, d.cost, {"simulations", "seconds"});

    json.member("heading", verdict_heading(d)).member("text", verdict_words(d)).member("left_out", left_out_text(2));
    add_members(json, d,
                {"specimen",
                 {"measured", "measured_file"},
                 "measured_fingerprint",
                 "runs",
                 "runs_used",
                 "code_version",
                 "seed",
                 "options",
                 "data_findings"});
    json.member("base_tests", json_list(d.base_tests, data_test))
        .member("sensor_tests", json_list(d.sensor_tests, data_test));
    add_members(json, d, {"baseline"});
    json.member("candidates", json_list(d.candidates, candidate));
    add_members(json, d, {"nulls", "missing", "tests"});
    return add_members(json, d.cost, {"window_simulations", "block_steps", "threads", "lockstep_speedup"});
}

} // namespace stylobate
