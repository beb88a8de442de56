#pragma once
/// Markup of the pages, and what a page has besides its document: style, scripts, pictures.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

/// Ready markup. A text that is given where `Html` is wanted is escaped, so that no name of a file or a specimen can
/// be taken for markup; and no line breaks inside "1.2 to 3.4 %".
struct Html {
    Html() = default;
    Html(std::string_view text);
    Html(const std::string& text) : Html(std::string_view(text)) {}
    Html(const char* text) : Html(std::string_view(text)) {}
    /// Taken as it is.
    static Html ready(std::string markup);

    Html& operator+=(const Html& more);

    std::string markup;
};

/// A text for HTML and for the values of attributes; bytes that are no UTF-8, and control characters, become U+FFFD.
std::string html_escaped(std::string_view text);

/// A text without a line break inside: a share with its interval.
Html unbroken(std::string_view text);
/// A word of a file or of the command line.
Html code(std::string_view text);
/// A word in a coloured field. @param tone "good", "warn", "bad", or "" for the plain colour
Html tag(std::string_view tone, std::string_view text);

struct HtmlTable {
    std::string align; ///< a letter for each column: l, n (short words, on one line), r (numbers) or c
    std::vector<Html> head;
    std::vector<std::vector<Html>> rows;
    std::string caption;
};

/// A picture inside the page.
/// @throws InputError if the file cannot be read
Html svg_image(const std::filesystem::path& svg, std::string_view alternative);

/// JSON for the script of a page, in an element that is not shown. Its text cannot end the element.
/// @param attributes of the element: "id=\"cells\""
Html data_script(std::string_view attributes, std::string_view json);

/// RFC 4648.
std::string base64(std::string_view bytes);
/// The same with the letters of addresses and without padding (RFC 4648, section 5).
std::string base64url(std::string_view bytes);

/// The style of a page, and all its scripts one after the other, to stand in one block of braces: the files of
/// `studies/report/page`, which the build embeds into the program.
std::string_view page_style();
std::string_view page_script();

/// What scripts/space.sh has written into docs/space.md (Markdown), which the build embeds too.
std::string_view space_evidence();

} // namespace stylobate
