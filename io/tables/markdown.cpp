#include "io/tables/markdown.hpp"

#include <algorithm>
#include <cstddef>

namespace stylobate {

std::string markdown_head(std::string_view columns, Align align)
{
    std::string head = "|", rule = "|";
    for (std::size_t begin = 0; begin <= columns.size();) {
        const std::size_t end = std::min(columns.find('|', begin), columns.size());
        std::string_view name = columns.substr(begin, end - begin);
        while (name.starts_with(' '))
            name.remove_prefix(1);
        while (name.ends_with(' '))
            name.remove_suffix(1);
        head += ' ';
        head += name;
        head += name.empty() ? "|" : " |";
        rule += align == Align::numbers ? "---:|" : "---|";
        begin = end + 1;
    }
    if (align == Align::numbers)
        rule.replace(1, 5, "---|");
    return head + '\n' + rule + '\n';
}

} // namespace stylobate
