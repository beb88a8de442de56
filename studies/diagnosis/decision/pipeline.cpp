#include "studies/diagnosis/decision/pipeline.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/diagnosis/decision/chance.hpp"
#include "studies/diagnosis/decision/prediction.hpp"
#include "studies/diagnosis/decision/window_evidence.hpp"
#include "studies/diagnosis/decision/wrong_windows.hpp"
#include "studies/diagnosis/findings/diagnosis_words.hpp"
#include "studies/diagnosis/tests/cause_model.hpp"
#include "studies/diagnosis/tests/friction_judgement.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

namespace stylobate {

namespace {

constexpr std::size_t most_wrong = 20;
constexpr double two_sided95 = 1.96;

/// @param chance_known whether campaigns with nothing hidden were simulated
/// @param unexplained whether that is the verdict
Candidate candidate_of(const JudgedCause& j, const Campaign& campaign, Decision decision,
                       const std::vector<WindowBaseline>& baselines, bool chance_known, bool unexplained)
{
    Candidate c;
    const Cause& cause = j.fit.cause;
    c.mechanism = cause.mechanism;
    c.place = cause.place;
    c.parameter = cause.parameter;
    if (!cause.side.empty())
        c.why = fmt::format("at the {} end", cause.side);
    c.unit = cause.unit;
    c.neutral = cause.neutral;
    if (j.fit.gain > 0) {
        c.size = j.fit.size;
        if (j.fit.sd > 0) {
            c.low = j.fit.size - two_sided95 * j.fit.sd;
            c.high = j.fit.size + two_sided95 * j.fit.sd;
        }
    }
    c.gain_nats = j.fit.gain;
    if (j.channel != Channel::direct && chance_known) {
        c.null95 = j.chance95;
        c.p = j.chance;
    }
    if (j.channel == Channel::direct || chance_known)
        c.probability = j.probability;
    for (std::size_t r = 0; r < j.fit.gain_by_run.size(); ++r)
        if (j.fit.gain_by_run[r] != 0)
            c.evidence.push_back({campaign.runs[r].name, j.fit.gain_by_run[r], ""});
    for (std::size_t k = 0; k < j.gain_by_form.size() && k < baselines.size(); ++k) {
        const std::string form = baselines[k].contacts.substr(0, baselines[k].contacts.find(','));
        (j.gain_by_form[k] > j.chance95 ? c.forms_agreed : c.forms_disagreed).push_back(form);
    }
    c.decision = decision;
    const std::string where = c.why.empty() ? "" : c.why + "; ";
    const std::string found =
        j.channel == Channel::direct
            ? "found by a direct test"
            : fmt::format("{}: {:.1f} nats; null distribution {:.1f} (95 %)",
                          j.channel == Channel::balance ? "by the balance of forces" : "by free windows", j.fit.gain,
                          j.chance95);
    c.why = where + (j.why_not.empty() ? found : j.why_not);
    if (decision == Decision::rejected && j.why_not.empty())
        c.why += unexplained ? "; a force of unknown kind has a significantly larger gain"
                             : "; the named cause explains the same data better";
    return c;
}

/// The size with its 95 % interval in brackets.
std::string size_text(const Candidate& c)
{
    if (!c.size)
        return "";
    return ", " + c.parameter + " = " + estimate_words(c.size, c.low, c.high, c.unit);
}

/// Gains of the candidates beside what chance gives; those that are named among them, however they were found.
DiagnosisFigure candidates_figure(const std::vector<Candidate>& candidates)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::candidates;
    figure.title = "Gain of each cause, and its null distribution";
    figure.caption =
        "Gain in log likelihood over the baseline. The dot is the 95 % quantile of the null distribution from "
        "simulated campaigns without a hidden effect (for fewer than 20 campaigns: 1.5 times their maximum, plus 1). A "
        "cause without a dot was found by a direct test of base, sensors or rest with a separate threshold.";
    figure.x_label = "cause";
    figure.y_label = "gain [nats]";
    FigureSeries named{"named as the cause", SeriesKind::bars, {}, {}, {}, {}},
        gain{"not named", SeriesKind::bars, {}, {}, {}, {}},
        chance{"null distribution, 95 %", SeriesKind::points, {}, {}, {}, {}};
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Candidate& c : candidates) { // the named ones come first
        if (figure.x_ticks.size() == 10 || !c.gain_nats)
            continue;
        const auto x = static_cast<double>(figure.x_ticks.size());
        figure.x_ticks.push_back(c.mechanism + ", " + c.place);
        FigureSeries& bars = c.decision == Decision::named ? named : gain;
        bars.x.push_back(x);
        bars.y.push_back(*c.gain_nats);
        if (c.null95) {
            chance.x.push_back(x);
            chance.y.push_back(*c.null95);
        }
        for (const MaybeReal value : {c.gain_nats, c.null95})
            if (value && *value > 0) {
                least = std::min(least, *value);
                most = std::max(most, *value);
            }
    }
    figure.y_log = most > 100 * least; // beside the bar of a direct test others are not seen
    for (FigureSeries& series : std::vector{std::move(named), std::move(gain), std::move(chance)})
        if (!series.x.empty())
            figure.series.push_back(std::move(series));
    return figure;
}

/// The friction as the balance of forces judges it, for the table of the baseline.
CalibratedParameter baseline_friction(const FrictionJudgement& judged, const Study& start)
{
    CalibratedParameter p{"contact.friction", "",         start.contact.friction, std::nullopt, std::nullopt,
                          judged.determined,  judged.note};
    if (judged.determined) {
        p.value = judged.value;
        p.low = judged.low;
        p.high = judged.high;
    }
    return p;
}

/// What sliding joints say of friction, sample by sample.
std::optional<DiagnosisFigure> friction_figure(const BalanceEvidence& balance, const Campaign& campaign)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::data;
    figure.title = "Friction of the joints that slide, from the balance of forces";
    figure.caption =
        "Each point is one window with continuous sliding of a joint: friction over normal force, without any "
        "contact model. Bars: one standard deviation, from the noise of the cameras.";
    figure.x_label = "slip velocity [m/s]";
    figure.y_label = "friction coefficient";
    const double mu = campaign.specimen.friction_nominal.value_or(0.7);
    for (std::size_t j = 0; j < campaign.specimen.joints.size(); ++j) {
        FigureSeries series{fmt::format("joint {}", j), SeriesKind::points, {}, {}, {}, {}};
        for (const LawSample& s : balance.fit->samples()) {
            if (s.terms.size() != 1 || s.terms[0].law != Law::sliding || s.terms[0].joint != static_cast<int>(j))
                continue;
            const double value = s.value / s.terms[0].normal + mu, sd = s.sd / s.terms[0].normal;
            if (sd > 0.3 || series.x.size() > 400)
                continue;
            series.x.push_back(std::fabs(s.terms[0].slip_m_s));
            series.y.push_back(value);
            series.low.push_back(value - sd);
            series.high.push_back(value + sd);
        }
        if (!series.x.empty())
            figure.series.push_back(std::move(series));
    }
    return figure.series.empty() ? std::nullopt : std::optional(figure);
}

/// Where the joints turn that rock, sample by sample.
std::optional<DiagnosisFigure> turning_figure(const BalanceEvidence& balance)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::data;
    figure.title = "Position of the contact force in rocking joints, from the balance of forces";
    figure.caption =
        "Distance of the contact force inside the corner on which a joint turns, over the half width: 0 is a "
        "sharp, hard corner. One point for each window.";
    figure.x_label = "relative rotation [rad]";
    figure.y_label = "distance inside the corner / half width";
    FigureSeries series{"", SeriesKind::points, {}, {}, {}, {}};
    for (const LawSample& s : balance.fit->samples()) {
        if (s.terms.size() != 1 || s.terms[0].law != Law::rocking || series.x.size() > 800)
            continue;
        series.x.push_back(s.terms[0].rotation_rad);
        series.y.push_back(s.value / s.terms[0].normal);
    }
    if (series.x.size() < 5)
        return std::nullopt;
    figure.series = {series};
    return figure;
}

/// Things that lack the same are told in one sentence.
void add_missing(Diagnosis& d, const std::string& what, const std::string& why)
{
    for (Missing& other : d.missing)
        if (other.why == why) {
            other.what += ", " + what;
            return;
        }
    d.missing.push_back({what, why});
}

std::string missing_words(const Diagnosis& d)
{
    std::string text;
    for (const Missing& missing : d.missing)
        text += (text.empty() ? "" : ", ") + missing.what;
    return text;
}

/// What the reader of the campaign noticed; what it noticed in several runs is one sentence.
std::vector<std::string> finding_texts(const std::vector<Finding>& findings)
{
    struct Told {
        std::vector<std::string> runs;
        std::string place, text;
    };
    std::vector<Told> all;
    for (const Finding& finding : findings) {
        Told one{{}, finding.place, finding.text};
        const std::size_t comma = finding.place.find(", ");
        if (finding.place.starts_with("run ") && comma != std::string::npos)
            one = {{finding.place.substr(4, comma - 4)}, finding.place.substr(comma + 2), finding.text};
        const auto same = std::find_if(all.begin(), all.end(), [&](const Told& other) {
            return !one.runs.empty() && !other.runs.empty() && other.place == one.place && other.text == one.text;
        });
        if (same == all.end())
            all.push_back(one);
        else
            same->runs.push_back(one.runs.front());
    }
    std::vector<std::string> texts;
    for (const Told& told : all)
        texts.push_back(told.runs.empty() ? told.place + ": " + told.text
                        : told.runs.size() == 1
                            ? "run " + told.runs.front() + ", " + told.place + ": " + told.text
                            : "runs " + list_words(told.runs) + ", " + told.place + ": " + told.text);
    return texts;
}

std::string verdict_text(const Diagnosis& d)
{
    if (d.verdict == Verdict::none)
        return "No mechanism explains the errors of the simulation better than noise, scatter and its contact law" +
               (d.missing.empty()
                    ? std::string(".")
                    : fmt::format(", among the tests that were possible. Not tested: {}.", missing_words(d)));
    std::vector<std::string> names;
    for (const Candidate* c : named_causes(d))
        names.push_back(fmt::format("{} {}, {}{}", c->mechanism, place_words(c->place), mechanism_words(c->mechanism),
                                    size_text(*c)));
    std::string text =
        names.empty() ? "" : fmt::format("The data show {} (in brackets: 95 % interval).", list_words(names));
    if (d.verdict == Verdict::unexplained)
        return text + fmt::format("{}n effect is present that none of the known mechanisms explains: {}.",
                                  names.empty() ? "A" : " In addition, a", d.unexplained ? d.unexplained->text : "");
    if (d.indistinguishable.size() > 1)
        text += fmt::format(" They do not distinguish {} from {}.", d.indistinguishable.front(),
                            list_words({d.indistinguishable.begin() + 1, d.indistinguishable.end()}));
    return text;
}

} // namespace

std::optional<Diagnosis> diagnose(const Campaign& measured, const Study& start, const DiagnosisOptions& options,
                                  const Tell& tell, Observer& observer)
{
    const auto begin = std::chrono::steady_clock::now();
    Diagnosis d;
    d.measured_file = measured.source;
    d.specimen = measured.specimen.name;
    d.code_version = code_version();
    d.seed = options.seed;
    d.options = {fmt::format("nulls = {}", options.nulls), fmt::format("threads = {}", options.run.threads)};
    d.runs = measured.runs.size();
    d.data_findings = finding_texts(measured.findings);
    SimulationCount count;

    const TrackScales scales = track_scales(measured); // refuses what cannot be diagnosed, before anything is told
    const SpecimenStructure built = build_specimen(measured.specimen);
    tell(fmt::format("{}: {} runs of {} blocks", measured.source, measured.runs.size(), measured.specimen.blocks()));
    Study study = start;
    study.structure = built.structure;

    // base and sensors
    const DirectResult direct = direct_tests(measured, scales);
    d.base_tests = direct.base_tests;
    d.sensor_tests = direct.sensor_tests;
    for (const DataTest& test : direct.base_tests) {
        tell(fmt::format("  {:<12} {}: {}", to_string(test.outcome), test.name, test.sentence));
        if (test.outcome == TestOutcome::not_judged)
            add_missing(d, test.name, test.sentence);
    }
    for (const DataTest& test : direct.sensor_tests)
        if (test.outcome == TestOutcome::failed)
            tell(fmt::format("  {:<12} {} at {}: {}", to_string(test.outcome), test.name, test.place, test.sentence));
    const Campaign campaign = corrected(measured, direct);
    std::vector<SizedCause> known; // of the direct tests, for the model
    for (const CauseFit& fit : direct.found)
        if (fit.cause.mechanism == "wedge" || fit.cause.mechanism == "table_pitch" ||
            (fit.cause.mechanism == "vertical_motion" && fit.cause.parameter == "ratio"))
            known.push_back({fit.cause, fit.size});

    // the balance of forces
    const BalanceEvidence balance = balance_evidence(measured, scales, direct.base_m);
    if (balance.fit) {
        int sliding = 0, rocking = 0;
        for (const LawSample& s : balance.fit->samples())
            for (const LawTerm& t : s.terms)
                ++(t.law == Law::sliding ? sliding : rocking);
        tell(fmt::format("  balance of forces: {} windows in which a joint slides, {} in which one rocks", sliding,
                         rocking));
        if (auto figure = friction_figure(balance, measured))
            d.figures.push_back(*figure);
        if (auto figure = turning_figure(balance))
            d.figures.push_back(*figure);
        std::vector<std::string> still;
        for (int j = 0; j < static_cast<int>(measured.specimen.joints.size()); ++j)
            if (balance.fit->samples_of(Law::sliding, j) < 5)
                still.push_back(fmt::format("{}", j));
        if (!still.empty())
            add_missing(
                d, fmt::format("the friction of joint{} {} by itself", still.size() > 1 ? "s" : "", list_words(still)),
                "It slides too rarely for the balance of forces to separate its friction from that of the others. A "
                "strong motion of low frequency, under which it slides, would determine it.");
    } else {
        d.missing.push_back({"balance of forces", balance.why_not});
        tell("  balance of forces: " + balance.why_not);
    }
    d.baseline.push_back(baseline_friction(judge_friction(measured, scales, direct.base_m), start));

    // windows of the simulation; a vertical motion without a model of its own would be blamed on something
    const bool unmodelled = std::any_of(direct.found.begin(), direct.found.end(), [](const CauseFit& fit) {
        return fit.cause.mechanism == "vertical_motion" && fit.cause.parameter != "ratio";
    });
    WindowEvidence windows;
    if (!unmodelled)
        windows = window_evidence(campaign, study, scales, known, options.windows, options.run, observer);
    else {
        windows.complete = true;
        windows.why_not = "The table has a vertical motion that the base motion does not contain.";
    }
    count.simulations += windows.simulations;
    count.window_simulations += windows.window_simulations;
    count.block_steps += windows.block_steps;
    if (!windows.complete)
        return std::nullopt;
    if (!windows.baselines.empty()) {
        study = windows.baselines.front().study;
        for (const WindowBaseline& b : windows.baselines)
            tell(
                fmt::format("  windows: {} scores {:.1f} nats", b.contacts, b.score - windows.baselines.front().score));
        d.baseline.push_back({"contact.form", "", std::nullopt, std::nullopt, std::nullopt, true,
                              windows.baselines.front().contacts +
                                  " (best of the tested forms; the factors are relative to the start study of the "
                                  "diagnosis, without intervals: see stylobate calibrate)"});
    } else {
        d.missing.push_back({"free windows", windows.why_not});
    }
    study.text = study_text(study);
    d.study_toml = study.text;

    // what chance gives
    Chance chance;
    if (options.nulls > 0) {
        ChanceOptions how{options.nulls, options.seed, options.cache, options.windows && windows.why_not.empty(),
                          options.run};
        chance = chance_of(
            measured, start, how,
            [&](std::uint64_t done, std::uint64_t cached) {
                tell(fmt::format("  null campaigns: {} of {}{}", done, options.nulls,
                                 done == cached ? " (from an earlier run, in " + options.cache.string() + ")" : ""));
            },
            observer);
        count.simulations += chance.simulations;
        count.window_simulations += chance.window_simulations;
        count.block_steps += chance.block_steps;
        if (!chance.complete)
            return std::nullopt;
        d.nulls.push_back({"area, two_corner and points", chance.campaigns,
                           "contacts (form, stiffness, exponent, damping), friction of the joints, widths, masses and "
                           "places of the blocks, noise of the cameras"});
    } else {
        add_missing(d, "the null distribution",
                    "No null campaigns were simulated (--nulls 0): only direct tests can name a cause, and forces of "
                    "unknown kind are compared with fixed thresholds only.");
    }

    // the verdict
    const auto again = [&](const JudgedCause& given) {
        const BalanceEvidence left = balance_evidence(measured, scales, direct.base_m, {given.fit.cause});
        return judge(left, {}, {}, chance.gains, options.rule);
    };
    const Decided decided =
        decide(direct, balance, judge(balance, windows.causes, windows.gain_by_form, chance.gains, options.rule),
               chance.gains, options.rule, again);
    if (observer.stop_requested())
        return std::nullopt;
    d.verdict = decided.verdict;
    std::set<std::pair<std::string, std::string>> told;
    const auto add = [&](const JudgedCause& j, Decision decision) {
        if (told.emplace(j.fit.cause.mechanism, j.fit.cause.place).second)
            d.candidates.push_back(candidate_of(j, measured, decision, windows.baselines, chance.campaigns > 0,
                                                decided.unexplained.has_value()));
    };
    for (const JudgedCause& j : decided.named)
        add(j, Decision::named);
    for (const JudgedCause& j : decided.in_set)
        add(j, Decision::in_set);
    for (const JudgedCause& j : decided.judged)
        add(j, Decision::rejected);
    for (const JudgedCause& j : decided.named)
        if (j.channel != Channel::direct && !decided.in_set.empty() && d.indistinguishable.empty())
            d.indistinguishable.push_back(j.fit.cause.mechanism);
    for (const JudgedCause& j : decided.in_set)
        if (std::find(d.indistinguishable.begin(), d.indistinguishable.end(), j.fit.cause.mechanism) ==
            d.indistinguishable.end())
            d.indistinguishable.push_back(j.fit.cause.mechanism);
    if (decided.unexplained) {
        const Structure& s = decided.unexplained->structure;
        Unexplained u;
        u.block = s.block;
        u.coordinate = s.coordinate;
        u.depends_on = s.depends_on;
        double best = 0;
        for (const CauseFit& fit : balance.causes)
            best = std::max(best, fit.gain);
        u.text = fmt::format(
            "{}. Its gain over the baseline is {:.1f} nats; that of the best known cause in its place is {:.1f}",
            s.text, decided.unexplained->gain, best);
        for (std::size_t k = 0; k < balance.structures.size() && k < 8; ++k) {
            const StructureFit& f = balance.structures[k];
            u.features.push_back(
                {fmt::format("{} (block {}, {})", f.structure.depends_on, f.structure.block, f.structure.coordinate),
                 f.gain, chance.gains.quantile95_of_structures()});
        }
        d.unexplained = u;
    }
    d.verdict_text = verdict_text(d);
    tell("  " + d.verdict_text);
    if (!d.candidates.empty())
        d.figures.push_back(candidates_figure(d.candidates));

    // where the baseline is wrong, and what the extension gains
    WrongWindows wrong = wrong_windows(measured, study, most_wrong, options.run, count, observer);
    d.wrong = std::move(wrong.stretches);
    std::move(wrong.figures.begin(), wrong.figures.end(), std::back_inserter(d.figures));
    if (d.verdict == Verdict::named) {
        if (!windows.baselines.empty())
            d.gain =
                predictive_gain(measured, scales, study, decided.named, options.seed, options.run, count, observer);
        Study extended = study;
        std::vector<std::string> left_out;
        for (const JudgedCause& j : decided.named) {
            if (j.fit.cause.mechanism == "vertical_motion" && j.fit.cause.parameter != "ratio") {
                left_out.push_back("vertical_motion (its record is not known)");
                continue;
            }
            if (j.fit.cause.mechanism == "harmonic_distortion") {
                add_distortion(direct.distortion, direct.gain, extended);
                continue;
            }
            add_mechanism({j.fit.cause, j.fit.size}, built, extended);
        }
        extended.excitation = ExcitationSpec{};
        extended.excitation.kind = ExcitationKind::table;
        extended.excitation.file = std::filesystem::absolute(measured.source).string();
        extended.excitation.run = measured.runs.front().name;
        extended.text = study_text(extended);
        d.extended_study = extended.text;
        if (!left_out.empty())
            d.missing.push_back({"all of the extended study", "It lacks " + list_words(left_out) + "."});
        if (!d.gain)
            d.missing.push_back(
                {"the gain of the extended model",
                 windows.baselines.empty()
                     ? "No free windows could be simulated: " + windows.why_not
                     : "Runs of at least two motions with windows are needed, so that some can be held out."});
    } else if (d.verdict == Verdict::unexplained) {
        d.missing.push_back(
            {"the gain of an extended model", "No extended model was made because part of the error is unexplained."});
    }
    std::vector<JudgedCause> rivals;
    for (const auto* list : {&decided.named, &decided.in_set, &decided.judged})
        for (const JudgedCause& j : *list)
            if (j.channel != Channel::direct && j.fit.gain > 0 && rivals.size() < 2 &&
                std::none_of(rivals.begin(), rivals.end(), [&](const JudgedCause& other) {
                    return other.fit.cause.mechanism == j.fit.cause.mechanism;
                }))
                rivals.push_back(j);
    if (!decided.in_set.empty() || (!decided.named.empty() && decided.named.front().channel != Channel::direct))
        d.next_test = next_test(measured, scales, study, rivals, options.seed, options.run, count, observer);
    if (observer.stop_requested())
        return std::nullopt;
    d.runs_used = static_cast<std::uint64_t>(
        std::count_if(measured.runs.begin(), measured.runs.end(),
                      [](const MeasuredRun& run) { return !run.blocks.x_m.empty() && run.time_s.size() > 1; }));
    d.method = {
        "Base and sensors are tested directly, while the lowest block moves with the table and while all blocks are at "
        "rest.",
        "The forces in the joints follow from the smoothed accelerations of the blocks by Newton's law. Where a joint "
        "slides or rocks, its law is tested without contact stiffness, damping or simulation.",
        std::string("The simulation is nudged towards the measured motion (an observer). Free windows that start from "
                    "its states are compared with the measurement: they determine the contacts of the baseline") +
            (options.windows ? ", and the gain of each cause."
                             : ". They are used to test causes only with --windows.")};
    if (chance.campaigns > 0)
        d.method.push_back(
            fmt::format("Null campaigns (without a hidden effect), simulated with contacts of many kinds, pass through "
                        "the same stages and give the null distribution. A cause is named only if its gain exceeds the "
                        "95 % quantile of the null distribution by {:g} nats, its p-value is below {:g}, its gain does "
                        "not depend on a single run, and its size exceeds the scatter between specimens. A gain "
                        "slightly above the null distribution is therefore not sufficient.",
                        options.rule.clear, options.rule.chance));
    d.cost.simulations = count.simulations;
    d.cost.window_simulations = count.window_simulations;
    d.cost.block_steps = count.block_steps;
    d.cost.threads = options.run.threads;
    d.cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return d;
}

} // namespace stylobate
