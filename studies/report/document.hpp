#pragma once
/// A document: sentences, tables and figures in sections, as data. One document is a page (HTML), a text (Markdown) and
/// data for other programs (JSON).

#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

/// One thing of a document.
struct DocumentBlock {
    enum class Kind {
        section,   ///< title
        heading,   ///< title
        contents,  ///< the list of sections stands here instead of the top
        answer,    ///< text
        paragraph, ///< text
        note,      ///< text, smaller
        box,       ///< tone, title, text
        list,      ///< items
        facts,     ///< items: names and what they are, in turn
        table,     ///< table
        preformed, ///< title: a text as it is, its lines kept
        figure,    ///< text: the picture; items: its caption
        fold,      ///< text: a sentence below which what follows opens, up to `end`
        part,      ///< title: a class of the style, up to `end`
        end,
        data,  ///< title: an id; text: JSON for the script of the page
        player ///< where the script puts the player of the animations
    };
    Kind kind;
    std::string title = {}, tone = {};
    Html text = {};
    std::vector<Html> items = {};
    HtmlTable table = {};
};

class Document {
public:
    Document(std::string title = {}, std::string subtitle = {});

    /// A numbered section; the contents lead to it.
    void section(const std::string& title);
    void heading(const std::string& title);
    /// Puts the contents here instead of the top.
    void contents();
    /// The answer in one sentence.
    void answer(const Html& sentence);
    void paragraph(const Html& text);
    /// Smaller.
    void note(const Html& text);
    /// What must not be missed. @param tone "good", "warn", "bad" or "answer"
    void box(const std::string& tone, const std::string& title, const Html& text);
    void list(const std::vector<Html>& items);
    /// Names and what they are, in two columns.
    void facts(const std::vector<std::pair<std::string, Html>>& facts);
    void table(const HtmlTable& table);
    /// Text as it is, its lines kept.
    void block(std::string_view text);
    void figure(const Html& picture, const Html& caption);
    /// A sentence below which more opens. @param more adds it
    void details(const Html& sentence, const std::function<void()>& more);
    /// What belongs together for the style and the script. @param name a class   @param more adds it
    void part(std::string_view name, const std::function<void()>& more);
    /// Data for the script (`data_script`).
    void data(std::string_view id, std::string_view json);
    /// Where the script puts the player of the animations.
    void player();

    const std::string& title() const { return title_; }
    const std::string& subtitle() const { return subtitle_; }
    const std::vector<DocumentBlock>& blocks() const { return blocks_; }

private:
    std::string title_, subtitle_;
    std::vector<DocumentBlock> blocks_;
};

/// A text of a page without its markup: words of the program stand in `, blanks that do not break are blanks.
std::string plain_text(const Html& html);

/// A page: nothing is loaded from elsewhere, it can be printed, and what needs its script is not needed to read it.
std::string html_of(const Document& document);

/// A text in Markdown (with the tables of GitHub), to be read as it is. Of a figure there is its caption; data for the
/// script are left out.
std::string markdown_of(const Document& document);

constexpr std::size_t console_width = 100; ///< characters of a line

/// Characters of UTF-8.
std::size_t characters(std::string_view text);

/// Words on lines of at most `width` characters, each after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width = console_width);

/// What a console shows of it: sentences, lists, facts and tables, each with two blanks before it, columns as wide as
/// their widest cell; of what is folded the sentence alone. A result's text on the console and the first part of its
/// page are made by one function.
/// @param width of the lines of sentences and lists; 0: as they are
std::string console_text(const Document& document, std::size_t width = 0);

/// {"title", "subtitle", "sections": [{"title", "blocks": [{"kind", ...}]}]}, with tables as lists of rows. The first
/// section, without a title, is what stands before the others.
Json json_of(const Document& document);

/// The forms of a document by the endings of files: "html", "md", "json".
/// @throws InputError for another ending
std::string document_as(const Document& document, const std::filesystem::path& file);
/// Whether a file of that name would be a page: ".html", ".htm" or no ending.
bool is_page_name(const std::filesystem::path& file);
/// @throws InputError for an ending that is none of these; no ending is right too
void check_document_ending(const std::filesystem::path& file);

/// A page and its pictures.
struct PageWriter {
    Document& page;
    /// Puts a picture into the page, or a note why it could not be drawn. The function draws an SVG.
    std::function<void(const std::string& caption, const std::function<void(const std::filesystem::path& svg)>& draw)>
        picture;
};

} // namespace stylobate
