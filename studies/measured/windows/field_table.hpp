#pragma once
/// Lists of structures as tables of an HDF5 file, written once for the writer and the reader.
///
/// Every list is a table: a group with a data set for each field of its items, one value an item. A list inside an item
/// is a table below the table of the item, whose column `row` is the item to which an entry belongs; a thing that may
/// be absent is a list of none or one. `visit_fields(std::type_identity<T>(), f)` calls f(name, &T::field) for each
/// field of T, in the order of the file; it and the words of enumerations stand beside the structures
/// (`diagnosis_fields.hpp`).

#include "io/files/hdf5.hpp"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate {

inline constexpr char row_column[] = "row";
inline constexpr char value_column[] = "value";

/// The version of a file from which on it has a list of these, which older ones leave out.
template <class Entry>
inline constexpr std::uint64_t since_version = 0;

/// The words of an enumeration in the file, in its order.
template <class E>
struct FieldWords;
template <>
struct FieldWords<bool> {
    static constexpr const char* words[] = {"no", "yes"};
};

template <class E>
hdf5::Handle word_type()
{
    std::vector<std::pair<const char*, std::uint8_t>> members;
    for (const char* word : FieldWords<E>::words)
        members.emplace_back(word, static_cast<std::uint8_t>(members.size()));
    return hdf5::byte_enumeration(members);
}

/// How a list is filled; what may be there once at most, or always, is a list too.
template <class T>
struct ListOf;
template <class T>
struct ListOf<std::vector<T>> {
    using Item = T;
    static void add(std::vector<T>& list, T item) { list.push_back(std::move(item)); }
};
template <class T>
struct ListOf<std::optional<T>> {
    using Item = T;
    static void add(std::optional<T>& list, T item)
    {
        if (list)
            throw hdf5::Error("there are two of what may be there once");
        list = std::move(item);
    }
};

template <class T>
inline constexpr bool is_value =
    std::is_same_v<T, std::string> || std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>> ||
    std::is_same_v<T, std::uint64_t> || std::is_same_v<T, int> || std::is_enum_v<T> || std::is_same_v<T, bool>;

template <class T, class F>
void for_each_item(const std::vector<T>& list, F f)
{
    for (const T& item : list)
        f(item);
}
template <class T, class F>
void for_each_item(const std::optional<T>& list, F f)
{
    if (list)
        f(*list);
}

/// @param at i -> the i-th value, i < n
template <class T, class At>
void write_column(hid_t group, const std::string& name, std::size_t n, At at)
{
    if constexpr (std::is_same_v<T, std::string>) {
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < n; ++i)
            texts.push_back(at(i));
        hdf5::write_texts(group, name, texts);
    } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(std::optional<double>(at(i)).value_or(std::numeric_limits<double>::quiet_NaN()));
        hdf5::write_array(group, name, values, {n}, "");
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        std::vector<std::uint64_t> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(at(i));
        hdf5::write_array(group, name, values, {n}, "");
    } else if constexpr (std::is_same_v<T, int>) {
        std::vector<std::int32_t> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(at(i));
        hdf5::write_array(group, name, values, {n}, "");
    } else {
        std::vector<std::uint8_t> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(static_cast<std::uint8_t>(at(i)));
        hdf5::write_bytes(group, name, word_type<T>().id(), values, {n});
    }
}

template <class T>
std::vector<T> read_column(hid_t group, const std::string& name, std::size_t n)
{
    std::vector<T> values;
    if constexpr (std::is_same_v<T, std::string>) {
        values = hdf5::read_texts(group, name, {n});
    } else if constexpr (std::is_same_v<T, double>) {
        values = hdf5::read_doubles(group, name, {n});
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
        for (const double value : hdf5::read_doubles(group, name, {n}))
            values.push_back(std::isnan(value) ? std::optional<double>() : value);
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        values = hdf5::read_counts(group, name, {n});
    } else if constexpr (std::is_same_v<T, int>) {
        values = hdf5::read_integers(group, name, {n});
    } else {
        for (const std::uint8_t value : hdf5::read_bytes(group, name, word_type<T>().id(), {n})) {
            if (value >= std::size(FieldWords<T>::words))
                throw hdf5::Error("'" + name + "' has a value that stands for nothing");
            values.push_back(static_cast<T>(value));
        }
    }
    return values;
}

/// @tparam Item of the items, a value or something with fields
template <class Item>
void write_table(hid_t group, const std::vector<const Item*>& items)
{
    if constexpr (is_value<Item>)
        write_column<Item>(group, value_column, items.size(), [&](std::size_t i) { return *items[i]; });
    else
        visit_fields(std::type_identity<Item>(), [&]<class Field>(const char* name, Field Item::*field) {
            if constexpr (is_value<Field>) {
                write_column<Field>(group, name, items.size(), [&](std::size_t i) { return items[i]->*field; });
            } else {
                using Entry = typename ListOf<Field>::Item;
                std::vector<std::uint64_t> rows;
                std::vector<const Entry*> entries;
                for (std::size_t row = 0; row < items.size(); ++row)
                    for_each_item(items[row]->*field, [&](const Entry& entry) {
                        rows.push_back(row);
                        entries.push_back(&entry);
                    });
                const hdf5::Handle below = hdf5::create_group(group, name);
                hdf5::write_array(below.id(), row_column, rows, {rows.size()}, "");
                write_table<Entry>(below.id(), entries);
            }
        });
}

/// @param version of the file: a field that it does not have yet is left as it is
template <class Item>
std::vector<Item> read_table(hid_t group, std::size_t n, std::uint64_t version)
{
    if constexpr (is_value<Item>) {
        return read_column<Item>(group, value_column, n);
    } else {
        std::vector<Item> items(n);
        visit_fields(std::type_identity<Item>(), [&]<class Field>(const char* name, Field Item::*field) {
            if constexpr (is_value<Field>) {
                std::vector<Field> values = read_column<Field>(group, name, n);
                for (std::size_t i = 0; i < n; ++i)
                    items[i].*field = std::move(values[i]);
            } else {
                using Entry = typename ListOf<Field>::Item;
                if (version < since_version<Entry>)
                    return;
                const hdf5::Handle below = hdf5::open_group(group, name);
                const hdf5::Dims dims = hdf5::dims_of(below.id(), row_column);
                if (dims.size() != 1)
                    throw hdf5::Error(std::string("the rows of '") + name + "' are not a list");
                const std::vector<std::uint64_t> rows = hdf5::read_counts(below.id(), row_column, dims);
                std::vector<Entry> entries = read_table<Entry>(below.id(), rows.size(), version);
                for (std::size_t i = 0; i < rows.size(); ++i) {
                    if (rows[i] >= n)
                        throw hdf5::Error(std::string("'") + name + "' has an entry of no row");
                    ListOf<Field>::add(items[rows[i]].*field, std::move(entries[i]));
                }
            }
        });
        return items;
    }
}

} // namespace stylobate
