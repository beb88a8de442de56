#include "studies/reference/key_words.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace {

/// "a", "b" or "c"
std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + toml_quoted(words[i]);
    return text;
}

/// Of whole numbers, digit by digit.
std::string whole_range(const Range& range)
{
    constexpr double largest = 9e18; // the largest of a signed integer is no double
    return fmt::format("[{:.0f}, {}]", range.low,
                       range.high > largest ? "2^63 - 1" : fmt::format("{:.0f}", range.high));
}

} // namespace

std::string type_words(const TomlKey& key)
{
    const std::string unit = key.unit();
    const std::string in_unit = unit.empty() ? "" : ", " + unit;
    const std::string or_word = key.words.empty() ? "" : "; or " + listed(key.words);
    switch (key.type) {
    case KeyType::number:
        return "number in " + key.range.text() + in_unit + or_word;
    case KeyType::whole:
        return "whole number in " + whole_range(key.range) + or_word;
    case KeyType::boolean:
        return "true or false";
    case KeyType::word:
        return listed(key.words);
    case KeyType::text:
        return "string";
    case KeyType::numbers:
        return "list of numbers in " + key.range.text() + in_unit;
    case KeyType::interval:
        return "[low, high] in " + key.range.text() + in_unit;
    case KeyType::wholes:
        return "list of whole numbers in " + whole_range(key.range);
    case KeyType::texts:
        return "list of strings";
    case KeyType::table:
        return "table" + in_unit;
    case KeyType::tables:
        return "list of tables";
    case KeyType::table_or_list:
        return "table, or list of tables";
    case KeyType::named:
        return "table under a name of your choice";
    }
    return {};
}

std::string use_words(const TomlKey& key)
{
    std::string text;
    for (const Condition& condition : key.used)
        text += (text.empty() ? "" : ", and ") + condition.key + " = " + listed(condition.values);
    if (!key.models.empty())
        text += (text.empty() ? "" : ", and ") + std::string("model = ") + listed(key.models);
    return text;
}

} // namespace stylobate
