#include "studies/decisions/compare/study_difference.hpp"

#include "io/files/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace stylobate {

namespace {

/// A value in full, so that two are equal if their texts are.
std::string value_in_full(const TomlValue& value)
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
            list += (list.empty() ? "" : ", ") + value_in_full(entry);
        return "[" + list + "]";
    }
    case TomlValue::Type::table: {
        std::string list;
        for (const TomlValue& entry : value.entries)
            list += (list.empty() ? "" : ", ") + entry.key + " = " + value_in_full(entry);
        return "{ " + list + " }";
    }
    case TomlValue::Type::string:
    case TomlValue::Type::date:
        break;
    }
    return toml_quoted(value.text);
}

void flatten_value(const TomlValue& value, const std::string& key, StudyKeys& keys)
{
    const bool tables =
        value.type == TomlValue::Type::array && !value.entries.empty() &&
        std::ranges::all_of(value.entries, [](const TomlValue& entry) { return entry.type == TomlValue::Type::table; });
    if (value.type == TomlValue::Type::table)
        for (const TomlValue& entry : value.entries)
            flatten_value(entry, key.empty() ? entry.key : key + "." + entry.key, keys);
    else if (tables)
        for (std::size_t i = 0; i < value.entries.size(); ++i)
            flatten_value(value.entries[i], fmt::format("{}[{}]", key, i), keys);
    else
        keys[key] = value_in_full(value);
}

/// "drums[2]" before "drums[10]".
bool comes_first(const std::string& a, const std::string& b)
{
    const auto digit = [](const std::string& text, std::size_t at) {
        return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
    };
    const auto digits = [&](const std::string& text, std::size_t at) {
        std::size_t end = at;
        while (digit(text, end))
            ++end;
        return end - at;
    };
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
        if (a[i] == b[i])
            continue;
        if ((digit(a, i) || digit(b, i)) && digits(a, i) != digits(b, i) && i > 0 &&
            (digit(a, i - 1) || a[i - 1] == '['))
            return digits(a, i) < digits(b, i);
        return a[i] < b[i];
    }
    return a.size() < b.size();
}

} // namespace

StudyKeys study_keys(const std::string& toml, const std::string& name)
{
    StudyKeys keys;
    flatten_value(parse_toml(toml, name), "", keys);
    return keys;
}

std::vector<DifferentKey> different_keys(const std::vector<std::string>& studies)
{
    std::vector<StudyKeys> each;
    StudyKeys all;
    for (const std::string& study : studies) {
        each.push_back(study_keys(study, "study"));
        all.insert(each.back().begin(), each.back().end());
    }
    std::vector<DifferentKey> different;
    for (const auto& [key, value] : all) {
        DifferentKey row{key, {}};
        for (const StudyKeys& keys : each) {
            const auto found = keys.find(key);
            row.values.push_back(found == keys.end() ? std::nullopt : std::optional(found->second));
        }
        const bool same = std::ranges::all_of(row.values, [&](const auto& one) { return one == row.values.front(); });
        if (!same && key != "study.title")
            different.push_back(std::move(row));
    }
    std::ranges::stable_sort(different, comes_first, &DifferentKey::key);
    return different;
}

} // namespace stylobate
