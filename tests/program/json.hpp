#pragma once
/// A strict reader of JSON (RFC 8259), for what the program prints.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

struct JsonMember;

struct JsonValue {
    enum class Kind { null, boolean, number, text, list, object };
    Kind kind = Kind::null;
    bool boolean = false;
    double number = 0;
    std::string text;
    std::vector<JsonValue> items;
    std::vector<JsonMember> members;

    bool has(std::string_view key) const;
    /// @throws std::runtime_error if there is no such member
    const JsonValue& operator[](std::string_view key) const;
};

struct JsonMember {
    std::string name;
    JsonValue value;
};

inline bool JsonValue::has(std::string_view key) const
{
    for (const JsonMember& member : members)
        if (member.name == key)
            return true;
    return false;
}

inline const JsonValue& JsonValue::operator[](std::string_view key) const
{
    for (const JsonMember& member : members)
        if (member.name == key)
            return member.value;
    throw std::runtime_error("no member " + std::string(key));
}

class JsonParser {
public:
    /// @throws std::runtime_error if `text` is not one JSON value with blanks about it, or no UTF-8, or names a key
    /// twice
    static JsonValue parse(std::string_view text)
    {
        JsonParser parser(text);
        const JsonValue value = parser.value(0);
        parser.blanks();
        if (parser.at_ != text.size())
            parser.fail("something follows the value");
        return value;
    }

private:
    explicit JsonParser(std::string_view text) : text_(text) {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error("JSON, byte " + std::to_string(at_) + ": " + what);
    }
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    char next()
    {
        if (at_ >= text_.size())
            fail("it ends too early");
        return text_[at_++];
    }
    void blanks()
    {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
            ++at_;
    }
    void word(std::string_view expected)
    {
        if (text_.substr(at_, expected.size()) != expected)
            fail("a value is expected");
        at_ += expected.size();
    }

    JsonValue value(int depth)
    {
        if (depth > 20)
            fail("it is too deep");
        blanks();
        JsonValue value;
        switch (peek()) {
        case '{':
            value.kind = JsonValue::Kind::object;
            sequence('}', [&] {
                blanks();
                std::string key = text();
                if (value.has(key))
                    fail("the key " + key + " comes twice");
                blanks();
                if (next() != ':')
                    fail("a colon is expected");
                value.members.push_back({std::move(key), this->value(depth + 1)});
            });
            break;
        case '[':
            value.kind = JsonValue::Kind::list;
            sequence(']', [&] { value.items.push_back(this->value(depth + 1)); });
            break;
        case '"':
            value.kind = JsonValue::Kind::text;
            value.text = text();
            break;
        case 't':
        case 'f':
            value.kind = JsonValue::Kind::boolean;
            value.boolean = peek() == 't';
            word(value.boolean ? "true" : "false");
            break;
        case 'n':
            word("null");
            break;
        default:
            value.kind = JsonValue::Kind::number;
            value.number = number();
        }
        return value;
    }

    template <class Item>
    void sequence(char close, Item item)
    {
        next();
        blanks();
        if (peek() == close) {
            next();
            return;
        }
        while (true) {
            item();
            blanks();
            const char c = next();
            if (c == close)
                return;
            if (c != ',')
                fail("a comma is expected");
        }
    }

    double number()
    {
        const std::size_t begin = at_;
        const auto digits = [&] {
            const std::size_t first = at_;
            while (peek() >= '0' && peek() <= '9')
                ++at_;
            if (at_ == first)
                fail("a digit is expected");
        };
        if (peek() == '-')
            ++at_;
        const bool zero = peek() == '0';
        const std::size_t first = at_;
        digits();
        if (zero && at_ - first > 1)
            fail("a number begins with 0");
        if (peek() == '.') {
            ++at_;
            digits();
        }
        if (peek() == 'e' || peek() == 'E') {
            ++at_;
            if (peek() == '+' || peek() == '-')
                ++at_;
            digits();
        }
        const double number = std::strtod(std::string(text_.substr(begin, at_ - begin)).c_str(), nullptr);
        if (!std::isfinite(number))
            fail("the number is not finite");
        return number;
    }

    std::string text()
    {
        if (next() != '"')
            fail("a string is expected");
        std::string out;
        while (true) {
            const char c = next();
            if (c == '"')
                return out;
            if (static_cast<unsigned char>(c) < 0x20)
                fail("a control character in a string");
            if (c == '\\')
                append(out, escape());
            else if (static_cast<unsigned char>(c) < 0x80)
                out += c;
            else
                character(out, static_cast<unsigned char>(c));
        }
    }

    std::uint32_t escape()
    {
        const char c = next();
        const std::string_view letters = "\"\\/bfnrt", meant = "\"\\/\b\f\n\r\t";
        if (const std::size_t i = letters.find(c); i != std::string_view::npos)
            return static_cast<unsigned char>(meant[i]);
        if (c != 'u')
            fail("an unknown escape");
        std::uint32_t code = 0;
        for (int i = 0; i < 4; ++i) {
            const std::size_t digit = std::string_view("0123456789abcdef").find(static_cast<char>(next() | 0x20));
            if (digit == std::string_view::npos)
                fail("four hexadecimal digits are expected");
            code = code * 16 + static_cast<std::uint32_t>(digit);
        }
        return code;
    }

    /// The rest of a character of several bytes.
    void character(std::string& out, std::uint32_t lead)
    {
        const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
        if (lead < 0xc2 || lead > 0xf4)
            fail("no UTF-8");
        std::uint32_t code = lead & (0x3fu >> more);
        for (int i = 0; i < more; ++i) {
            const auto byte = static_cast<unsigned char>(next());
            if ((byte & 0xc0) != 0x80)
                fail("no UTF-8");
            code = code << 6 | (byte & 0x3fu);
        }
        const std::uint32_t smallest[] = {0x80, 0x800, 0x10000};
        if (code < smallest[more - 1] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000))
            fail("no UTF-8");
        append(out, code);
    }

    static void append(std::string& out, std::uint32_t code)
    {
        const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
        if (code < 0x80) {
            put(code);
        } else if (code < 0x800) {
            put(0xc0 | code >> 6);
            put(0x80 | (code & 0x3f));
        } else if (code < 0x10000) {
            put(0xe0 | code >> 12);
            put(0x80 | (code >> 6 & 0x3f));
            put(0x80 | (code & 0x3f));
        } else {
            put(0xf0 | code >> 18);
            put(0x80 | (code >> 12 & 0x3f));
            put(0x80 | (code >> 6 & 0x3f));
            put(0x80 | (code & 0x3f));
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace stylobate
