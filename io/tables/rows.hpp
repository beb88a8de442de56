#pragma once
/// Structures as tables, by the lists of their fields (`ensemble/model/fields.hpp`): one list writes and reads.
///
/// Rows have a column for each value. A structure inside a row has one for each of its own fields, NAME_FIELD; the
/// field "value" has NAME alone, so that a number with its limits is NAME, NAME_lower, NAME_upper. A record is one
/// structure: its values are attributes, its lists are columns. Items are rows that have lists: every list is a table
/// below, whose column `row` is the item to which an entry belongs; what may be absent is a list of none or one.
///
/// An optional number is NaN where there is none, and an optional text is empty. An enumeration has its words beside it
/// (`FieldWords`). True and false are 1 and 0, and words of items.

#include "ensemble/model/fields.hpp"
#include "io/tables/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate {

/// How the values of an enumeration lie in a file.
enum class WordsAs { enumeration, texts, numbers };

/// The words of an enumeration in files, in its order: `words`, and `as` where they are no enumeration of the file.
template <class E>
struct FieldWords;
template <>
struct FieldWords<bool> {
    static constexpr const char* words[] = {"no", "yes"};
};

/// Pointers to what lies in several lists, one after the other: the functions below take rows so.
template <class Items, class List>
auto pointers_to(Items& items, const List& list)
{
    std::vector<decltype(&*std::begin(std::invoke(list, *std::begin(items))))> all;
    for (auto& item : items)
        for (auto& part : std::invoke(list, item))
            all.push_back(&part);
    return all;
}
/// Pointers to all of a list.
template <class List>
auto pointers_to(List& list)
{
    std::vector<decltype(&*std::begin(list))> all;
    for (auto& item : list)
        all.push_back(&item);
    return all;
}

namespace row_values {

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_value =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string> || std::is_same_v<T, const char*> ||
    std::is_same_v<T, std::optional<double>> || std::is_same_v<T, std::optional<std::string>>;

/// The type of a field of a structure.
template <class Field, class S>
using TypeOf = std::remove_cvref_t<std::invoke_result_t<const Field&, S&>>;
/// Whether a field can be read back; else it follows from others and is written alone.
template <class Field, class S>
inline constexpr bool is_settable = std::is_lvalue_reference_v<std::invoke_result_t<const Field&, S&>> &&
                                    !std::is_const_v<std::remove_reference_t<std::invoke_result_t<const Field&, S&>>>;

template <class E>
constexpr WordsAs words_as()
{
    if constexpr (requires { FieldWords<E>::as; })
        return FieldWords<E>::as;
    else
        return WordsAs::enumeration;
}

/// Whether a value is one of the words of an enumeration of the file. @tparam item of an item
template <class T, bool item>
inline constexpr bool is_word = false;
template <class T, bool item>
requires(std::is_enum_v<T> ||
         (item &&
          std::is_same_v<T, bool>)) inline constexpr bool is_word<T, item> = words_as<T>() == WordsAs::enumeration;

/// A value as a column has it.
template <class T, bool item = false>
auto stored(const T& value)
{
    if constexpr (std::is_same_v<T, std::optional<double>>)
        return value.value_or(std::numeric_limits<double>::quiet_NaN());
    else if constexpr (std::is_same_v<T, std::optional<std::string>>)
        return value.value_or("");
    else if constexpr (is_word<T, item>)
        return std::string(FieldWords<T>::words[static_cast<std::size_t>(value)]);
    else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, int>)
        return static_cast<std::int32_t>(value);
    else if constexpr (std::is_floating_point_v<T>)
        return static_cast<double>(value);
    else if constexpr (std::is_integral_v<T>)
        return static_cast<std::uint64_t>(value);
    else if constexpr (!std::is_enum_v<T>)
        return std::string(value);
    else if constexpr (words_as<T>() == WordsAs::numbers)
        return static_cast<std::int32_t>(value);
    else
        return std::string(FieldWords<T>::words[static_cast<std::size_t>(value)]);
}
template <class T, bool item = false>
using Stored = decltype(stored<T, item>(std::declval<T>()));

/// The value that a column has. @throws InputError if it stands for nothing
template <class T, bool item = false>
void restore(T& value, const Stored<T, item>& found, const Table& table)
{
    if constexpr (std::is_same_v<T, std::optional<double>>) {
        value = std::isnan(found) ? std::optional<double>() : found;
    } else if constexpr (std::is_same_v<T, std::optional<std::string>>) {
        value = found.empty() ? std::nullopt : std::optional(found);
    } else if constexpr (std::is_enum_v<T> || is_word<T, item>) {
        const auto& words = FieldWords<T>::words;
        std::size_t place = 0;
        if constexpr (std::is_same_v<Stored<T, item>, std::string>)
            place = static_cast<std::size_t>(std::ranges::find(words, found) - std::begin(words));
        else
            place = static_cast<std::size_t>(found);
        if (place >= std::size(words))
            table.refuse("'" + table.name() + "' has a value that stands for nothing");
        value = static_cast<T>(place);
    } else {
        value = static_cast<T>(found);
    }
}

/// @param at i -> the i-th value, i < n
template <class T, bool item, class At>
void add_column(Table& table, const std::string& name, std::size_t n, const At& at,
                const std::optional<Table::Shape>& shape = std::nullopt, const std::string& unit = {})
{
    std::vector<Stored<T, item>> values;
    for (std::size_t i = 0; i < n; ++i)
        values.push_back(stored<T, item>(at(i)));
    if constexpr (is_word<T, item>)
        table.add_words(name, std::move(values), {std::begin(FieldWords<T>::words), std::end(FieldWords<T>::words)});
    else
        table.add(name, std::move(values), shape.value_or(Table::Shape{n}), unit);
}

/// @param to i -> the i-th value, which is set
template <class T, bool item, class To>
void read_column(const Table& table, const std::string& name, std::size_t n, const To& to,
                 const std::optional<Table::Shape>& shape = std::nullopt)
{
    const auto& found = table.values<Stored<T, item>>(name, shape.value_or(Table::Shape{n}));
    for (std::size_t i = 0; i < found.size(); ++i)
        restore<T, item>(to(i), found[i], table);
}

inline std::string joined(const std::string& before, const std::string& name)
{
    return before.empty() ? name : name.empty() || name == "value" ? before : before + "_" + name;
}

/// The unit of a column: that of the field, of the structure that it is in, or the end of its name. "1": none.
inline std::string unit_of_column(const FieldFacts& facts, const std::string& inherited, const std::string& name)
{
    const std::string unit(facts.unit.value_or(inherited.empty() ? unit_of(name) : inherited));
    return unit == "1" ? "" : unit;
}

/// Calls f(name, field, unit, facts) for every value and list of a structure, and of the structures in it.
template <class S, class F>
void visit_values(const F& f, const std::string& before, const std::string& unit = {})
{
    visit_fields(std::type_identity<S>(), [&](const char* name, auto field, const FieldFacts& facts = {}) {
        using T = TypeOf<decltype(field), S>;
        const std::string full = joined(before, name);
        if constexpr (is_value<T> || is_list<T>)
            f(full, field, unit_of_column(facts, unit, full), facts);
        else
            visit_values<T>(
                [&](const std::string& inner, auto of, const std::string& its_unit, const FieldFacts& its_facts) {
                    f(
                        inner, [=](auto& s) -> decltype(auto) { return std::invoke(of, std::invoke(field, s)); },
                        its_unit, its_facts);
                },
                full, std::string(facts.unit.value_or(unit)));
    });
}

} // namespace row_values

/// Adds the columns of rows.
/// @param before of the names: "overall" for "overall_p"   @param shape of the rows; none: a list
template <class Row>
void add_rows(Table& table, const std::vector<Row*>& all, const std::string& before = {},
              const std::optional<Table::Shape>& shape = std::nullopt)
{
    using S = std::remove_const_t<Row>;
    row_values::visit_values<S>(
        [&](const std::string& name, auto field, const std::string& unit, const FieldFacts&) {
            using T = row_values::TypeOf<decltype(field), const S>;
            const auto at = [&](std::size_t i) { return std::invoke(field, std::as_const(*all[i])); };
            row_values::add_column<T, false>(table, name, all.size(), at, shape, unit);
        },
        before);
}
template <class Row>
void add_rows(Table& table, const std::vector<Row>& all, const std::string& before = {})
{
    add_rows(table, pointers_to(all), before);
}

/// Reads into as many rows as there are. @throws InputError "FILE: is damaged" if the table was not written so
template <class Row>
void read_rows(const Table& table, const std::vector<Row*>& all, const std::string& before = {},
               const std::optional<Table::Shape>& shape = std::nullopt)
{
    row_values::visit_values<Row>(
        [&](const std::string& name, auto field, const std::string&, const FieldFacts&) {
            if constexpr (row_values::is_settable<decltype(field), Row>) {
                const auto to = [&](std::size_t i) -> auto&
                {
                    return std::invoke(field, *all[i]);
                };
                row_values::read_column<row_values::TypeOf<decltype(field), Row>, false>(table, name, all.size(), to,
                                                                                         shape);
            }
        },
        before);
}

/// As many rows as the column of this name has values. @throws InputError as `read_rows`
template <class Row>
std::vector<Row> rows_of(const Table& table, const std::string& column, const std::string& before = {})
{
    std::vector<Row> all(table.list_shape(column)[0]);
    read_rows(table, pointers_to(all), before);
    return all;
}

/// Adds the attributes and lists of a record. A list of which `FieldFacts::none` says what it means is left out where
/// it is empty.
template <class S>
void add_record(Table& table, const S& record)
{
    row_values::visit_values<S>(
        [&](const std::string& name, auto field, const std::string& unit, const FieldFacts& facts) {
            using T = row_values::TypeOf<decltype(field), const S>;
            const auto& value = std::invoke(field, record);
            if constexpr (row_values::is_list<T>) {
                if (!value.empty() || !facts.none)
                    row_values::add_column<typename T::value_type, false>(
                        table, name, value.size(), [&](std::size_t i) { return value[i]; }, std::nullopt, unit);
            } else if constexpr (std::is_same_v<T, bool>) {
                table.set(name, std::uint64_t{value});
            } else {
                table.set(name, row_values::stored<T>(value));
            }
        },
        "");
}

/// @throws InputError "FILE: is damaged" if the table was not written so
template <class S>
void read_record(const Table& table, S& record)
{
    row_values::visit_values<S>(
        [&](const std::string& name, auto field, const std::string&, const FieldFacts& facts) {
            if constexpr (row_values::is_settable<decltype(field), S>) {
                using T = row_values::TypeOf<decltype(field), S>;
                auto& value = std::invoke(field, record);
                if constexpr (row_values::is_list<T>) {
                    if (facts.none && !table.has(name))
                        return;
                    value.resize(table.list_shape(name)[0]);
                    row_values::read_column<typename T::value_type, false>(
                        table, name, value.size(), [&](std::size_t i) -> auto& { return value[i]; });
                } else if constexpr (std::is_same_v<T, bool>) {
                    value = table.count(name) != 0;
                } else {
                    row_values::restore(value, table.attribute<row_values::Stored<T>>(name), table);
                }
            }
        },
        "");
}

/// A table of the entries of lists that items have, with the number of each one's item in the column `row`.
/// @param list item -> its list
template <class Item, class List>
Table entries_table(const std::string& name, const std::vector<Item>& items, const List& list,
                    const std::string& row = "row")
{
    std::vector<std::int32_t> of;
    for (std::size_t i = 0; i < items.size(); ++i)
        of.insert(of.end(), std::invoke(list, items[i]).size(), static_cast<std::int32_t>(i));
    Table table(name);
    table.add(row, std::move(of));
    add_rows(table, pointers_to(items, list));
    return table;
}

/// Adds the entries of a table to the lists of their items. @throws InputError as `read_rows`, or of an entry of no
/// item
template <class Item, class List>
void read_entries(const Table& table, std::vector<Item>& items, const List& list, const std::string& row = "row")
{
    using Entry = typename row_values::TypeOf<List, Item>::value_type;
    const std::vector<std::int32_t>& of = table.integers(row, table.list_shape(row));
    std::vector<Entry> entries = rows_of<Entry>(table, row);
    for (std::size_t i = 0; i < of.size(); ++i) {
        if (of[i] < 0 || static_cast<std::size_t>(of[i]) >= items.size())
            table.refuse("'" + table.name() + "' has an entry of no row");
        std::invoke(list, items[static_cast<std::size_t>(of[i])]).push_back(std::move(entries[i]));
    }
}

// ---- items, which have lists ----------------------------------------------------------------------------------------

namespace row_values {

/// The entries of a field of an item: a list, what may be absent, or a structure that is always there.
template <class T>
std::vector<const T*> entries_of(const std::vector<T>& list)
{
    return pointers_to(list);
}
template <class T>
std::vector<const T*> entries_of(const std::optional<T>& part)
{
    return part ? std::vector<const T*>{&*part} : std::vector<const T*>{};
}
template <class T>
std::vector<const T*> entries_of(const T& part)
{
    return {&part};
}

/// @returns whether there is room for the entry
template <class T>
bool add_entry(std::vector<T>& list, T entry)
{
    list.push_back(std::move(entry));
    return true;
}
template <class T>
bool add_entry(std::optional<T>& part, T entry)
{
    return !std::exchange(part, std::move(entry)).has_value();
}
template <class T>
bool add_entry(T& part, T entry)
{
    part = std::move(entry);
    return true;
}

} // namespace row_values

/// Adds the columns of items, and the tables of their lists.
template <class Item>
void add_items(Table& table, const std::vector<const Item*>& items)
{
    if constexpr (row_values::is_value<Item>)
        row_values::add_column<Item, true>(table, "value", items.size(), [&](std::size_t i) { return *items[i]; });
    else
        visit_fields(std::type_identity<Item>(), [&](const char* name, auto field, const FieldFacts& = {}) {
            using Field = row_values::TypeOf<decltype(field), Item>;
            if constexpr (row_values::is_value<Field>) {
                row_values::add_column<Field, true>(table, name, items.size(),
                                                    [&](std::size_t i) { return std::invoke(field, *items[i]); });
            } else {
                std::vector<std::uint64_t> of;
                decltype(row_values::entries_of(std::invoke(field, *items[0]))) entries;
                for (std::size_t row = 0; row < items.size(); ++row)
                    for (const auto* entry : row_values::entries_of(std::invoke(field, *items[row]))) {
                        of.push_back(row);
                        entries.push_back(entry);
                    }
                Table below(name);
                below.add("row", std::move(of));
                add_items(below, entries);
                table.add(std::move(below));
            }
        });
}

/// @param version of the file: a field that it does not have yet is left as it is (`FieldFacts::since`)
/// @throws InputError "FILE: is damaged" if the table was not written so
template <class Item>
std::vector<Item> items_of(const Table& table, std::size_t n, std::uint64_t version)
{
    std::vector<Item> items(n);
    if constexpr (row_values::is_value<Item>)
        row_values::read_column<Item, true>(
            table, "value", n, [&](std::size_t i) -> auto& { return items[i]; });
    else
        visit_fields(std::type_identity<Item>(), [&](const char* name, auto field, const FieldFacts& facts = {}) {
            using Field = row_values::TypeOf<decltype(field), Item>;
            if (version < facts.since)
                return;
            if constexpr (row_values::is_value<Field>) {
                row_values::read_column<Field, true>(
                    table, name, n, [&](std::size_t i) -> auto& { return std::invoke(field, items[i]); });
            } else {
                using Entry = std::remove_cvref_t<decltype(*row_values::entries_of(std::invoke(field, items[0]))[0])>;
                const Table& below = table.table(name);
                const std::vector<std::uint64_t>& of = below.counts("row", below.list_shape("row"));
                std::vector<Entry> entries = items_of<Entry>(below, of.size(), version);
                for (std::size_t i = 0; i < of.size(); ++i)
                    if (of[i] >= n)
                        below.refuse(std::string("'") + name + "' has an entry of no row");
                    else if (!row_values::add_entry(std::invoke(field, items[of[i]]), std::move(entries[i])))
                        below.refuse(std::string("'") + name + "' has two of what may be there once");
            }
        });
    return items;
}

} // namespace stylobate
