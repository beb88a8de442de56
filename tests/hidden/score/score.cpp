#include "tests/hidden/score/score.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate::hidden {

namespace {

constexpr std::size_t largest_set = 3;

template <class Enum>
std::size_t at(Enum value)
{
    return static_cast<std::size_t>(value);
}

const AnswerEffect* effect_named(const Answer& answer, const std::string& name)
{
    for (const AnswerEffect& effect : answer.effects)
        if (effect.listed && effect.name == name)
            return &effect;
    return nullptr;
}

/// Names that must be found; those that are detectable.
std::vector<std::string> wanted_of(const Answer& answer)
{
    std::vector<std::string> wanted;
    for (const AnswerEffect& effect : answer.effects)
        if (effect.listed && effect.detectable)
            wanted.push_back(effect.name);
    return wanted;
}

bool any_detectable(const Answer& answer)
{
    return std::any_of(answer.effects.begin(), answer.effects.end(),
                       [](const AnswerEffect& effect) { return effect.detectable; });
}

std::string joined(const std::vector<std::string>& names)
{
    std::string all;
    for (const std::string& name : names)
        all += (all.empty() ? "" : " + ") + name;
    return all;
}

std::string hidden_label(const Answer& answer)
{
    if (answer.effects.empty())
        return "nothing";
    std::vector<std::string> names;
    for (const AnswerEffect& effect : answer.effects)
        names.push_back((effect.listed ? "" : "outside: ") + effect.name);
    std::sort(names.begin(), names.end());
    return joined(names) + (any_detectable(answer) ? "" : " (undetectable)");
}

std::string said_label(const DiagnosisSummary& said)
{
    return said.verdict == "named" ? said.causes.front().name : said.verdict;
}

} // namespace

const char* name_of(Judgement judgement)
{
    static const char* const names[judgements] = {"hit",       "in a set of 3 or fewer", "one of two", "wrong name",
                                                  "abstained", "nothing said",           "false alarm"};
    return names[at(judgement)];
}

const char* name_of(Group group)
{
    static const char* const names[groups] = {"nothing hidden", "one effect", "two effects", "outside the list",
                                              "undetectable"};
    return names[at(group)];
}

Group group_of(const Answer& answer)
{
    if (answer.effects.empty())
        return Group::nothing;
    if (!any_detectable(answer))
        return Group::undetectable;
    const std::size_t wanted = wanted_of(answer).size();
    return wanted == 0 ? Group::outside : wanted == 1 ? Group::single : Group::pair;
}

Judgement judge(const Answer& answer, const DiagnosisSummary& said)
{
    const Group group = group_of(answer);
    if (group == Group::nothing)
        return said.verdict == "none" ? Judgement::quiet : Judgement::false_alarm;
    if (group == Group::outside)
        return said.verdict == "unexplained" ? Judgement::hit
               : said.verdict == "none"      ? Judgement::abstained
                                             : Judgement::wrong_name;
    if (said.verdict != "named") {
        if (group == Group::undetectable)
            return Judgement::quiet;
        return Judgement::abstained;
    }
    const auto first = said.causes.front().name;
    const auto in_set = [&](const std::string& name) {
        const auto& set = said.indistinguishable;
        return set.size() <= largest_set && std::find(set.begin(), set.end(), name) != set.end();
    };
    if (group == Group::undetectable)
        return effect_named(answer, first) != nullptr ? Judgement::hit : Judgement::wrong_name;
    const std::vector<std::string> wanted = wanted_of(answer);
    if (group == Group::pair) {
        const auto said_first_two = [&](const std::string& name) {
            for (std::size_t k = 0; k < std::min<std::size_t>(2, said.causes.size()); ++k)
                if (said.causes[k].name == name)
                    return true;
            return false;
        };
        if (said_first_two(wanted[0]) && said_first_two(wanted[1]))
            return Judgement::hit;
        if (first == wanted[0] || first == wanted[1])
            return Judgement::one_of_two;
        return in_set(wanted[0]) || in_set(wanted[1]) ? Judgement::in_set : Judgement::wrong_name;
    }
    if (first == wanted.front())
        return Judgement::hit;
    if (in_set(wanted.front()))
        return Judgement::in_set;
    // the other of two, which lies below the thresholds: it is there all the same
    return effect_named(answer, first) != nullptr ? Judgement::one_of_two : Judgement::wrong_name;
}

Score score(const std::vector<Answer>& answers, const std::vector<std::optional<DiagnosisSummary>>& said)
{
    Score total;
    for (int i = 0; i < 5; ++i)
        total.reliability.push_back({0.2 * i, 0.2 * (i + 1), 0, 0, 0});
    for (const double limit : {0.5, 1.0, 2.0, 4.0, static_cast<double>(INFINITY)})
        total.by_strength.push_back({limit, {}});
    for (std::size_t k = 0; k < answers.size(); ++k) {
        const Answer& answer = answers[k];
        if (!said[k]) {
            total.missing.push_back(answer.seed);
            continue;
        }
        const DiagnosisSummary& diagnosis = *said[k];
        ++total.campaigns;
        total.seconds += diagnosis.seconds;
        const Group group = group_of(answer);
        const Judgement judgement = judge(answer, diagnosis);
        ++total.counts[at(group)][at(judgement)];
        ++total.confusion[hidden_label(answer)][said_label(diagnosis)];
        if (group == Group::nothing) {
            ++total.false_alarms.of;
            ++total.named_alarms.of;
            total.false_alarms.count += judgement == Judgement::false_alarm ? 1 : 0;
            total.named_alarms.count += diagnosis.verdict == "named" ? 1 : 0;
        } else if (group != Group::undetectable) {
            ++total.to_find;
            total.points += judgement == Judgement::hit                                            ? 1
                            : judgement == Judgement::in_set || judgement == Judgement::one_of_two ? 0.5
                                                                                                   : 0;
        }
        if (answer.effects.size() == 1) {
            const auto bin = std::find_if(total.by_strength.begin(), total.by_strength.end(), [&](const auto& one) {
                return answer.effects.front().snr_scatter < one.first;
            });
            if (bin != total.by_strength.end()) {
                ++bin->second.of;
                bin->second.count += judgement == Judgement::hit ? 1 : 0;
            }
        }
        if (diagnosis.verdict != "named")
            continue;
        for (const SaidCause& cause : diagnosis.causes) {
            const AnswerEffect* effect = effect_named(answer, cause.name);
            const int right = effect != nullptr ? 1 : 0;
            ++total.stated.of;
            total.stated.count += right;
            total.brier += (cause.probability - right) * (cause.probability - right);
            ReliabilityBin& bin = total.reliability[std::min<std::size_t>(
                static_cast<std::size_t>(cause.probability * 5), total.reliability.size() - 1)];
            ++bin.causes;
            bin.right += right;
            bin.mean_probability += cause.probability;
        }
        // place and size: of the causes that the verdict stands for
        const std::size_t meant = std::min(diagnosis.causes.size(), std::max<std::size_t>(answer.effects.size(), 1));
        for (std::size_t c = 0; c < meant; ++c) {
            const SaidCause& cause = diagnosis.causes[c];
            const AnswerEffect* effect = effect_named(answer, cause.name);
            if (effect == nullptr)
                continue;
            ++total.places.of;
            total.places.count += effect->place == cause.place ? 1 : 0;
            if (!effect->size_comparable || effect->place != cause.place || std::isnan(cause.low) ||
                std::isnan(cause.high))
                continue;
            if (effect->parameter != cause.parameter) {
                ++total.other_parameter;
                continue;
            }
            ++total.coverage.of;
            total.coverage.count += effect->size >= cause.low && effect->size <= cause.high ? 1 : 0;
        }
    }
    if (total.stated.of > 0)
        total.brier /= total.stated.of;
    for (ReliabilityBin& bin : total.reliability)
        if (bin.causes > 0)
            bin.mean_probability /= bin.causes;
    return total;
}

} // namespace stylobate::hidden
