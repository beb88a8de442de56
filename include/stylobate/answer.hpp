#pragma once
/// What comparisons, risk estimates and pasts have in common: text, JSON, tables, a file, a picture.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stylobate::api {

/// One column of a table.
struct Column {
    std::string name; ///< with its unit where it has one of length, time and so on: "pga_m_s2"
    std::string unit; ///< "1/year"; "" where there is none, and where the name has it
    std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::int32_t>, std::vector<std::string>>
        values;
    std::vector<std::size_t> shape; ///< of the values, which lie row by row
};

/// Columns, and what holds of the whole. A number with an interval has the columns NAME, NAME_lower and NAME_upper.
struct Table {
    std::string name;
    std::vector<std::pair<std::string, std::variant<std::string, double, std::uint64_t>>> attributes;
    std::vector<Column> columns;

    /// @throws std::out_of_range if there is no such column
    const Column& column(const std::string& name) const;
    /// Its values as real numbers. @throws std::out_of_range if there is no such column, or if it contains texts
    std::vector<double> numbers(const std::string& column) const;
    /// @throws std::out_of_range if there is no such column, or if it contains numbers
    const std::vector<std::string>& texts(const std::string& column) const;
};

/// A copy is cheap.
class Answer {
public:
    std::string text() const; ///< what the command line prints, without the names of its files
    std::string json() const; ///< what the command line prints with --json, without the names of its files
    /// The numbers that are asked for, a row each; the columns are described at each answer.
    const Table& rows() const;
    /// All tables (io/FORMAT.md).
    const std::vector<Table>& tables() const;
    /// @throws std::out_of_range if there is no such table
    const Table& table(const std::string& name) const;

    /// Writes the file of the command line, which `stylobate report` and `export` accept, whole or not at all. A file
    /// that is there is replaced.
    /// @throws InputError if it cannot be written, and of a past, which has no file
    void write(const std::filesystem::path& file) const;
    /// Draws the picture of `stylobate export`: .png, .svg or .pdf. A file that is there is replaced.
    /// @param limit_state nullopt: the principal one
    /// @throws InputError for another ending, for no such limit state, or if the picture cannot be drawn
    void draw(const std::filesystem::path& picture, const std::optional<std::string>& limit_state = {}) const;

protected:
    struct Data;
    friend struct Inside;
    explicit Answer(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

} // namespace stylobate::api
