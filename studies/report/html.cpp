#include "studies/report/html.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/utf8.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace stylobate {
namespace {

constexpr char style[] = R"css(
:root { --ink: #1f2933; --soft: #5a6672; --line: #d5dbe1; --pale: #f4f6f8; --accent: #1f5673; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink);
  font: 15px/1.5 "Source Sans 3", "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
main { max-width: 62rem; margin: 0 auto; padding: 2.2rem 1.6rem 3rem; }
header { border-bottom: 2px solid var(--ink); margin-bottom: 1.2rem; padding-bottom: .8rem; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .3rem; font-weight: 600; overflow-wrap: anywhere; }
header p { margin: 0; color: var(--soft); overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; font-weight: 600; margin: 2.2rem 0 .7rem; padding-bottom: .2rem; color: var(--accent);
  border-bottom: 1px solid var(--line); }
h3 { font-size: 1rem; font-weight: 600; margin: 1.3rem 0 .4rem; }
p { margin: .5rem 0; }
nav { font-size: .88rem; color: var(--soft); margin-bottom: 1rem; }
nav a { color: var(--accent); text-decoration: none; margin-right: 1.1em; white-space: nowrap; }
.note { font-size: .88rem; color: var(--soft); }
.box { border-left: 5px solid; padding: .8rem 1.1rem; margin: 1.2rem 0; background: var(--pale); }
.box strong { display: block; font-size: 1.15rem; font-weight: 600; }
.box p { margin: .3rem 0 0; }
.good { border-color: #2f7d5b; } .warn { border-color: #c98a1b; } .bad { border-color: #b23a3a; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .7rem 0; font-size: .88rem; line-height: 1.4; }
caption { text-align: left; color: var(--soft); padding-bottom: .3rem; }
th { font-weight: 600; text-align: left; vertical-align: bottom; border-bottom: 1.5px solid var(--ink); }
th, td { padding: .26rem .9rem .26rem 0; }
td { vertical-align: top; border-bottom: 1px solid var(--line); overflow-wrap: break-word; }
td:last-child, th:last-child { padding-right: .2rem; }
.n { white-space: nowrap; }
.r { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.c { text-align: center; font-variant-numeric: tabular-nums; }
.facts td:first-child { color: var(--soft); white-space: nowrap; padding-right: 1.6rem; }
small { color: var(--soft); font-size: .82em; }
code, pre { font-family: "DejaVu Sans Mono", "Liberation Mono", Menlo, Consolas, monospace; font-size: .82rem; }
code { overflow-wrap: anywhere; }
pre { background: var(--pale); border: 1px solid var(--line); padding: .7rem .9rem; line-height: 1.4;
  white-space: pre-wrap; overflow-wrap: anywhere; }
figure { margin: 1rem 0 1.3rem; }
figure img, figure svg { display: block; max-width: 100%; height: auto; }
figcaption { font-size: .88rem; color: var(--soft); margin-top: .4rem; }
figcaption b { color: var(--ink); font-weight: 600; }
.tag { display: inline-block; padding: 0 .5em; border-radius: 3px; border: 1px solid var(--line); font-size: .8rem;
  white-space: nowrap; }
.tag.good { background: #e3f1ea; } .tag.warn { background: #fbf1dc; } .tag.bad { background: #f7e3e3; }
footer { margin-top: 2.5rem; padding-top: .6rem; border-top: 1px solid var(--line); color: var(--soft);
  font-size: .82rem; }
@page { margin: 16mm 15mm; }
@media print {
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  nav { display: none; }
  h2, h3, caption { break-after: avoid; }
  figure, .box, tr { break-inside: avoid; }
  .wide { overflow: visible; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
)css";

std::string cells(const HtmlTable& table, const std::vector<Html>& row, const char* tag)
{
    std::string out = "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
        const char align = i < table.align.size() ? table.align[i] : 'l';
        out += fmt::format("<{0}{1}>{2}</{0}>", tag, align == 'l' ? "" : fmt::format(" class=\"{}\"", align),
                           row[i].markup);
    }
    return out + "</tr>\n";
}

} // namespace

std::string html_escaped(std::string_view text)
{
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const char c = text[0];
        if (length > 1)
            out += text.substr(0, length);
        else if (length == 0 || c == 0x7f || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'))
            out += "\xef\xbf\xbd";
        else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += c;
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

Html code(std::string_view text)
{
    return Html::ready("<code>" + html_escaped(text) + "</code>");
}

Html tag(std::string_view tone, std::string_view text)
{
    return Html::ready(fmt::format("<span class=\"tag {}\">{}</span>", tone, html_escaped(text)));
}

Html::Html(std::string_view text) : markup(html_escaped(text)) {}

Html Html::ready(std::string markup)
{
    Html html;
    html.markup = std::move(markup);
    return html;
}

Html& Html::operator+=(const Html& more)
{
    markup += more.markup;
    return *this;
}

HtmlPage::HtmlPage(std::string title, std::string subtitle) : title_(std::move(title)), subtitle_(std::move(subtitle))
{
}

void HtmlPage::section(const std::string& title)
{
    ++sections_;
    contents_ += fmt::format("<a href=\"#s{0}\">{0}&nbsp;{1}</a> ", sections_, html_escaped(title));
    body_ += fmt::format("<h2 id=\"s{0}\">{0}&ensp;{1}</h2>\n", sections_, html_escaped(title));
}

void HtmlPage::heading(const std::string& title)
{
    body_ += "<h3>" + html_escaped(title) + "</h3>\n";
}

void HtmlPage::paragraph(const Html& text)
{
    body_ += "<p>" + text.markup + "</p>\n";
}

void HtmlPage::note(const Html& text)
{
    body_ += "<p class=\"note\">" + text.markup + "</p>\n";
}

void HtmlPage::box(const std::string& tone, const std::string& title, const Html& text)
{
    body_ += fmt::format("<div class=\"box {}\"><strong>{}</strong><p>{}</p></div>\n", tone, html_escaped(title),
                         text.markup);
}

void HtmlPage::list(const std::vector<Html>& items)
{
    body_ += "<ul>\n";
    for (const Html& item : items)
        body_ += "<li>" + item.markup + "</li>\n";
    body_ += "</ul>\n";
}

void HtmlPage::facts(const std::vector<std::pair<std::string, Html>>& facts)
{
    body_ += "<table class=\"facts\">\n";
    for (const auto& [name, what] : facts)
        body_ += "<tr><td>" + html_escaped(name) + "</td><td>" + what.markup + "</td></tr>\n";
    body_ += "</table>\n";
}

void HtmlPage::table(const HtmlTable& table)
{
    body_ += "<div class=\"wide\"><table>\n";
    if (!table.caption.empty())
        body_ += "<caption>" + html_escaped(table.caption) + "</caption>\n";
    if (!table.head.empty())
        body_ += "<thead>" + cells(table, table.head, "th") + "</thead>\n";
    body_ += "<tbody>\n";
    for (const std::vector<Html>& row : table.rows)
        body_ += cells(table, row, "td");
    body_ += "</tbody></table></div>\n";
}

void HtmlPage::block(std::string_view text)
{
    body_ += "<pre>" + html_escaped(text) + "</pre>\n";
}

void HtmlPage::figure(const Html& picture, const Html& caption)
{
    body_ += "<figure>" + picture.markup;
    if (!caption.markup.empty())
        body_ += "<figcaption>" + caption.markup + "</figcaption>";
    body_ += "</figure>\n";
}

std::string HtmlPage::text() const
{
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n"
                       "<header><h1>{0}</h1><p>{2}</p></header>\n<nav>{3}</nav>\n{4}"
                       "<footer>Generated by stylobate {5}.</footer>\n</main>\n</body>\n</html>\n",
                       html_escaped(title_), style, html_escaped(subtitle_), contents_, body_,
                       html_escaped(code_version()));
}

std::string base64(std::string_view bytes)
{
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= n ? letters[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

Html png_image(const std::filesystem::path& png, std::string_view alternative)
{
    std::ifstream in(png, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in || bytes.empty())
        throw InputError(png.string(), 0, "cannot be read");
    return Html::ready("<img alt=\"" + html_escaped(alternative) + "\" src=\"data:image/png;base64," + base64(bytes) +
                       "\">");
}

} // namespace stylobate
