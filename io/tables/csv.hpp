#pragma once
/// Comma-separated values as they are written: a header line, the unit in the column's name, numbers that read back bit
/// by bit ("nan" and "inf" where they are not finite), texts in quotation marks where they need them (RFC 4180).

#include "io/tables/table.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace stylobate {

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

} // namespace stylobate
