#include "io/files/toml_document.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

// toml++ 3.3 breaks its own assertions on some malformed texts; without them it runs into undefined behaviour. Here
// they hold in every build and throw. No other file includes toml++.
namespace stylobate::detail {
struct BrokenAssertion {};
[[noreturn]] static void broken_assertion()
{
    throw BrokenAssertion{};
}
} // namespace stylobate::detail
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : stylobate::detail::broken_assertion())
#include <toml++/toml.h>

namespace stylobate {

namespace {

/// The parser's message on a text that is not TOML.
struct NotToml {
    std::string why;
    long line = 0;          ///< from 1; 0: not known
    std::size_t column = 0; ///< from 1: behind what was read last
};

/// Longer lines are refused: no study has them, and dotted keys without end would nest as deep as the stack.
constexpr std::size_t longest_line = 8192;
constexpr std::size_t longest_setting = 4096;
constexpr std::size_t deepest_setting = 8;

bool is_control(char c)
{
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// @throws NotToml, and nothing else of the parser's
toml::table parse(std::string_view text)
{
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        NotToml out{std::string(error.description()), static_cast<long>(at.line), at.column};
        std::replace_if(out.why.begin(), out.why.end(), is_control, ' ');
        throw out;
    } catch (const detail::BrokenAssertion&) {
        throw NotToml{"the parser cannot read it", 0, 0};
    }
}

/// Writes a number beyond 64 bits or the largest double, which TOML allows and its parser refuses, so that it takes it.
/// @returns whether the literal behind which the parser stopped is one
bool rewrite_number(std::string& text, const NotToml& error)
{
    std::size_t begin_of_line = 0;
    for (long line = 1; line < error.line; ++line)
        begin_of_line = text.find('\n', begin_of_line) + 1;
    const std::size_t end = begin_of_line + error.column - 1;
    if (error.line == 0 || error.column < 2 || end > text.size())
        return false;
    const std::size_t begin = text.find_last_not_of("0123456789abcdefABCDEFx_.+-", end - 1) + 1;
    std::string literal = text.substr(begin, end - begin);
    std::erase(literal, '_');
    char* stop = nullptr;
    const double value = std::strtod(literal.c_str(), &stop);
    constexpr double most = 9223372036854775808.0; // 2^63
    if (literal.empty() || *stop != '\0' || std::fabs(value) < most)
        return false;
    text.replace(begin, end - begin, std::isfinite(value) ? toml_number(value) : value < 0 ? "-inf" : "inf");
    return true;
}

/// Every number is read, those beyond the parser's too: the ranges of their keys refuse them.
/// @throws NotToml
toml::table parse_numbers(std::string text)
{
    constexpr int most = 16; // numbers beyond the parser's
    for (int numbers = 0;; ++numbers)
        try {
            return parse(text);
        } catch (const NotToml& error) {
            if (numbers == most || !rewrite_number(text, error))
                throw;
        }
}

/// No study nests so deep: what is there is refused as an unknown key above it, and must not use up the stack.
constexpr int deepest = 64;

TomlValue convert(const toml::node& node, std::string key, const TomlPlace& place, int depth = 0)
{
    using Type = TomlValue::Type;
    TomlValue out;
    out.key = std::move(key);
    out.place = place;
    if (const auto* table = node.as_table()) {
        out.type = Type::table;
        for (const auto& [name, value] : *table) {
            if (depth == deepest)
                break;
            TomlPlace own = place;
            if (!place.command_line)
                own.line = static_cast<long>(name.source().begin.line);
            out.entries.push_back(convert(value, std::string(name.str()), own, depth + 1));
        }
    } else if (const auto* boolean = node.as_boolean()) {
        out.type = Type::boolean;
        out.boolean = boolean->get();
    } else if (const auto* integer = node.as_integer()) {
        out.type = Type::integer;
        out.integer = integer->get();
        out.number = static_cast<double>(out.integer);
    } else if (const auto* number = node.as_floating_point()) {
        out.type = Type::number;
        out.number = number->get();
    } else if (const auto* string = node.as_string()) {
        out.type = Type::string;
        out.text = string->get();
    } else if (const auto* array = node.as_array()) {
        out.type = Type::array;
        for (const auto& entry : *array) {
            if (depth == deepest)
                break;
            TomlPlace own = place;
            if (!place.command_line)
                own.line = static_cast<long>(entry.source().begin.line);
            out.entries.push_back(convert(entry, std::to_string(out.entries.size()), own, depth + 1));
        }
    } else {
        out.type = Type::date;
    }
    return out;
}

void check_lines(const std::string& text, const std::string& name)
{
    long line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end - begin > longest_line)
            throw InputError(name, line,
                             fmt::format("a line of {} characters, more than {}.\n  Is this a study file?", end - begin,
                                         longest_line));
        begin = end + 1;
    }
}

bool is_bare(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// Whether a text that begins with '[' goes on like a section's name.
bool names_section(std::string_view text)
{
    const auto name = text.find_first_not_of(" \t", text.substr(0, 2) == "[[" ? 2 : 1);
    return name != std::string_view::npos && (is_bare(text[name]) || text[name] == '"' || text[name] == '\'');
}

struct Unfit {
    long line = 0; ///< 0: nothing found
    const char* what = "";
};

/// The first thing that must not reach the parser. toml++ 3.3 runs into undefined behaviour when it looks whether a
/// character from U+00A1 to U+0499 is white space, which it does outside of comments and strings (where TOML allows
/// none beyond ASCII), in strings of many lines (which a study does not need), and in quotes within a number, which
/// goes on for it up to a comma, a closing bracket or white space. It breaks an assertion without a line number where a
/// section's name begins with another character than a key's.
Unfit find_unfit(std::string_view text)
{
    if (text.substr(0, 3) == "\xef\xbb\xbf")
        text.remove_prefix(3); // a byte order mark
    enum class In { nothing, comment, basic, literal } in = In::nothing;
    bool blank_so_far = true; // this line
    bool section = false;     // this line is its name
    bool assigned = false;    // since the last key of a table may have begun
    bool within = false;      // the last character is an = that is within a value
    std::string brackets;     // that are open
    long line = 1;
    const auto begins_value = [&](std::size_t i) {
        return i == 0 || (!within && std::string_view(" \t\r\n=,[{").find(text[i - 1]) != std::string_view::npos);
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\n') {
            ++line;
            blank_so_far = true;
            section = false;
            assigned = assigned && !brackets.empty();
            in = In::nothing; // a string that is still open is an error that the parser finds
            continue;
        }
        switch (in) {
        case In::nothing:
            if (c == '[' && blank_so_far && !names_section(text.substr(i)))
                return {line, "a [section] without a proper name"};
            section = section || (c == '[' && blank_so_far && brackets.empty());
            blank_so_far = blank_so_far && (c == ' ' || c == '\t');
            if (static_cast<unsigned char>(c) >= 0x80)
                return {line, "a character beyond ASCII outside of quotes"};
            if (c == '#')
                in = In::comment;
            if (text.substr(i, 3) == "\"\"\"" || text.substr(i, 3) == "'''")
                return {line, "a string in three quotes"};
            if (c == '"' || c == '\'') {
                const bool part_of_name = section && text[i - 1] == '.';
                if (!begins_value(i) && !part_of_name)
                    return {line, "a quote in the middle of a value"};
                in = c == '"' ? In::basic : In::literal;
            }
            if (c == '[' || c == '{') {
                if (!begins_value(i))
                    return {line, "a bracket in the middle of a value"};
                brackets += c;
            }
            if ((c == ']' || c == '}') && !brackets.empty())
                brackets.pop_back();
            within = c == '=' && (assigned || brackets.ends_with('['));
            assigned = c == '=' || (assigned && c != '{' && (c != ',' || !brackets.ends_with('{')));
            break;
        case In::comment:
            break;
        case In::basic:
            if (c == '\\' && i + 1 < text.size() && text[i + 1] != '\n')
                ++i;
            else if (c == '"')
                in = In::nothing;
            break;
        case In::literal:
            if (c == '\'')
                in = In::nothing;
            break;
        }
    }
    return {};
}

/// The value of a setting: TOML, or else a bare word or path.
toml::table parse_setting(const std::string& value, const std::string& place)
{
    std::string why;
    if (const auto unfit = find_unfit("value = " + value); unfit.line > 0) {
        why = unfit.what;
    } else {
        try {
            return parse_numbers("value = " + value);
        } catch (const NotToml& error) {
            why = error.why;
        }
    }
    if (value.front() == '{' || value.front() == '[' || value.front() == '"' || value.front() == '\'')
        throw InputError(place, 0, "the value is not valid TOML: " + why + ".");
    try {
        return parse("value = " + toml_quoted(value));
    } catch (const NotToml& error) {
        throw InputError(place, 0, "the value is not valid text: " + error.why + ".");
    }
}

/// The parts of a dotted key; none if it is not one.
std::vector<std::string> key_parts(const std::string& key)
{
    std::vector<std::string> parts(1);
    for (const char c : key) {
        if (c == '.')
            parts.emplace_back();
        else if (is_bare(c))
            parts.back() += c;
        else
            return {};
    }
    const bool whole = std::none_of(parts.begin(), parts.end(), [](const auto& part) { return part.empty(); });
    return whole && parts.size() <= deepest_setting ? parts : std::vector<std::string>{};
}

std::vector<std::string> split_key(const std::string& key, const std::string& place)
{
    std::vector<std::string> parts = key_parts(key);
    if (parts.empty())
        throw InputError(place, 0,
                         "the key must be the dotted name of a key of the study file.\n"
                         "  For example --set study.realizations=64.");
    return parts;
}

/// Puts a value at a path, making tables on the way.
/// @param fail throws for a path through what is no table: its name, and what it is
template <class Fail>
void put(TomlValue& root, const std::vector<std::string>& parts, TomlValue given, const Fail& fail)
{
    TomlValue* table = &root;
    std::string path;
    for (const std::string& part : parts) {
        if (table->type != TomlValue::Type::table)
            fail(fmt::format("{} = {} is {}, not a table, and has no key {}.{}", path, table->shown(),
                             table->type_name(), part,
                             table->type == TomlValue::Type::array ? "\n  Give the whole list " + path + "." : ""));
        path += (path.empty() ? "" : ".") + part;
        TomlValue* next = table->find(part);
        if (next == nullptr) {
            TomlValue fresh;
            fresh.key = part;
            fresh.place = given.place;
            table->entries.push_back(std::move(fresh));
            next = &table->entries.back();
        }
        table = next;
    }
    given.key = parts.back();
    *table = std::move(given);
}

} // namespace

const TomlValue* TomlValue::find(std::string_view name) const
{
    const auto at = std::find_if(entries.begin(), entries.end(), [&](const TomlValue& e) { return e.key == name; });
    return at == entries.end() ? nullptr : &*at;
}

TomlValue* TomlValue::find(std::string_view name)
{
    return const_cast<TomlValue*>(std::as_const(*this).find(name));
}

std::string TomlValue::shown() const
{
    switch (type) {
    case Type::boolean:
        return boolean ? "true" : "false";
    case Type::integer:
        return fmt::format("{}", integer);
    case Type::number: // a whole number beyond 64 bits has all its digits
        return std::fabs(number) >= 1e16 && std::fabs(number) < 1e22 ? fmt::format("{:.0f}", number)
                                                                     : fmt::format("{}", number);
    case Type::string: {
        constexpr std::size_t longest = 60;
        if (text.size() <= longest)
            return toml_quoted(text);
        std::size_t end = longest;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u)
            --end; // not within a character
        return toml_quoted(text.substr(0, end) + "...");
    }
    case Type::table:
        return "{ ... }";
    case Type::array:
        return "[ ... ]";
    case Type::date:
        break;
    }
    return "(a date)";
}

std::string TomlValue::type_name() const
{
    switch (type) {
    case Type::boolean:
        return "true or false";
    case Type::integer:
        return "a whole number";
    case Type::number:
        return "a number";
    case Type::string:
        return "a string";
    case Type::table:
        return "a table";
    case Type::array:
        return "an array";
    case Type::date:
        break;
    }
    return "a date or time";
}

TomlValue parse_toml(const std::string& text, const std::string& name)
{
    check_lines(text, name);
    if (const auto unfit = find_unfit(text); unfit.line > 0)
        throw InputError(
            name, unfit.line,
            fmt::format("not valid in a study file: {}.\n  Write text as \"text\", on one line.", unfit.what));
    try {
        return convert(parse_numbers(text), "", {name, 0, false});
    } catch (const NotToml& error) {
        throw InputError(name, error.line,
                         "not valid TOML: " + error.why + ".\n  A line is KEY = VALUE, a [section] or a # comment.");
    }
}

void apply_setting(TomlValue& root, const std::string& setting)
{
    if (setting.size() > longest_setting || std::any_of(setting.begin(), setting.end(), is_control))
        throw InputError("--set", 0,
                         fmt::format("KEY=VALUE must be one line of at most {} characters without control characters.",
                                     longest_setting));
    const std::string place = "--set " + setting;
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos)
        throw InputError(place, 0, "must be KEY=VALUE, for example --set study.realizations=64.");

    const auto trimmed = [](const std::string& text) {
        const std::size_t first = text.find_first_not_of(' ');
        return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
    };
    const auto parts = split_key(trimmed(setting.substr(0, equals)), place);
    const auto value = trimmed(setting.substr(equals + 1));
    if (value.empty())
        throw InputError(place, 0, "has no value.\n  Give --set KEY=VALUE; an empty string is \"\".");

    const TomlPlace here{place, 0, true};
    const toml::table parsed = parse_setting(value, place);
    TomlValue given = convert(*parsed.get("value"), parts.back(), here);
    if (given.type != TomlValue::Type::string)
        given.text = value;

    put(root, parts, std::move(given), [&](const std::string& text) { throw InputError(place, 0, text); });
}

void apply_value(TomlValue& root, const std::string& key, const TomlValue& value, const std::string& why)
{
    const auto fail = [&](const std::string& text) {
        throw InputError(value.place.source, value.place.line, fmt::format("{}: {}", why, text));
    };
    const std::vector<std::string> parts = key_parts(key);
    if (parts.empty())
        fail(fmt::format("\"{}\" is not the dotted name of a key of the study file.\n  For example "
                         "\"contact.friction\" = 0.4.",
                         key));
    put(root, parts, value, fail);
}

std::string toml_quoted(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (is_control(c))
            out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        else
            out += c;
    }
    return out + '"';
}

std::string toml_number(double value)
{
    std::string out = fmt::format("{}", value);
    if (out.find_first_of(".en") == std::string::npos)
        out += ".0"; // a float, not an integer
    return out;
}

} // namespace stylobate
