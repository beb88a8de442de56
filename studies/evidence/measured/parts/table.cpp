#include "studies/evidence/measured/parts/table.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/csv_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace stylobate::measured {

Table::Table(const std::filesystem::path& file) : file_(file.string())
{
    const std::string content = csv_content(file, std::uint64_t{1} << 30);
    for_each_csv_line(content, [&](const CsvLine& line) {
        std::vector<std::string> cells(line.fields.begin(), line.fields.end());
        if (headings_.empty()) {
            headings_ = std::move(cells);
            return;
        }
        if (cells.size() != headings_.size())
            throw InputError(file_, line.number,
                             fmt::format("{} cells under {} headings", cells.size(), headings_.size()));
        rows_.push_back(std::move(cells));
        lines_.push_back(line.number);
    });
    if (headings_.empty())
        throw InputError(file_, 0, "is empty; a table with a line of headings is needed");
}

bool Table::has(const std::string& heading) const
{
    return std::find(headings_.begin(), headings_.end(), heading) != headings_.end();
}

std::size_t Table::column(const std::string& heading) const
{
    const auto found = std::find(headings_.begin(), headings_.end(), heading);
    if (found == headings_.end())
        throw InputError(file_, 1, fmt::format("there is no column '{}'", heading));
    return static_cast<std::size_t>(found - headings_.begin());
}

const std::string& Table::text(std::size_t row, const std::string& heading) const
{
    return rows_.at(row)[column(heading)];
}

double Table::number(std::size_t row, const std::string& heading) const
{
    const std::string& cell = text(row, heading);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size())
        throw InputError(file_, lines_[row], fmt::format("{} = '{}' is not a number", heading, cell));
    return value;
}

bool Table::flag(std::size_t row, const std::string& heading) const
{
    const double value = number(row, heading);
    if (value != 0 && value != 1)
        throw InputError(file_, lines_[row], fmt::format("{} = {} is neither 0 nor 1", heading, value));
    return value == 1;
}

} // namespace stylobate::measured
