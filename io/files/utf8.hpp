#pragma once
/// Characters of texts that come from elsewhere.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace stylobate {

/// Bytes of the UTF-8 character that `text` begins with; 0 if it is none (a byte of Latin-1 in an old record's title,
/// an overlong form, a surrogate, what lies beyond the last code point), or if `text` is empty.
inline std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
    const unsigned char lead = byte(0);
    if (lead < 0x80)
        return text.empty() ? 0 : 1;
    const std::size_t length = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80)
            return 0;
    const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
    const bool no_character = (lead == 0xed && byte(1) > 0x9f) || (lead == 0xf4 && byte(1) > 0x8f);
    return overlong || no_character ? 0 : length;
}

/// Whether it begins with a control character, which no name needs and a terminal may obey.
inline bool begins_with_control(std::string_view text)
{
    return !text.empty() && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f);
}

/// Whether a text is UTF-8 without control characters, so that every format that we write can hold it.
inline bool is_plain_text(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0 || begins_with_control(text))
            return false;
        text.remove_prefix(length);
    }
    return true;
}

/// The text with a replacement character (U+FFFD) for each byte that is no UTF-8, and for each control character but
/// line break and tabulator, as XML allows no others.
inline std::string replaced_text(std::string_view text)
{
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0 || (begins_with_control(text) && text[0] != '\n' && text[0] != '\t'))
            out += "\xef\xbf\xbd";
        else
            out += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

/// A text for XML, HTML and the values of their attributes; what `replaced_text` replaces becomes U+FFFD.
inline std::string xml_escaped(std::string_view text)
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

} // namespace stylobate
