#pragma once
/// Machine-readable summaries on standard output.

#include "ensemble/model/fields.hpp"
#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stylobate {

/// One JSON object or list, written member by member in order.
class Json {
public:
    static Json object() { return Json('{', '}'); }
    static Json list() { return Json('[', ']'); }
    /// A list of texts.
    static Json list(const std::vector<std::string>& texts)
    {
        Json json = list();
        for (const std::string& text : texts)
            json.item(text);
        return json;
    }
    /// Numbers for the script of a page, of which there are many: whole ones as they are, others with six significant
    /// digits, null where one is not finite; no blanks.
    template <class Number>
    static Json brief(const std::vector<Number>& numbers)
    {
        Json json = list();
        for (const Number number : numbers) {
            json.body_ += json.body_.empty() ? "" : ",";
            if constexpr (std::integral<Number>)
                json.body_ += fmt::format("{}", number);
            else
                json.body_ += std::isfinite(number) ? fmt::format("{:.6g}", number) : "null";
        }
        return json;
    }

    Json& member(std::string_view key, const Json& value) { return raw(key, value.text()); }
    Json& member(std::string_view key, std::string_view value) { return raw(key, quote(value)); }
    Json& member(std::string_view key, const char* value) { return raw(key, quote(value)); }
    Json& member(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
    Json& member(std::string_view key, std::integral auto value) { return raw(key, fmt::format("{}", value)); }
    /// Shortest decimals that read back to the same double; null where it is not finite, as JSON has no word for that.
    Json& member(std::string_view key, double value)
    {
        return raw(key, std::isfinite(value) ? fmt::format("{}", value) : "null");
    }
    /// A value that is JSON already.
    Json& member_as_is(std::string_view key, std::string_view json) { return raw(key, json); }
    Json& item(const Json& value) { return add(value.text()); }
    Json& item(double value) { return add(std::isfinite(value) ? fmt::format("{}", value) : "null"); }
    Json& item(std::integral auto value) { return add(fmt::format("{}", value)); }
    Json& item(std::string_view value) { return add(quote(value)); }
    Json& item_as_is(std::string_view json) { return add(json); }

    std::string text() const { return open_ + body_ + close_; }

private:
    Json(char open, char close) : open_(1, open), close_(1, close) {}

    static std::string quote(std::string_view text)
    {
        std::string quoted = "\"";
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            if (c == '"' || c == '\\') {
                quoted += {'\\', c};
            } else if (const std::size_t length = utf8_length(text.substr(i));
                       length > 0 && static_cast<unsigned char>(c) >= 0x20) {
                quoted += text.substr(i, length);
                i += length - 1;
            } else { // a control character, or a byte that is no UTF-8: it is taken as Latin-1
                quoted += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
            }
        }
        return quoted + '"';
    }

    Json& raw(std::string_view key, std::string_view value) { return add(quote(key) + ": " + std::string(value)); }
    Json& add(std::string_view text)
    {
        if (!body_.empty())
            body_ += ", ";
        body_ += text;
        return *this;
    }

    std::string open_, close_, body_;
};

/// A member of an object, and the field that it is where that has another name.
struct JsonName {
    JsonName(const char* both) : name(both), field(both) {}
    JsonName(const char* its_name, const char* of_field) : name(its_name), field(of_field) {}

    std::string_view name, field;
};

template <class S>
Json json_of(const S& s, std::initializer_list<JsonName> names = {});
template <class T>
Json json_of(const std::vector<T>& list);

/// Adds a value: null where there is none (an optional text is empty), the word of an enumeration (its number where it
/// has none), the object of a structure, a list.
template <class T>
void add_member(Json& json, std::string_view name, const T& value)
{
    if constexpr (std::is_enum_v<T> && !requires { to_string(value); })
        json.member(name, static_cast<int>(value));
    else if constexpr (std::is_enum_v<T>)
        json.member(name, to_string(value));
    else if constexpr (std::is_arithmetic_v<T> || std::is_convertible_v<T, std::string_view>)
        json.member(name, value);
    else if constexpr (std::is_same_v<T, std::optional<std::string>>)
        json.member(name, value.value_or(""));
    else if constexpr (requires { value.has_value(); })
        value ? add_member(json, name, *value) : add_member(json, name, std::numeric_limits<double>::quiet_NaN());
    else
        json.member(name, json_of(value));
}

/// Adds fields of a structure, by the list of them: all in its order, or those that are named in this one.
template <class S>
Json& add_members(Json& json, const S& s, std::initializer_list<JsonName> names = {})
{
    const auto visit = [&](const auto& f) {
        visit_fields(std::type_identity<S>(),
                     [&](const char* field, auto of, const FieldFacts& = {}) { f(field, of); });
    };
    if (names.size() == 0)
        visit([&](const char* field, auto of) { add_member(json, field, std::invoke(of, s)); });
    for (const JsonName& name : names)
        visit([&](const char* field, auto of) {
            if (name.field == field)
                add_member(json, name.name, std::invoke(of, s));
        });
    return json;
}

/// The object of a structure.
template <class S>
Json json_of(const S& s, std::initializer_list<JsonName> names)
{
    Json json = Json::object();
    return add_members(json, s, names);
}

/// A list of what `object` makes of its items.
template <class List, class F>
Json json_list(const List& list, const F& object)
{
    Json json = Json::list();
    for (const auto& item : list)
        json.item(object(item));
    return json;
}
template <class T>
Json json_of(const std::vector<T>& list)
{
    return json_list(list, [](const T& item) {
        if constexpr (std::is_convertible_v<T, std::string_view>)
            return std::string_view(item);
        else if constexpr (std::is_arithmetic_v<T>)
            return item;
        else
            return json_of(item);
    });
}

} // namespace stylobate
