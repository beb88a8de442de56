#include "studies/report/document.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {
namespace {

constexpr std::size_t widest_name = 34; ///< of facts: longer names do not push the others to the right

/// Columns as wide as their widest cell.
std::string console_table(const HtmlTable& table)
{
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const std::vector<Html>& cells) {
        std::vector<std::string>& row = rows.emplace_back();
        for (const Html& html : cells)
            row.push_back(plain_text(html));
    };
    add(table.head);
    for (const std::vector<Html>& row : table.rows)
        add(row);
    std::vector<std::size_t> widths;
    for (const std::vector<std::string>& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], characters(row[i]));
    }
    std::string out = table.caption.empty() ? "" : fmt::format("  {}\n", table.caption);
    for (const std::vector<std::string>& row : rows) {
        std::string line = " ";
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - characters(row[i]), ' ');
            line += i < table.align.size() && table.align[i] == 'r' ? " " + space + row[i] : " " + row[i] + space;
            line += i + 1 < row.size() ? " " : "";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

std::string console_facts(const std::vector<Html>& items)
{
    std::size_t width = 0;
    for (std::size_t i = 0; i + 1 < items.size(); i += 2)
        width = std::max(width, std::min(widest_name, characters(plain_text(items[i])) + 1));
    std::string out;
    for (std::size_t i = 0; i + 1 < items.size(); i += 2) {
        const std::string name = plain_text(items[i]) + ":";
        out += fmt::format("  {}{} {}\n", name, std::string(width - std::min(width, characters(name)), ' '),
                           plain_text(items[i + 1]));
    }
    return out;
}

/// Text with its lines, each after two blanks.
std::string indented(const std::string& text)
{
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += "  " + text.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return out;
}

/// @param width of the lines; 0: those of the text
std::string console_block(const DocumentBlock& b, std::size_t width)
{
    const auto lines = [&](const Html& text) {
        return width > 0 ? wrapped(plain_text(text), 2, width) : indented(plain_text(text));
    };
    using Kind = DocumentBlock::Kind;
    std::string out;
    switch (b.kind) {
    case Kind::section:
    case Kind::heading:
        return b.title + "\n";
    case Kind::answer:
    case Kind::paragraph:
    case Kind::note:
    case Kind::fold:
    case Kind::box: // its title says the same more briefly
        return lines(b.text);
    case Kind::list:
        for (const Html& item : b.items)
            out += lines("- " + plain_text(item));
        return out;
    case Kind::facts:
        return console_facts(b.items);
    case Kind::table:
        return console_table(b.table);
    case Kind::preformed:
        return indented(b.title);
    default: // no words
        break;
    }
    return out;
}

} // namespace

std::size_t characters(std::string_view text)
{
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width)
{
    std::string out(indent, ' ');
    std::size_t column = indent;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        begin = end + 1;
        if (word.empty())
            continue;
        if (column > indent && column + 1 + characters(word) > width) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        }
        out += (column > indent ? " " : "") + word;
        column += (column > indent ? 1 : 0) + characters(word);
    }
    return out + "\n";
}

std::string console_text(const Document& document, std::size_t width)
{
    std::string out = document.title().empty() ? "" : document.title() + "\n";
    std::size_t folds = 0; // what opens below a sentence is for a page
    for (const DocumentBlock& block : document.blocks()) {
        if (folds == 0)
            out += console_block(block, width);
        if (block.kind == DocumentBlock::Kind::fold)
            ++folds;
        else if (folds > 0 && block.kind == DocumentBlock::Kind::end && block.title == "details")
            --folds;
    }
    return out;
}

} // namespace stylobate
