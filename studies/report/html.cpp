#include "studies/report/html.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace stylobate {
namespace {

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
    return xml_escaped(text);
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

std::string base64url(std::string_view bytes)
{
    std::string out = base64(bytes);
    std::replace(out.begin(), out.end(), '+', '-');
    std::replace(out.begin(), out.end(), '/', '_');
    out.resize(std::min(out.find('='), out.size()));
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
