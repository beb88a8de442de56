/// Pages and figures: what comes from elsewhere is text and never markup; figures hold what they are given.

#include "ensemble/model/collapse_criterion.hpp"
#include "io/files/atomic_file.hpp"
#include "io/store/surface_axis.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/report/document.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/html_map.hpp"
#include "studies/report/json.hpp"
#include "studies/results/study_facts.hpp"
#include "tests/program/json.hpp"
#include "tests/studies/measured/calibration/calibration_sample.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

namespace stylobate {
namespace {

std::size_t count_of(std::string_view text, std::string_view part)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
        ++n;
    return n;
}

/// The markup alone, without what is between the tags of scripts.
std::string without_scripts(const std::string& page)
{
    std::string rest;
    std::size_t at = 0;
    for (std::size_t open = page.find("<script"); open != std::string::npos; open = page.find("<script", at)) {
        const std::size_t inside = page.find('>', open) + 1;
        rest += page.substr(at, inside - at);
        at = page.find("</script>", inside);
    }
    return rest + page.substr(at);
}

/// Every element that is opened is closed, in order: HTML's void elements and what ends itself aside.
void expect_balanced(const std::string& whole)
{
    const std::string page = without_scripts(whole);
    std::vector<std::string> open;
    for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
        const std::size_t end = page.find('>', at);
        ASSERT_NE(end, std::string::npos);
        const std::string tag = page.substr(at + 1, end - at - 1);
        if (tag.starts_with('!') || tag.ends_with('/'))
            continue;
        const std::string name = tag.substr(tag.starts_with('/'), tag.find_first_of(" \n") - tag.starts_with('/'));
        if (name == "meta" || name == "img" || name == "br")
            continue;
        if (!tag.starts_with('/')) {
            open.push_back(name);
            continue;
        }
        ASSERT_FALSE(open.empty()) << tag;
        EXPECT_EQ(open.back(), name) << "at byte " << at;
        open.pop_back();
    }
    EXPECT_TRUE(open.empty());
}

/// Nothing is loaded from elsewhere, and nothing runs but the one script of the page.
void expect_self_contained(const std::string& page)
{
    EXPECT_EQ(count_of(page, "<script>"), 1U);
    EXPECT_EQ(count_of(page, "<script"), 1 + count_of(page, "<script type=\"application/json\""));
    EXPECT_EQ(count_of(page, "<script"), count_of(page, "</script>"));
    for (const char* loads : {"fetch(", "XMLHttpRequest", "WebSocket", "import(", "blob:", "createObjectURL", "eval("})
        EXPECT_EQ(page.find(loads), std::string::npos) << loads;
    EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'; img-src data:;"), std::string::npos);
    EXPECT_EQ(page.find("<link"), std::string::npos);
    EXPECT_EQ(count_of(page, "url("), count_of(page, "url(#"));
    EXPECT_EQ(page.find("@import"), std::string::npos);
    EXPECT_EQ(count_of(page, "src="), count_of(page, "src=\"data:"));
    EXPECT_EQ(count_of(page, "href="), count_of(page, "href=\"#"));
}

TEST(Html, EscapesWhatComesFromElsewhere)
{
    EXPECT_EQ(html_escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
    EXPECT_EQ(html_escaped("µ é ✓"), "µ é ✓");
    EXPECT_EQ(html_escaped("\xff\x01z\n"), "\xef\xbf\xbd\xef\xbf\xbdz\n");
    const Html text = "<b>";
    EXPECT_EQ(text.markup, "&lt;b&gt;");
    EXPECT_EQ(Html::ready("<b>").markup, "<b>");
}

TEST(Html, NoLineBreaksInsideAnInterval)
{
    EXPECT_EQ(Html("1.2 to 3.4 % of 5 to ten").markup, "1.2&nbsp;to&nbsp;3.4&nbsp;% of 5 to ten");
    EXPECT_EQ(Html("(-5 to +3) and 2e-05 to ∞; to 7").markup, "(-5&nbsp;to&nbsp;+3) and 2e-05&nbsp;to&nbsp;∞; to 7");
    EXPECT_EQ(Html("from 1 to 2 to 3").markup, "from 1&nbsp;to&nbsp;2&nbsp;to&nbsp;3");
    EXPECT_EQ(Html("a 61 % (58 to 64), 2e-05 (1e-05 to 3e-05)").markup,
              "a 61&nbsp;%&nbsp;(58&nbsp;to&nbsp;64), 2e-05&nbsp;(1e-05&nbsp;to&nbsp;3e-05)");
    EXPECT_EQ(Html("goes to 3 (1 of 2)").markup, "goes to 3 (1 of 2)");
    EXPECT_EQ(code("1 to 2").markup, "<code>1 to 2</code>") << "what is copied";
}

TEST(Html, Base64AsInRfc4648)
{
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Html, DataCannotEndTheirElement)
{
    Document page("t", "s");
    page.data("names", R"({"name": "</script><script>alert(1)</script><!--"})");
    const std::string text = html_of(page);
    EXPECT_NE(text.find(R"(<script type="application/json" id="names">{"name": "\u003c/script>\u003cscript>alert(1))"),
              std::string::npos);
    EXPECT_EQ(text.find("<!--"), std::string::npos);
    expect_self_contained(text);
    expect_balanced(text);
}

TEST(Html, ContentsStandWhereThePagePutsThem)
{
    Document page("title", "subtitle");
    page.answer("answer");
    page.contents();
    page.section("one");
    const std::string html = html_of(page);
    const std::size_t answer = html.find("answer</p>"), contents = html.find("<nav"), section = html.find("<h2");
    EXPECT_LT(answer, contents);
    EXPECT_LT(contents, section);
    EXPECT_NE(section, std::string::npos);
    Document usual("title", "subtitle");
    usual.section("one");
    EXPECT_LT(html_of(usual).find("<nav"), html_of(usual).find("<h2"));
}

TEST(HtmlFigure, GivesItsValuesToTheScript)
{
    Figure figure;
    figure.x_label = "time [s]";
    figure.y_log = true;
    figure.series = {{"a </script>", SeriesKind::line, {0, 1, 2}, {10, std::nan(""), 1000}, {}, {}},
                     {"b", SeriesKind::points, {1}, {20}, {15}, {30}, "a </script>", "points"}};
    const std::string html = figure_svg(figure).markup;
    const std::size_t begin = html.find("figure-data\">") + 13;
    const JsonValue data = JsonParser::parse(html.substr(begin, html.find("</script>") - begin));
    EXPECT_EQ(data["x"]["label"].text, "time [s]");
    EXPECT_FALSE(data["x"]["log"].boolean);
    EXPECT_TRUE(data["y"]["log"].boolean);
    const JsonValue& line = data["series"].items.at(0);
    EXPECT_EQ(line["name"].text, "a </script>");
    EXPECT_EQ(line["y"].items.at(0).number, 10);
    EXPECT_EQ(line["y"].items.at(1).kind, JsonValue::Kind::null);
    EXPECT_EQ(line["y"].items.at(2).number, 1000);
    EXPECT_TRUE(line["low"].items.empty());
    const JsonValue& points = data["series"].items.at(1);
    EXPECT_EQ(points["high"].items.at(0).number, 30);
    EXPECT_EQ(points["layer"].text, "points");
    // one group has one colour and one entry of the legend
    EXPECT_EQ(line["colour"].number, points["colour"].number);
    EXPECT_EQ(count_of(html, "class=\"key\""), 1U);
    EXPECT_EQ(count_of(html, "data-series="), 2U);
    // where the script takes the ends of the axis for, the drawing has them: the line begins and ends there
    const std::size_t at = html.find("<path d=\"M");
    double x = 0, y = 0;
    ASSERT_EQ(std::sscanf(html.c_str() + at, "<path d=\"M%lf %lf", &x, &y), 2);
    const JsonValue& axis = data["x"];
    const double share = (0 - axis["from"].number) / (axis["to"].number - axis["from"].number);
    EXPECT_NEAR(x, axis["first"].number + share * (axis["last"].number - axis["first"].number), 0.06);
}

TEST(HtmlMap, PutsCellsWhereTheyLie)
{
    SurfaceTable surface; // cells as wide as their neighbours in frequency; in PGA the edges are 5, 15, 30 and 50
    surface.frequency_hz = {1, 2, 3};
    surface.pga_m_s2 = {10, 20, 40};
    surface.trials.assign(9, 10);
    surface.collapses = {0, 5, 10, 0, 5, 10, 0, 5, 10};
    surface.probability = {0, 0.5, 1, std::nan(""), 0.5, 1, 0, 0.5, 1};
    surface.lower = surface.upper = surface.probability;
    const CellAxis pga = make_cell_axis(surface.pga_m_s2, "pga_m_s2");
    const std::string svg = map_svg(surface).markup;
    EXPECT_EQ(count_of(svg, "data-cell="), 9U);
    EXPECT_EQ(count_of(svg, "class=\"empty-cell\""), 1U); // of which nothing is known
    const auto rect = [&](int cell) {
        std::array<double, 4> r{};
        const std::size_t at = svg.rfind("<rect", svg.find(fmt::format("data-cell=\"{}\"", cell)));
        EXPECT_EQ(std::sscanf(svg.c_str() + at, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\"", &r[0], &r[1],
                              &r[2], &r[3]),
                  4);
        return r;
    };
    // the frame that the script takes is the one that the cells fill
    std::array<double, 4> frame{};
    const std::size_t at = svg.find("data-frame=");
    ASSERT_EQ(
        std::sscanf(svg.c_str() + at, "data-frame=\"%lf %lf %lf %lf\"", &frame[0], &frame[1], &frame[2], &frame[3]), 4);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const auto drawn = rect(3 * i + j);
            const auto edge = [&](int k) { return pga.in_unit(pga.edges[static_cast<std::size_t>(k)]); };
            EXPECT_NEAR(drawn[0], frame[0] + frame[2] * i / 3, 0.02) << i;
            EXPECT_NEAR(drawn[2], frame[2] / 3, 0.52) << "cells overlap by half a pixel";
            EXPECT_NEAR(drawn[1] + drawn[3], frame[1] + frame[3] * (1 - edge(j)), 0.02) << "the larger one is above";
            EXPECT_NEAR(drawn[3], frame[3] * (edge(j + 1) - edge(j)), 0.52) << j;
        }
}

TEST(HtmlFigure, PutsPointsWhereTheAxesSay)
{
    Figure figure;
    figure.x_log = true;
    figure.series = {{"", SeriesKind::line, {1, 10, 100}, {0, 1, 2}, {}, {}}};
    const std::string svg = figure_svg(figure).markup;
    // on a logarithmic axis a decade is a decade: the middle point lies half way in x, and in y
    double x[3] = {}, y[3] = {};
    const std::size_t at = svg.find("<path d=\"M");
    ASSERT_NE(at, std::string::npos) << svg;
    ASSERT_EQ(
        std::sscanf(svg.c_str() + at, "<path d=\"M%lf %lfL%lf %lfL%lf %lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]),
        6);
    EXPECT_NEAR(x[1], (x[0] + x[2]) / 2, 0.11);
    EXPECT_NEAR(y[1], (y[0] + y[2]) / 2, 0.11);
    EXPECT_LT(x[0], x[2]);
    EXPECT_GT(y[0], y[2]); // up is up
    for (const char* label : {">1<", ">10<", ">100<"})
        EXPECT_NE(svg.find(label), std::string::npos) << label;
}

TEST(HtmlFigure, LeavesGapsAndKeepsPeaksOfLongSeries)
{
    FigureSeries series{"long", SeriesKind::line, {}, {}, {}, {}};
    for (int i = 0; i < 100000; ++i) {
        series.x.push_back(i);
        series.y.push_back(i == 54321 ? 7.0 : i / 20000 == 4 ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    }
    Figure figure;
    figure.series = {series};
    const std::string svg = figure_svg(figure).markup;
    EXPECT_LT(svg.size(), 60000U);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    // the one high sample is the highest point of the axis' range, and is drawn there
    const std::size_t at = svg.find("<path d=\"M");
    const std::string path = svg.substr(at, svg.find('"', at + 10) - at);
    double least = 1e9;
    for (std::size_t p = path.find_first_of("ML"); p != std::string::npos; p = path.find_first_of("ML", p + 1)) {
        double x = 0, y = 0;
        if (std::sscanf(path.c_str() + p + 1, "%lf %lf", &x, &y) == 2)
            least = std::min(least, y);
    }
    EXPECT_LT(least, 60);
    EXPECT_EQ(count_of(path, "M"), 1U); // the gap is at the end
}

TEST(HtmlFigure, OfNothingSaysSo)
{
    for (const bool log : {false, true}) {
        Figure figure;
        figure.x_log = figure.y_log = log;
        figure.series = {{"<none>", SeriesKind::points, {0, -1}, {0, -2}, {}, {}},
                         {"unequal", SeriesKind::line, {1, 2}, {1}, {}, {}},
                         {"no ends", SeriesKind::band, {1, 2}, {}, {}, {}}};
        if (!log)
            figure.series.erase(figure.series.begin());
        const std::string svg = figure_svg(figure).markup;
        EXPECT_NE(svg.find("no data"), std::string::npos) << svg;
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
        EXPECT_EQ(svg.find("<none>"), std::string::npos);
    }
}

TEST(HtmlFigure, MarksSpansAndDrawsBandsAboutLines)
{
    Figure figure;
    figure.series = {{"seen", SeriesKind::line, {0, 1, 2}, {0, 1, 0}, {-0.1, 0.9, -0.1}, {0.1, 1.1, 0.1}},
                     {"model", SeriesKind::line, {0, 1, 2}, {0, 0.5, 0}, {}, {}},
                     {"wrong", SeriesKind::spans, {0.5}, {1.5}, {}, {}}};
    const std::string svg = figure_svg(figure, 100).markup;
    EXPECT_EQ(count_of(svg, "<path"), 3U); // a band and two lines
    double x = 0, y = 0, width = 0, height = 0;
    const std::size_t at = svg.find("<rect", svg.find("data-series=\"2\""));
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\"", &x, &y, &width,
                          &height),
              4);
    EXPECT_NEAR(height, 100, 0.11); // the whole height
    double left = 0, right = 0, unused = 0, also = 0, middle = 0;
    const std::size_t line = svg.rfind("<path d=\"M");
    ASSERT_EQ(std::sscanf(svg.c_str() + line, "<path d=\"M%lf %lfL%lf %lfL%lf", &left, &unused, &middle, &also, &right),
              5);
    EXPECT_NEAR(x, left + 0.25 * (right - left), 0.2);
    EXPECT_NEAR(width, 0.5 * (right - left), 0.2);
    EXPECT_LT(at, svg.find("<path")); // behind the curves
}

TEST(HtmlFigure, BarsStandSideBySideOnlyWhereTheyMeet)
{
    const auto middle = [](const std::string& svg) {
        const std::size_t at = svg.find("<rect", svg.find("data-series=\"0\""));
        double x = 0, y = 0, width = 0;
        EXPECT_EQ(std::sscanf(svg.c_str() + at, "<rect x=\"%lf\" y=\"%lf\" width=\"%lf\"", &x, &y, &width), 3);
        return x + width / 2;
    };
    const auto tick = [](const std::string& svg) { // of the first name
        const std::size_t at = svg.rfind("<text", svg.find(">a<"));
        double x = 0;
        EXPECT_EQ(std::sscanf(svg.c_str() + at, "<text x=\"%lf\"", &x), 1);
        return x;
    };
    Figure figure;
    figure.x_ticks = {"a", "b"};
    figure.series = {{"one", SeriesKind::bars, {0}, {3}, {}, {}}, {"other", SeriesKind::bars, {1}, {2}, {}, {}}};
    const std::string apart = figure_svg(figure).markup;
    EXPECT_NEAR(middle(apart), tick(apart), 0.2);
    figure.series[1].x = {0};
    const std::string beside = figure_svg(figure).markup;
    EXPECT_LT(middle(beside), tick(beside) - 5);
}

TEST(StudyFacts, OfAReplayAreOfItsRealization)
{
    Study study = parse_study(R"([study]
kind = "surface"
realizations = 8
[structure]
blocks = 7
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
capital = { width_m = 0.06, height_m = 0.02, mass_kg = 0.1 }
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
[excitation]
kind = "harmonic"
[surface]
frequency_hz = { from = 0.5, to = 8, count = 5 }
pga_m_s2 = { from = 1, to = 9, count = 3 }
)",
                              "a study");
    const auto fact = [](const auto& facts, const std::string& name) {
        for (const auto& [what, text] : facts)
            if (what == name)
                return text;
        return std::string();
    };
    const auto all = study_facts(study);
    EXPECT_NE(fact(all, "Excitation").find("5 from 0.5 to 8 Hz"), std::string::npos);
    EXPECT_NE(fact(all, "Structure").find("7 drums: width"), std::string::npos);
    EXPECT_NE(fact(all, "Structure").find("1 capital: width 0.06 m"), std::string::npos);
    EXPECT_EQ(fact(all, "Randomized"), "nothing");
    ResultRow row;
    row.frequency_hz = 2.375;
    row.pga_m_s2 = 5;
    row.inputs = {0.71};
    const auto one = study_facts(study, &row, {"friction"});
    EXPECT_NE(fact(one, "Excitation").find("2.375 Hz, PGA 5 m/s²"), std::string::npos) << fact(one, "Excitation");
    EXPECT_EQ(fact(one, "Excitation").find(" to "), std::string::npos);
    EXPECT_EQ(fact(one, "Drawn in this realization"), "friction 0.71");
    EXPECT_EQ(fact(one, "Randomized"), "");
}

TEST(DiagnosisPage, SaysWhatNatsAndSmallProbabilitiesMean)
{
    const std::string page = html_of(diagnosis_page(filled_diagnosis(), "diagnosis.h5"));
    const std::size_t nats = page.find("the unit of log likelihood"), p = page.find("p is the p-value of the gain");
    const std::size_t table = page.find("gain [nats]");
    EXPECT_LT(nats, table);
    EXPECT_LT(p, table);
    EXPECT_NE(page.find("is not named if the named cause"), std::string::npos);
}

TEST(DiagnosisPage, ShowsEveryPartAndEscapesIt)
{
    const std::string page = html_of(diagnosis_page(filled_diagnosis(), "folder/diagnosis.h5"));
    expect_self_contained(page);
    expect_balanced(page);
    EXPECT_NE(page.find("Seven drums &lt;script&gt;alert(1)&lt;/script&gt;, 1:10, é"), std::string::npos);
    std::size_t before = 0;
    for (const char* title :
         {"Tests of single joints", "First diagnosis", "Errors and their location", "Candidates", "Unexplained error",
          "The extended model and its gain", "The data", "The calibrated baseline", "Tests that were not possible",
          "Method and cost", "Reproduction"}) {
        const std::size_t at = page.find(std::string("&ensp;") + title + "</h2>");
        EXPECT_NE(at, std::string::npos) << title;
        EXPECT_GT(at, before) << title;
        before = at;
    }
    // three curves, the ends of the windows in motion, and the estimates of a test of single joints
    EXPECT_EQ(count_of(page, "<figure>"), 5U);
    for (const char* words :
         {"Joint 0 has less friction than the others", "dynamic_ratio = 0.81&nbsp;(0.7&nbsp;to&nbsp;0.95)",
          "could not be judged", "1a2b3c4d", "crc32", "diagnosis_extended.toml", "18364758544493064720",
          "stylobate diagnose &#39;col&quot;umn &amp; co.h5&#39;"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST(DiagnosisPage, OfAnEmptyDiagnosisIsAPageToo)
{
    const std::string whole = html_of(diagnosis_page(Diagnosis{}, "d.h5"));
    expect_self_contained(whole);
    expect_balanced(whole);
    const std::string page = whole.substr(0, whole.find("\"use strict\"")); // without the words of the scripts
    EXPECT_NE(page.find("No cause identified"), std::string::npos);
    EXPECT_EQ(page.find("null distribution"), std::string::npos);
    EXPECT_EQ(page.find("not known"), std::string::npos);
}

TEST(DiagnosisPage, OfNoneIsNotGreenAndShowsNoProbability)
{
    const std::string page = html_of(diagnosis_page(diagnosis_without_cause(), "d.h5"));
    EXPECT_NE(page.find("<div class=\"box \"><strong>No cause identified; best candidate: friction of joint 0 x 0.63 "
                        "(p = 0.056)</strong>"),
              std::string::npos);
    for (const char* wrong : {"box good", "rejected", "<small>probability", "&lt; 0.001"})
        EXPECT_EQ(page.find(wrong), std::string::npos) << wrong;
}

std::string fact_of(const Study& study, const std::string& name)
{
    for (const auto& [what, text] : study_facts(study))
        if (what == name)
            return text;
    return "";
}

TEST(StudyFacts, SayHowStrongTheShakingIsByItsKind)
{
    const auto excitation = [](const std::string& file, const std::vector<std::string>& settings) {
        return fact_of(read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/" + file, settings), "Excitation");
    };
    // along an axis there is no other PGA, whatever shakes
    const std::string surface = excitation("small_scale_column.toml", {});
    EXPECT_NE(surface.find("PGA: 16 from"), std::string::npos) << surface;
    EXPECT_EQ(surface.find("as recorded"), std::string::npos) << surface;
    const std::string harmonic = excitation("mechanisms.toml", {});
    EXPECT_EQ(harmonic.find("as recorded"), std::string::npos) << harmonic;

    Study study = read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml");
    EXPECT_EQ(fact_of(study, "Excitation"), "none: the base is at rest");
    study.excitation.kind = ExcitationKind::record;
    study.excitation.file = "a.at2";
    EXPECT_EQ(fact_of(study, "Excitation"), "record a.at2, PGA as recorded");
    study.excitation.pga_m_s2 = 3;
    EXPECT_EQ(fact_of(study, "Excitation"), "record a.at2, PGA 3 m/s²");
    study.excitation.kind = ExcitationKind::table;
    study.excitation.pga_m_s2 = 0;
    EXPECT_EQ(fact_of(study, "Excitation"), "table of samples a.at2, PGA as in the table");
}

TEST(StudyFacts, StateTheWholeCollapseCriterion)
{
    Study study = read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml");
    study.outcome.collapse_height_fraction = 0.75;
    const std::string text = fact_of(study, "Collapse");
    EXPECT_NE(text.find("below 0.75 of its height"), std::string::npos) << text;
    EXPECT_NE(text.find("slenderness angle"), std::string::npos) << text;

    // the reference of the study file states the same, of the defaults
    std::ifstream in(STYLOBATE_SOURCE_DIR "/studies/inputs/README.md");
    const std::string reference{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_NE(reference.find(collapse_criterion(OutcomeSpec{})), std::string::npos);
}

/// The sample, written and read again.
StoredCalibration stored_sample(const Calibration& calibration)
{
    const TemporaryFolder folder;
    write_calibration(calibration, calibration.forms[0].study, "1.2.3", folder / "c.h5");
    return read_calibration(folder / "c.h5");
}

TEST(CalibrationFile, ReadsBackWhatWasWritten)
{
    const Calibration c = sample_calibration();
    const StoredCalibration stored = stored_sample(c);
    EXPECT_EQ(stored.measured, c.measured);
    EXPECT_EQ(stored.evidence, "histories");
    EXPECT_EQ(stored.best_form, "area");
    EXPECT_EQ(stored.code_version, "1.2.3");
    EXPECT_EQ(stored.start_toml, c.forms[0].study.text);
    EXPECT_EQ(stored.notes, c.notes);
    EXPECT_EQ(stored.block_steps, c.block_steps);
    EXPECT_EQ(stored.seconds, c.seconds);
    ASSERT_EQ(stored.forms.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
        const StoredForm& form = stored.forms[k];
        const FormCalibration& want = c.forms[k];
        EXPECT_EQ(form.name, k == 0 ? "area" : "points");
        EXPECT_EQ(form.score, want.score);
        EXPECT_EQ(form.nominal_score, want.nominal_score);
        EXPECT_EQ(form.correlation, want.correlation);
        EXPECT_EQ(form.held_out.low, want.held_out.low);
        EXPECT_EQ(form.held_out.groups, want.held_out.groups);
        ASSERT_EQ(form.parameters.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            const FittedParameter &p = form.parameters[i], &q = want.parameters[i];
            EXPECT_EQ(p.key, q.key);
            EXPECT_EQ(p.high, q.high);
            EXPECT_EQ(p.to, q.to);
            EXPECT_EQ(p.determined, q.determined);
            EXPECT_EQ(p.note, q.note);
            ASSERT_EQ(p.profile.size(), q.profile.size());
            EXPECT_EQ(p.profile.back().score, q.profile.back().score);
        }
        ASSERT_EQ(form.runs.size(), 50U);
        EXPECT_EQ(form.runs[7].motion_id, 3);
        EXPECT_EQ(form.runs[7].calibrated, want.runs[7].calibrated);
    }
    EXPECT_EQ(stored.best().name, "area");
    ASSERT_TRUE(stored.motion);
    EXPECT_EQ(stored.motion->blocks, c.motion->blocks);
    ASSERT_EQ(stored.motion->windows.size(), 2U);
    const WindowMotion &window = stored.motion->windows[1], &want = c.motion->windows[1];
    EXPECT_EQ(window.choice, WindowChoice::typical);
    EXPECT_EQ(window.run, want.run);
    EXPECT_EQ(window.samples[5].time_s, want.samples[5].time_s);
    EXPECT_EQ(window.tracks[2].excess, want.tracks[2].excess);
    EXPECT_EQ(window.tracks[2].places.back().theta_rad, want.tracks[2].places.back().theta_rad);
}

TEST(CalibrationPage, ShowsEveryPartAndEscapesIt)
{
    const std::string page = html_of(calibration_page(stored_sample(sample_calibration()), "some/c.h5"));
    expect_balanced(page);
    expect_self_contained(page);
    for (const char* part : {"Calibration: campaign &quot;7&quot; &lt;b&gt;.h5",
                             "These data determine 1 of 2 fitted parameters.",
                             "it predicts them better than the start study",
                             "+75.0&nbsp;(+20.5&nbsp;to&nbsp;+129.5)",
                             "nothing slides &lt;here&gt; &amp; there",
                             "1.2e+07",
                             ">effective</span>",
                             "9.6e+06&nbsp;to&nbsp;1.5e+07",
                             "2.4e+06&nbsp;to&nbsp;6e+07",
                             "(-0.70)",
                             ">best</span>",
                             "points",
                             "without an interval: too few motions",
                             "+40.2",
                             "run 39",
                             "The first 40 of 50 runs",
                             "run 003 has no table motion &amp; was left out",
                             "&lt;i&gt;",
                             "1 min 23 s",
                             "--form area,points",
                             "The calibrated study",
                             "drum_height_m"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("run 40<"), std::string::npos);
    EXPECT_EQ(count_of(page, "<svg"), 2U + 3U); // a profile of each parameter; two windows and what is about them
    EXPECT_NE(page.find("id=\"animations\""), std::string::npos);

    // nothing left out, one form, all determined
    Calibration c = sample_calibration();
    c.forms.pop_back();
    c.forms[0].parameters.pop_back();
    c.forms[0].correlation = {1};
    c.forms[0].held_out = {};
    c.notes.clear();
    c.motion.reset(); // as in a file of format version 3
    const std::string plain = html_of(calibration_page(stored_sample(c), "c.h5"));
    expect_balanced(plain);
    for (const char* part :
         {"These data determine the fitted parameter.", "was not tested on held-out", "--form all compares them",
          "not shown in motion: c.h5 was written by an earlier version of the program (1.2.3)"})
        EXPECT_NE(plain.find(part), std::string::npos) << part;
}

TEST(Json, BriefNumbersHaveSixDigitsAndCountsAll)
{
    const double nan = std::nan("");
    EXPECT_EQ(Json::brief(std::vector<double>{0.123456789, nan, -2}).text(), "[0.123457,null,-2]");
    EXPECT_EQ(Json::brief(std::vector<std::uint64_t>{12345678, 0}).text(), "[12345678,0]");
    EXPECT_EQ(Json::brief(std::vector<double>{}).text(), "[]");
    EXPECT_EQ(Json::list({"a \"word\"", "<b>"}).text(), "[\"a \\\"word\\\"\", \"<b>\"]");
}

} // namespace
} // namespace stylobate
