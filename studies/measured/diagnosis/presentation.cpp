#include "studies/measured/diagnosis/presentation.hpp"

#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double two_sided95 = 1.96;

/// The size with its 95 % interval in brackets.
std::string size_text(const Candidate& c)
{
    if (!c.size)
        return "";
    return ", " + c.parameter + " = " + estimate_words(c.size, c.low, c.high, c.unit);
}

std::string missing_words(const Diagnosis& d)
{
    std::string text;
    for (const Missing& missing : d.missing)
        text += (text.empty() ? "" : ", ") + missing.what;
    return text;
}

/// What stands for forces of no known kind is called so.
std::string name_words(const std::string& mechanism)
{
    Cause cause;
    cause.mechanism = mechanism;
    return stands_for_unknown(cause) ? "a force of no known kind (" + mechanism + ")" : mechanism;
}

std::vector<std::string> names_words(std::vector<std::string> mechanisms)
{
    for (std::string& mechanism : mechanisms)
        mechanism = name_words(mechanism);
    return mechanisms;
}

/// Why a cause is named, in the set, or neither.
std::string reason(const JudgedCause& j, Decision decision, const Decided& decided)
{
    if (j.why_not)
        return *j.why_not;
    if (j.channel == Channel::direct)
        return "found by a direct test";
    if (j.channel == Channel::forces)
        return fmt::format("by the balance of forces: {:.1f} nats; the p-value of all its scores is {:.2g}", j.fit.gain,
                           j.chance);
    if (decision != Decision::not_shown)
        return fmt::format("by the statistics of the campaign: {:.1f} nats; null distribution {:.1f} (95 %)",
                           j.fit.gain, j.chance95);
    if (decided.unexplained)
        return "a force of unknown kind has a significantly larger gain";
    if (std::ranges::any_of(decided.named, [](const JudgedCause& named) { return named.channel != Channel::direct; }))
        return "another cause explains the same data better";
    return j.chance > EnsembleRule{}.named ? fmt::format("the p-value of the gain is {:.2g}", j.chance)
                                           : "the candidate of the largest gain is not named, and this one gains less";
}

} // namespace

Candidate candidate_of(const JudgedCause& j, const Campaign& campaign, Decision decision, bool chance_known,
                       const Decided& decided)
{
    Candidate c;
    const Cause& cause = j.fit.cause;
    c.mechanism = cause.mechanism;
    c.place = cause.place;
    c.parameter = cause.parameter;
    if (cause.side)
        c.why = fmt::format("at the {} end", *cause.side);
    if (cause.persists)
        c.why = "it goes on from run to run";
    if (stands_for_unknown(cause))
        c.why = "it stands for forces of no known kind on this block";
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
    if (j.channel != Channel::direct && chance_known)
        c.p = j.chance;
    if (j.channel == Channel::statistics && chance_known)
        c.null95 = j.chance95;
    if (j.channel == Channel::direct || chance_known)
        c.probability = j.probability;
    for (std::size_t r = 0; r < j.fit.gain_by_run.size(); ++r)
        if (j.fit.gain_by_run[r] != 0)
            c.evidence.push_back({campaign.runs[r].name, j.fit.gain_by_run[r], std::nullopt});
    c.decision = decision;
    c.why += (c.why.empty() ? "" : "; ") + reason(j, decision, decided);
    if (j.forces_too)
        c.why +=
            fmt::format("; the balance of forces names it, too (p = {:.2g}): place and size are its", *j.forces_too);
    return c;
}

DiagnosisFigure candidates_figure(const std::vector<Candidate>& candidates)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::candidates;
    const bool compared =
        std::any_of(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.null95.has_value(); });
    figure.title = compared ? "Gain of each cause, and its null distribution" : "Gain of each cause";
    figure.caption = "Gain in log likelihood over the baseline.";
    figure.caption += compared
                          ? " The dot is the 95 % quantile of the null distribution from simulated campaigns without a "
                            "hidden effect. A cause without a dot was found by a direct test of base, sensors or rest "
                            "with a separate threshold, or by the balance of forces alone."
                          : " The causes were found by direct tests of base, sensors or rest, each with a threshold of "
                            "its own.";
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

CarryingNumber carrying_score(const EnsembleDiagnosis& ensemble, std::uint64_t scouts, const Cause& cause)
{
    const std::vector<Cause>& scored = ensemble.scored.causes;
    const auto at = std::find(scored.begin(), scored.end(), cause);
    CarryingNumber out;
    if (at == scored.end())
        return out;
    const auto column = static_cast<std::size_t>(at - scored.begin());
    out.text = fmt::format("score of {} in the balance of forces", cause.label());
    out.measured = ensemble.scores[column];
    for (const SimulatedCampaign& row : ensemble.ensemble.campaigns) {
        if (row.number < scouts)
            continue;
        const double score = row.scores[column];
        if (row.cause < 0)
            out.add_healthy(score);
        else if (const CandidateCause& candidate = ensemble.causes[static_cast<std::size_t>(row.cause)];
                 candidate.cause.label() == cause.label() && candidate.cause.parameter == cause.parameter)
            out.add_labelled(candidate.size_of(row.z), score);
    }
    return out;
}

DiagnosisFigure carrying_figure(const CarryingNumber& number, const Candidate& named)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::candidates;
    figure.title = fmt::format("What shows {} at {}: {}", named.mechanism, named.place, number.text);
    figure.caption =
        "Simulated campaigns of this specimen under these motions, with contact laws like the measured one: "
        "healthy ones (at the neutral size), and ones with the cause at several sizes. The measured "
        "campaign stands at the size that was found.";
    if (number.hidden > 0)
        figure.caption += fmt::format(" {} healthy campaigns do not show it and are not drawn.", number.hidden);
    figure.x_label = named.parameter + (named.unit.empty() ? "" : " [" + named.unit + "]");
    figure.y_label = number.text;
    FigureSeries healthy{"healthy", SeriesKind::points, {}, {}, {}, {}},
        labelled{"with the cause", SeriesKind::points, {}, {}, {}, {}},
        measured{"measured", SeriesKind::points, {}, {}, {}, {}};
    for (const double value : number.nulls) {
        healthy.x.push_back(named.neutral.value_or(0));
        healthy.y.push_back(value);
    }
    for (const auto& [size, value] : number.labelled) {
        labelled.x.push_back(size);
        labelled.y.push_back(value);
    }
    measured.x = {named.size.value_or(named.neutral.value_or(0))};
    measured.y = {number.measured};
    figure.series = {healthy, labelled, measured};
    return figure;
}

std::vector<Missing> hardly_shown(const EnsembleDiagnosis& ensemble, const Decided& decided)
{
    const auto told = [&](const std::string& mechanism) {
        for (const auto* list : {&decided.named, &decided.in_set})
            for (const JudgedCause& j : *list)
                if (j.fit.cause.mechanism == mechanism)
                    return true;
        return false;
    };

    constexpr double strong = 0.8, hardly = 0.5; // z; share that is named
    std::vector<Missing> out;
    for (std::size_t m = 0; m < ensemble.mechanisms.size(); ++m)
        if (const auto power = ensemble.power(static_cast<int>(m), strong);
            power && *power < hardly && !told(ensemble.mechanisms[m]))
            out.push_back({name_words(ensemble.mechanisms[m]),
                           fmt::format("These data would hardly show it: of simulated campaigns in which it acts "
                                       "strongly {:.0f} % are named rightly.",
                                       100 * *power)});
    return out;
}

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

std::optional<DiagnosisFigure> friction_figure(const BalanceEvidence& balance, const Campaign& campaign)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::data;
    figure.title = "Friction of the joints that slide, from the balance of forces";
    figure.caption = "Each point is one window with continuous sliding of a joint: friction over normal force, without "
                     "any contact model. Bars: one standard deviation, from the noise of the cameras.";
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

std::optional<DiagnosisFigure> turning_figure(const BalanceEvidence& balance)
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::data;
    figure.title = "Position of the contact force in rocking joints, from the balance of forces";
    figure.caption = "Distance of the contact force inside the corner on which a joint turns, over the half width: 0 "
                     "is a sharp, hard corner. One point for each window.";
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

void add_missing(Diagnosis& d, const std::string& what, const std::string& why)
{
    for (Missing& other : d.missing)
        if (other.why == why) {
            other.what += ", " + what;
            return;
        }
    d.missing.push_back({what, why});
}

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
        return (d.nulls.empty() ? "The direct tests of base and sensors name no cause"
                                : "No mechanism explains the errors of the simulation better than noise, scatter and "
                                  "its contact law") +
               (d.missing.empty() ? std::string(".") : fmt::format(". Not tested: {}.", missing_words(d)));
    std::vector<std::string> names;
    for (const Candidate* c : named_causes(d))
        names.push_back(fmt::format("{} {}, {}{}", c->mechanism, place_words(c->place), mechanism_words(c->mechanism),
                                    size_text(*c)));
    std::string text =
        names.empty() ? "" : fmt::format("The data show {} (in brackets: 95 % interval).", list_words(names));
    if (d.verdict == Verdict::unexplained)
        return text + fmt::format("{}n effect is present that none of the known mechanisms explains: {}.{}",
                                  names.empty() ? "A" : " In addition, a", d.unexplained ? d.unexplained->text : "",
                                  d.indistinguishable.empty() ? ""
                                                              : " The data do not exclude " +
                                                                    list_words(d.indistinguishable) + " in its place.");
    if (d.indistinguishable.size() > 1)
        text += fmt::format(" They do not distinguish {} from {}.", d.indistinguishable.front(),
                            list_words(names_words({d.indistinguishable.begin() + 1, d.indistinguishable.end()})));
    return text;
}

} // namespace stylobate
