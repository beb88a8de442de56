#include "studies/evidence/claims/verdict.hpp"

#include "io/files/suggest.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

namespace stylobate::claims {

namespace {

/// The axes by which cases may be told apart: those of the variants, then the ranges.
struct Places {
    std::vector<std::string> label;
    std::vector<std::vector<std::string>> level; ///< their names
};

Places places_of(const ClaimFile& file, const Test& test)
{
    Places places;
    for (const VariantAxis& axis : file.axes) {
        places.label.push_back(axis.label);
        places.level.emplace_back();
        for (const Level& level : axis.levels)
            places.level.back().push_back(level.name);
    }
    places.label.emplace_back("frequency");
    places.level.emplace_back();
    for (const Range& range : test.ranges)
        places.level.back().push_back(range.name);
    return places;
}

Levels place_of(const Case& one)
{
    Levels place = one.levels;
    place.push_back(one.range);
    return place;
}

using Split = std::map<Levels, Finding>;

/// The finding for each combination of levels of a set of axes; empty if one combination has both.
Split split_by(const std::vector<Case>& cases, unsigned axes)
{
    Split split;
    for (const Case& one : cases) {
        if (one.finding == Finding::undecided)
            continue;
        Levels key, place = place_of(one);
        for (std::size_t i = 0; i < place.size(); ++i)
            if (axes >> i & 1u)
                key.push_back(place[i]);
        const auto [at, fresh] = split.emplace(key, one.finding);
        if (!fresh && at->second != one.finding)
            return {};
    }
    return split;
}

/// "K_N 1e7, K_N 1e8", or "(K_N 1e7, start smooth)" where it takes several axes.
std::vector<std::string> names(const Places& places, const Split& split, unsigned axes, Finding finding)
{
    std::vector<std::string> all;
    for (const auto& [key, found] : split) {
        if (found != finding)
            continue;
        std::string one;
        std::size_t k = 0;
        for (std::size_t i = 0; i < places.label.size(); ++i)
            if (axes >> i & 1u)
                one += (one.empty() ? "" : ", ") + places.label[i] + ' ' + places.level[i][key[k++]];
        all.push_back(std::popcount(axes) > 1 ? '(' + one + ')' : one);
    }
    return all;
}

/// The margin at which axes are ranked and cases are told apart.
constexpr std::size_t ranked_at = 1;
/// More axes than this explain nothing.
constexpr int most_axes = 2;

std::string split_text(const ClaimFile& file, const Test& test, const std::vector<Case>& cases,
                       const MarginVerdict& counts)
{
    const Places places = places_of(file, test);
    const unsigned sets = 1u << places.label.size();
    unsigned best = 0;
    for (unsigned axes = 1; axes < sets; ++axes)
        if ((best == 0 || std::popcount(axes) < std::popcount(best)) && !split_by(cases, axes).empty())
            best = axes;
    if (best == 0 || std::popcount(best) > most_axes || counts.holds == 0 || counts.fails == 0)
        return fmt::format("holds in {} and fails in {}", counted(counts.holds, "case"), counts.fails);
    const Split split = split_by(cases, best);
    // the longer list says nothing that the shorter one leaves open
    constexpr std::size_t most_named = 4;
    const auto holding = names(places, split, best, Finding::holds),
               failing = names(places, split, best, Finding::fails);
    const auto listed = [&](const std::vector<std::string>& list, const std::vector<std::string>& other) {
        return list.size() > most_named && list.size() > other.size() ? "all other decided cases" : list_words(list);
    };
    return fmt::format("holds for {}; it fails for {}", listed(holding, failing), listed(failing, holding));
}

std::vector<Influence> influences(const ClaimFile& file, const Test& test, const std::vector<Case>& cases)
{
    const Places places = places_of(file, test);
    std::vector<Influence> all;
    for (const std::string& label : places.label)
        all.push_back({label});
    for (std::size_t a = 0; a < cases.size(); ++a)
        for (std::size_t b = a + 1; b < cases.size(); ++b) {
            if (cases[a].finding == Finding::undecided || cases[b].finding == Finding::undecided)
                continue;
            const Levels left = place_of(cases[a]), right = place_of(cases[b]);
            std::size_t differ = 0, axis = 0;
            for (std::size_t i = 0; i < left.size(); ++i)
                if (left[i] != right[i]) {
                    ++differ;
                    axis = i;
                }
            if (differ != 1)
                continue;
            ++all[axis].pairs;
            all[axis].flips += cases[a].finding != cases[b].finding;
        }
    std::erase_if(all, [](const Influence& one) { return one.flips == 0; });
    std::stable_sort(all.begin(), all.end(), [](const Influence& a, const Influence& b) {
        return a.flips * b.pairs > b.flips * a.pairs; // shares of the pairs
    });
    return all;
}

MarginVerdict at_margin(const std::vector<Case>& cases)
{
    using Outcome = MarginVerdict::Outcome;
    MarginVerdict v;
    for (const Case& one : cases) {
        v.holds += one.finding == Finding::holds;
        v.fails += one.finding == Finding::fails;
        v.undecided += one.finding == Finding::undecided;
    }
    v.outcome = cases.empty()                     ? Outcome::none
                : v.holds > 0 && v.fails > 0      ? Outcome::mixed
                : v.holds + v.fails < v.undecided ? Outcome::undecided
                : v.holds > 0                     ? Outcome::holds
                                                  : Outcome::fails;
    return v;
}

} // namespace

const char* to_string(Judgement judgement)
{
    switch (judgement) {
    case Judgement::confirmed:
        return "confirmed";
    case Judgement::refuted:
        return "refuted";
    case Judgement::depends:
        return "depends";
    case Judgement::untestable:
        return "untestable";
    case Judgement::not_run:
        break;
    }
    return "not run";
}

std::string counts_text(const MarginVerdict& v)
{
    std::string text;
    for (const auto& [name, count] :
         {std::pair{"holds", v.holds}, std::pair{"fails", v.fails}, std::pair{"undecided", v.undecided}})
        if (count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
    return text.empty() ? "no case" : text;
}

Verdict verdict_of(const ClaimFile& file, const Test& test, const std::array<std::vector<Case>, margins.size()>& cases)
{
    using Outcome = MarginVerdict::Outcome;
    Verdict verdict;
    for (std::size_t m = 0; m < margins.size(); ++m)
        verdict.at[m] = at_margin(cases[m]);
    const auto all = [&](Outcome outcome) {
        return std::all_of(verdict.at.begin(), verdict.at.end(),
                           [&](const MarginVerdict& v) { return v.outcome == outcome; });
    };
    if (all(Outcome::none)) {
        verdict.judgement = Judgement::not_run;
    } else if (test.untestable || (all(Outcome::holds) && test.impossible)) {
        verdict.judgement = Judgement::untestable;
    } else if (all(Outcome::holds) || all(Outcome::fails)) {
        verdict.judgement = all(Outcome::holds) ? Judgement::confirmed : Judgement::refuted;
    } else {
        verdict.judgement = Judgement::depends;
        verdict.tie = all(Outcome::undecided);
        verdict.by_margin = !verdict.tie && !all(Outcome::mixed);
        verdict.by = influences(file, test, cases[ranked_at]);
        verdict.split = split_text(file, test, cases[ranked_at], verdict.at[ranked_at]);
    }
    return verdict;
}

} // namespace stylobate::claims
