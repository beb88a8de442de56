/// `stylobate report`, as its user runs it.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "tests/program/program.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

namespace stylobate {
namespace {

const std::string rocking_report_study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";

class Report : public Program {
protected:
    void expect_done(const Words& arguments) const
    {
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }
    std::string page(const std::string& name) const { return read_page(folder / name); }
    /// Has them, in this order.
    static void expect_has(const std::string& page, const Words& parts)
    {
        std::size_t at = 0;
        for (const std::string& part : parts) {
            const std::size_t next = page.find(part, at);
            EXPECT_NE(next, std::string::npos) << part;
            at = next == std::string::npos ? at : next;
        }
    }
};

TEST_F(Report, OfASurface)
{
    expect_done(run_words(column_study, eight_realizations, {"-o", "surface.h5", "--quiet"}));
    const Ended ended = run(Words{"report", "surface.h5", "--json"});
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(json_of(ended)["written"].text, "surface.html");
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(names(), (Words{"surface.h5", "surface.html"}));
    const std::string html = page("surface.html");
    expect_has(html, {"Results: surface", "valid realizations over 2 × 2 cells", "The study", "7 drums (1 fixed)",
                      "Outcomes", "of 8</td>", "Probability of collapse", "Order of falls", "Energy audit",
                      "stylobate run STUDY.toml", "[perturbation"});
    // its axes say how strong the shaking is, and a fall is what the engine takes for one
    EXPECT_EQ(html.find("as recorded"), std::string::npos);
    expect_has(html,
               {"below 0.6 of its height at rest above the base, or when it has rotated beyond its own slenderness"});
    // the surface and its slice are drawn here, the order of falls by io/plots
    EXPECT_EQ(count_of(html, "data-cell=\""), 4U);
    EXPECT_EQ(count_of(html, "src=\"data:image/svg+xml;base64,"), 1U);
    EXPECT_EQ(count_of(html, "<img"), 1U);
    EXPECT_EQ(count_of(html, "http"), count_of(html, "http://www.w3.org/2000/svg") + count_of(html, "http-equiv"));
}

TEST_F(Report, OfASingleRealizationAndOfAReplay)
{
    expect_done({"run", rocking_report_study, "-o", "one.h5", "--quiet"});
    expect_done({"report", "one.h5", "-o", "page.html", "--quiet"});
    std::string html = page("page.html");
    expect_has(html, {"Results: one", "Realization 0 did not collapse; it rocked more than it slid", "1 drum: width",
                      "Motion", "Displacements", "Energy audit", "drum_height_m"});
    EXPECT_EQ(count_of(html, "<img"), 1U);
    EXPECT_EQ(html.find("Order of falls"), std::string::npos);

    expect_done(run_words(column_study, eight_realizations, {"-o", "surface.h5", "--quiet"}));
    expect_done({"replay", "surface.h5", "--realization", "7", "-o", "seven.h5", "--quiet"});
    expect_done({"report", "seven.h5", "--quiet"});
    html = page("seven.html");
    expect_has(html, {"Kind of study: replay", "Realization 7 ", "8 Hz, PGA 16 m/s²", "Drawn in this realization",
                      "Motion", "--realization 7 -o seven.h5"});
    // not the axes of the surface that it is from
    const std::string facts = html.substr(html.find("Settings of the study"));
    EXPECT_EQ(facts.substr(0, facts.find("</details>")).find("2 from"), std::string::npos) << facts;
}

TEST_F(Report, LinksToThePageOfTheBrowser)
{
    expect_done({"run", rocking_report_study, "-o", "one.h5", "--quiet"});
    expect_done({"report", "one.h5", "--quiet"});
    EXPECT_EQ(page("one.html").find("#study="), std::string::npos);
    expect_done({"report", "one.h5", "--quiet", "--force", "--web", "https://example.org/a&b/"});
    const std::string html = page("one.html");
    const std::string link = "<a href=\"https://example.org/a&amp;b/#study=";
    const std::size_t at = html.find(link);
    ASSERT_NE(at, std::string::npos);
    const std::string study = html.substr(at + link.size(), html.find('"', at + link.size()) - at - link.size());
    EXPECT_GT(study.size(), 500U);
    EXPECT_EQ(study.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"),
              std::string::npos);
    EXPECT_TRUE(study.starts_with("W3N0dWR5XQ")) << study.substr(0, 20); // "[study]"
}

TEST_F(Report, OfADiagnosis)
{
    write_diagnosis(filled_diagnosis(), folder / "diagnosis.h5");
    const Ended ended = run(Words{"report", "diagnosis.h5"});
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(ended.out, "diagnosis.html\n");
    const std::string html = page("diagnosis.html");
    expect_has(html, {"Diagnosis: Seven drums &lt;script&gt;", "The cause: joint_friction", "Candidates"});
    EXPECT_EQ(html.find("<script>alert"), std::string::npos);
}

TEST_F(Report, NeedsNoLibraryForItsPictures)
{
    expect_done({"run", rocking_report_study, "-o", "one.h5", "--quiet"});
    ::setenv("STYLOBATE_LIBRSVG", "/none/such", 1);
    const Ended ended = run(Words{"report", "one.h5"});
    ::unsetenv("STYLOBATE_LIBRSVG");
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(ended.err.find("warning"), std::string::npos) << ended.err;
    const std::string html = page("one.html");
    expect_has(html, {"data:image/svg+xml;base64,", "Energy audit"});
    EXPECT_EQ(html.find("could not be drawn"), std::string::npos);
}

TEST_F(Report, RefusesBadInputAndWritesNothing)
{
    expect_done({"run", rocking_report_study, "-o", "one.h5", "--quiet"});
    write_diagnosis(filled_diagnosis(), folder / "diagnosis.h5");
    write_bytes(folder / "study.h5", read_bytes(rocking_report_study));
    write_bytes(folder / "empty.h5", "");
    for (const std::string name : {"one", "diagnosis"}) {
        std::string bytes = read_bytes(folder / (name + ".h5"));
        write_bytes(folder / (name + "_short.h5"), std::string_view(bytes).substr(0, bytes.size() / 2));
        bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
        write_bytes(folder / (name + "_damaged.h5"), bytes);
        expect_refused({"report", name + "_short.h5"}, {name + "_short.h5", "truncated"});
        expect_refused({"report", name + "_damaged.h5"}, {name + "_damaged.h5", "damaged"});
    }
    expect_refused({"report", "none.h5"}, {"none.h5", "no such file"});
    expect_refused({"report", "study.h5"}, {"study.h5", "is a study file"});
    expect_refused({"report", "empty.h5"}, {"empty.h5", "empty"});
    fs::create_directory(folder / "page.html");
    expect_refused({"report", "diagnosis.h5", "--set", "contact.friction=1"},
                   {"--set contact.friction=1", "diagnosis"});
    for (const char* file : {"one.h5", "diagnosis.h5"}) {
        expect_refused({"report", file, "-o", "page.pdf"}, {"page.pdf", ".html"});
        expect_refused({"report", file, "-o", "page.html"}, {"page.html", "nothing was written"});
        expect_refused({"report", file, "-o", "no/page.html"}, {"no/page.html", "nothing was written"});
        expect_refused({"report", file, "-o", file}, {file, "the input file"});
    }
}

} // namespace
} // namespace stylobate
