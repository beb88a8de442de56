#pragma once
/// Runs the program as its user does: in a folder of its own, with arguments, and sees what it prints and leaves
/// behind.

#include "io/store/result_store.hpp"
#include "tests/program/json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <poll.h>
#include <pty.h>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace stylobate {

namespace fs = std::filesystem;

/// Some tests are as long as the program is slow.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
inline constexpr bool slow_build = true;
#else
inline constexpr bool slow_build = false;
#endif

struct ProgramRun {
    std::vector<std::string> arguments;
    bool terminal = false;     ///< standard error is a (pseudo-)terminal
    bool no_privilege = false; ///< root, too, may read and write only where the permissions say so
    int signal = 0;            ///< sent as soon as `when` holds
    std::function<bool(const std::string& err)> when = [](const std::string&) { return true; };
    double limit_s = 1200; ///< killed then: it hangs, however slow the machine is
};

struct Ended {
    int status = -1; ///< exit status, -1 if a signal ended it
    int signal = 0;  ///< that signal
    bool timed_out = false;
    double seconds = 0;
    std::string out, err;
};

/// How many realizations the last progress line of a terminal says are done; 0 without one.
inline std::uint64_t progress_in(const std::string& err)
{
    const std::size_t end = err.rfind(" realizations,");
    const std::size_t begin = end == std::string::npos ? end : err.rfind("\x1b[K", end);
    return begin == std::string::npos ? 0 : std::strtoull(err.c_str() + begin + 3, nullptr, 10);
}

/// Holds once that many are done, of a program with a terminal.
inline std::function<bool(const std::string&)> when_done(std::uint64_t realizations)
{
    return [realizations](const std::string& err) { return progress_in(err) >= realizations; };
}

/// Holds once there is such a file.
inline std::function<bool(const std::string&)> when_there(const fs::path& file)
{
    return [file](const std::string&) { return fs::exists(file); };
}

inline void PrintTo(const Ended& ended, std::ostream* to)
{
    *to << "exit status " << ended.status << ", signal " << ended.signal << (ended.timed_out ? ", timed out" : "")
        << "\n--- stdout\n"
        << ended.out << "\n--- stderr\n"
        << ended.err;
}

/// One end of a pipe or of a pseudo-terminal, read to its end.
struct Capture {
    int descriptor = -1;
    std::string* text = nullptr;

    void read()
    {
        char buffer[65536];
        const ssize_t n = ::read(descriptor, buffer, sizeof buffer);
        if (n > 0)
            text->append(buffer, static_cast<std::size_t>(n));
        else if (n == 0 || errno != EINTR) // a pseudo-terminal ends with EIO
            close();
    }
    void close()
    {
        ::close(descriptor);
        descriptor = -1;
    }
};

inline Ended run_program(const ProgramRun& run, const fs::path& folder)
{
    std::vector<std::string> words = run.arguments;
    words.insert(words.begin(), STYLOBATE_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    Ended ended;
    int out[2] = {}, err[2] = {};
    const bool opened =
        ::pipe2(out, O_CLOEXEC) == 0 &&
        (run.terminal ? ::openpty(&err[0], &err[1], nullptr, nullptr, nullptr) : ::pipe2(err, O_CLOEXEC)) == 0;
    if (!opened) {
        ADD_FAILURE() << "no pipe or pseudo-terminal";
        return ended;
    }
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const pid_t child = ::fork();
    if (child == 0) {
        ::setpgid(0, 0);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL); // it does not outlive a test that is stopped
        ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
        ::dup2(out[1], STDOUT_FILENO);
        ::dup2(err[1], STDERR_FILENO);
        if (run.terminal) {
            ::close(err[0]);
            ::close(err[1]);
        }
        if (run.no_privilege && ::geteuid() == 0)
            for (const int capability : {1, 2}) // CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH
                ::prctl(PR_CAPBSET_DROP, capability);
        if (::chdir(folder.c_str()) == 0)
            ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(out[1]);
    ::close(err[1]);

    Capture captures[] = {{out[0], &ended.out}, {err[0], &ended.err}};
    bool signalled = run.signal == 0;
    while (captures[0].descriptor >= 0 || captures[1].descriptor >= 0) {
        pollfd polled[2];
        for (int i = 0; i < 2; ++i)
            polled[i] = {captures[i].descriptor, POLLIN, 0};
        const double due = signalled ? run.limit_s - passed() : 0.002; // what it waits for may be no output
        const auto wait = std::chrono::duration<double>(std::max(due, 0.0));
        const timespec timeout{static_cast<time_t>(wait.count()),
                               static_cast<long>(1e9 * (wait.count() - std::floor(wait.count())))};
        if (::ppoll(polled, 2, &timeout, nullptr) > 0)
            for (int i = 0; i < 2; ++i)
                if (captures[i].descriptor >= 0 && polled[i].revents != 0)
                    captures[i].read();
        if (!signalled && run.when(ended.err)) {
            ::kill(child, run.signal);
            signalled = true;
        }
        if (passed() >= run.limit_s && !ended.timed_out) {
            ended.timed_out = true;
            ::kill(-child, SIGKILL); // with what it has started
            for (Capture& capture : captures)
                if (capture.descriptor >= 0)
                    capture.close();
        }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ended.seconds = passed();
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    ended.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return ended;
}

inline std::string read_bytes(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A page, with ordinary blanks inside its intervals: no line breaks there.
inline std::string read_page(const fs::path& file)
{
    constexpr std::string_view unbroken = "&nbsp;";
    std::string page = read_bytes(file);
    for (std::size_t at = page.find(unbroken); at != std::string::npos; at = page.find(unbroken, at))
        page.replace(at, unbroken.size(), " ");
    return page;
}

inline void write_bytes(const fs::path& file, std::string_view content)
{
    std::ofstream out(file, std::ios::binary);
    out << content;
    EXPECT_TRUE(out.flush()) << file;
}

inline std::size_t count_of(std::string_view text, std::string_view part)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
        ++n;
    return n;
}

/// The JSON value that `ended` printed, and printed alone.
inline JsonValue json_of(const Ended& ended)
{
    try {
        return JsonParser::parse(ended.out);
    } catch (const std::exception& error) {
        ADD_FAILURE() << error.what() << "\n" << testing::PrintToString(ended);
        return {};
    }
}

/// A file as it lies in a folder: two are equal if nothing has touched it.
struct FileState {
    std::string content;
    std::int64_t changed_ns = 0;
    unsigned mode = 0;
    bool operator==(const FileState&) const = default;
};

/// A fresh folder for each test, and the program run in it.
class Program : public testing::Test {
protected:
    void SetUp() override
    {
        std::string name = (fs::temp_directory_path() / "stylobate-program-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override
    {
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_directory() && !entry.is_symlink())
                fs::permissions(entry, fs::perms::owner_all, fs::perm_options::add);
        fs::remove_all(folder);
    }

    using Words = std::vector<std::string>;

    Ended run(const ProgramRun& program) const { return run_program(program, folder); }
    Ended run(const Words& arguments) const { return run_program({.arguments = arguments}, folder); }

    std::string bytes(const std::string& name) const { return read_bytes(folder / name); }

    /// What a run prints after the line with its time.
    static std::string without_first_line(const std::string& text)
    {
        const std::size_t first = text.find(" collapsed, ");
        const std::size_t end = text.find('\n', first == std::string::npos ? 0 : first);
        return end == std::string::npos ? "" : text.substr(end);
    }

    /// A study's results are the same bytes with scalar steps on one thread, and where the run is interrupted in turn
    /// by Ctrl-C and by its death until a part comes to the end.
    /// @param words the program's words for given results, threads and instruction set
    template <class MakeWords>
    void expect_no_byte_changes(const MakeWords& words) const
    {
        const Ended whole = run(words("whole.h5", "2", "auto"));
        ASSERT_EQ(whole.status, 0) << testing::PrintToString(whole);
        ASSERT_EQ(run(words("scalar.h5", "1", "scalar")).status, 0);
        EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "scalar.h5"));

        const std::uint64_t rows = ResultReader(folder / "whole.h5").done();
        std::uint64_t kept = 0;
        int parts = 0;
        Ended ended;
        do {
            ProgramRun part = words("parts.h5", parts % 2 == 0 ? "1" : "3", parts % 2 == 0 ? "scalar" : "auto");
            if (parts < 6) {
                part.terminal = true;
                part.signal = parts % 2 == 0 ? SIGINT : SIGKILL;
                part.when = when_done(kept + 1 + rows / 8);
            }
            ended = run(part);
            ++parts;
            const ResultReader reader(folder / "parts.h5");
            EXPECT_GE(reader.done(), kept) << "what was kept is lost";
            kept = reader.done();
            if (ended.status == 130 && ended.out.starts_with('{')) {
                EXPECT_EQ(json_of(ended)["realizations"].number, static_cast<double>(kept));
            } else if (ended.status == 130) {
                EXPECT_NE(ended.out.find(std::to_string(kept) + " realizations are kept"), std::string::npos)
                    << testing::PrintToString(ended);
            }
        } while (ended.status != 0 && parts < 8);
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_GT(parts, 1);
        EXPECT_TRUE(read_bytes(folder / "whole.h5") == read_bytes(folder / "parts.h5"));

        const Ended again = run(words("whole.h5", "1", "auto"));
        EXPECT_EQ(again.status, 0);
        EXPECT_EQ(again.err, "");
        if (again.out.starts_with('{')) {
            const JsonValue first = json_of(whole), second = json_of(again);
            for (const char* key : {"realizations", "collapsed", "invalid"})
                EXPECT_EQ(first[key].number, second[key].number) << key;
            EXPECT_TRUE(second["complete"].boolean);
            return;
        }
        EXPECT_NE(again.out.find("already complete"), std::string::npos) << again.out;
        // the rest is what the run said
        EXPECT_EQ(without_first_line(again.out), without_first_line(whole.out));
    }

    /// All below the folder; the modification time of a folder is part of it.
    std::map<std::string, FileState> contents() const
    {
        std::map<std::string, FileState> all;
        const auto add = [&](const fs::path& path) {
            struct stat status = {};
            ASSERT_EQ(::lstat(path.c_str(), &status), 0) << path;
            FileState state;
            state.changed_ns = std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
            state.mode = status.st_mode;
            if (S_ISREG(status.st_mode))
                state.content = read_bytes(path);
            all[path.lexically_relative(folder)] = state;
        };
        add(folder);
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            add(entry.path());
        return all;
    }

    /// The names in the folder, in order.
    Words names() const
    {
        Words all;
        for (const auto& entry : fs::directory_iterator(folder))
            all.push_back(entry.path().filename());
        std::sort(all.begin(), all.end());
        return all;
    }

    /// Bad input: one message that has all of `parts`, exit status 2, nothing on standard output, nothing changed.
    void expect_refused(const Words& arguments, const Words& parts) const
    {
        expect_refused(ProgramRun{.arguments = arguments}, parts);
    }
    void expect_refused(const ProgramRun& program, const Words& parts) const
    {
        const Words& arguments = program.arguments;
        const auto before = contents();
        const Ended ended = run(program);
        const std::string what = testing::PrintToString(arguments) + "\n" + testing::PrintToString(ended);
        EXPECT_EQ(ended.status, 2) << what;
        EXPECT_EQ(ended.out, "") << what;
        expect_one_message(ended.err, what);
        for (const std::string& part : parts)
            EXPECT_NE(ended.err.find(part), std::string::npos) << "lacks '" << part << "': " << what;
        EXPECT_TRUE(contents() == before) << "the folder has changed: " << what;
    }

    /// "stylobate: ..." and perhaps some more lines, which are indented.
    static void expect_one_message(const std::string& text, const std::string& what)
    {
        ASSERT_TRUE(text.starts_with("stylobate: ") && text.ends_with('\n')) << what;
        EXPECT_GT(text.size(), 30u) << what;
        EXPECT_LE(count_of(text, "\n"), 6u) << what;
        for (std::size_t i = 0; i + 1 < text.size(); ++i) {
            EXPECT_TRUE(static_cast<unsigned char>(text[i]) >= 0x20 || text[i] == '\n')
                << "a control character: " << what;
            EXPECT_FALSE(text[i] == '\n' && text[i + 1] != ' ') << "more than one message: " << what;
        }
    }

    fs::path folder;
};

/// The column of the small-scale specimen, and settings that make a study of it which takes a fraction of a second.
inline const std::string column_study = STYLOBATE_SOURCE_DIR "/studies/inputs/small_scale_column.toml";

/// "run STUDY --set ... --set ..."
inline std::vector<std::string> run_words(const std::string& study, const std::vector<std::string>& settings,
                                          const std::vector<std::string>& more = {})
{
    std::vector<std::string> words = {"run", study};
    for (const std::string& setting : settings) {
        words.push_back("--set");
        words.push_back(setting);
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Settings and more of them; the later ones count.
inline std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more)
{
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

/// Settings of a surface: 16 cells of a short column; in about half of them it collapses.
inline std::vector<std::string> short_surface(int realizations_per_cell)
{
    return {"study.realizations=" + std::to_string(realizations_per_cell),
            "structure.blocks=4",
            "contact.normal_stiffness_n_m2=4e6",
            "contact.tangential_stiffness_n_m=2e5",
            "excitation.cycles=4",
            "surface.frequency_hz={from=4.0,to=8.0,count=4}",
            "surface.pga_m_s2={from=4.0,to=25.0,count=4}"};
}

/// A column of round drums in space, and settings of a surface: 4 cells of three drums; in some it collapses.
inline const std::string round_column = STYLOBATE_SOURCE_DIR "/studies/inputs/round_column.toml";
inline std::vector<std::string> short_surface_in_space(int realizations_per_cell)
{
    return {"study.realizations=" + std::to_string(realizations_per_cell), "structure.blocks=3", "excitation.cycles=4",
            "surface.frequency_hz={from=0.6,to=1.2,count=2}", "surface.pga_m_s2={from=2.5,to=7.0,count=2}"};
}

/// The program run on the small-scale column with other settings.
class ColumnProgram : public Program {
protected:
    static ProgramRun words(const std::vector<std::string>& settings, const std::string& results, const char* threads,
                            const std::string& simd = "auto")
    {
        return {.arguments =
                    run_words(column_study, settings, {"-o", results, "--threads", threads, "--simd", simd, "--json"})};
    }
};

/// 2 x 2 cells of 2 realizations on softer joints; some stand and some collapse.
inline const std::vector<std::string> eight_realizations = {
    "study.realizations=2",
    "contact.normal_stiffness_n_m2=1e7",
    "contact.tangential_stiffness_n_m=4.8e5",
    "excitation.cycles=5",
    "surface.frequency_hz={from=4.0,to=8.0,count=2}",
    "surface.pga_m_s2={from=1.0,to=16.0,count=2}",
};

/// The structure and contacts of a study of three soft drums, and a fragility study of them under pulses.
inline const std::string short_column = R"([structure]
blocks = 3
drum_width_m = 0.048
drum_height_m = 0.06
depth_m = 0.048
drum_mass_kg = 0.3
[contact]
normal_stiffness_n_m2 = 4e6
tangential_stiffness_n_m = 2e5
friction = 0.6
)";

/// @param intensity PGA [m/s2], as text: from, to and count   @param more further tables
inline std::string short_fragility_study(const std::string& intensity, const std::string& more)
{
    return "[study]\nkind = \"fragility\"\nrealizations = 2\n" + short_column +
           "[excitation]\nkind = \"pulse\"\nfrequency_hz = 2\n[fragility]\nmotions = 12\nintensity = { " + intensity +
           " }\n[perturbation]\nfriction = { distribution = \"normal\", cov = 0.10, per = \"joint\" }\n"
           "pulse_frequency = { distribution = \"log_uniform\", from = 1, to = 4 }\n" +
           more;
}

/// A PEER file of a burst A exp(-((t - t0) / s)^2) sin(2 pi f (t - t0)), t0 = half its length: in g, 5 values a line.
struct Burst {
    double amplitude_g = 0.4;
    double frequency_hz = 2;
    double width_s = 2;
    double dt_s = 0.01;
    int samples = 1001;

    double value_g(int i) const
    {
        const double pi = 3.14159265358979323846;
        const int middle = (samples - 1) / 2;
        const double t = dt_s * (i - middle);
        return amplitude_g * std::exp(-(t / width_s) * (t / width_s)) * std::sin(2 * pi * frequency_hz * t);
    }
    std::string at2() const
    {
        std::string text = "PEER STRONG MOTION DATABASE RECORD\nSome Where, 1/1/2001, A Station, 090\n"
                           "ACCELERATION TIME HISTORY IN UNITS OF G\n";
        char part[64];
        std::snprintf(part, sizeof part, "NPTS= %d, DT= %.4f SEC\n", samples, dt_s);
        text += part;
        for (int i = 0; i < samples; ++i) {
            std::snprintf(part, sizeof part, "%15.7E%s", value_g(i), i % 5 == 4 || i + 1 == samples ? "\n" : "");
            text += part;
        }
        return text;
    }
    /// Time [s] and acceleration [m/s2].
    std::string columns() const
    {
        std::string text;
        char part[64];
        for (int i = 0; i < samples; ++i) {
            std::snprintf(part, sizeof part, "%10.4f %14.7f\n", dt_s * i, 9.80665 * value_g(i));
            text += part;
        }
        return text;
    }
};

/// A column under a record, in as little time as it takes: 2 realizations of two blocks on soft joints.
inline const std::string record_study = STYLOBATE_SOURCE_DIR "/studies/inputs/record.toml";
inline const std::vector<std::string> two_under_a_record = {
    "study.realizations=1",
    "structure.blocks=3",
    "contact.normal_stiffness_n_m2=1e8",
    "surface.frequency_hz={from=4.0,to=4.0,count=1}",
    "surface.pga_m_s2={from=3.0,to=9.0,count=2}",
};

} // namespace stylobate
