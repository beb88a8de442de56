#include "io/keys/mechanism_keys.hpp"

#include "io/keys/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

constexpr std::uint64_t most_places = 199; ///< joints or blocks of a structure, counted from 0

std::vector<std::string> models_of(MechanismModels models)
{
    return models == MechanismModels::planar    ? in_plane()
           : models == MechanismModels::spatial ? in_space()
                                                : KeyFacts().models;
}

/// How a parameter is described where it may be absent, and a value to begin with.
KeyFacts facts_of(const MechanismRule& rule, const MechanismParameter& parameter)
{
    if (parameter.models != MechanismModels::both)
        return {.models = models_of(parameter.models)};
    if (parameter.role == ParameterRole::needed)
        return {};
    if (rule.mechanism == Mechanism::stribeck) // neutral: as much as the friction of [contact]
        return {.absent = "contact.friction: no effect"};
    return {};
}

/// Where a mechanism acts when no place is given.
std::string usual_words(const MechanismRule& rule)
{
    switch (rule.usual) {
    case UsualPlaces::tops:
        return "the uppermost drum of each column";
    case UsualPlaces::feet:
        return "the lowest joint of each column";
    case UsualPlaces::neighbours:
        return "every epistyle beside another one";
    case UsualPlaces::all:
        break;
    }
    return rule.place == MechanismPlace::joint ? "every joint" : "every block";
}

} // namespace

Range range_of(const MechanismParameter& parameter)
{
    const std::string unit = parameter.unit;
    std::string hint = parameter.says;
    if (!unit.empty())
        hint = fmt::format("In {}: {}", unit, hint);
    else if (hint[0] >= 'a' && hint[0] <= 'z')
        hint[0] = static_cast<char>(hint[0] - 'a' + 'A');
    return {parameter.low, parameter.high, parameter.open, hint + "."};
}

MechanismKey::MechanismKey(const MechanismRule& rule)
    : TableKey(rule.name, rule.says, {}, {.absent = "no effect", .models = models_of(rule.models)},
               rule.place == MechanismPlace::base ? KeyType::table : KeyType::table_or_list)
{
    if (rule.place != MechanismPlace::base) {
        const std::string one = rule.place == MechanismPlace::joint ? "joint" : "block";
        place.emplace(one, WholeKey::Limits{0, most_places}, "the " + one + " at which it acts, counted from 0",
                      KeyFacts{.absent = usual_words(rule)});
        places.emplace(one + "s", KeyType::wholes, Range{0, static_cast<double>(most_places)},
                       "several of them, instead", KeyFacts{.absent = usual_words(rule), .excludes = {one}});
        keys = {&*place, &*places};
    }
    parameters.reserve(rule.parameters.size());
    for (const MechanismParameter& p : rule.parameters)
        if (p.role == ParameterRole::needed)
            parameters.emplace_back(p.key(), range_of(p), p.says, facts_of(rule, p));
        else
            parameters.emplace_back(p.key(), p.neutral, range_of(p), p.says, facts_of(rule, p));
    for (const NumberKey& parameter : parameters)
        keys.push_back(&parameter);
    if (rule.mechanism == Mechanism::vertical_motion)
        keys.insert(keys.end(),
                    {&vertical_keys::file, &vertical_keys::component, &vertical_keys::unit, &vertical_keys::baseline});
}

const MechanismKey& mechanism_key(Mechanism mechanism)
{
    static const std::vector<std::unique_ptr<MechanismKey>> all = [] {
        std::vector<std::unique_ptr<MechanismKey>> made;
        for (const MechanismRule& rule : mechanism_rules())
            made.push_back(std::make_unique<MechanismKey>(rule));
        return made;
    }();
    return *all[static_cast<std::size_t>(mechanism)];
}

const TableKey& mechanisms_table()
{
    static const TableKey table = [] {
        std::vector<const TomlKey*> keys;
        for (const MechanismRule& rule : mechanism_rules())
            keys.push_back(&mechanism_key(rule.mechanism));
        return TableKey("mechanisms", "extensions of the baseline model", std::move(keys), {.absent = "the baseline"});
    }();
    return table;
}

} // namespace stylobate
