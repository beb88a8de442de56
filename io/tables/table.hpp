#pragma once
/// A table as plain data: columns with a name and a unit, and what holds of the whole. `table_hdf5.hpp` writes it into
/// a results file and reads it back, `csv_text` writes it as comma-separated values.

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace stylobate {

/// Values with their intervals, row by row; NaN, all three, where the data do not determine one.
struct IntervalArray {
    std::vector<double> value, lower, upper;

    void add(double v, double low, double high)
    {
        value.push_back(v);
        lower.push_back(low);
        upper.push_back(high);
    }
};

class Table {
public:
    using Shape = std::vector<std::size_t>;
    using Values = std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::int32_t>,
                                std::vector<std::string>>;
    struct Column {
        std::string name;
        Values values;
        Shape shape;                         ///< of the array, which lies row by row
        std::string unit;                    ///< "" of a ratio, a count or a text
        std::vector<std::string> words = {}; ///< those that texts are taken from, where the file enumerates them
    };
    using Attribute = std::variant<std::string, double, std::uint64_t>;

    /// @param name  of its group in HDF5, and of its file without the ending
    /// @param file  that it was read from, for messages; else empty
    explicit Table(std::string name, std::string file = {}) : name_(std::move(name)), file_(std::move(file)) {}
    /// Without columns of its own.
    Table(std::string name, std::vector<Table> tables) : name_(std::move(name)), tables_(std::move(tables)) {}

    const std::string& name() const { return name_; }
    const std::vector<Column>& columns() const { return columns_; }
    const std::vector<std::pair<std::string, Attribute>>& attributes() const { return attributes_; }
    const std::vector<Table>& tables() const { return tables_; }
    bool empty() const { return columns_.empty() && attributes_.empty(); }

    void set(std::string name, Attribute value) { attributes_.emplace_back(std::move(name), std::move(value)); }
    /// @throws std::invalid_argument if the values do not fit the shape
    void add(std::string name, Values values, Shape shape, std::string unit = {});
    /// A list.
    void add(std::string name, Values values);
    /// NAME, NAME_lower, NAME_upper. @throws std::invalid_argument if the values do not fit the shape
    void add(const std::string& name, const IntervalArray& array, const Shape& shape);
    /// Texts that the file stores as an enumeration of these words.
    void add_words(std::string name, std::vector<std::string> texts, std::vector<std::string> words);
    /// Gives a column another name. @throws InputError "FILE: is damaged" if it is missing
    void rename(const std::string& column, std::string name);
    /// A table below this one.
    void add(Table below) { tables_.push_back(std::move(below)); }

    /// @name What a table that was read must have.
    /// @throws InputError "FILE: is damaged" if it is missing, or has another type or shape
    /// @{
    bool has(const std::string& column) const { return find(column) != nullptr; }
    const Shape& shape(const std::string& column) const;
    /// The shape of a column that is a list.
    const Shape& list_shape(const std::string& column) const;
    /// @tparam T double, std::uint64_t, std::int32_t or std::string
    template <class T>
    const std::vector<T>& values(const std::string& column, const Shape& shape) const;
    /// @tparam T std::string, double or std::uint64_t
    template <class T>
    const T& attribute(const std::string& name) const;
    const std::vector<double>& numbers(const std::string& column, const Shape& shape) const;
    const std::vector<std::uint64_t>& counts(const std::string& column, const Shape& shape) const;
    const std::vector<std::int32_t>& integers(const std::string& column, const Shape& shape) const;
    const std::vector<std::string>& texts(const std::string& column) const;
    IntervalArray intervals(const std::string& column, const Shape& shape) const;
    const std::string& text(const std::string& attribute) const;
    double number(const std::string& attribute) const;
    std::uint64_t count(const std::string& attribute) const;
    /// One of the tables below.
    const Table& table(const std::string& name) const;
    [[noreturn]] void refuse(const std::string& what) const;
    /// @}

private:
    const Column* find(const std::string& column) const;

    std::string name_, file_;
    std::vector<std::pair<std::string, Attribute>> attributes_;
    std::vector<Column> columns_;
    std::vector<Table> tables_;
};

/// Null if there is none of this name.
const Table* find_table(const std::vector<Table>& tables, const std::string& name);
/// @param file for messages   @throws InputError "FILE: is damaged" if there is no table of this name
const Table& table_named(const std::vector<Table>& tables, const std::string& name, const std::string& file);

// Comma-separated values as they are written: a header line, the unit in the column's name, numbers that read back bit
// by bit ("nan" and "inf" where they are not finite), texts in quotation marks where they need them (RFC 4180).

/// A text as a field, in quotation marks where it needs them. What is no UTF-8 is replaced. One that begins as a
/// formula does in a spreadsheet (=, +, -, @) has an apostrophe before it, so that the name of a file can start nothing
/// there.
std::string csv_field(std::string_view text);

/// One line of a table, field by field.
class CsvRow {
public:
    explicit CsvRow(std::string& text) : text_(text) {}
    ~CsvRow() { text_ += '\n'; }
    CsvRow(const CsvRow&) = delete;
    CsvRow& operator=(const CsvRow&) = delete;

    template <class Number>
    CsvRow& operator<<(Number value)
    {
        separate();
        // fmt's default for doubles is the shortest decimal that reads back as the same double.
        fmt::format_to(std::back_inserter(text_), "{}", value);
        return *this;
    }
    CsvRow& operator<<(std::string_view value)
    {
        separate();
        text_ += csv_field(value);
        return *this;
    }
    CsvRow& operator<<(const char* value) { return *this << std::string_view(value); }
    CsvRow& operator<<(const std::string& value) { return *this << std::string_view(value); }

private:
    void separate()
    {
        if (!first_)
            text_ += ',';
        first_ = false;
    }

    std::string& text_;
    bool first_ = true;
};

/// A table whose columns are lists of equal length. Its attributes are left out.
/// @throws std::invalid_argument if they are not
std::string csv_text(const Table& table);

// Tables of the Markdown pages that programs write, line by line.

enum class Align { left, numbers /*!< flush right, but for the first column */ };

/// The heading of a table and the rule under it.
/// @param columns their names, with '|' between them; a name may be empty
std::string markdown_head(std::string_view columns, Align align = Align::left);

/// One row.
/// @param cells formats with " | " between them, as `fmt::format` takes them
template <class... Values>
std::string markdown_row(fmt::format_string<Values...> cells, Values&&... values)
{
    return "| " + fmt::format(cells, std::forward<Values>(values)...) + " |\n";
}

} // namespace stylobate
