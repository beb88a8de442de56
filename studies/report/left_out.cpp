#include "studies/report/left_out.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

/// How many times as often the round column of docs/space.md falls under both components as in the plane, rounded: at
/// 4 m/s² and at 3 m/s². test_left_out compares it with the page.
constexpr const char* times_as_often = "two to four times";
constexpr const char* at_pga = "3 to 4 m/s²";

std::optional<int> dimensions_of(const std::string& study_toml)
{
    try {
        return parse_study(study_toml, "study").structure.dimensions;
    } catch (const InputError&) { // of another version
        return std::nullopt;
    }
}

/// The cells of "| a | b |", without the blanks at their ends.
std::vector<Html> markdown_cells(std::string_view line)
{
    std::vector<Html> cells;
    line.remove_prefix(1);
    for (std::size_t end = line.find('|'); end != std::string_view::npos; end = line.find('|')) {
        std::string_view cell = line.substr(0, end);
        cell.remove_prefix(std::min(cell.find_first_not_of(' '), cell.size()));
        cell.remove_suffix(cell.size() - (cell.find_last_not_of(' ') + 1));
        cells.emplace_back(cell);
        line.remove_prefix(end + 1);
    }
    return cells;
}

} // namespace

std::string left_out_text(int dimensions)
{
    if (dimensions == 3)
        return "The model in space ends each realization with its first fall and computes no contacts beside the beds; "
               "with dashpots spread over the contact it loses less energy in an impact than rigid bodies do "
               "(docs/space.md).";
    return fmt::format("The plane leaves out the second horizontal component of the shaking and the round face of the "
                       "drums: with both, a column of six drums fell {} as often at a PGA of {} (docs/space.md).",
                       times_as_often, at_pga);
}

std::string left_out_text(const Study& study)
{
    return left_out_text(study.structure.dimensions);
}

std::optional<std::string> left_out_text_of(const std::string& study_toml)
{
    const std::optional<int> dimensions = dimensions_of(study_toml);
    return dimensions ? std::optional(left_out_text(*dimensions)) : std::nullopt;
}

HtmlTable left_out_evidence()
{
    HtmlTable table;
    std::string_view text = space_evidence();
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("|--"))
            table.align = "l" + std::string(table.head.size() - 1, 'r');
        else if (line.starts_with('|'))
            (table.head.empty() ? table.head : table.rows.emplace_back()) = markdown_cells(line);
        else if (!table.head.empty())
            break; // below the table
        else if (!line.empty())
            table.caption = line.substr(0, line.find_last_not_of(':') + 1);
    }
    return table;
}

void add_left_out(Document& page, int dimensions)
{
    page.details(left_out_text(dimensions), [&] {
        page.table(left_out_evidence());
        page.note("Six round drums, or square ones, 1 m wide and 6 m high in all; friction 0.7; noise of about 2 Hz; "
                  "the second component has 0.8 of the PGA of the first.");
    });
}

void add_left_out_of(Document& page, const std::string& study_toml)
{
    if (const std::optional<int> dimensions = dimensions_of(study_toml))
        add_left_out(page, *dimensions);
}

} // namespace stylobate
