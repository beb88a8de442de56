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

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

constexpr std::string_view no_break = "&nbsp;";

/// A text that ends with the lower limit of an interval: where a value stands before it ("61 % (58"), without a break
/// between them.
std::string joined_to_its_value(std::string_view text)
{
    const std::size_t end = text.find_last_not_of("0123456789.e+-∞");
    const std::size_t number = end == std::string_view::npos ? 0 : end + 1;
    std::string_view value = text.substr(0, number);
    if (!value.ends_with(" ("))
        return std::string(text);
    value.remove_suffix(2);
    const bool percent = value.ends_with(" %");
    if (percent)
        value.remove_suffix(2);
    if (value.empty() || !is_digit(value.back()))
        return std::string(text);
    return fmt::format("{}{}{}({}", value, percent ? fmt::format("{}%", no_break) : "", no_break, text.substr(number));
}

/// "1.2 to 3.4 %" and "5 (4 to 6)" with blanks at which no line breaks, anywhere in a text.
std::string unbroken_intervals(std::string_view text)
{
    constexpr std::string_view to = " to ", endless = "∞";
    std::string out;
    for (std::size_t at = text.find(to); at != std::string_view::npos; at = text.find(to)) {
        const std::string_view before = text.substr(0, at), after = text.substr(at + to.size());
        const std::size_t sign = after.starts_with('-') || after.starts_with('+') ? 1 : 0;
        const bool number = (sign < after.size() && is_digit(after[sign])) || after.substr(sign).starts_with(endless);
        text = after;
        if (!number || at == 0 || !(is_digit(before.back()) || before.ends_with(endless))) {
            out += fmt::format("{}{}", before, to);
            continue;
        }
        out += fmt::format("{0}{1}to{1}", joined_to_its_value(before), no_break);
        const std::size_t end = std::min(after.find_first_not_of("0123456789.e+-∞"), after.size());
        if (text.substr(end).starts_with(" %")) {
            out += fmt::format("{}{}%", text.substr(0, end), no_break);
            text.remove_prefix(end + 2);
        }
    }
    return out + std::string(text);
}

} // namespace

std::string html_escaped(std::string_view text)
{
    std::string out;
    for (const char c : replaced_text(text))
        if (c == '&')
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
    return out;
}

Html unbroken(std::string_view text)
{
    return Html::ready("<span class=\"n\">" + html_escaped(text) + "</span>");
}

Html code(std::string_view text)
{
    return Html::ready("<code>" + html_escaped(text) + "</code>");
}

Html tag(std::string_view tone, std::string_view text)
{
    return Html::ready(fmt::format("<span class=\"tag {}\">{}</span>", tone, html_escaped(text)));
}

Html::Html(std::string_view text) : markup(unbroken_intervals(html_escaped(text))) {}

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

void HtmlPage::contents()
{
    contents_at_ = body_.size();
}

void HtmlPage::answer(const Html& sentence)
{
    body_ += "<p class=\"answer\">" + sentence.markup + "</p>\n";
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
    body_ += fmt::format("<div class=\"box {}\"><strong>{}</strong><p>{}</p></div>\n", tone, Html(title).markup,
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
        body_ += "<caption>" + Html(table.caption).markup + "</caption>\n";
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

void HtmlPage::details(const Html& sentence, const std::function<void()>& more)
{
    body_ += "<details><summary>" + sentence.markup + "</summary>\n";
    more();
    body_ += "</details>\n";
}

void HtmlPage::part(std::string_view name, const std::function<void()>& more)
{
    body_ += fmt::format("<div class=\"{}\">\n", html_escaped(name));
    more();
    body_ += "</div>\n";
}

void HtmlPage::data(std::string_view id, std::string_view json)
{
    body_ += data_script(fmt::format("id=\"{}\"", html_escaped(id)), json).markup + "\n";
}

void HtmlPage::player()
{
    body_ += "<div data-player=\"\"></div>\n";
}

std::string HtmlPage::text() const
{
    const std::string_view body = body_;
    // the browser itself sees to it that nothing is loaded from elsewhere
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
                       "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
                       "<title>{0}</title>\n<style>\n{1}</style>\n</head>\n<body>\n<main>\n"
                       "<header><h1>{0}</h1><p>{2}</p></header>\n"
                       "<noscript><p class=\"note\">This browser runs no scripts: the page shows its pictures and "
                       "tables, but no values under the pointer and no animations.</p></noscript>\n"
                       "{3}<nav aria-label=\"contents\">{4}</nav>\n{5}"
                       "<footer>Generated by stylobate {6}.</footer>\n</main>\n"
                       "<script>\n\"use strict\";\n{{\n{7}}}\n</script>\n</body>\n</html>\n",
                       html_escaped(title_), page_style(), html_escaped(subtitle_), body.substr(0, contents_at_),
                       contents_, body.substr(contents_at_), html_escaped(code_version()), page_script());
}

Html data_script(std::string_view attributes, std::string_view json)
{
    std::string text = fmt::format("<script type=\"application/json\" {}>", attributes);
    for (const char c : json) // only strings of JSON have it
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    return Html::ready(text + "</script>");
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

Html svg_image(const std::filesystem::path& svg, std::string_view alternative)
{
    std::ifstream in(svg, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in || bytes.empty())
        throw InputError(svg.string(), 0, "cannot be read");
    return Html::ready("<img alt=\"" + html_escaped(alternative) + "\" src=\"data:image/svg+xml;base64," +
                       base64(bytes) + "\">");
}

} // namespace stylobate
