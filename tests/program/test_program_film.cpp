/// `stylobate export --to html, gif, mp4, webm`: one realization in motion.

#include "io/files/program.hpp"
#include "tests/program/program.hpp"

#include <fmt/format.h>

namespace stylobate {
namespace {

class FilmExport : public Program {
protected:
    void SetUp() override
    {
        Program::SetUp();
        make("one.h5", STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml");
    }
    void make(const std::string& results, const std::string& study) const
    {
        EXPECT_EQ(run({"run", study, "-o", results, "--quiet"}).status, 0);
    }
    void TearDown() override
    {
        ::unsetenv("STYLOBATE_FFMPEG");
        Program::TearDown();
    }

    struct FilmBytes {
        std::string all;           ///< (frames x height x width x 3)
        int width = 0, height = 0; ///< [px]
    };
    /// What ffmpeg is given of a results file. @param name without .h5
    FilmBytes film_of(const std::string& name) const
    {
        use_recorder();
        EXPECT_EQ(run({"export", name + ".h5", "-o", name + ".gif"}).status, 0);
        return recorded();
    }
    /// A program in ffmpeg's place, which keeps its words and what it reads.
    void use_recorder() const
    {
        use(fmt::format("for last; do :; done\nprintf '%s\\n' \"$@\" > {}\ncat > {}\necho film > \"$last\"\n",
                        (folder / "words").string(), (folder / "frames").string()));
    }
    FilmBytes recorded() const
    {
        const std::string said = read_bytes(folder / "words");
        FilmBytes film{read_bytes(folder / "frames"), 0, 0};
        EXPECT_EQ(std::sscanf(said.c_str() + said.find("\n-s\n") + 4, "%dx%d", &film.width, &film.height), 2) << said;
        return film;
    }

    /// A program in ffmpeg's place, which does these commands.
    void use(const std::string& commands) const
    {
        write_bytes(folder / "ffmpeg.sh", "#!/bin/sh\n" + commands);
        fs::permissions(folder / "ffmpeg.sh", fs::perms::owner_all);
        ::setenv("STYLOBATE_FFMPEG", (folder / "ffmpeg.sh").c_str(), 1);
    }
};

TEST_F(FilmExport, GivesEveryFrameToFfmpeg)
{
    for (const auto& [format, rate] : {std::pair<std::string, double>{"gif", 25}, {"mp4", 50}, {"webm", 50}}) {
        use_recorder();
        const Ended ended = run({"export", "one.h5", "-o", "one." + format});
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(ended.out, "one." + format + "\n");
        EXPECT_EQ(read_bytes(folder / ("one." + format)), "film\n");
        const auto [all, width, height] = recorded();
        const std::string said = read_bytes(folder / "words");
        EXPECT_NE(said.find(fmt::format("\n-r\n{}\n", rate)), std::string::npos) << said;
        const double end = ResultReader(folder / "one.h5").trajectory(0).time_s.back();
        const auto count = static_cast<std::size_t>(std::floor(end * rate + 1e-9)) + 1;
        EXPECT_EQ(all.size(), count * 3U * static_cast<unsigned>(width * height));
        // the block is there, and moves: the first frame is not the last
        const std::size_t one = all.size() / count;
        EXPECT_NE(all.substr(0, one), all.substr(all.size() - one));
    }
}

/// Pixels whose colour has the ratios of this one: a shaded face.
std::size_t pixels_like(std::string_view frame, double red, double green, double blue)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < frame.size(); i += 3) {
        const auto part = [&](std::size_t k) { return static_cast<double>(static_cast<unsigned char>(frame[i + k])); };
        const double brightness = part(0) / red;
        count += brightness > 0.5 && std::abs(part(1) - brightness * green) <= 2 &&
                 std::abs(part(2) - brightness * blue) <= 2;
    }
    return count;
}

TEST_F(FilmExport, InSpaceADrumFallsAndChangesItsColour)
{
    write_bytes(folder / "drum.toml", R"([study]
kind = "single"
[structure]
dimensions = 3
blocks = 1
drum_width_m = 0.5
drum_height_m = 2
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m3 = 1e9
friction = 0.7
[excitation]
kind = "full_sine"
frequency_hz = 1
pga_m_s2 = 6
tail_s = 3
)");
    make("drum.h5", "drum.toml");
    const auto [all, width, height] = film_of("drum");
    const std::size_t one = 3U * static_cast<unsigned>(width * height);
    ASSERT_GT(one, 0U);
    ASSERT_EQ(all.size() % one, 0U);
    const std::string_view first(all.data(), one), last(all.data() + all.size() - one, one);
    EXPECT_GT(pixels_like(first, 233, 226, 208), 200U);
    EXPECT_LT(pixels_like(first, 227, 160, 143), 20U);
    EXPECT_GT(pixels_like(last, 227, 160, 143), 200U);
}

TEST_F(FilmExport, ARodStaysWhereItsEndIs)
{
    // a block leans to the left and falls to the right; a rod that only pushes touches it at the start
    EXPECT_EQ(run({"run", STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml", "-o", "rod.h5", "--quiet", "--set",
                   "mechanisms.rod={block=0,to_right_n_m=2000,height_m=0.16,speed_m_s=0.1,start_s=0.2,travel_m=0.02}"})
                  .status,
              0);
    const FilmBytes film = film_of("rod");
    const std::size_t one = 3U * static_cast<unsigned>(film.width * film.height);
    ASSERT_GT(one, 0U);
    const auto tip = [&](std::size_t from) { // the last pixel of the rod, from the left edge
        int last = -1;
        for (int y = 0; y < film.height; ++y)
            for (int x = 0; x < film.width; ++x)
                if (film.all.compare(from + 3U * static_cast<unsigned>(y * film.width + x), 3, "\x1d\x27\x30") == 0)
                    last = std::max(last, x);
        return last;
    };
    const int first = tip(0), end = tip(film.all.size() - one);
    ASSERT_GT(first, 0);
    const double start_m = ResultReader(folder / "rod.h5").trajectory(0)["x_m"][0];
    EXPECT_LT(start_m, 0) << "it leans to the left";
    EXPECT_GT(end, first) << "it has gone on by 20 mm";
    EXPECT_LT(end, film.width / 2) << "and stays behind, while the block goes to the right";

    EXPECT_EQ(run({"export", "rod.h5", "--to", "html", "-o", "rod.html"}).status, 0);
    const std::string page = read_bytes(folder / "rod.html");
    EXPECT_NE(page.find("\"right\": false, \"tip\": ["), std::string::npos);
}

TEST_F(FilmExport, AsAPageOfItsOwn)
{
    const Ended ended = run({"export", "one.h5", "--to", "html", "--title", "A <block>"});
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(ended.out, "one_realization_0.html\n");
    const std::string page = read_bytes(folder / "one_realization_0.html");
    EXPECT_NE(page.find("<h1>A &lt;block&gt;</h1>"), std::string::npos);
    EXPECT_EQ(count_of(page, "id=\"animations\""), 1U);
    EXPECT_EQ(count_of(page, "<div data-player"), 1U);
    EXPECT_EQ(count_of(page, "<img"), 0U);
}

TEST_F(FilmExport, RefusesWhatCannotBeWritten)
{
    expect_refused({"export", "one.h5", "--to", "gif", "-o", "one.mp4"}, {"--to gif", "one.mp4"});
    expect_refused({"export", "one.h5", "--to", "html", "--picture", "strip"}, {"--picture strip", "--realization"});
    expect_refused({"export", "one.h5", "--to", "html", "--realization", "9"}, {"--realization 9"});
    expect_refused({"export", "one.h5", "-o", "no/one.html"}, {"no/one.html", "nothing was written"});
    ::setenv("STYLOBATE_FFMPEG", "/none/such", 1);
    expect_refused({"export", "one.h5", "--to", "mp4"}, {"STYLOBATE_FFMPEG", "/none/such"});
    const std::string path = std::getenv("PATH");
    ::unsetenv("STYLOBATE_FFMPEG");
    ::setenv("PATH", "/none", 1);
    expect_refused({"export", "one.h5", "--to", "webm"}, {"ffmpeg was not found", "apt install ffmpeg"});
    ::setenv("PATH", path.c_str(), 1);
}

TEST_F(FilmExport, ReportsWhatFfmpegReports)
{
    // one that fails at once, and one that reads nothing and leaves nothing
    for (const auto& [commands, part] :
         {std::pair<std::string, std::string>{"echo no such codec >&2\nexit 3\n", "no such codec"},
          {"exit 0\n", "no message"}}) {
        use(commands);
        const Ended ended = run({"export", "one.h5", "--to", "mp4"});
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(ended);
        EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
        expect_one_message(ended.err, ended.err);
        EXPECT_FALSE(fs::exists(folder / "one_realization_0.mp4"));
    }
}

TEST_F(FilmExport, AnInterruptLeavesNothing)
{
    // the interrupt comes while the film is made; ffmpeg itself ends well
    use("for last; do :; done\nkill -INT $PPID\ncat > /dev/null\necho film > \"$last\"\n");
    const Words before = names();
    const Ended ended = run({"export", "one.h5", "--to", "mp4"});
    EXPECT_EQ(ended.status, 130) << testing::PrintToString(ended);
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find("interrupted: 'one_realization_0.mp4' was not written"), std::string::npos) << ended.err;
    EXPECT_EQ(names(), before);
}

TEST_F(FilmExport, TheEndingMayBeInCapitals)
{
    use("for last; do :; done\ncat > /dev/null\necho film > \"$last\"\n");
    EXPECT_EQ(run({"export", "one.h5", "-o", "one.MP4", "--quiet"}).status, 0);
    EXPECT_EQ(read_bytes(folder / "one.MP4"), "film\n");
    expect_refused({"export", "one.h5", "-o", "one.mov"}, {"one.mov", ".mp4", ".png"});
}

TEST_F(FilmExport, WithTheRealFfmpeg)
{
    if (!find_program("ffmpeg"))
        GTEST_SKIP() << "ffmpeg is not installed";
    const std::map<std::string, std::string> begins = {
        {"gif", "GIF89a"}, {"mp4", std::string("\0\0\0", 3)}, {"webm", "\x1a\x45\xdf\xa3"}};
    for (const auto& [format, magic] : begins) {
        const Ended ended = run({"export", "one.h5", "-o", "film." + format, "--quiet"});
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const std::string film = read_bytes(folder / ("film." + format));
        EXPECT_TRUE(film.starts_with(magic)) << format;
        EXPECT_GT(film.size(), 2000U) << format;
    }
}

} // namespace
} // namespace stylobate
