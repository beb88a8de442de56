#include "studies/decisions/compare/comparable.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/mechanism_spec.hpp"
#include "io/files/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace stylobate {

namespace {

/// A value in full, so that two are equal if their texts are.
std::string text_of(const TomlValue& value)
{
    switch (value.type) {
    case TomlValue::Type::boolean:
        return value.boolean ? "true" : "false";
    case TomlValue::Type::integer:
        return fmt::format("{}", value.integer);
    case TomlValue::Type::number:
        return fmt::format("{}", value.number);
    case TomlValue::Type::array: {
        std::string list;
        for (const TomlValue& entry : value.entries)
            list += (list.empty() ? "" : ", ") + text_of(entry);
        return "[" + list + "]";
    }
    case TomlValue::Type::table: {
        std::string list;
        for (const TomlValue& entry : value.entries)
            list += (list.empty() ? "" : ", ") + entry.key + " = " + text_of(entry);
        return "{ " + list + " }";
    }
    case TomlValue::Type::string:
    case TomlValue::Type::date:
        break;
    }
    return toml_quoted(value.text);
}

using Keys = std::map<std::string, std::string>;

void flatten(const TomlValue& table, const std::string& above, Keys& keys)
{
    for (const TomlValue& value : table.entries) {
        const std::string key = above.empty() ? value.key : above + "." + value.key;
        if (value.type == TomlValue::Type::table)
            flatten(value, key, keys);
        else
            keys[key] = text_of(value);
    }
}

Keys keys_of(const ResultHeader& header, const std::string& name)
{
    Keys keys;
    flatten(parse_toml(header.study_toml, name), "", keys);
    return keys;
}

/// Keys, or beginnings of keys (with a dot), that both studies need alike.
std::vector<std::string> fixed_keys()
{
    std::vector<std::string> fixed = {"study.kind",
                                      "study.seed",
                                      "study.realizations",
                                      "study.sampling",
                                      "structure.gravity_m_s2",
                                      "excitation.",
                                      "surface.",
                                      "fragility.",
                                      "outcome.",
                                      "perturbation.phase.",
                                      "perturbation.pulse_frequency.",
                                      "perturbation.pulse_gamma."};
    for (const MechanismRule& rule : mechanism_rules()) // what changes the shaking itself
        if (rule.place == MechanismPlace::base) {
            fixed.push_back(fmt::format("mechanisms.{}.", rule.name));
            fixed.push_back(fmt::format("perturbation.mechanisms.{}.", rule.name));
        }
    return fixed;
}

bool is_fixed(const std::string& key)
{
    static const std::vector<std::string> fixed = fixed_keys();
    return std::any_of(fixed.begin(), fixed.end(),
                       [&](const std::string& one) { return one.ends_with('.') ? key.starts_with(one) : key == one; });
}

/// The first key of a kind that is not alike, in the order of the names; empty: there is none.
template <class Wanted>
std::string first_difference(const Keys& base, const Keys& variant, const Wanted& wanted)
{
    Keys all = base;
    all.insert(variant.begin(), variant.end());
    for (const auto& [key, value] : all) {
        const auto a = base.find(key), b = variant.find(key);
        if (wanted(key) && (a == base.end() || b == variant.end() || a->second != b->second))
            return key;
    }
    return {};
}

std::string value_or_absent(const Keys& keys, const std::string& key)
{
    const auto found = keys.find(key);
    return found == keys.end() ? "is absent" : "= " + found->second;
}

/// The lines behind the study that identify its records.
std::vector<std::string> fingerprints(const ResultHeader& header)
{
    std::vector<std::string> lines;
    std::istringstream text(header.study_toml);
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("# "))
            lines.push_back(line.substr(2));
    return lines;
}

} // namespace

void check_can_be_compared(const ResultHeader& header, const std::string& name)
{
    if (header.kind != "surface" && header.kind != "fragility" && header.kind != "single")
        throw InputError(name, 0,
                         fmt::format("study.kind = \"{}\" has no realizations that a variant could repeat one by "
                                     "one.\n  Compare studies of kind surface, fragility or single.",
                                     header.kind));
    if (header.selected)
        throw InputError(name, 0,
                         "surface.adaptive chooses the realizations of each study by its own outcomes, which leaves "
                         "no pairs.\n  Remove it; compare --adaptive BUDGET chooses them for both together.");
    if (!header.has_rows())
        throw InputError(name, 0,
                         "keeps no row of each realization, so that none can be paired.\n  Give "
                         "output.realizations = \"all\", or omit it.");
}

void check_comparable(const ResultHeader& base, const std::string& base_name, const ResultHeader& variant,
                      const std::string& variant_name)
{
    const Keys a = keys_of(base, base_name), b = keys_of(variant, variant_name);
    std::string key;
    for (const char* first : {"study.kind", "study.seed", "study.realizations"}) // these name the cause best
        if (key.empty())
            key = first_difference(a, b, [&](const std::string& one) { return one == first; });
    if (key.empty())
        key = first_difference(a, b, is_fixed);
    if (!key.empty())
        throw InputError(fmt::format("{0}: {1} {2}, and {3} has {1} {4}.\n  Realizations are compared pair by pair, "
                                     "under the same draws and the same shaking: give both the same value.",
                                     variant_name, key, value_or_absent(b, key), base_name, value_or_absent(a, key)));
    const std::vector<std::string> records = fingerprints(base), others = fingerprints(variant);
    for (std::size_t i = 0; i < std::max(records.size(), others.size()); ++i)
        if (i >= records.size() || i >= others.size() || records[i] != others[i])
            throw InputError(fmt::format("{}: its motion is not that of {}: {}, and there {}.\n  Give both the same "
                                         "record.",
                                         variant_name, base_name, i < others.size() ? others[i] : "none",
                                         i < records.size() ? records[i] : "none"));
}

std::vector<std::string> differences_to_know(const ResultHeader& base, const ResultHeader& variant)
{
    if (base.study_toml == variant.study_toml)
        return {"It is the study of the base: the variant changes nothing."};
    std::vector<std::string> notes;
    const Keys a = keys_of(base, "base"), b = keys_of(variant, "variant");
    const auto numeric = [](const std::string& key) {
        return key.starts_with("run.") && key != "run.max_invalid_fraction";
    };
    if (const std::string key = first_difference(a, b, numeric); !key.empty())
        notes.push_back(fmt::format("The numerics differ ({} {} in the base, {} in the variant): a part of the "
                                    "difference may be theirs.",
                                    key, value_or_absent(a, key), value_or_absent(b, key)));
    if (base.block_names != variant.block_names)
        notes.push_back(fmt::format("The base has {} blocks, the variant {}: draws of blocks and joints are common "
                                    "where both have one of the same number.",
                                    base.block_names.size(), variant.block_names.size()));
    return notes;
}

} // namespace stylobate
