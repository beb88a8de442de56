#pragma once
/// A strict reader of JSON (RFC 8259), for what the program prints.

#include <stdexcept>
#include <string>
#include <string_view>
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
    std::vector<JsonMember> members; ///< in the order of the text

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

struct JsonParser {
    /// @throws std::runtime_error if `text` is not one JSON value with blanks about it, or no UTF-8, or names a key
    /// twice, or has a number that is not finite
    static JsonValue parse(std::string_view text);
};

} // namespace stylobate
