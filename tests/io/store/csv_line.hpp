#pragma once
/// One line of a comma-separated table.

#include <string>
#include <vector>

namespace stylobate {

/// Its cells; commas between quotation marks belong to a cell, the marks do not.
inline std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

} // namespace stylobate
