/// One document as a page, as Markdown and as JSON.

#include "studies/report/document.hpp"

#include "ensemble/model/input_error.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stylobate {
namespace {

Document some_document()
{
    Document document("A <title>", "its subtitle");
    document.answer("61 % of them fell (58 to 64 %).");
    document.contents();
    document.section("Results");
    Html text = "Lower & upper: ";
    text += code("a|b");
    document.paragraph(text);
    document.table({"lr", {"name", "value"}, {{"x|y", "1.5"}, {tag("good", "better"), "2"}}, "A table"});
    document.facts({{"Structure", "6 drums"}, {"Depth", "1 m"}});
    document.list({"one", "two"});
    document.box("warn", "Doubtful", "few motions");
    document.figure(Html::ready("<svg><text>a word of a drawing</text></svg>"), "What it shows.");
    document.details("More", [&] { document.block("key = 1\n<b>\n"); });
    document.data("cells", R"({"a":1})");
    document.player();
    return document;
}

TEST(Documents, AreMarkdown)
{
    EXPECT_EQ(markdown_of(some_document()), "# A <title>\n\n"
                                            "its subtitle\n\n"
                                            "**61 % of them fell (58 to 64 %).**\n\n"
                                            "## Results\n\n"
                                            "Lower & upper: `a|b`\n\n"
                                            "A table:\n\n"
                                            "| name | value |\n"
                                            "|---|---:|\n"
                                            "| x\\|y | 1.5 |\n"
                                            "| better | 2 |\n\n"
                                            "- Structure: 6 drums\n"
                                            "- Depth: 1 m\n\n"
                                            "- one\n- two\n\n"
                                            "> **Doubtful**\n>\n> few motions\n\n"
                                            "Figure: What it shows.\n\n"
                                            "More\n\n"
                                            "```\nkey = 1\n<b>\n```\n");
}

TEST(Documents, AreTextOfAConsole)
{
    EXPECT_EQ(console_text(some_document()), "A <title>\n"
                                             "  61 % of them fell (58 to 64 %).\n"
                                             "Results\n"
                                             "  Lower & upper: `a|b`\n"
                                             "  A table\n"
                                             "  name    value\n"
                                             "  x|y       1.5\n"
                                             "  better      2\n"
                                             "  Structure: 6 drums\n"
                                             "  Depth:     1 m\n"
                                             "  - one\n"
                                             "  - two\n"
                                             "  few motions\n"
                                             "  More\n"); // and what it opens is for a page
}

TEST(Documents, WrapSentencesAndListsWhereAWidthIsGiven)
{
    Document page;
    page.paragraph("eleven drums stand on a base, and a twelfth one lies beside it");
    page.list({"a γ of a long list item that goes on", "short"});
    // by hand: two blanks, and at most 20 characters (γ is one of them)
    EXPECT_EQ(console_text(page, 20), "  eleven drums stand\n  on a base, and a\n  twelfth one lies\n  beside it\n"
                                      "  - a γ of a long\n  list item that\n  goes on\n  - short\n");
}

TEST(Documents, CountCharactersNotBytesInColumns)
{
    Document document;
    document.table({"ll", {"a", "b"}, {{"m/s²", "1"}, {"–", "2"}, {"long name"}}, ""});
    document.block("key = 1\n<b>\n");
    EXPECT_EQ(console_text(document),
              "  a          b\n  m/s²       1\n  –          2\n  long name\n  key = 1\n  <b>\n");
}

TEST(Documents, AreJson)
{
    const nlohmann::json json = nlohmann::json::parse(json_of(some_document()).text());
    EXPECT_EQ(json["title"], "A <title>");
    ASSERT_EQ(json["sections"].size(), 2U);
    EXPECT_EQ(json["sections"][0]["blocks"][0]["kind"], "answer");
    EXPECT_EQ(json["sections"][0]["blocks"][0]["text"], "61 % of them fell (58 to 64 %).");
    const nlohmann::json& blocks = json["sections"][1]["blocks"];
    EXPECT_EQ(json["sections"][1]["title"], "Results");
    EXPECT_EQ(blocks[1]["head"], nlohmann::json::parse(R"(["name", "value"])"));
    EXPECT_EQ(blocks[1]["rows"], nlohmann::json::parse(R"([["x|y", "1.5"], ["better", "2"]])"));
    EXPECT_EQ(blocks[2]["rows"][1], nlohmann::json::parse(R"(["Depth", "1 m"])"));
    EXPECT_EQ(blocks.back()["text"], "key = 1\n<b>\n");
}

TEST(Documents, AreAPageWithItsContentsAfterTheAnswer)
{
    const std::string page = html_of(some_document());
    const std::size_t answer = page.find("<p class=\"answer\">"), contents = page.find("<nav"),
                      section = page.find("<h2 id=\"s1\">");
    EXPECT_NE(answer, std::string::npos);
    EXPECT_LT(answer, contents);
    EXPECT_LT(contents, section);
    EXPECT_NE(page.find("<h1>A &lt;title&gt;</h1>"), std::string::npos);
    EXPECT_NE(page.find("<pre>key = 1\n&lt;b&gt;\n</pre>\n</details>"), std::string::npos);
    EXPECT_NE(page.find("<script type=\"application/json\" id=\"cells\">{\"a\":1}</script>"), std::string::npos);
}

TEST(Documents, HaveTheFormOfTheirEnding)
{
    const Document document = some_document();
    EXPECT_EQ(document_as(document, "a/b.md"), markdown_of(document));
    EXPECT_EQ(document_as(document, "b.JSON"), json_of(document).text() + "\n");
    EXPECT_EQ(document_as(document, "b.htm"), html_of(document));
    EXPECT_TRUE(is_page_name("b"));
    EXPECT_FALSE(is_page_name("b.md"));
    EXPECT_THROW(check_document_ending("b.pdf"), InputError);
}

} // namespace
} // namespace stylobate
