#include "studies/evidence/claims/verdict.hpp"

#include <fmt/format.h>

#include <bit>
#include <map>

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

void name_separation(const ClaimFile& file, const Test& test, const std::vector<Case>& cases, Verdict& verdict)
{
    const Places places = places_of(file, test);
    const unsigned sets = 1u << places.label.size();
    unsigned best = 0;
    for (unsigned axes = 1; axes < sets; ++axes)
        if ((best == 0 || std::popcount(axes) < std::popcount(best)) && !split_by(cases, axes).empty())
            best = axes;
    for (std::size_t i = 0; i < places.label.size(); ++i)
        if (best >> i & 1u)
            verdict.by.push_back(places.label[i]);
    const Split split = split_by(cases, best);
    // the longer list says nothing that the shorter one leaves open
    constexpr std::size_t most_named = 4;
    const auto holding = names(places, split, best, Finding::holds),
               failing = names(places, split, best, Finding::fails);
    const auto listed = [&](const std::vector<std::string>& list, const std::vector<std::string>& other) {
        return list.size() > most_named && list.size() > other.size() ? "all other decided cases" : series(list);
    };
    verdict.split = fmt::format("holds for {}; it fails for {}", listed(holding, failing), listed(failing, holding));
}

} // namespace

std::string series(const std::vector<std::string>& list)
{
    std::string text;
    for (std::size_t i = 0; i < list.size(); ++i)
        text += (i == 0 ? "" : i + 1 == list.size() ? " and " : ", ") + list[i];
    return text;
}

const char* to_string(Judgement judgement)
{
    switch (judgement) {
    case Judgement::confirmed:
        return "confirmed";
    case Judgement::refuted:
        return "refuted";
    case Judgement::depends:
        return "depends on";
    case Judgement::untestable:
        return "untestable";
    case Judgement::not_run:
        break;
    }
    return "not run";
}

Verdict verdict_of(const ClaimFile& file, const Test& test, const std::vector<Case>& cases)
{
    Verdict verdict;
    for (const Case& one : cases) {
        verdict.holds += one.finding == Finding::holds;
        verdict.fails += one.finding == Finding::fails;
        verdict.undecided += one.finding == Finding::undecided;
    }
    if (cases.empty()) {
        verdict.judgement = Judgement::not_run;
    } else if (!test.untestable.empty()) {
        verdict.judgement = Judgement::untestable;
    } else if (verdict.holds > 0 && verdict.fails > 0) {
        verdict.judgement = Judgement::depends;
        name_separation(file, test, cases, verdict);
    } else if (verdict.holds + verdict.fails < verdict.undecided || (verdict.holds > 0 && !test.impossible.empty())) {
        verdict.judgement = Judgement::untestable;
    } else {
        verdict.judgement = verdict.holds > 0 ? Judgement::confirmed : Judgement::refuted;
    }
    return verdict;
}

} // namespace stylobate::claims
