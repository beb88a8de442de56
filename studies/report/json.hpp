#pragma once
/// Machine-readable summaries on standard output.

#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
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

} // namespace stylobate
