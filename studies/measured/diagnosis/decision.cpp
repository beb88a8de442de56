#include "studies/measured/diagnosis/decision.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

// Of each cause before the data: half of the campaigns show something, and there are some fifteen mechanisms.
constexpr double probable_before = 1.0 / 30;
// No finding is surer: what a test leaves out is not in its standard deviation.
constexpr double surest_finding = 0.97;
constexpr double half_width90 = 1.6449; // of a normal interval of 90 %, in standard deviations

double quantile95(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : sorted_quantile(values, 0.95, QuantileDefinition::linear);
}

/// How probable a finding at one of `places` is by chance.
double chance_of(const CauseFit& fit, std::size_t places)
{
    const double at_one = std::erfc(std::sqrt(std::max(fit.gain, 0.0))); // beyond sqrt(2 gain) standard deviations
    return std::min(1.0, static_cast<double>(places) * at_one);
}

std::size_t places_tested(const DirectResult& direct, const std::string& name)
{
    const auto at = [&](const DataTest& test) { return test.name == name; };
    return static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(1, std::count_if(direct.base_tests.begin(), direct.base_tests.end(), at) +
                                        std::count_if(direct.sensor_tests.begin(), direct.sensor_tests.end(), at)));
}

/// What the direct tests of base and sensors found is named.
std::vector<JudgedCause> named_directly(const DirectResult& direct)
{
    std::vector<JudgedCause> named;
    for (const CauseFit& fit : direct.found) {
        JudgedCause j;
        j.fit = fit;
        j.channel = Channel::direct;
        j.considered = true;
        j.chance = chance_of(fit, places_tested(direct, fit.cause.mechanism));
        j.probability = std::min(surest_finding, probability_of_finding(j.chance, probable_before));
        named.push_back(std::move(j));
    }
    return named;
}

/// A candidate as the statistics judge it.
JudgedCause judged(const EnsembleDiagnosis& ensemble, std::size_t candidate, const CauseLikelihood& found)
{
    const EnsembleVerdict& verdict = ensemble.by_statistics;
    const CandidateCause& cause = ensemble.causes[candidate];
    JudgedCause j;
    j.fit.cause = cause.cause;
    j.fit.size = cause.size_of(found.size);
    j.fit.sd = std::fabs(cause.size_of(found.high) - cause.size_of(found.low)) / (2 * half_width90);
    j.fit.gain = std::max(found.gain, 0.0);
    j.chance95 = quantile95(verdict.null_gains);
    j.chance = conformal_p_value(verdict.null_gains, found.gain, verdict.null_weights);
    return j;
}

/// The fit of a cause in the balance of forces, where this sees the cause clearly; else null.
const CauseFit* seen_by_forces(const BalanceEvidence& balance, const CauseFit& wanted)
{
    for (const CauseFit& fit : balance.causes)
        if (fit.cause.mechanism == wanted.cause.mechanism && fit.cause.place == wanted.cause.place &&
            fit.cause.parameter == wanted.cause.parameter && fit.cause.persists == wanted.cause.persists &&
            fit.gain >= DecisionRule{}.clear)
            return &fit;
    return nullptr;
}

/// Place and size by the balance of forces: its sizes are not limited to simulated ones. The gain stays that of the
/// statistics, as those beside it in the list: the other is no likelihood of the same data.
void take_fit_of_forces(CauseFit fit, JudgedCause& j)
{
    fit.gain = j.fit.gain;
    fit.gain_by_run.clear();
    j.fit = std::move(fit);
}

void take_size_of_forces(const BalanceEvidence& balance, JudgedCause& j)
{
    if (const CauseFit* fit = seen_by_forces(balance, j.fit))
        take_fit_of_forces(*fit, j);
}

/// More friction of one joint lets it slide less, and so do contact laws that are not of the family. Only forces that
/// the nominal friction cannot carry distinguish the two.
bool more_friction_without_forces(const BalanceEvidence& balance, const CauseFit& fit)
{
    if (fit.cause.mechanism != "joint_friction" || fit.size <= 1)
        return false;
    const CauseFit* seen = seen_by_forces(balance, fit);
    return !seen || seen->size <= 1;
}

/// The force of unknown kind with the largest score, if nothing else explains it.
std::optional<StructureFit> unknown_force(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble,
                                          const DecisionRule& rule, double named_at)
{
    const ForceTest& scores = ensemble.forces;
    if (scores.variant < 0 || scores.p_value > named_at)
        return std::nullopt;
    if (nats_of_score(scores.score) <= nats_of_score(quantile95(scores.nulls)) + rule.structure_clear)
        return std::nullopt;
    double listed = 0; // what a known cause explains of the same samples
    for (const CauseFit& fit : balance.causes)
        listed = std::max(listed, fit.gain);
    const Structure& wanted = ensemble.scored.structures[static_cast<std::size_t>(scores.variant)];
    for (const StructureFit& fit : balance.structures) {
        if (fit.structure.text == wanted.text && fit.gain > listed + rule.structure_better &&
            not_by_one_run(fit.gain, fit.gain_by_run, rule.without_best))
            return fit;
    }
    return std::nullopt;
}

/// A tie in words: on what the force depends that it stands for.
StructureFit structure_of(const CauseFit& tie)
{
    StructureFit fit;
    fit.gain = tie.gain;
    fit.size = tie.size;
    fit.sd = tie.sd;
    Structure& s = fit.structure;
    s.block = tie.cause.block;
    const bool turns = tie.cause.parameter == "turning_dashpot_n_m_s";
    s.coordinate = turns ? "theta" : "x";
    s.depends_on = turns ? "angular velocity" : tie.cause.parameter == "dashpot_n_s_m" ? "velocity" : "position";
    const std::string how = s.depends_on != "position" ? "goes against its " + s.depends_on
                            : tie.size > 0             ? "draws it to its place on the base"
                                                       : "drives it away from its place on the base";
    s.text = fmt::format("{} on block {} that {}, as a tie of {:.2g} {} would", turns ? "a moment" : "a sideways force",
                         s.block, how, tie.size, tie.cause.unit);
    return fit;
}

/// What the best cause leaves of the set's probability goes to the others in the set, by their gains.
void share_what_remains(const EnsembleVerdict& verdict, Decided& out)
{
    const double left = verdict.set_probability - verdict.probability;
    double sum = 0, most = 0;
    for (const JudgedCause& j : out.in_set)
        most = std::max(most, j.fit.gain);
    for (const JudgedCause& j : out.in_set)
        sum += std::exp(j.fit.gain - most);
    for (JudgedCause& j : out.in_set)
        j.probability = left * std::exp(j.fit.gain - most) / sum;
}

bool contains(const std::vector<JudgedCause>& list, const std::string& mechanism)
{
    return std::any_of(list.begin(), list.end(),
                       [&](const JudgedCause& j) { return j.fit.cause.mechanism == mechanism; });
}

/// The best candidate, if it may be named. Says of it why not.
bool may_be_named(const BalanceEvidence& balance, const EnsembleVerdict& verdict, JudgedCause& best)
{
    const bool probable = verdict.named && verdict.set_probability >= least_probability;
    if (verdict.named)
        best.probability = verdict.probability;
    if (!verdict.named)
        best.why_not = fmt::format("the p-value of the gain is {:.2g}", verdict.p_value);
    else if (!probable)
        best.why_not = fmt::format("possible, with a probability of {:.2f}", verdict.probability);
    else if (!stands_for_unknown(best.fit.cause) && !matters(best.fit))
        best.why_not = "its size is within the scatter between specimens";
    else if (more_friction_without_forces(balance, best.fit))
        best.why_not = "more friction is named only where forces in the joint show it";
    best.considered = !best.why_not;
    return best.considered;
}

/// By the statistics: all candidates are listed, the likeliest first; the best one and its rivals are considered if
/// they may be named. A tie is never named: it stands for what is not in the list.
void judge_statistics(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble, Decided& out)
{
    const EnsembleVerdict& verdict = ensemble.by_statistics;
    if (verdict.best < 0)
        return;
    JudgedCause best = judged(ensemble, static_cast<std::size_t>(verdict.best),
                              verdict.causes[static_cast<std::size_t>(verdict.best)]);
    const bool named = may_be_named(balance, verdict, best);
    std::vector<std::size_t> order(ensemble.causes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return verdict.causes[a].gain > verdict.causes[b].gain; });
    for (const std::size_t c : order) {
        if (static_cast<int>(c) == verdict.best)
            continue;
        JudgedCause j = judged(ensemble, c, verdict.causes[c]);
        const bool rival =
            std::find(verdict.set.begin(), verdict.set.end(), ensemble.mechanism_of(j.fit.cause)) != verdict.set.end();
        if (named && rival && j.fit.gain > 0 && !contains(out.in_set, j.fit.cause.mechanism)) {
            j.considered = true;
            out.in_set.push_back(j);
        }
        out.judged.push_back(std::move(j));
    }
    std::erase_if(out.judged, [](const JudgedCause& j) { return !j.considered && j.fit.gain == 0; });
    out.judged.push_back(best);
    std::stable_sort(out.judged.begin(), out.judged.end(), [](const JudgedCause& a, const JudgedCause& b) {
        return a.considered != b.considered ? a.considered : a.fit.gain > b.fit.gain;
    });
    if (!named)
        return;
    if (stands_for_unknown(best.fit.cause)) {
        out.unexplained = structure_of(best.fit);
        out.unexplained_chance = best.chance;
        out.by_tie = true;
        return;
    }
    take_size_of_forces(balance, best);
    out.named.push_back(best);
}

std::vector<Cause> named_by_statistics(const Decided& decided)
{
    std::vector<Cause> causes;
    for (const JudgedCause& j : decided.named)
        if (j.channel == Channel::statistics)
            causes.push_back(j.fit.cause);
    return causes;
}

/// Gain of a mechanism by the statistics [nats].
double gain_by_statistics(const EnsembleDiagnosis& ensemble, const std::string& mechanism)
{
    double gain = 0;
    for (std::size_t c = 0; c < ensemble.causes.size(); ++c)
        if (ensemble.causes[c].cause.mechanism == mechanism)
            gain = std::max(gain, ensemble.by_statistics.causes[c].gain);
    return gain;
}

/// What the forces name, the likeliest first: of what explains the forces about as well the statistics choose.
std::vector<JudgedCause> judged_by_forces(const NamedByForces& forces, const EnsembleDiagnosis& ensemble,
                                          const DecisionRule& rule)
{
    std::vector<JudgedCause> all;
    const auto nats = [&](const JudgedCause& j) {
        return j.fit.gain + gain_by_statistics(ensemble, j.fit.cause.mechanism);
    };
    for (const CauseFit& fit : forces.causes) {
        JudgedCause j;
        j.fit = fit;
        j.channel = Channel::forces;
        j.considered = true;
        j.chance = forces.p_value;
        all.push_back(std::move(j));
    }
    std::stable_sort(all.begin(), all.end(),
                     [&](const JudgedCause& a, const JudgedCause& b) { return nats(a) > nats(b); });
    double sum = 0;
    for (const JudgedCause& j : all)
        sum += std::exp(nats(j) - nats(all.front()));
    for (JudgedCause& j : all)
        j.probability = rule.of_known_kind * std::exp(nats(j) - nats(all.front())) / sum;
    return all;
}

/// Into the set, with no more of the probability than the named cause leaves.
void add_rivals(std::vector<JudgedCause> rivals, double named, std::vector<JudgedCause>& in_set)
{
    double sum = 0;
    for (const JudgedCause& j : rivals)
        sum += j.probability.value_or(0);
    for (JudgedCause& j : rivals) {
        j.probability = j.probability.value_or(0) * std::min(1.0, (1 - named) / sum);
        if (!contains(in_set, j.fit.cause.mechanism))
            in_set.push_back(std::move(j));
    }
}

/// What the forces name beside what the statistics do.
void judge_forces(const NamedByForces& forces, const EnsembleDiagnosis& ensemble, const DecisionRule& rule,
                  Decided& out)
{
    std::vector<JudgedCause> by_forces = judged_by_forces(forces, ensemble, rule);
    if (by_forces.empty() || forces.unknown)
        return;
    const auto by_statistics = [](const JudgedCause& j) { return j.channel == Channel::statistics; };
    double most = 0; // of what is named
    if (std::none_of(out.named.begin(), out.named.end(), by_statistics)) {
        out.unexplained.reset(); // a tie stands for forces: these are those of a known cause
        out.by_tie = false;
        out.in_set.clear();
        out.named.push_back(by_forces.front());
        most = by_forces.front().probability.value_or(0);
        by_forces.erase(by_forces.begin());
    }
    for (JudgedCause& named : out.named) {
        if (!by_statistics(named))
            continue;
        const auto same = std::find_if(by_forces.begin(), by_forces.end(), [&](const JudgedCause& j) {
            return j.fit.cause.mechanism == named.fit.cause.mechanism;
        });
        if (same != by_forces.end()) {
            take_fit_of_forces(std::move(same->fit), named);
            named.probability = std::max(same->probability, named.probability);
            named.forces_too = same->chance;
            by_forces.erase(same);
            out.in_set.clear(); // of the statistics: forces distinguish more
        }
        most = std::max(most, named.probability.value_or(0));
    }
    add_rivals(std::move(by_forces), most, out.in_set);
}

/// What acts and is no cause of the list.
void find_unexplained(const BalanceEvidence& balance, const EnsembleDiagnosis& ensemble, const NamedByForces& forces,
                      const DecisionRule& rule, Decided& out)
{
    if (out.by_tie)
        return;
    if (forces.unknown) {
        out.unexplained = forces.unknown;
        if (!forces.causes.empty())
            out.beside = forces.causes.front();
        out.beside_too = forces.given_too;
        out.unexplained_chance = forces.p_value;
    } else if ((out.unexplained = unknown_force(balance, ensemble, rule, EnsembleRule{}.force))) {
        out.unexplained_chance = ensemble.forces.p_value;
    }
    if (out.unexplained) {
        std::erase_if(out.named, [](const JudgedCause& j) { return j.channel != Channel::direct; });
        out.in_set.clear();
    }
}

} // namespace

bool beyond_simulation(const DirectResult& direct)
{
    return std::any_of(direct.found.begin(), direct.found.end(),
                       [](const CauseFit& fit) { return unrecorded_vertical(fit.cause); });
}

Decided decide(const DirectResult& direct, const BalanceEvidence& balance, const EnsembleDiagnosis* ensemble,
               const DecisionRule& rule)
{
    Decided out;
    out.named = named_directly(direct);
    if (ensemble) {
        out.structure95 = nats_of_score(quantile95(ensemble->forces.nulls));
        if (!beyond_simulation(direct)) {
            judge_statistics(balance, *ensemble, out);
            share_what_remains(ensemble->by_statistics, out);
            const NamedByForces forces = named_by_forces(balance, *ensemble, named_by_statistics(out), rule);
            judge_forces(forces, *ensemble, rule, out);
            find_unexplained(balance, *ensemble, forces, rule, out);
        }
    }
    out.verdict = out.unexplained ? Verdict::unexplained : out.named.empty() ? Verdict::none : Verdict::named;
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const JudgedCause& a, const JudgedCause& b) { return a.probability > b.probability; });
    return out;
}

std::vector<std::string> tests_in_words(const EnsembleDiagnosis& ensemble)
{
    std::vector<std::string> lines;
    if (const ForceTest& listed = ensemble.listed; listed.variant >= 0)
        lines.push_back(fmt::format("balance of forces: {}, p = {:.2g}",
                                    ensemble.scored.causes[static_cast<std::size_t>(listed.variant)].label(),
                                    listed.p_value));
    const ForceTest& forces = ensemble.forces;
    if (forces.variant >= 0)
        lines.push_back(fmt::format("forces of no known kind: {}, p = {:.2g}, {:.1f} nats",
                                    ensemble.scored.structures[static_cast<std::size_t>(forces.variant)].text,
                                    forces.p_value, nats_of_score(forces.score)));
    const EnsembleVerdict& statistics = ensemble.by_statistics;
    if (statistics.best >= 0)
        lines.push_back(fmt::format("statistics of the campaign: {}, p = {:.2g}, probability {:.2f}; law p = {:.2g}{}",
                                    ensemble.causes[static_cast<std::size_t>(statistics.best)].cause.label(),
                                    statistics.p_value, statistics.probability, ensemble.law_p_value,
                                    statistics.contrasts ? ", contrasts alone" : ""));
    return lines;
}

} // namespace stylobate
