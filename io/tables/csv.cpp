#include "io/tables/csv.hpp"

#include "io/files/utf8.hpp"

#include <stdexcept>

namespace stylobate {

std::string csv_field(std::string_view value)
{
    std::string text = replaced_text(value);
    if (!text.empty() && std::string_view("=+-@\t").find(text[0]) != std::string_view::npos)
        text.insert(0, "'");
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out.append(c == '"' ? 2 : 1, c);
    return out + '"';
}

std::string csv_text(const Table& table)
{
    std::string text;
    const std::size_t rows = table.columns().empty() ? 0 : table.columns().front().shape.at(0);
    {
        CsvRow head(text);
        for (const Table::Column& column : table.columns()) {
            if (column.shape != Table::Shape{rows})
                throw std::invalid_argument("the columns of '" + table.name() + "' are not lists of equal length");
            head << column.name;
        }
    }
    for (std::size_t i = 0; i < rows; ++i) {
        CsvRow line(text);
        for (const Table::Column& column : table.columns())
            std::visit([&](const auto& values) { line << values[i]; }, column.values);
    }
    return text;
}

} // namespace stylobate
