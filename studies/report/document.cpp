#include "studies/report/document.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace stylobate {
namespace {

using Kind = DocumentBlock::Kind;

std::string ending_of_document(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending.empty() || ending == ".htm" ? ".html" : ending;
}

/// A cell of a table in Markdown.
std::string cell(const Html& html)
{
    std::string out;
    for (const char c : plain_text(html))
        out += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
    return out;
}

std::string markdown_table(const HtmlTable& table)
{
    std::size_t columns = table.head.size();
    for (const std::vector<Html>& row : table.rows)
        columns = std::max(columns, row.size());
    const auto line = [&](const std::vector<Html>& row) {
        std::string out = "|";
        for (std::size_t i = 0; i < columns; ++i)
            out += fmt::format(" {} |", i < row.size() ? cell(row[i]) : "");
        return out + "\n";
    };
    std::string out = table.caption.empty() ? "" : table.caption + ":\n\n";
    out += line(table.head) + "|";
    for (std::size_t i = 0; i < columns; ++i)
        out += i < table.align.size() && table.align[i] == 'r' ? "---:|" : "---|";
    out += "\n";
    for (const std::vector<Html>& row : table.rows)
        out += line(row);
    return out + "\n";
}

std::string markdown_block(const DocumentBlock& b)
{
    std::string out;
    switch (b.kind) {
    case Kind::section:
        return fmt::format("## {}\n\n", b.title);
    case Kind::heading:
        return fmt::format("### {}\n\n", b.title);
    case Kind::answer:
        return fmt::format("**{}**\n\n", plain_text(b.text));
    case Kind::paragraph:
    case Kind::note:
    case Kind::fold:
        return plain_text(b.text) + "\n\n";
    case Kind::box:
        return fmt::format("> **{}**\n>\n> {}\n\n", b.title, plain_text(b.text));
    case Kind::list:
        for (const Html& item : b.items)
            out += fmt::format("- {}\n", plain_text(item));
        return out + "\n";
    case Kind::facts:
        for (std::size_t i = 0; i + 1 < b.items.size(); i += 2)
            out += fmt::format("- {}: {}\n", plain_text(b.items[i]), plain_text(b.items[i + 1]));
        return out + "\n";
    case Kind::table:
        return markdown_table(b.table);
    case Kind::preformed:
        return fmt::format("```\n{}{}```\n\n", b.title, b.title.ends_with('\n') ? "" : "\n");
    case Kind::figure:
        return b.items.empty() || b.items[0].markup.empty() ? ""
                                                            : fmt::format("Figure: {}\n\n", plain_text(b.items[0]));
    case Kind::contents:
    case Kind::part:
    case Kind::end:
    case Kind::data:
    case Kind::player:
        break;
    }
    return out;
}

Json text_list(const std::vector<Html>& texts)
{
    Json list = Json::list();
    for (const Html& text : texts)
        list.item(plain_text(text));
    return list;
}

/// @returns nullopt of what has no words
std::optional<Json> block_json(const DocumentBlock& b)
{
    Json json = Json::object();
    switch (b.kind) {
    case Kind::heading:
        return json.member("kind", "heading").member("text", b.title);
    case Kind::answer:
    case Kind::paragraph:
    case Kind::note:
    case Kind::fold:
        return json.member("kind", b.kind == Kind::answer ? "answer"
                                   : b.kind == Kind::note ? "note"
                                                          : "paragraph")
            .member("text", plain_text(b.text));
    case Kind::box:
        return json.member("kind", "box")
            .member("tone", b.tone)
            .member("title", b.title)
            .member("text", plain_text(b.text));
    case Kind::list:
        return json.member("kind", "list").member("items", text_list(b.items));
    case Kind::facts: {
        Json rows = Json::list();
        for (std::size_t i = 0; i + 1 < b.items.size(); i += 2)
            rows.item(text_list({b.items[i], b.items[i + 1]}));
        return json.member("kind", "facts").member("rows", rows);
    }
    case Kind::table: {
        Json rows = Json::list();
        for (const std::vector<Html>& row : b.table.rows)
            rows.item(text_list(row));
        return json.member("kind", "table")
            .member("caption", b.table.caption)
            .member("head", text_list(b.table.head))
            .member("rows", rows);
    }
    case Kind::preformed:
        return json.member("kind", "preformed").member("text", b.title);
    case Kind::figure:
        return json.member("kind", "figure").member("caption", b.items.empty() ? "" : plain_text(b.items[0]));
    default:
        return std::nullopt;
    }
}

} // namespace

std::string plain_text(const Html& html)
{
    std::string out;
    std::string_view rest = html.markup;
    while (!rest.empty()) {
        if (rest.front() == '<') {
            const std::size_t end = std::min(rest.find('>'), rest.size() - 1);
            const std::string_view element = rest.substr(0, end + 1);
            if (element == "<code>" || element == "</code>")
                out += '`';
            else if (element.starts_with("<svg") || element.starts_with("<script")) { // no words
                const std::string_view close = element.starts_with("<svg") ? "</svg>" : "</script>";
                const std::size_t after = rest.find(close);
                rest.remove_prefix(after == std::string_view::npos ? rest.size() : after + close.size());
                continue;
            }
            rest.remove_prefix(end + 1);
            continue;
        }
        bool found = false;
        constexpr std::pair<std::string_view, std::string_view> entities[] = {
            {"&amp;", "&"}, {"&lt;", "<"},   {"&gt;", ">"},   {"&quot;", "\""},
            {"&#39;", "'"}, {"&nbsp;", " "}, {"&ensp;", " "}, {"\xc2\xa0", " "}};
        for (const auto& [entity, text] : entities)
            if (rest.starts_with(entity)) {
                out += text;
                rest.remove_prefix(entity.size());
                found = true;
                break;
            }
        if (!found) {
            out += rest.front();
            rest.remove_prefix(1);
        }
    }
    return out;
}

Document::Document(std::string title, std::string subtitle) : title_(std::move(title)), subtitle_(std::move(subtitle))
{
}

void Document::section(const std::string& title)
{
    blocks_.push_back({Kind::section, title});
}

void Document::heading(const std::string& title)
{
    blocks_.push_back({Kind::heading, title});
}

void Document::contents()
{
    blocks_.push_back({Kind::contents});
}

void Document::answer(const Html& sentence)
{
    blocks_.push_back({Kind::answer, "", "", sentence});
}

void Document::paragraph(const Html& text)
{
    blocks_.push_back({Kind::paragraph, "", "", text});
}

void Document::note(const Html& text)
{
    blocks_.push_back({Kind::note, "", "", text});
}

void Document::box(const std::string& tone, const std::string& title, const Html& text)
{
    blocks_.push_back({Kind::box, title, tone, text});
}

void Document::list(const std::vector<Html>& items)
{
    blocks_.push_back({Kind::list, "", "", {}, items});
}

void Document::facts(const std::vector<std::pair<std::string, Html>>& facts)
{
    DocumentBlock block{Kind::facts};
    for (const auto& [name, what] : facts) {
        block.items.emplace_back(name);
        block.items.push_back(what);
    }
    blocks_.push_back(std::move(block));
}

void Document::table(const HtmlTable& table)
{
    blocks_.push_back({Kind::table, "", "", {}, {}, table});
}

void Document::block(std::string_view text)
{
    blocks_.push_back({Kind::preformed, std::string(text)});
}

void Document::figure(const Html& picture, const Html& caption)
{
    blocks_.push_back({Kind::figure, "", "", picture, {caption}});
}

void Document::details(const Html& sentence, const std::function<void()>& more)
{
    blocks_.push_back({Kind::fold, "", "", sentence});
    more();
    blocks_.push_back({Kind::end, "details"});
}

void Document::part(std::string_view name, const std::function<void()>& more)
{
    blocks_.push_back({Kind::part, std::string(name)});
    more();
    blocks_.push_back({Kind::end, "div"});
}

void Document::data(std::string_view id, std::string_view json)
{
    blocks_.push_back({Kind::data, std::string(id), "", Html::ready(std::string(json))});
}

void Document::player()
{
    blocks_.push_back({Kind::player});
}

std::string markdown_of(const Document& document)
{
    std::string out = fmt::format("# {}\n\n{}\n\n", document.title(), document.subtitle());
    for (const DocumentBlock& block : document.blocks())
        out += markdown_block(block);
    while (out.ends_with("\n\n"))
        out.pop_back();
    return out;
}

Json json_of(const Document& document)
{
    Json sections = Json::list(), blocks = Json::list();
    std::string title;
    const auto close = [&] { sections.item(Json::object().member("title", title).member("blocks", blocks)); };
    for (const DocumentBlock& block : document.blocks()) {
        if (block.kind == Kind::section) {
            close();
            title = block.title;
            blocks = Json::list();
        } else if (const std::optional<Json> json = block_json(block)) {
            blocks.item(*json);
        }
    }
    close();
    return Json::object()
        .member("title", document.title())
        .member("subtitle", document.subtitle())
        .member("sections", sections);
}

bool is_page_name(const std::filesystem::path& file)
{
    return ending_of_document(file) == ".html";
}

void check_document_ending(const std::filesystem::path& file)
{
    const std::string ending = ending_of_document(file);
    if (ending != ".html" && ending != ".md" && ending != ".json")
        throw InputError(fmt::format("-o {}: a report is written as HTML, Markdown or JSON.\n  Give a name with .html, "
                                     ".md or .json; a browser can print the page to PDF.",
                                     file.string()));
}

std::string document_as(const Document& document, const std::filesystem::path& file)
{
    check_document_ending(file);
    const std::string ending = ending_of_document(file);
    return ending == ".md"     ? markdown_of(document)
           : ending == ".json" ? json_of(document).text() + "\n"
                               : html_of(document);
}

} // namespace stylobate
