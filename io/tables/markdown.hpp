#pragma once
/// Tables of the Markdown pages that programs write, line by line.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace stylobate {

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
