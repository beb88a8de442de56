#pragma once
/// A TOML text as a tree of values that know where they stand, with the settings of the command line laid over it.
/// Says nothing about which keys there may be: that is `key_reader.hpp`.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Where a value was given, for messages.
struct TomlPlace {
    std::string source;        ///< the file's name, or "--set KEY=VALUE"
    long line = 0;             ///< from 1; 0 where there is none
    bool command_line = false; ///< given by --set
};

struct TomlValue {
    enum class Type { boolean, integer, number, string, table, array, date };

    std::string key; ///< its name in the table above it
    TomlPlace place; ///< of the key
    Type type = Type::table;
    bool boolean = false;
    std::int64_t integer = 0;
    double number = 0;              ///< of an integer too
    std::string text;               ///< of a string; of another value from the command line, as it was typed
    std::vector<TomlValue> entries; ///< of a table, by name; of an array, in order, named by their numbers

    /// The entry of a table; null if there is none.
    const TomlValue* find(std::string_view name) const;
    TomlValue* find(std::string_view name);
    /// As in a TOML file, on one line and shortened, for messages: 1450, "smooth", { ... }.
    std::string shown() const;
    /// "a string", "a table", ...
    std::string type_name() const;
};

/// Parses a text. @throws InputError with `name` and the line if it is not TOML.
TomlValue parse_toml(const std::string& text, const std::string& name);

/// Lays "KEY=VALUE" over the tree: KEY is dotted, VALUE as in TOML, and a bare word or path is taken as a string.
/// @throws InputError with "--set KEY=VALUE" as the place
void apply_setting(TomlValue& root, const std::string& setting);

/// Lays a value of another table over the tree at a dotted key, in place of what is there.
/// @param why what the key is one of, for messages: "variants.dowels"
/// @throws InputError at the value's place
void apply_value(TomlValue& root, const std::string& key, const TomlValue& value, const std::string& why);

/// A string in TOML's double quotes.
std::string toml_quoted(std::string_view text);
/// A finite number as a TOML float that reads back to the same bits.
std::string toml_number(double value);

} // namespace stylobate
