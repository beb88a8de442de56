/// Names of files, titles and stations that would be markup, formulas, commands or line ends elsewhere: in every output
/// they are text, as another reader takes it, and no shell ever meets them.

#include "tests/program/program.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>

namespace stylobate {
namespace {

const std::vector<std::string> hostile = {"<script>alert(1)<&script>",
                                          "\"a\",b",
                                          "=cmd|' &C calc'!A0",
                                          "a'b$(touch x)`touch y`",
                                          "@SUM(1)",
                                          "-5+3 --x-->",
                                          " back\\slash",
                                          "caf\xc3\xa9 ]]> &amp;",
                                          "%n%s{0}{}",
                                          "+1;touch z"};

/// Sines of other strengths under hostile names, and a study of them with a hostile title.
class HostileNames : public Program {
protected:
    static void write_record(const fs::path& file, double strength)
    {
        std::string text;
        for (int i = 0; i < 400; ++i)
            text += fmt::format("{:.2f} {:.6f}\n", 0.01 * i, strength * std::sin(0.12566 * i));
        write_bytes(file, text);
    }
    void SetUp() override
    {
        Program::SetUp();
        fs::create_directory(folder / "records");
        for (std::size_t k = 0; k < hostile.size(); ++k)
            write_record(folder / "records" / hostile[k], 2 + 0.3 * static_cast<double>(k));
        write_bytes(folder / "study.toml",
                    "[study]\nkind = \"fragility\"\nrealizations = 1\n"
                    "title = '<img src=x onerror=alert(2)>, \"q\" $(touch t) =1+1'\n"
                    "[structure]\nkind = \"column\"\nblocks = 2\ndrum_width_m = 0.5\ndrum_height_m = 1.0\n"
                    "depth_m = 1.0\ndensity_kg_m3 = 2700\n"
                    "[contact]\nnormal_stiffness_n_m2 = 1e7\nnormal_damping_ratio = 0.1\n"
                    "tangential_damping_ratio = 0.1\nfriction = 0.68\n"
                    "[excitation]\nkind = \"record\"\n"
                    "[fragility]\nfolder = \"records\"\nunit = \"m/s2\"\n"
                    "intensity = { measure = \"pga\", from = 1.0, to = 9.0, count = 3, spacing = \"log\" }\n"
                    "[perturbation]\n"
                    "friction = { distribution = \"normal\", cov = 0.1, min = 0.36, max = 0.84, per = \"joint\" }\n");
    }
    void TearDown() override
    {
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            for (const char* touched : {"x", "y", "z", "t"})
                EXPECT_NE(entry.path().filename(), touched) << "a shell has met a name";
        Program::TearDown();
    }
    Ended done(const Words& words) const
    {
        Ended ended = run(words);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return ended;
    }
};

/// Fields of a CSV text by RFC 4180, line by line.
std::vector<std::vector<std::string>> rfc_4180(const std::string& text)
{
    std::vector<std::vector<std::string>> lines(1, std::vector<std::string>(1));
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string& field = lines.back().back();
        if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"')
            field += text[++i];
        else if (text[i] == '"')
            quoted = !quoted;
        else if (!quoted && text[i] == ',')
            lines.back().emplace_back();
        else if (!quoted && text[i] == '\n')
            lines.emplace_back(1);
        else
            field += text[i];
    }
    EXPECT_FALSE(quoted);
    lines.pop_back();
    return lines;
}

TEST_F(HostileNames, AreTextInEveryOutput)
{
    const std::string results = "<b>\"o',$(touch x);.h5";
    done({"run", "study.toml", "-o", results, "--quiet"});
    for (const std::string format : {"csv", "nrml", "json", "vtk"})
        done({"export", results, "--to", format, "-o", "out_" + format});
    for (const std::string format : {"svg", "pdf", "png"})
        done({"export", results, "-o", "out." + format});
    done({"report", results, "-o", "page.html", "--animate", "0"});
    json_of(done({"info", results, "--json"}));
    EXPECT_TRUE(json_of(done({"verify-file", results, "--json"}))["well"].boolean);

    // tables: no field begins a formula, and all names are there
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "out_csv"))
        for (const Words& line : rfc_4180(read_bytes(entry.path())))
            for (const std::string& field : line) {
                if (!field.empty() && std::string("=+-@").find(field[0]) != std::string::npos) {
                    char* end = nullptr;
                    std::strtod(field.c_str(), &end);
                    EXPECT_EQ(*end, '\0') << entry.path() << ": " << field;
                }
                names.insert(field.starts_with('\'') ? field.substr(1) : field);
            }
    for (const std::string& name : hostile)
        EXPECT_TRUE(names.contains(name)) << name;

    // pages and pictures: no tag of a name or of the title
    for (const std::string file : {"page.html", "out.svg"}) {
        const std::string text = read_bytes(folder / file);
        for (const char* tag : {"<script>alert", "<img src=x", "<b>\""})
            EXPECT_EQ(text.find(tag), std::string::npos) << file << ": " << tag;
    }
    EXPECT_NE(read_bytes(folder / "page.html").find("&lt;img src=x onerror=alert(2)&gt;"), std::string::npos);
    int json_files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string ending = entry.path().extension();
        if (ending == ".json") {
            ++json_files;
            EXPECT_NO_THROW(JsonParser::parse(read_bytes(entry.path()))) << entry.path();
        }
    }
    EXPECT_GT(json_files, 0);
    // the name chooses its motion
    const Ended replay = done({"replay", results, "--motion", hostile[3], "--nth", "1", "--stood"});
    EXPECT_NE(replay.out.find("bitwise identical"), std::string::npos) << testing::PrintToString(replay);
}

/// Results have the names of the motions in their study: what they could not hold is refused before anything runs.
TEST_F(HostileNames, ThatResultsCannotHoldAreRefusedAtOnce)
{
    for (const std::string name : {"new\nline", "latin \xe9", "red \x1b[31m"}) {
        write_record(folder / "records" / name, 3);
        const Ended ended = run({"run", "study.toml", "-o", "results.h5"});
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
        EXPECT_NE(ended.err.find("Rename the file."), std::string::npos) << ended.err;
        EXPECT_EQ(ended.err.find('\x1b'), std::string::npos) << "a terminal would obey it";
        EXPECT_FALSE(fs::exists(folder / "results.h5"));
        fs::remove(folder / "records" / name);
    }
}

/// The sources start other programs in one place only, by their path and words.
TEST(NoShell, IsStarted)
{
    std::set<std::string> starters;
    for (const char* room : {"kernels", "ensemble", "io", "studies", "library", "python/module"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(STYLOBATE_SOURCE_DIR) / room)) {
            const std::string ending = entry.path().extension();
            if (ending != ".cpp" && ending != ".hpp")
                continue;
            const std::string text = read_bytes(entry.path());
            for (const char* shell :
                 {"popen(", "std::system(", "::system(", "wordexp(", "execl(", "execlp(", "execvp("})
                EXPECT_EQ(text.find(shell), std::string::npos) << entry.path() << ": " << shell;
            if (text.find("posix_spawn(") != std::string::npos)
                starters.insert(fs::relative(entry.path(), STYLOBATE_SOURCE_DIR));
        }
    EXPECT_EQ(starters, (std::set<std::string>{"io/files/program.cpp"}));
}

} // namespace
} // namespace stylobate
