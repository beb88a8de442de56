#pragma once
/// Rows of numbers in the files that keep what was simulated: with tabs between, as many digits as read back bit by
/// bit.

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace stylobate {

/// Without the end of the line.
inline std::string number_row(const std::vector<double>& numbers)
{
    std::string row;
    for (const double number : numbers)
        row += fmt::format("{}{:.17g}", row.empty() ? "" : "\t", number);
    return row;
}

/// Nothing: the line has something else.
inline std::optional<std::vector<double>> numbers_of_row(const std::string& line)
{
    std::vector<double> numbers;
    std::istringstream in(line);
    for (std::string part; std::getline(in, part, '\t');) {
        char* end = nullptr;
        numbers.push_back(std::strtod(part.c_str(), &end));
        if (end == part.c_str() || *end != '\0')
            return std::nullopt;
    }
    return numbers;
}

} // namespace stylobate
