#include "studies/diagnosis/decision/decision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

// A direct test is as sure as its thresholds are far.
constexpr double direct_probability = 0.97;
// Two places of one mechanism that explain alike are one finding.
constexpr double most_surprise = 40;

JudgedCause judged_cause(const CauseFit& fit, Channel channel, const ChanceGains& chance, const DecisionRule& rule)
{
    JudgedCause j;
    j.fit = fit;
    j.channel = channel;
    const std::string& mechanism = fit.cause.mechanism;
    j.chance95 = chance.quantile95(channel, mechanism);
    j.chance = chance.probability(channel, mechanism, fit.gain);
    j.surprise = std::min(fit.gain - j.chance95, -std::log(std::max(j.chance, 1e-30)) - 3);
    const double left = fit.gain_without_best();
    if (!chance.tell_of(channel, mechanism))
        j.why_not = "the null distribution is unknown";
    else if (fit.gain - j.chance95 < rule.clear)
        j.why_not = fmt::format("gain {:.1f} nats; null distribution up to {:.1f} (95 %)", fit.gain, j.chance95);
    else if (j.chance > rule.chance)
        j.why_not = fmt::format("the p-value of the gain is {:.2g}", j.chance);
    else if (left < rule.without_best * fit.gain && left < j.chance95 + rule.clear)
        j.why_not =
            fmt::format("without the run with the largest contribution {:.1f} of {:.1f} nats remain", left, fit.gain);
    else if (!matters(fit))
        j.why_not = "its size is within the scatter between specimens";
    else
        j.considered = true;
    return j;
}

void sort_judged(std::vector<JudgedCause>& judged)
{
    std::stable_sort(judged.begin(), judged.end(), [](const JudgedCause& a, const JudgedCause& b) {
        return a.considered != b.considered ? a.considered : a.surprise > b.surprise;
    });
}

/// Odds among those considered and 'none of them'.
void set_probabilities(std::vector<JudgedCause>& judged, const DecisionRule& rule)
{
    double sum = std::exp(rule.sure);
    double first = 0;
    for (const JudgedCause& j : judged)
        if (j.considered)
            first = std::max(first, std::min(j.surprise, most_surprise));
    sum = std::exp(rule.sure - first);
    for (JudgedCause& j : judged)
        if (j.considered)
            sum += std::exp(std::min(j.surprise, most_surprise) - first);
    for (JudgedCause& j : judged)
        j.probability = j.considered ? 0.97 * std::exp(std::min(j.surprise, most_surprise) - first) / sum : 0;
}

/// A wedge or an offset seen at rest explains what it makes of the motion.
bool known_at_rest(const DirectResult& direct, const JudgedCause& j)
{
    return std::any_of(direct.found.begin(), direct.found.end(), [&](const CauseFit& fit) {
        const std::string& m = fit.cause.mechanism;
        return (m == "wedge" || m == "drum_offset") &&
               (j.fit.cause.mechanism == "eccentricity" || j.fit.cause.mechanism == "corner_loss");
    });
}

/// The most surprising one considered whose mechanism is not named yet; null: none.
const JudgedCause* next_named(const std::vector<JudgedCause>& list, const DirectResult& direct,
                              const std::vector<JudgedCause>& named)
{
    for (const JudgedCause& j : list) {
        if (!j.considered || known_at_rest(direct, j))
            continue;
        if (std::none_of(named.begin(), named.end(),
                         [&](const JudgedCause& other) { return other.fit.cause.mechanism == j.fit.cause.mechanism; }))
            return &j;
    }
    return nullptr;
}

/// Rules 3 and 4. @return what the named ones explain by the balance of forces [nats]
double name_causes(const DirectResult& direct, const std::vector<JudgedCause>& judged, const DecisionRule& rule,
                   const std::function<std::vector<JudgedCause>(const JudgedCause&)>& again, Decided& out)
{
    const JudgedCause* first = next_named(judged, direct, out.named);
    if (first == nullptr)
        return 0;
    for (const JudgedCause& j : judged)
        if (j.considered && j.fit.cause.mechanism != first->fit.cause.mechanism &&
            j.surprise > first->surprise - rule.apart && !known_at_rest(direct, j))
            out.in_set.push_back(j);
    double together = first->probability;
    for (const JudgedCause& j : out.in_set)
        together += j.probability;
    if (together < least_probability) {
        out.in_set.clear();
        return 0; // possible, and no more
    }
    out.named.push_back(*first);
    double explained = first->channel == Channel::balance ? first->fit.gain : 0;
    const std::vector<JudgedCause> rest = again(*first);
    if (const JudgedCause* second = next_named(rest, direct, out.named)) {
        // what is in the first one's set already is no second cause unless it stands by itself
        out.named.push_back(*second);
        explained += second->channel == Channel::balance ? second->fit.gain : 0;
        std::erase_if(out.in_set,
                      [&](const JudgedCause& j) { return j.fit.cause.mechanism == second->fit.cause.mechanism; });
    }
    return explained;
}

/// Rule 5: forces of no known kind.
/// @param explained by what is named [nats]
void find_unexplained(const BalanceEvidence& balance, const ChanceGains& chance, const DecisionRule& rule,
                      double explained, Decided& out)
{
    if (balance.structures.empty())
        return;
    const double chance95 = chance.quantile95_of_structures();
    const StructureFit& best = balance.structures.front();
    const double left =
        best.gain_by_run.empty() ? 0 : best.gain - *std::max_element(best.gain_by_run.begin(), best.gain_by_run.end());
    const bool clear = best.gain > chance95 + rule.structure_clear && best.gain_by_run.size() > 1 &&
                       (left > rule.without_best * best.gain || left > chance95 + rule.clear);
    double listed = explained;
    for (const CauseFit& fit : balance.causes)
        listed = std::max(listed, fit.gain);
    if (clear && best.gain > listed + rule.structure_better) {
        out.unexplained = best;
        out.unexplained_chance = chance.probability_of_structure(best.gain);
        std::erase_if(out.named, [](const JudgedCause& j) { return j.channel != Channel::direct; });
        out.in_set.clear();
    }
}

} // namespace

std::vector<JudgedCause> named_directly(const DirectResult& direct)
{
    std::vector<JudgedCause> named;
    for (const CauseFit& fit : direct.found) {
        JudgedCause j;
        j.fit = fit;
        j.channel = Channel::direct;
        j.considered = true;
        j.surprise = fit.gain;
        j.chance = 0;
        j.probability = direct_probability;
        named.push_back(std::move(j));
    }
    return named;
}

std::vector<JudgedCause> judge(const BalanceEvidence& balance, const std::vector<CauseFit>& windows,
                               const std::vector<std::vector<double>>& windows_by_form, const ChanceGains& chance,
                               const DecisionRule& rule)
{
    std::vector<JudgedCause> judged;
    for (const CauseFit& fit : balance.causes)
        judged.push_back(judged_cause(fit, Channel::balance, chance, rule));
    for (std::size_t i = 0; i < windows.size(); ++i) {
        JudgedCause j = judged_cause(windows[i], Channel::windows, chance, rule);
        if (i < windows_by_form.size())
            j.gain_by_form = windows_by_form[i];
        judged.push_back(std::move(j));
    }
    // what both ways see at one place is one finding: the more surprising view of it
    sort_judged(judged);
    std::vector<JudgedCause> kept;
    for (JudgedCause& j : judged)
        if (std::none_of(kept.begin(), kept.end(), [&](const JudgedCause& other) {
                return other.fit.cause.mechanism == j.fit.cause.mechanism && other.fit.cause.place == j.fit.cause.place;
            }))
            kept.push_back(std::move(j));
    set_probabilities(kept, rule);
    return kept;
}

Decided decide(const DirectResult& direct, const BalanceEvidence& balance, std::vector<JudgedCause> judged,
               const ChanceGains& chance, const DecisionRule& rule,
               const std::function<std::vector<JudgedCause>(const JudgedCause&)>& again)
{
    Decided out;
    out.named = named_directly(direct);
    const double explained = name_causes(direct, judged, rule, again, out);
    out.judged = std::move(judged);
    for (JudgedCause& j : out.judged)
        if (j.considered && j.probability < least_probability &&
            std::none_of(out.named.begin(), out.named.end(),
                         [](const JudgedCause& named) { return named.channel != Channel::direct; })) {
            j.considered = false;
            j.why_not = fmt::format("possible, with a probability of {:.2f}", j.probability);
        }
    out.structure95 = chance.quantile95_of_structures();
    find_unexplained(balance, chance, rule, explained, out);
    out.verdict = out.unexplained ? Verdict::unexplained : out.named.empty() ? Verdict::none : Verdict::named;
    // Most probable first. The second cause of the joints was judged with the first one given, among fewer rivals: it
    // is no surer than that.
    const auto of_joints = std::find_if(out.named.begin(), out.named.end(),
                                        [](const JudgedCause& j) { return j.channel != Channel::direct; });
    for (auto j = of_joints; j != out.named.end(); ++j)
        j->probability = std::min(j->probability, of_joints->probability);
    std::stable_sort(out.named.begin(), out.named.end(),
                     [](const JudgedCause& a, const JudgedCause& b) { return a.probability > b.probability; });
    return out;
}

} // namespace stylobate
