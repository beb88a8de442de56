#pragma once
/// A comma-separated table with one line of headings, as measured data come in.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::measured {

class Table {
public:
    /// @throws InputError if the file cannot be read, is empty, or has a line with more or fewer cells than headings
    explicit Table(const std::filesystem::path& file);

    std::size_t rows() const { return rows_.size(); }
    bool has(const std::string& heading) const;
    /// @throws InputError naming the file, the line and the heading: no such heading, or no number in the cell
    const std::string& text(std::size_t row, const std::string& heading) const;
    double number(std::size_t row, const std::string& heading) const;
    /// 0 or 1.
    bool flag(std::size_t row, const std::string& heading) const;

private:
    std::size_t column(const std::string& heading) const;

    std::string file_;
    std::vector<std::string> headings_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<long> lines_; ///< of the file, by row
};

} // namespace stylobate::measured
