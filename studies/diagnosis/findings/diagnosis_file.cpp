#include "studies/diagnosis/findings/diagnosis_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/store/result_seal.hpp"
#include "studies/diagnosis/findings/diagnosis_fields.hpp"

#include <cmath>
#include <limits>
#include <system_error>
#include <type_traits>

/// Every list of the diagnosis is a table: a group with a data set for each field of its items, one value an item. The
/// diagnosis itself is a table of one item, the root. A list inside an item is a table below the table of the item,
/// whose column `row` says to which item an entry belongs; a thing that may be absent is a list of none or one.
namespace stylobate {
namespace {

constexpr char format_name[] = "stylobate-diagnosis";
constexpr std::uint64_t format_version = 2; // 2: spans in figures
constexpr char row_column[] = "row";
constexpr char value_column[] = "value";

/// Words of an enumeration in the file, in its order.
template <class E>
struct Words;
template <>
struct Words<Verdict> {
    static constexpr const char* words[] = {"none", "named", "unexplained"};
};
template <>
struct Words<TestOutcome> {
    static constexpr const char* words[] = {"passed", "failed", "not_judged"};
};
template <>
struct Words<Decision> {
    static constexpr const char* words[] = {"named", "in_set", "rejected", "not_judged"};
};
template <>
struct Words<SeriesKind> {
    static constexpr const char* words[] = {"line", "points", "band", "bars", "spans"};
};
template <>
struct Words<FigurePlace> {
    static constexpr const char* words[] = {"verdict",    "data",        "baseline", "wrong",
                                            "candidates", "unexplained", "gain",     "next_test"};
};
template <>
struct Words<bool> {
    static constexpr const char* words[] = {"no", "yes"};
};

template <class E>
hdf5::Handle word_type()
{
    std::vector<std::pair<const char*, std::uint8_t>> members;
    for (const char* word : Words<E>::words)
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
template <>
struct ListOf<DiagnosisCost> {
    using Item = DiagnosisCost;
    static void add(DiagnosisCost& part, DiagnosisCost item) { part = std::move(item); }
};

template <class T>
constexpr bool is_value =
    std::is_same_v<T, std::string> || std::is_same_v<T, double> || std::is_same_v<T, MaybeReal> ||
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
template <class F>
void for_each_item(const DiagnosisCost& part, F f)
{
    f(part);
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
    } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, MaybeReal>) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(MaybeReal(at(i)).value_or(std::numeric_limits<double>::quiet_NaN()));
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
    } else if constexpr (std::is_same_v<T, MaybeReal>) {
        for (const double value : hdf5::read_doubles(group, name, {n}))
            values.push_back(std::isnan(value) ? MaybeReal() : value);
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        values = hdf5::read_counts(group, name, {n});
    } else if constexpr (std::is_same_v<T, int>) {
        values = hdf5::read_integers(group, name, {n});
    } else {
        for (const std::uint8_t value : hdf5::read_bytes(group, name, word_type<T>().id(), {n})) {
            if (value >= std::size(Words<T>::words))
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

template <class Item>
std::vector<Item> read_table(hid_t group, std::size_t n)
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
                const hdf5::Handle below = hdf5::open_group(group, name);
                const hdf5::Dims dims = hdf5::dims_of(below.id(), row_column);
                if (dims.size() != 1)
                    throw hdf5::Error(std::string("the rows of '") + name + "' are not a list");
                const std::vector<std::uint64_t> rows = hdf5::read_counts(below.id(), row_column, dims);
                std::vector<Entry> entries = read_table<Entry>(below.id(), rows.size());
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

struct OpenDiagnosis {
    FileHandle handle;
    hdf5::Handle hdf5;
};

[[noreturn]] void refuse_damaged(const std::filesystem::path& file, const std::string& text)
{
    throw InputError(file.string(), 0, "is damaged: " + text + ". Use a backup copy, or run the diagnosis again.");
}

/// Its seal verified. @throws InputError
OpenDiagnosis open_sealed(const std::filesystem::path& file)
{
    OpenDiagnosis open;
    open.handle = FileHandle::open(file, false);
    check_seal(open.handle, file.string());
    try {
        open.hdf5 = hdf5::open_file(file, false);
    } catch (const hdf5::Error& error) {
        refuse_damaged(file, error.what());
    }
    return open;
}

} // namespace

void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file)
{
    AtomicFile target(file);
    try {
        const std::uint64_t block = seal_bytes(0);
        hdf5::Handle made = hdf5::create_file(target.temporary(), block);
        hdf5::write_text(made.id(), "format", format_name);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format_version);
        hdf5::write_text(made.id(), "kind", "diagnosis");
        hdf5::write_text(made.id(), "code_version", diagnosis.code_version);
        write_table<Diagnosis>(made.id(), {&diagnosis});
        made.close();
        FileHandle handle = FileHandle::open(target.temporary(), true);
        write_seal(handle, block, {});
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    } catch (const std::system_error& error) {
        throw InputError(file.string(), 0, "cannot be written: " + error.code().message());
    }
    target.commit();
}

Diagnosis read_diagnosis(const std::filesystem::path& file)
{
    const OpenDiagnosis open = open_sealed(file);
    try {
        const hid_t root = open.hdf5.id();
        if (hdf5::read_text(root, "format") != format_name)
            throw InputError(file.string(), 0, "contains no diagnosis, but the results of a study");
        if (const std::uint64_t version = hdf5::read_number(root, "format_version"); version != format_version)
            throw InputError(file.string(), 0,
                             "is a diagnosis of format version " + std::to_string(version) +
                                 "; this program reads version " + std::to_string(format_version) +
                                 ". Read it with the version that wrote it, or run the diagnosis again.");
        return std::move(read_table<Diagnosis>(root, 1).front());
    } catch (const hdf5::Error& error) {
        refuse_damaged(file, error.what());
    }
}

} // namespace stylobate
