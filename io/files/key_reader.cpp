#include "io/files/key_reader.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace stylobate {

namespace {

/// A key for a message: as it stands if it is a bare one.
std::string shown_key(const std::string& key)
{
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    constexpr std::size_t longest = 60;
    if (bare && key.size() <= longest)
        return key;
    TomlValue quoted;
    quoted.type = TomlValue::Type::string;
    quoted.text = key;
    return quoted.shown();
}

/// 1e6 is a float in TOML; below 2^53 it stands for one whole number only.
constexpr double exact = 9007199254740992.0;

std::optional<std::uint64_t> whole_number(const TomlValue& value)
{
    if (value.type == TomlValue::Type::integer && value.integer >= 0)
        return static_cast<std::uint64_t>(value.integer);
    if (value.type == TomlValue::Type::number && value.number >= 0 && value.number < exact &&
        value.number == std::floor(value.number))
        return static_cast<std::uint64_t>(value.number);
    return std::nullopt;
}

/// A setting as in a study file.
std::string given_as(const std::string& key, const std::string& word)
{
    if (word == key_given)
        return "a study with " + key;
    return key + " = " + (key == model_key ? word : toml_quoted(word));
}

std::string with_todo(const std::string& what, std::string todo)
{
    while (!todo.empty() && todo.back() == ' ')
        todo.pop_back(); // where a key has no hint
    return todo.empty() ? what : what + "\n  " + todo;
}

} // namespace

KeyReader::KeyReader(const TomlValue* table, std::string path, const TomlPlace& above)
    : table_(table), path_(std::move(path)), place_(table ? table->place : above)
{
    if (table_ && table_->type != TomlValue::Type::table)
        throw InputError(
            place_.source, place_.line,
            with_todo(fmt::format("{} = {} is {}, not a table.", path_, table_->shown(), table_->type_name()),
                      "Tables are [sections] or { key = value, ... }."));
}

std::string KeyReader::full(std::string_view key) const
{
    const auto shown = shown_key(std::string(key));
    return path_.empty() ? shown : path_ + "." + shown;
}

void KeyReader::allow_only(const std::vector<std::string>& known) const
{
    if (!table_)
        return;
    const TomlValue* first = nullptr;
    for (const auto& entry : table_->entries) {
        const bool is_known = std::find(known.begin(), known.end(), entry.key) != known.end();
        if (!is_known && (!first || entry.place.line < first->place.line))
            first = &entry;
    }
    if (!first)
        return;

    const auto meant = meant_key(first->key, known);
    std::string todo;
    if (!meant)
        todo = fmt::format("Known {}: {}.", path_.empty() ? "sections" : "keys of " + path_, fmt::join(known, ", "));
    else if (without_unit(*meant) != *meant && std::string_view(first->key).starts_with(without_unit(*meant)))
        todo = fmt::format("Did you mean {}? The unit is part of the key.{}", *meant,
                           first->key.size() > without_unit(*meant).size() ? " Convert the value to it." : "");
    else
        todo = fmt::format("Did you mean {}?", *meant);
    throw InputError(
        first->place.source, first->place.line,
        with_todo(fmt::format("unknown {} {}.", path_.empty() ? "section" : "key", full(first->key)), todo));
}

void KeyReader::refuse_unused(const std::vector<std::string>& used, const std::string& why) const
{
    if (!table_)
        return;
    const TomlValue* first = nullptr;
    for (const auto& entry : table_->entries) {
        const bool is_used = std::find(used.begin(), used.end(), entry.key) != used.end();
        if (!is_used && (!first || entry.place.line < first->place.line))
            first = &entry;
    }
    if (first)
        refuse(first->key, "is not used by " + why,
               fmt::format("Remove it. Keys that are used: {}.", fmt::join(used, ", ")));
}

void KeyReader::refuse_unused(const TableKey& table, const std::string& kind, const std::string& word) const
{
    refuse_unused(table.names_where(kind, word), given_as(kind, word));
}

void KeyReader::refuse_unused(const TableKey& table, const std::string& kind, const std::string& word,
                              const std::string& todo) const
{
    for (const TomlKey* key : table.keys)
        if (!key->used_where(kind, word) && has(*key))
            refuse(key->name, "is not used by " + given_as(kind, word), todo);
}

KeyReader KeyReader::table(std::string_view key) const
{
    return KeyReader(find(key), full(key), place_);
}

void KeyReader::check_keys(const TableKey& table) const
{
    allow_only(table.names());
    for (const TomlKey* key : table.keys)
        for (const std::string& other : key->excludes)
            if (has(*key) && has(other))
                refuse(key->name, "and " + other + " exclude each other", "Give one of the two.");
}

KeyReader KeyReader::table(const TableKey& key) const
{
    KeyReader keys = table(key.name);
    keys.check_keys(key);
    return keys;
}

std::vector<KeyReader> KeyReader::tables(const TableKey& key) const
{
    std::vector<KeyReader> all = tables(key.name);
    for (const KeyReader& keys : all)
        keys.check_keys(key);
    return all;
}

std::vector<KeyReader> KeyReader::tables(std::string_view key) const
{
    std::vector<KeyReader> all;
    const TomlValue* list = find(key);
    if (!list)
        return all;
    if (list->type != TomlValue::Type::array)
        refuse(key, fmt::format("is {}, not an array", list->type_name()),
               "Give a list of tables: [ { ... }, { ... } ].");
    for (const TomlValue& entry : list->entries)
        all.emplace_back(&entry, fmt::format("{}[{}]", full(key), entry.key), place_);
    return all;
}

const TomlValue& KeyReader::need(std::string_view key, const std::string& todo) const
{
    const auto* value = find(key);
    if (!value)
        missing(key, todo);
    return *value;
}

double KeyReader::check(std::string_view key, const TomlValue& value, const Range& range) const
{
    if (value.type != TomlValue::Type::number && value.type != TomlValue::Type::integer)
        refuse(key, fmt::format("is {}, not a number", value.type_name()),
               fmt::format("Give a number in {}. {}", range.text(), range.hint));
    if (!range.contains(value.number)) {
        const auto meant = range.meant(value.number);
        refuse(key, "is outside " + range.text_for(value.number), range.hint + (meant ? " " + *meant : ""));
    }
    return value.number + 0.0; // -0 becomes 0, so that equal studies have equal texts
}

double KeyReader::number(std::string_view key, const Range& range) const
{
    return check(key, need(key, fmt::format("Give a number in {}. {}", range.text(), range.hint)), range);
}

double KeyReader::number_or(std::string_view key, const Range& range, double absent) const
{
    return has(key) ? number(key, range) : absent;
}

std::optional<double> KeyReader::maybe_number(std::string_view key, const Range& range) const
{
    return has(key) ? std::optional<double>(number(key, range)) : std::nullopt;
}

const TomlValue& KeyReader::need_list(std::string_view key, const std::string& todo) const
{
    const TomlValue& value = need(key, todo);
    if (value.type != TomlValue::Type::array)
        refuse(key, fmt::format("is {}, not a list", value.type_name()), todo);
    if (value.entries.empty())
        refuse(key, "is empty", todo);
    return value;
}

std::vector<double> KeyReader::check_list(std::string_view key, const Range& range, const std::string& todo) const
{
    std::vector<double> numbers;
    for (const TomlValue& entry : need(key, todo).entries) {
        if (entry.type != TomlValue::Type::number && entry.type != TomlValue::Type::integer)
            refuse(key, fmt::format("contains {}, which is {}, not a number", entry.shown(), entry.type_name()), todo);
        if (!range.contains(entry.number))
            refuse(key, fmt::format("contains {}, which is outside {}", entry.shown(), range.text_for(entry.number)),
                   todo);
        numbers.push_back(entry.number + 0.0);
    }
    return numbers;
}

std::vector<double> KeyReader::number_list(std::string_view key, const Range& range) const
{
    const auto todo = fmt::format("Give numbers in {}: {} = [NUMBER, ...]. {}", range.text(), key, range.hint);
    need_list(key, todo);
    return check_list(key, range, todo);
}

std::optional<std::array<double, 2>> KeyReader::maybe_interval(std::string_view key, const Range& range) const
{
    if (!has(key))
        return std::nullopt;
    const auto& value = *find(key);
    const auto todo = fmt::format("Give two numbers in {}, the smaller one first: {} = [LOW, HIGH]. {}", range.text(),
                                  key, range.hint);
    if (value.type != TomlValue::Type::array || value.entries.size() != 2)
        refuse(key, "is not two numbers in brackets", todo);
    const std::vector<double> ends = check_list(key, range, todo);
    if (!(ends[0] < ends[1]))
        refuse(key, fmt::format("has {} before {}", value.entries[0].shown(), value.entries[1].shown()), todo);
    return std::array{ends[0], ends[1]};
}

std::uint64_t KeyReader::whole(std::string_view key, std::uint64_t low, std::uint64_t high,
                               const std::string& hint) const
{
    const auto range = fmt::format("[{}, {}]", low, high);
    const auto& value = need(key, fmt::format("Give a whole number in {}. {}", range, hint));
    if (const std::optional<std::uint64_t> number = whole_number(value); number && *number >= low && *number <= high)
        return *number;
    const bool numeric = value.type == TomlValue::Type::number || value.type == TomlValue::Type::integer;
    if (!numeric || (std::isfinite(value.number) && value.number != std::floor(value.number)))
        refuse(key, fmt::format("is {}, not a whole number", value.type_name()),
               fmt::format("Give a whole number in {}. {}", range, hint));
    if (value.type == TomlValue::Type::number && value.number >= exact && value.number < static_cast<double>(high))
        refuse(key, "is a floating-point number above 2^53, which does not stand for one whole number",
               fmt::format("Write all digits, without point and exponent: a whole number in {}. {}", range, hint));
    refuse(key, "is outside " + range, hint);
}

std::vector<std::uint64_t> KeyReader::whole_list_or_none(std::string_view key, std::uint64_t low, std::uint64_t high,
                                                         const std::string& hint) const
{
    std::vector<std::uint64_t> all;
    if (!has(key))
        return all;
    const std::string todo =
        fmt::format("Give whole numbers in [{}, {}]: {} = [NUMBER, ...]. {}", low, high, key, hint);
    for (const TomlValue& entry : need_list(key, todo).entries) {
        const std::optional<std::uint64_t> value = whole_number(entry);
        if (!value || *value < low || *value > high)
            refuse(key, fmt::format("contains {}, which is not a whole number in [{}, {}]", entry.shown(), low, high),
                   hint);
        all.push_back(*value);
    }
    return all;
}

bool KeyReader::boolean_or(std::string_view key, bool absent) const
{
    const auto* value = find(key);
    if (!value)
        return absent;
    if (value->type != TomlValue::Type::boolean)
        refuse(key, fmt::format("is {}, not true or false", value->type_name()), "Give true or false, without quotes.");
    return value->boolean;
}

std::string KeyReader::text(std::string_view key) const
{
    const auto& value = need(key, "Give a string in double quotes.");
    const bool typed = value.place.command_line && !value.text.empty();
    if (value.type != TomlValue::Type::string && !typed)
        refuse(key, fmt::format("is {}, not a string", value.type_name()), "Give a string in double quotes.");
    if (value.text.empty())
        refuse(key, "is empty", "Give a string, or omit the key.");
    constexpr std::size_t longest = 2048;
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (value.text.size() > longest || std::any_of(value.text.begin(), value.text.end(), is_control))
        refuse(key, fmt::format("is longer than {} characters or contains control characters", longest),
               "In a path write / for a backslash, or use single quotes: 'C:\\folder\\file'.");
    return value.text;
}

std::size_t KeyReader::word_index(std::string_view key, const std::vector<std::string>& words) const
{
    std::string allowed = "Allowed:";
    for (const auto& word : words)
        allowed += (&word == words.data() ? " " : ", ") + toml_quoted(word);
    allowed += ".";

    const auto& value = need(key, allowed);
    if (value.type != TomlValue::Type::string)
        refuse(key, fmt::format("is {}, not a string", value.type_name()), allowed);
    const auto at = std::find(words.begin(), words.end(), value.text);
    if (at == words.end()) {
        const auto meant = nearest_word(value.text, words);
        refuse(key, "is not allowed", allowed + (meant ? " Did you mean " + toml_quoted(*meant) + "?" : ""));
    }
    return static_cast<std::size_t>(at - words.begin());
}

void KeyReader::refuse(std::string_view key, const std::string& what, const std::string& todo) const
{
    const TomlValue* given = find(key);
    if (!given)
        refuse_all(with_todo(fmt::format("{} {}.", full(key), what), todo));
    const TomlValue& value = *given;
    throw InputError(value.place.source, value.place.line,
                     with_todo(fmt::format("{} = {} {}.", full(key), value.shown(), what), todo));
}

void KeyReader::refuse_all(const std::string& text) const
{
    throw InputError(place_.source, place_.line, text);
}

void KeyReader::missing(std::string_view key, const std::string& todo) const
{
    throw InputError(place_.source, place_.line, with_todo(fmt::format("{} is missing.", full(key)), todo));
}

} // namespace stylobate
