#include "io/study/study_variants.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/kind_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t longest_name = 60;

/// What a file's name may have, and what the files of a comparison are called.
bool is_name(const std::string& name)
{
    return !name.empty() && name.size() <= longest_name && name != "comparison" &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
                      c == '-';
           });
}

void lay(TomlValue& root, const std::string& above, const TomlValue& table, const std::string& why)
{
    for (const TomlValue& value : table.entries) {
        const std::string key = above.empty() ? value.key : above + "." + value.key;
        if (value.type == TomlValue::Type::table && value.key.find('.') == std::string::npos)
            lay(root, key, value, why);
        else
            apply_value(root, key, value, why);
    }
}

SearchedKey read_searched(const KeyReader& keys, const std::string& name)
{
    using namespace optimise_keys;
    keys.allow_only(any.names());
    SearchedKey key{name, keys.read(from), keys.read(to), keys.read(spacing)};
    if (!(key.from < key.to))
        keys.refuse(to.name, fmt::format("is not above from = {:g}", key.from), "Give from < to.");
    if (key.spacing == Spacing::log && !(key.from > 0))
        keys.refuse(from.name, "is not above 0, as spacing = \"log\" needs", "Give spacing = \"linear\".");
    if (const double ratio = key.to / key.from; key.spacing == Spacing::log && !(ratio > 1 && std::isfinite(ratio)))
        keys.refuse(to.name, fmt::format("is {:g} times from = {:g}", ratio, key.from),
                    "Give limits whose ratio is above 1 and finite.");
    return key;
}

} // namespace

double SearchedKey::value(double place) const
{
    if (place <= 0)
        return from;
    if (place >= 1)
        return to;
    return spacing == Spacing::log ? from * std::pow(to / from, place) : from + (to - from) * place;
}

double SearchedKey::place(double value) const
{
    return spacing == Spacing::log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
}

std::vector<std::string> variant_names(const KeyReader& top)
{
    const TomlValue* table = top.find(variants_keys::table.name);
    if (!table)
        return {};
    if (table->type != TomlValue::Type::table)
        top.refuse(table->key, "is not a table", "Give [variants] with a table for each variant.");
    const KeyReader keys = top.table(variants_keys::table.name);
    std::vector<std::string> names;
    for (const TomlValue& variant : table->entries) {
        if (!is_name(variant.key))
            keys.refuse(variant.key, "has a name that no results file can have",
                        fmt::format("Name it with at most {} letters, digits, _ and -; \"comparison\" is taken.",
                                    longest_name));
        if (variant.type != TomlValue::Type::table)
            keys.refuse(variant.key, "is not a table",
                        "Give " + variant.key + " = { \"KEY\" = VALUE }, such as { \"contact.friction\" = 0.4 }.");
        names.push_back(variant.key);
    }
    std::sort(names.begin(), names.end());
    return names;
}

void apply_variant(TomlValue& root, const std::string& name, const std::string& file)
{
    const TomlValue* table = root.find(variants_keys::table.name);
    const TomlValue* variant = table ? table->find(name) : nullptr;
    if (!variant) {
        std::vector<std::string> names;
        if (table)
            for (const TomlValue& each : table->entries)
                names.push_back(each.key);
        throw InputError(file, 0,
                         fmt::format("[variants] has no '{}'; it has {}.", name,
                                     names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "))));
    }
    const TomlValue overrides = *variant; // the tree that it lies in changes
    for (const char* own : {"variants", "optimise"})
        for (const TomlValue& value : overrides.entries)
            if (value.key == own || value.key.starts_with(std::string(own) + "."))
                throw InputError(value.place.source, value.place.line,
                                 fmt::format("variants.{}: {} is no key of a variant.\n  A variant changes the study.",
                                             name, value.key));
    lay(root, "", overrides, "variants." + name);
}

std::optional<OptimiseSpec> read_optimise(const KeyReader& top)
{
    const TomlValue* table = top.find(optimise_keys::table.name);
    if (!table)
        return std::nullopt;
    const KeyReader keys = top.table(optimise_keys::table.name);
    OptimiseSpec spec;
    spec.minimise = keys.read_or(optimise_keys::minimise, spec.minimise);
    spec.hazard = keys.read_or(optimise_keys::hazard, spec.hazard);
    spec.budget = keys.read(optimise_keys::budget);
    for (const TomlValue& value : table->entries)
        if (value.key != optimise_keys::minimise.name && value.key != optimise_keys::hazard.name &&
            value.key != optimise_keys::budget.name) {
            if (value.type != TomlValue::Type::table)
                keys.refuse(value.key, "is not a table",
                            "Give \"KEY\" = { from = ..., to = ... }; the other keys are minimise, hazard and budget.");
            if (std::ranges::any_of(value.entries, [](const auto& e) { return e.type == TomlValue::Type::table; }))
                keys.refuse(value.key, "contains tables",
                            "A key with dots stands in quotes: \"contact.friction\" = { from = ..., to = ... }.");
            spec.keys.push_back(read_searched(keys.table(value.key), value.key));
        }
    if (spec.keys.empty() || spec.keys.size() > most_searched_keys)
        top.refuse(table->key, fmt::format("has {} keys of the study to choose", spec.keys.size()),
                   "Give one to three, each as \"KEY\" = { from = ..., to = ... }.");
    std::sort(spec.keys.begin(), spec.keys.end(),
              [](const SearchedKey& a, const SearchedKey& b) { return a.key < b.key; });
    return spec;
}

} // namespace stylobate
