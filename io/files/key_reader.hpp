#pragma once
/// Checked access to the keys of one table of a TOML file. Every refusal is an InputError that names file and line,
/// key, value, what is allowed and what to do.

#include "io/files/toml_document.hpp"
#include "io/files/toml_key.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

class KeyReader {
public:
    /// @param table null where the file has no such table: then every key is absent
    /// @param path  its dotted name in messages; empty for the whole file
    /// @param above where a table that is absent would be missed
    KeyReader(const TomlValue* table, std::string path, const TomlPlace& above);

    bool has(std::string_view key) const { return find(key) != nullptr; }
    /// The value as it stands; null if absent.
    const TomlValue* find(std::string_view key) const { return table_ ? table_->find(key) : nullptr; }

    // By the key's description: type, range and default are its own. Without a default, a key that is absent is
    // missing.

    double read(const NumberKey& key) const { return read_within(key, key.range); }
    /// In a range that this file allows.
    double read_within(const NumberKey& key, const Range& range) const
    {
        return key.absent_value && !has(key.name) ? *key.absent_value : number(key.name, range);
    }
    std::uint64_t read(const WholeKey& key) const { return read_up_to(key, key.high); }
    /// No more than this file allows.
    std::uint64_t read_up_to(const WholeKey& key, std::uint64_t high) const
    {
        return key.absent_value && !has(key.name) ? *key.absent_value : whole(key.name, key.low, high, key.hint);
    }
    bool read(const BooleanKey& key) const { return boolean_or(key.name, key.absent_value.value_or(false)); }
    template <class Enum>
    Enum read(const WordKey<Enum>& key) const
    {
        return key.absent_value && !has(key.name) ? *key.absent_value : choice(key.name, key.names);
    }
    /// Of a key with words one of them.
    std::string read(const TextKey& key) const
    {
        return key.words.empty() ? text(key.name) : key.words[word_index(key.name, key.words)];
    }
    std::vector<double> read(const ListKey& key) const { return number_list(key.name, key.range); }
    /// The value where the key is given, and else this one.
    template <class Key>
    typename Key::Value read_or(const Key& key, typename Key::Value absent) const
    {
        return has(key.name) ? read(key) : absent;
    }
    template <class Key>
    std::optional<typename Key::Value> maybe(const Key& key) const
    {
        return has(key.name) ? std::optional<typename Key::Value>(read(key)) : std::nullopt;
    }
    bool has(const TomlKey& key) const { return has(key.name); }
    /// Reads a value that is given or needed; otherwise `value` keeps what it has.
    template <class Key, class Value>
    void fill(const Key& key, Value& value) const
    {
        if (has(key) || key.needed())
            value = static_cast<Value>(read(key));
    }
    /// Fills the members of a structure by those keys of the table that fill them and that are used.
    template <class S>
    void read_fields(const TableKey& table, S& to, const KeyUse& use = {}) const
    {
        for (const TomlKey* key : table.keys)
            if (key->field.read && key->field.of == typeid(S) && use.of(*key))
                key->field.read(*this, *key, &to);
    }
    /// A table in this one, perhaps absent; its keys are checked: known, and none beside one that excludes it.
    KeyReader table(const TableKey& key) const;
    /// The tables of a list, with their keys checked; none if the key is absent.
    std::vector<KeyReader> tables(const TableKey& key) const;

    /// Refuses any key that is not one of these: 'did you mean'.
    void allow_only(const std::vector<std::string>& known) const;
    /// Refuses known keys other than these; `why` names the setting that does not use them: `excitation.kind =
    /// "record"`.
    void refuse_unused(const std::vector<std::string>& used, const std::string& why) const;
    /// Refuses keys of this table that KIND = "WORD" does not use.
    void refuse_unused(const TableKey& table, const std::string& kind, const std::string& word) const;
    /// The first key, in the table's order, that KIND = "WORD" does not use is refused with advice of its own.
    void refuse_unused(const TableKey& table, const std::string& kind, const std::string& word,
                       const std::string& todo) const;

    /// A table in this one, perhaps absent.
    KeyReader table(std::string_view key) const;

    /// The tables of an array of tables, each with its own place; none if the key is absent.
    std::vector<KeyReader> tables(std::string_view key) const;

    double number(std::string_view key, const Range& range) const;
    double number_or(std::string_view key, const Range& range, double absent) const;
    std::optional<double> maybe_number(std::string_view key, const Range& range) const;

    /// Numbers in brackets, at least one.
    std::vector<double> number_list(std::string_view key, const Range& range) const;

    /// [low, high], two numbers of which the first is the smaller one.
    std::optional<std::array<double, 2>> maybe_interval(std::string_view key, const Range& range) const;

    /// A whole number; 1e6 counts as one. @pre high is at most 2^63 - 1
    std::uint64_t whole(std::string_view key, std::uint64_t low, std::uint64_t high,
                        const std::string& hint = {}) const;

    /// Whole numbers in brackets, at least one; none if the key is absent.
    std::vector<std::uint64_t> whole_list_or_none(std::string_view key, std::uint64_t low, std::uint64_t high,
                                                  const std::string& hint = {}) const;

    bool boolean_or(std::string_view key, bool absent) const;

    /// A string that is not empty. From the command line a number is taken as the text that was typed.
    std::string text(std::string_view key) const;
    /// The same; nullopt where the key is absent.
    std::optional<std::string> text_if_given(std::string_view key) const
    {
        return has(key) ? std::optional(text(key)) : std::nullopt;
    }

    /// One of the words of a list of `Name`s.
    template <class List>
    auto choice(std::string_view key, const List& names) const
    {
        std::vector<std::string> words;
        for (const auto& name : names)
            words.emplace_back(name.word);
        return names[word_index(key, words)].value;
    }
    template <class List, class Enum>
    Enum choice_or(std::string_view key, const List& names, Enum absent) const
    {
        return has(key) ? choice(key, names) : absent;
    }
    /// The place of a string among the words that are allowed.
    std::size_t word_index(std::string_view key, const std::vector<std::string>& words) const;

    /// "PLACE: path.key = value WHAT.\n  ADVICE"; `what` begins with a verb. Of a key that is absent there is no value.
    [[noreturn]] void refuse(std::string_view key, const std::string& what, const std::string& todo = {}) const;
    /// "PLACE: path.key is missing.\n  ADVICE"
    [[noreturn]] void missing(std::string_view key, const std::string& todo) const;

    /// "PLACE: TEXT", for what no single key of the table is to blame for.
    [[noreturn]] void refuse_all(const std::string& text) const;

    const std::string& path() const { return path_; }

private:
    void check_keys(const TableKey& table) const;
    std::string full(std::string_view key) const;
    /// The value of a key that must be there.
    const TomlValue& need(std::string_view key, const std::string& todo) const;
    /// A list that must be there and have an entry.
    const TomlValue& need_list(std::string_view key, const std::string& todo) const;
    double check(std::string_view key, const TomlValue& value, const Range& range) const;
    std::vector<double> check_list(std::string_view key, const Range& range, const std::string& todo) const;

    const TomlValue* table_;
    std::string path_;
    TomlPlace place_;
};

template <class Key, class S, class M>
KeyField field_of(M S::*member)
{
    KeyField field{typeid(S), {}, [member](const TomlKey& key, const void* from) {
                       return key_text(static_cast<const Key&>(key), static_cast<const S*>(from)->*member);
                   }};
    if constexpr (!std::is_same_v<Key, ListKey> || std::is_same_v<M, std::vector<double>>) // others are checked more
        field.read = [member](const KeyReader& keys, const TomlKey& key, void* to) {
            keys.fill(static_cast<const Key&>(key), static_cast<S*>(to)->*member);
        };
    return field;
}

} // namespace stylobate
