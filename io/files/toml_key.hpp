#pragma once
/// The description of a key of a TOML file: its name, type, range, default, meaning and the member that it fills, once.
/// `KeyReader` reads by it, `study_text` writes by it, and documentation, schema and templates are made from it
/// (io/keys/).

#include "ensemble/numerics/unit_slip.hpp"
#include "io/files/toml_document.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <vector>

namespace stylobate {

/// The least number of a range above 0: products and quotients of smaller ones would become 0 or infinite.
inline constexpr double least_above_zero = 1e-30;

/// What a number may be; never NaN or infinite.
struct Range {
    double low = 0;
    double high = 0;
    bool open = false;                    ///< `low` itself is outside
    std::string hint = {};                ///< the unit, as a sentence
    std::span<const UnitSlip> slips = {}; ///< units in which a value outside may have been given

    bool contains(double value) const;
    /// "(0, 10]"
    std::string text() const;
    /// "Did you mean 0.155 (155 mm) or 1.55 (155 cm)?" of a value outside; nullopt if it is inside in
    /// none of those units.
    std::optional<std::string> meant(double value) const;
    /// The text for a message about a value outside: of a range that begins just above 0 it states the least
    /// value.
    std::string text_for(double value) const;

private:
    bool is_next_to_zero(double value) const;
};

/// A word of a file and what it stands for.
template <class Enum>
struct Name {
    const char* word;
    Enum value;
};

/// Words for the enumerators of an enumeration, in their order.
template <class Enum, class... Words>
constexpr auto word_list(Words... words)
{
    int next = 0;
    return std::array{Name<Enum>{words, static_cast<Enum>(next++)}...};
}

/// The word for a value that its list holds.
template <class List, class Enum>
const char* word_for(const List& names, Enum value)
{
    for (const auto& name : names)
        if (name.value == value)
            return name.word;
    return "?";
}

enum class KeyType {
    number,
    whole, ///< a whole number
    boolean,
    word,     ///< one of `TomlKey::words`
    text,     ///< any string
    numbers,  ///< a list
    interval, ///< [low, high]
    wholes,   ///< a list of whole numbers
    texts,    ///< a list of strings
    table,
    tables,        ///< a list of tables
    table_or_list, ///< a table, or a list of such tables
    named          ///< tables under names of the user's, all with these keys; without keys, with any
};

/// The key that chooses the model of a study, and the models in the order of its values 2 and 3.
inline constexpr const char* model_key = "structure.dimensions";
inline constexpr std::array model_names = {"planar", "spatial"};

/// Of a key that is a table: whether it is there, in the place of the values of a word.
inline constexpr const char *key_given = "given", *key_absent = "absent";

/// A key is used only where another one has one of these values.
struct Condition {
    std::string key; ///< dotted, from the top: "excitation.kind"
    std::vector<std::string> values;
};

class KeyReader;
struct TomlKey;

/// The member of a structure that a key fills.
struct KeyField {
    std::type_index of = typeid(void); ///< the structure
    /// Reads the value; where the key is absent and not needed, the member keeps what it has.
    std::function<void(const KeyReader&, const TomlKey&, void*)> read = {};
    /// The value as TOML; nothing of a member without one.
    std::function<std::optional<std::string>(const TomlKey&, const void*)> text = {};
};

template <class Key, class S, class M>
KeyField field_of(M S::*member); // in key_reader.hpp

/// What only some keys have.
struct KeyFacts {
    bool needed = false; ///< must be given where it is used, whatever its member is without it
    /// What applies where the key is absent, if that is no plain value: "K_N times the width of the widest drum".
    std::optional<std::string> absent = {};
    std::vector<Condition> used = {}; ///< all must hold; none: always used
    /// A value to begin with, as TOML, for a file that is written for the user; nullopt: the default.
    std::optional<std::string> example = {};
    std::vector<std::string> words = {};                     ///< of a number: words that may stand in its place
    std::vector<std::string> excludes = {};                  ///< keys of its table in whose place it stands
    std::vector<std::string> models = {"planar", "spatial"}; ///< models that use it; by default every one there is
};

/// What all descriptions have in common.
struct TomlKey {
    std::string name;
    KeyType type = KeyType::number;
    std::string meaning; ///< a phrase for people, without a full stop
    Range range = {};    ///< of numbers, also in lists
    std::vector<std::string> words = {};
    std::optional<std::string> absent = {};  ///< the default as TOML, or in words; nullopt: the key must be given
    bool absent_is_value = false;            ///< `absent` is TOML
    std::vector<Condition> used = {};        ///< see `KeyFacts`
    std::optional<std::string> example = {}; ///< see `KeyFacts`
    std::vector<std::string> excludes = {};  ///< see `KeyFacts`
    std::vector<std::string> models = {};    ///< see `KeyFacts`
    std::vector<const TomlKey*> keys = {};   ///< of a table
    KeyField field = {};

    /// Must be given wherever it is used.
    bool needed() const { return !absent; }
    /// Whether a condition on `key` allows `value`; true where there is no such condition. The models that use it are a
    /// condition on `model_key`.
    bool used_where(std::string_view key, std::string_view value) const;
    /// "m/s2", from the end of the name: the unit is part of the key; nullopt if it has none.
    std::optional<std::string> unit() const;

protected:
    TomlKey(std::string key, KeyType of_type, std::string means, KeyFacts facts);
    ~TomlKey() = default;
    TomlKey(const TomlKey&) = default;
    TomlKey(TomlKey&&) = default;
    TomlKey& operator=(const TomlKey&) = default;
    TomlKey& operator=(TomlKey&&) = default;
    void set_default(std::string toml);
    /// @param from the member that the key fills, whose initial value is the default unless there is another one; or a
    ///             default
    template <class Key, class From>
    static void begin(Key& key, const From& from, bool needed)
    {
        if constexpr (std::is_member_object_pointer_v<From>)
            key.field = field_of<Key>(from);
        if (const auto text = key_text(key, initial(from)); text && !needed)
            key.set_default(*text);
        if constexpr (requires { key.absent_value = static_cast<typename Key::Value>(initial(from)); })
            if (key.absent_is_value || !std::is_member_object_pointer_v<From>)
                key.absent_value = static_cast<typename Key::Value>(initial(from));
    }

    template <class S, class M>
    static M initial(M S::*member)
    {
        return S{}.*member;
    }
    template <class Value>
    static const Value& initial(const Value& value)
    {
        return value;
    }
};

/// Which keys of a study are read and written by their fields.
struct KeyUse {
    std::map<std::string, std::string> kinds = {}; ///< "excitation.kind" and its word: what conditions depend on
    std::vector<const TomlKey*> apart = {};        ///< keys that have code of their own
    bool of(const TomlKey& key) const;
    KeyUse without(std::initializer_list<const TomlKey*> keys) const;
};

/// The unit that the name of a quantity ends with: "m/s2" of "pga_m_s2"; nullopt if there is none.
std::optional<std::string> unit_in_name(std::string_view name);

/// The value of a key as TOML.
std::string toml_text(double value);
std::string toml_text(bool value);
std::string toml_text(std::uint64_t value);
std::string toml_text(const std::string& value);
std::string toml_text(const std::vector<double>& values);
std::string toml_text(const std::vector<int>& values);
std::string toml_text(const std::vector<std::string>& values);

/// The value of a member as TOML; nothing of an empty optional, string or list.
template <class Key, class Value>
std::optional<std::string> key_text(const Key& key, const Value& value)
{
    if constexpr (requires { value.has_value(); })
        return value ? key_text(key, *value) : std::nullopt;
    else if constexpr (std::is_enum_v<Value>)
        return toml_quoted(word_for(key.names, value));
    else if constexpr (std::is_same_v<Value, int>)
        return std::to_string(value);
    else if constexpr (std::is_unsigned_v<Value> && !std::is_same_v<Value, bool>)
        return toml_text(std::uint64_t{value});
    else if constexpr (requires { value.empty(); })
        return value.empty() ? std::nullopt : std::optional(toml_text(value));
    else
        return toml_text(value);
}

// A key is made from its name, the member that it fills or its default (or neither), what is allowed, and its meaning.

struct NumberKey : TomlKey {
    using Value = double;
    std::optional<double> absent_value;

    NumberKey(std::string key, const Range& allowed, std::string means, KeyFacts facts = {});
    template <class From>
    NumberKey(std::string key, From from, const Range& allowed, std::string means, const KeyFacts& facts = {})
        : NumberKey(std::move(key), allowed, std::move(means), facts)
    {
        begin(*this, from, facts.needed);
    }
};

struct WholeKey : TomlKey {
    using Value = std::uint64_t;
    std::uint64_t low, high; ///< @pre high is at most 2^63 - 1
    std::string hint;        ///< a sentence of what is counted
    std::optional<std::uint64_t> absent_value;

    struct Limits {
        std::uint64_t low, high;
        std::string hint = {};
    };
    WholeKey(std::string key, Limits allowed, std::string means, KeyFacts facts = {});
    template <class From>
    WholeKey(std::string key, From from, Limits allowed, std::string means, const KeyFacts& facts = {})
        : WholeKey(std::move(key), std::move(allowed), std::move(means), facts)
    {
        begin(*this, from, facts.needed);
    }
};

struct BooleanKey : TomlKey {
    using Value = bool;
    std::optional<bool> absent_value;

    BooleanKey(std::string key, std::string means, KeyFacts facts);
    template <class From>
    requires std::is_same_v<From, bool> || std::is_member_object_pointer_v<From>
    BooleanKey(std::string key, From from, std::string means, const KeyFacts& facts = {})
        : BooleanKey(std::move(key), std::move(means), facts)
    {
        begin(*this, from, false);
    }
};

template <class Enum>
struct WordKey : TomlKey {
    using Value = Enum;
    std::vector<Name<Enum>> names;
    std::optional<Enum> absent_value;

    template <class From, class List>
    requires std::is_same_v<From, Enum> || std::is_member_object_pointer_v<From>
    WordKey(std::string key, From from, const List& allowed, std::string means, const KeyFacts& facts = {})
        : WordKey(std::move(key), allowed, std::move(means), facts)
    {
        begin(*this, from, facts.needed);
    }
    template <class List>
    WordKey(std::string key, const List& allowed, std::string means, KeyFacts facts = {})
        : TomlKey(std::move(key), KeyType::word, std::move(means), std::move(facts)),
          names(allowed.begin(), allowed.end())
    {
        for (const Name<Enum>& each : names)
            words.emplace_back(each.word);
    }
};

struct TextKey : TomlKey {
    using Value = std::string;
    TextKey(std::string key, std::string means, KeyFacts facts = {});
    template <class S, class M>
    TextKey(std::string key, M S::*member, std::string means, KeyFacts facts = {})
        : TextKey(std::move(key), std::move(means), std::move(facts))
    {
        begin(*this, member, true);
    }
};

/// A list of numbers, an interval or a list of strings.
struct ListKey : TomlKey {
    ListKey(std::string key, KeyType of_type, const Range& allowed, std::string means, KeyFacts facts = {});
    template <class From>
    ListKey(std::string key, const From& from, const Range& allowed, std::string means, KeyFacts facts = {})
        : ListKey(std::move(key), type_of(initial(from)), allowed, std::move(means), std::move(facts))
    {
        begin(*this, from, false);
    }

private:
    static KeyType type_of(const std::vector<double>&) { return KeyType::numbers; }
    static KeyType type_of(const std::vector<int>&) { return KeyType::wholes; }
    static KeyType type_of(const std::vector<std::string>&) { return KeyType::texts; }
};

/// A table, or a list of tables, with its keys.
struct TableKey : TomlKey {
    TableKey(std::string key, std::string means, std::vector<const TomlKey*> of_table, KeyFacts facts = {},
             KeyType of_type = KeyType::table);

    std::vector<std::string> names() const;
    /// The names of those keys that a condition on `key` does not exclude.
    std::vector<std::string> names_where(std::string_view key, std::string_view value) const;
};

} // namespace stylobate
