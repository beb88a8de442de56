/// `stylobate export`, as its user runs it: the ending says the format, names differ, nothing is replaced unasked.

#include "tests/io/plots/pixels.hpp"
#include "tests/program/program.hpp"

namespace stylobate {
namespace {

const std::string doric_column = STYLOBATE_SOURCE_DIR "/studies/inputs/doric_column.toml";

class Exports : public Program {
protected:
    Ended expect_done(const Words& arguments) const
    {
        Ended ended = run(arguments);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(arguments) << testing::PrintToString(ended);
        return ended;
    }
    void eight(const Words& more = {}) const
    {
        Words settings = eight_realizations;
        settings.insert(settings.end(), more.begin(), more.end());
        expect_done(run_words(column_study, settings, {"-o", "a.h5", "--quiet"}));
    }
    std::string written(const Words& more) const
    {
        Words words = {"export", "a.h5", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return json_of(expect_done(words))["written"].text;
    }
    bool begins(const std::string& name, std::string_view start) const
    {
        return read_bytes(folder / name).starts_with(start);
    }
};

TEST_F(Exports, TheEndingDecidesOrIsRefused)
{
    eight();
    EXPECT_EQ(written({"-o", "s.svg"}), "s.svg");
    EXPECT_TRUE(begins("s.svg", "<?xml"));
    EXPECT_NE(read_bytes(folder / "s.svg").find("<svg"), std::string::npos);
    EXPECT_EQ(written({"-o", "s.PDF"}), "s.PDF");
    EXPECT_TRUE(begins("s.PDF", "%PDF"));
    EXPECT_EQ(written({"--to", "svg"}), "a_surface.svg");
    EXPECT_TRUE(begins("a_surface.svg", "<?xml"));
    EXPECT_EQ(written({"--to", "png", "-o", "s.png"}), "s.png");
    EXPECT_TRUE(begins("s.png", "\x89PNG"));

    expect_refused({"export", "a.h5", "--to", "png", "-o", "x.svg"}, {"x.svg", "--to png", "extension"});
    expect_refused({"export", "a.h5", "--to", "png", "-o", "x.jpg"}, {"x.jpg", ".png, .svg or .pdf"});
    expect_refused({"export", "a.h5", "--to", "png", "-o", "x"}, {"-o x", ".png, .svg or .pdf"});
    expect_refused({"export", "a.h5", "-o", "x.tiff"}, {"x.tiff", ".png, .svg or .pdf"});
    expect_refused({"export", "a.h5", "--to", "csv", "-o", "x.csv"}, {"x.csv", "folder"});
    expect_refused({"export", "a.h5"}, {"--to"});
    expect_refused({"report", "a.h5", "-o", "x.pdf"}, {"x.pdf", ".html"});
}

TEST_F(Exports, NothingIsReplacedUnlessAsked)
{
    eight();
    const std::vector<Words> verbs = {
        {"export", "a.h5", "--to", "png"},      {"export", "a.h5", "--to", "png", "-o", "named.png"},
        {"export", "a.h5", "--to", "csv"},      {"report", "a.h5"},
        {"report", "a.h5", "-o", "named.html"}, {"replay", "a.h5", "--realization", "7", "-o", "seven.h5"}};
    for (const Words& verb : verbs) {
        SCOPED_TRACE(testing::PrintToString(verb));
        expect_done(verb);
        expect_refused(verb, {"already", "--force"});
        Words forced = verb;
        forced.push_back("--force");
        expect_done(forced);
    }
    // one of the same results, but another file's
    write_bytes(folder / "other.h5", "not a picture");
    expect_refused({"export", "a.h5", "--to", "csv", "-o", "a_csv"}, {"a_csv", "--force"});
    expect_done({"replay", "a.h5", "--realization", "6", "-o", "seven.h5", "--force", "--quiet"});
    expect_done({"report", "seven.h5", "--quiet"});
    EXPECT_NE(read_bytes(folder / "seven.html").find("Realization 6 "), std::string::npos);
    // its input is never replaced
    for (const Words& verb :
         {Words{"report", "a.h5", "-o", "a.h5"}, {"replay", "a.h5", "--realization", "1", "-o", "a.h5"}}) {
        Words forced = verb;
        forced.push_back("--force");
        const std::string before = read_bytes(folder / "a.h5");
        EXPECT_EQ(run(forced).status, 2);
        EXPECT_TRUE(read_bytes(folder / "a.h5") == before);
    }
}

TEST_F(Exports, NamesSayTheRealizationTheCellAndTheFrequencies)
{
    eight();
    EXPECT_EQ(written({"--to", "png", "--realization", "3"}), "a_strip_realization_3.png");
    EXPECT_EQ(written({"--to", "png", "--realization", "2"}), "a_strip_realization_2.png");
    EXPECT_EQ(written({"--to", "png", "--picture", "strip"}), "a_strip_realization_0.png");
    EXPECT_EQ(written({"--to", "png", "--picture", "order"}), "a_order.png"); // one of a cell: test_limit_state
    EXPECT_EQ(written({"--to", "png", "--picture", "slice"}), "a_slice.png");
    EXPECT_EQ(written({"--to", "png", "--frequency", "4"}), "a_slice_4Hz.png");
    EXPECT_EQ(written({"--to", "png", "--frequency", "8,4", "--limit", "rocked"}), "a_slice_4Hz_8Hz_rocked.png");
    EXPECT_EQ(names().size(), 8U);
}

TEST_F(Exports, WhatIsNotUsedIsRefused)
{
    eight();
    for (const Words& verb : {Words{"export", "a.h5", "--to", "png"}, Words{"export", "a.h5", "--to", "csv"},
                              Words{"report", "a.h5"}, Words{"replay", "a.h5", "--realization", "1"}}) {
        for (const std::string setting : {"no.such.key=3", "contact.friction=0.1"}) {
            Words words = verb;
            words.insert(words.end(), {"--set", setting});
            expect_refused(words, {"--set " + setting, "fixed"});
        }
        Words words = verb;
        words.insert(words.end(), {"--set", "excitation.file=x.at2"});
        expect_refused(words, {"not driven by a record"});
    }
    // the axis has 4 and 8 Hz
    for (const std::string beyond : {"9", "2", "0", "-1", "nan"})
        expect_refused({"export", "a.h5", "--to", "png", "--picture", "slice", "--frequency=" + beyond},
                       {"--frequency " + beyond, "4 to 8 Hz"});
    const Words png = {"export", "a.h5", "--to", "png", "--picture"};
    const auto refused = [&](const Words& more, const std::string& part) {
        Words words = png;
        words.insert(words.end(), more.begin(), more.end());
        expect_refused(words, {part});
    };
    refused({"surface", "--frequency", "4"}, "--frequency 4");
    refused({"surface", "--realization", "1"}, "--realization 1");
    refused({"order", "--realization", "1"}, "--realization 1");
    expect_refused({"export", "a.h5", "--to", "csv", "--title", "x"}, {"--title x"});
    expect_refused({"export", "a.h5", "--to", "csv", "--realization", "1"}, {"--realization 1"});
}

TEST_F(Exports, TheStudysTitleIsThePicturesAndChangesNoStudy)
{
    eight({"study.title=The column's \"south\" side"});
    const auto svg = [&](const Words& more) {
        const std::string name = written(more);
        const std::string text = read_bytes(folder / name);
        fs::remove(folder / name);
        return text;
    };
    // letters of the title are the picture's, not the file's name
    EXPECT_NE(svg({"--to", "svg"}).find("Probability of collapse: The column"), std::string::npos);
    EXPECT_NE(svg({"--to", "svg", "--picture", "slice"}).find("collapse: The column"), std::string::npos);
    EXPECT_NE(svg({"--to", "svg", "--realization", "5"}).find("side, realization 5"), std::string::npos);
    EXPECT_NE(svg({"--to", "svg", "--picture", "order"}).find("Falls: The column"), std::string::npos);
    for (const Words& picture : {Words{"--picture", "surface"}, Words{"--picture", "slice"},
                                 Words{"--picture", "order"}, Words{"--picture", "strip"}}) {
        Words words = picture;
        words.insert(words.end(), {"--to", "svg", "--title", "As I call it"});
        const std::string text = svg(words);
        EXPECT_NE(text.find("As I call it"), std::string::npos) << picture[1];
        EXPECT_EQ(text.find("south"), std::string::npos) << picture[1];
    }
    expect_done({"report", "a.h5", "--quiet"});
    EXPECT_NE(read_bytes(folder / "a.html").find("<h1>Results: The column&#39;s &quot;south&quot; side</h1>"),
              std::string::npos);
    expect_done({"report", "a.h5", "--title", "As I call it", "--force", "--quiet"});
    EXPECT_NE(read_bytes(folder / "a.html").find("<h1>As I call it</h1>"), std::string::npos);

    // another title, or none, is no other study; another key is
    for (const Words& more : {Words{}, Words{"study.title=Another"}}) {
        Words settings = eight_realizations;
        settings.insert(settings.end(), more.begin(), more.end());
        const Ended again = run(run_words(column_study, settings, {"-o", "a.h5"}));
        EXPECT_NE((again.out + again.err).find("already complete"), std::string::npos) << testing::PrintToString(again);
    }
    expect_refused(run_words(column_study, {"study.title=" + std::string(201, 'x')}, {"-o", "b.h5"}),
                   {"study.title", "200 bytes"});
}

TEST_F(Exports, ACapitalIsCalledOne)
{
    const Words settings = {"study.realizations=1",
                            "contact.normal_stiffness_n_m2=1e8",
                            "contact.tangential_stiffness_n_m=1e8",
                            "surface.frequency_hz={from=0.5,to=1.0,count=2}",
                            "surface.pga_m_s2={from=1.0,to=9.0,count=2}",
                            "excitation.cycles=4"};
    expect_done(run_words(doric_column, settings, {"-o", "a.h5", "--quiet"}));
    const std::string svg = read_bytes(folder / written({"--to", "svg", "--realization", "3"}));
    EXPECT_NE(svg.find("8 drums and 1 capital"), std::string::npos);
    expect_done({"report", "a.h5", "--quiet"});
    const std::string page = read_bytes(folder / "a.html");
    EXPECT_NE(page.find("8 drums: width"), std::string::npos);
    EXPECT_NE(page.find("1 capital: width 1.7 m"), std::string::npos);
    const Ended told = expect_done({"export", "a.h5", "--to", "csv"});
    EXPECT_NE(read_bytes(folder / "a_csv" / "blocks.csv").find("capital"), std::string::npos);
}

} // namespace
} // namespace stylobate
