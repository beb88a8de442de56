#include "studies/evidence/measured/parts/table.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace stylobate::measured {

namespace {

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else if (c != '\r')
            cells.back() += c;
    }
    return cells;
}

long line_of(std::size_t row)
{
    return static_cast<long>(row) + 2;
}

} // namespace

Table::Table(const std::filesystem::path& file) : file_(file.string())
{
    std::ifstream in(file);
    std::string line;
    if (!in || !std::getline(in, line))
        throw InputError(file_, 0, "cannot be read, or is empty; a table with a line of headings is needed");
    headings_ = cells_of(line);
    while (std::getline(in, line)) {
        if (line.empty())
            continue;
        rows_.push_back(cells_of(line));
        if (rows_.back().size() != headings_.size())
            throw InputError(file_, line_of(rows_.size() - 1),
                             fmt::format("{} cells under {} headings", rows_.back().size(), headings_.size()));
    }
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
        throw InputError(file_, line_of(row), fmt::format("{} = '{}' is not a number", heading, cell));
    return value;
}

bool Table::flag(std::size_t row, const std::string& heading) const
{
    const double value = number(row, heading);
    if (value != 0 && value != 1)
        throw InputError(file_, line_of(row), fmt::format("{} = {} is neither 0 nor 1", heading, value));
    return value == 1;
}

} // namespace stylobate::measured
