/// A run that is killed or interrupted, again and again, and continued: the same results as without.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "kernels/isa.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

#include <cmath>
#include <random>

namespace stylobate {
namespace {

constexpr int per_cell = slow_build ? 128 : 320;
constexpr std::uint64_t total = 16 * per_cell;

/// Up to 20 chunks: seconds with one thread of scalar code.
const std::vector<std::string> many_realizations = short_surface(per_cell);

struct Machine {
    const char* threads;
    std::string simd;
};

/// The machines that the parts of a run are spread over.
std::vector<Machine> machines()
{
    std::vector<Machine> all = {{"2", "auto"}, {"1", "scalar"}};
    for (const Isa isa : usable_isas())
        all.push_back({isa == Isa::scalar ? "3" : "1", to_string(isa)});
    return all;
}

/// The first and the last number of realizations done in the progress lines of a terminal; {0, 0} if there is none.
std::pair<std::uint64_t, std::uint64_t> progress_of(const std::string& err, std::uint64_t of)
{
    const std::string before = "\x1b[K", after = " of " + std::to_string(of) + " realizations";
    const auto number = [&](std::size_t end) {
        const std::size_t begin = err.rfind(before, end);
        return begin == std::string::npos ? 0 : std::stoull(err.substr(begin + before.size(), end));
    };
    const std::size_t first = err.find(after), last = err.rfind(after);
    if (first == std::string::npos)
        return {};
    return {number(first), number(last)};
}

class Resume : public Program {
protected:
    std::string study_ = column_study;
    std::vector<std::string> settings_ = many_realizations;
    std::uint64_t realizations_ = total;

    ProgramRun part(const std::string& results, const Machine& machine) const
    {
        return {.arguments =
                    run_words(study_, settings_, {"-o", results, "--threads", machine.threads, "--simd", machine.simd}),
                .terminal = true};
    }

    std::uint64_t rows_in(const std::string& results) const
    {
        return fs::exists(folder / results) ? ResultReader(folder / results).rows().size() : 0;
    }

    /// The uninterrupted run.
    void run_at_once(const std::string& results) const
    {
        const Ended ended = run(part(results, {"2", "auto"}));
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const auto rows = ResultReader(folder / results).rows();
        EXPECT_EQ(rows.size(), realizations_);
        const auto collapsed = std::count_if(
            rows.begin(), rows.end(), [](const ResultRow& row) { return row.outcome.state == State::collapsed; });
        EXPECT_GT(collapsed, realizations_ / 10); // both kinds of endings are there
        EXPECT_LT(collapsed, realizations_ * 9 / 10);
    }

    void expect_same(const std::string& a, const std::string& b) const
    {
        for (const std::string& results : {a, b})
            ASSERT_EQ(run({"export", results + ".h5", "--to", "csv"}).status, 0);
        for (const char* file : {"realizations.csv", "surface.csv"}) {
            const std::string left = read_bytes(folder / (a + "_csv") / file);
            EXPECT_GT(left.size(), 300u);
            EXPECT_TRUE(left == read_bytes(folder / (b + "_csv") / file)) << file;
        }
        // that is all of the content, and so the files are the same, too
        EXPECT_TRUE(read_bytes(folder / (a + ".h5")) == read_bytes(folder / (b + ".h5")));
    }

    /// Starts the run `parts` times and sends `signals` in turn, each when a random number of realizations is done, and
    /// then lets it run to its end. A run that ends before its signal comes, on a loaded machine, is begun anew until
    /// one has gone on from another.
    void interrupt(const std::vector<int>& signals, int parts, unsigned seed)
    {
        run_at_once("whole.h5");
        std::mt19937_64 random(seed);
        const std::vector<Machine> all = machines();
        int continued = 0;
        for (int i = 0; i < parts || (continued == 0 && i < 50 * parts); ++i) {
            if (rows_in("parts.h5") == realizations_) {
                if (continued > 0)
                    break;
                fs::remove(folder / "parts.h5");
            }
            const std::uint64_t rows = rows_in("parts.h5");
            const auto before = contents();
            ProgramRun program = part("parts.h5", all[static_cast<std::size_t>(i) % all.size()]);
            program.signal = signals[static_cast<std::size_t>(i) % signals.size()];
            program.when = when_done(rows + random() % (realizations_ / 4)); // as soon as it begins, or later
            const Ended ended = run(program);
            if (ended.status == 0)
                continue;
            if (ended.status == 130) {
                EXPECT_NE(ended.out.find("The same command continues"), std::string::npos) << ended.out;
                // what it says is kept is what there is
                const std::string kept = std::to_string(rows_in("parts.h5"));
                EXPECT_NE(ended.out.find("; " + kept + " realizations are kept"), std::string::npos) << ended.out;
                EXPECT_EQ(json_of(run({"info", "parts.h5", "--json"}))["done"].number, std::stod(kept));
            } else { // killed, or interrupted before there was anything to keep
                EXPECT_EQ(ended.signal, program.signal) << testing::PrintToString(ended);
                EXPECT_TRUE(program.signal == SIGKILL || contents() == before) << testing::PrintToString(ended);
            }
            // what was done is kept, and counted on from
            const std::uint64_t kept = rows_in("parts.h5");
            EXPECT_GE(kept, rows);
            EXPECT_GE(kept, progress_in(ended.err)) << "realizations that had ended are lost";
            const auto [first, last] = progress_of(ended.err, realizations_);
            if (last > 0) {
                EXPECT_GE(first, rows) << ended.err;
                EXPECT_GE(last, first) << ended.err;
            }
            if (ended.status == 130) {
                EXPECT_EQ(last, kept) << ended.err;
                EXPECT_NE(ended.out.find(": " + std::to_string(last) + " of "), std::string::npos) << ended.out;
            }
            continued += rows > 0 && rows < realizations_;
            if (kept > 0 && kept < realizations_)
                expect_unfinished("parts.h5");
        }
        EXPECT_GT(continued, 0) << "no part began where another one had stopped: nothing was tested";
        if (rows_in("parts.h5") < realizations_ || !ResultReader(folder / "parts.h5").complete()) {
            const Ended ended = run(part("parts.h5", {"3", "auto"}));
            ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        }
        expect_same("whole", "parts");
        EXPECT_EQ(names(), (Words{"parts.h5", "parts_csv", "whole.h5", "whole_csv"})); // no leftovers
    }

    /// What an unfinished result can be used for, and what not.
    void expect_unfinished(const std::string& results) const
    {
        EXPECT_FALSE(ResultReader(folder / results).complete());
        expect_refused({"report", results}, {results, "not complete", "continue"});
        expect_refused({"export", results, "--to", "png", "--picture", "order"}, {results, "not complete"});
        EXPECT_EQ(run({"info", results}).out.find("stylobate report"), std::string::npos); // advises what can be done
    }
};

TEST_F(Resume, AfterKills)
{
    interrupt({SIGKILL}, 8, 1);
}

TEST_F(Resume, AfterInterrupts)
{
    interrupt({SIGINT}, 6, 2);
}

TEST_F(Resume, AfterAMixture)
{
    interrupt({SIGKILL, SIGINT, SIGTERM}, 8, 3);
}

TEST_F(Resume, AStructureInSpaceAfterAMixture)
{
    constexpr int of_a_cell = slow_build ? 20 : 80;
    study_ = round_column;
    settings_ = short_surface_in_space(of_a_cell);
    realizations_ = 4 * of_a_cell;
    interrupt({SIGKILL, SIGINT}, 4, 4);
}

TEST_F(Resume, AnInterruptSaysSo)
{
    ProgramRun program = part("a.h5", {"1", "scalar"});
    program.arguments.push_back("--json");
    program.terminal = false;
    program.signal = SIGINT;
    program.when = when_there(folder / "a.h5");
    const Ended ended = run(program);
    ASSERT_EQ(ended.status, 130) << testing::PrintToString(ended);
    EXPECT_EQ(ended.err, "");
    const JsonValue json = json_of(ended);
    EXPECT_FALSE(json["complete"].boolean);
    EXPECT_EQ(json["total"].number, static_cast<double>(total));
    EXPECT_LT(json["realizations"].number, static_cast<double>(total));
    EXPECT_EQ(json["realizations"].number, static_cast<double>(rows_in("a.h5")));
    EXPECT_EQ(names(), Words{"a.h5"});
}

TEST_F(Resume, RowsOfAnUnfinishedRunCanBeExportedAndReplayed)
{
    run_at_once("whole.h5");
    ProgramRun program = part("a.h5", {"1", "scalar"});
    program.signal = SIGKILL;
    program.when = when_done(1);
    run(program);
    const std::uint64_t rows = rows_in("a.h5");
    ASSERT_GT(rows, 0u);
    ASSERT_LT(rows, total);
    ASSERT_EQ(run({"export", "a.h5", "--to", "csv"}).status, 0);
    EXPECT_EQ(count_of(read_bytes(folder / "a_csv/realizations.csv"), "\n"), rows + 1);
    EXPECT_FALSE(fs::exists(folder / "a_csv/surface.csv")); // a surface of some of its trials is none

    // one that is in the file, and one that is not
    const ResultReader reader(folder / "a.h5"), whole(folder / "whole.h5");
    const std::uint64_t known = reader.rows().front().index;
    std::uint64_t unknown = 0;
    while (reader.has(unknown))
        ++unknown;
    for (const std::uint64_t index : {known, unknown}) {
        const Ended ended = run({"replay", "a.h5", "--realization", std::to_string(index), "--json"});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const JsonValue json = json_of(ended);
        EXPECT_EQ(json["in_results"].boolean, index == known);
        EXPECT_EQ(json["same_bits"].boolean, index == known);
        EXPECT_EQ(json["energy_residual"].number, whole.row(index).outcome.energy_residual);
    }
}

/// A surface whose cells are anything from safe to lost: a part of it in index order would be a corner of it.
TEST_F(Resume, AnInterimShareIsThatOfTheWhole)
{
    run_at_once("whole.h5");
    const auto rows = ResultReader(folder / "whole.h5").rows();
    double final_share = 0;
    for (const ResultRow& row : rows)
        final_share += row.outcome.state == State::collapsed ? 1.0 / static_cast<double>(total) : 0.0;
    for (const std::uint64_t part : {total / 10, total / 3, total * 2 / 3}) {
        fs::remove(folder / "a.h5");
        ProgramRun program = this->part("a.h5", {"2", "auto"});
        program.arguments.push_back("--json");
        program.signal = SIGINT;
        program.when = when_done(part);
        const Ended ended = run(program);
        if (ended.status == 0)
            continue; // it had come to the end before the signal came
        const JsonValue json = json_of(ended);
        if (json["collapse_probability"].kind == JsonValue::Kind::null)
            continue; // one of the first ones took so long that nothing could be said
        EXPECT_EQ(json["realizations"].number, static_cast<double>(rows_in("a.h5")));

        // so is a picture of it, which states of how many realizations it is
        const ResultReader reader(folder / "a.h5");
        const Study of_a = parse_study(reader.header().study_toml, "its study");
        const SurfaceTable surface = surface_so_far(reader, of_a, "a.h5", LimitState::collapse);
        const SurfaceTable whole = ResultReader(folder / "whole.h5").surface();
        std::uint64_t drawn = 0;
        for (std::size_t cell = 0; cell < surface.trials.size(); ++cell) {
            drawn += surface.trials[cell];
            EXPECT_NEAR(static_cast<double>(surface.trials[cell]),
                        static_cast<double>(drawn) / static_cast<double>(cell + 1), 8)
                << "all cells have as many realizations";
            EXPECT_LE(surface.lower[cell] - 0.15, whole.probability[cell]);
            EXPECT_GE(surface.upper[cell] + 0.15, whole.probability[cell]);
        }
        EXPECT_LE(drawn, rows_in("a.h5"));
        // the errors are those of so many, and not of a corner of the study
        const double sd = 0.5 / std::sqrt(static_cast<double>(drawn));
        EXPECT_NEAR(json["collapse_probability"].number, final_share, 2 * sd) << drawn;
        EXPECT_LT(json["collapse_lower"].number, final_share + sd);
        EXPECT_GT(json["collapse_upper"].number, final_share - sd);
        EXPECT_LT(json["collapse_upper"].number - json["collapse_lower"].number, 4.2 * sd) << drawn;
        const std::string words = partial_words(reader, of_a, surface);
        EXPECT_NE(words.find("partial: "), std::string::npos) << words;
        EXPECT_NE(words.find(slow_build ? "of 2,048" : "of 5,120"), std::string::npos) << words;
        // what is kept and not drawn is counted too
        const std::uint64_t kept = rows_in("a.h5");
        if (drawn < kept && kept < 1000) {
            EXPECT_NE(words.find(fmt::format("partial: {} of the {} realizations kept", drawn, kept)),
                      std::string::npos)
                << words;
        }
        for (const char* picture : {"surface", "slice"}) {
            const Ended drawing = run({"export", "a.h5", "--to", "png", "--picture", picture});
            EXPECT_EQ(drawing.status, 0) << testing::PrintToString(drawing);
            EXPECT_TRUE(fs::exists(folder / ("a_" + std::string(picture) + ".png")));
            fs::remove(folder / ("a_" + std::string(picture) + ".png"));
        }
    }
    const ResultReader reader(folder / "whole.h5");
    EXPECT_EQ(partial_words(reader, parse_study(reader.header().study_toml, "its study"), reader.surface()), "");
}

TEST_F(Resume, AFinishedResultIsNoMistake)
{
    const Words words = run_words(column_study, eight_realizations, {"-o", "a.h5", "--json"});
    const Ended first = run(words);
    ASSERT_EQ(first.status, 0);
    const auto before = contents();
    const Ended again = run(words);
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    EXPECT_EQ(again.err, "");
    EXPECT_TRUE(contents() == before);
    const JsonValue a = json_of(first), b = json_of(again);
    for (const char* key : {"realizations", "total", "collapsed", "invalid"})
        EXPECT_EQ(a[key].number, b[key].number) << key;
    EXPECT_TRUE(b["complete"].boolean);
    EXPECT_EQ(a["limit_states"]["collapse"]["lower"].number, b["limit_states"]["collapse"]["lower"].number);
    Words other = words;
    other.insert(other.end(), {"--set", "contact.friction=0.7"});
    expect_refused(other, {"another study"});
}

TEST_F(Resume, TwoRunsDoNotWriteOneFile)
{
    // the second one starts while the first one is at work, and is refused
    ProgramRun first = part("a.h5", {"1", "scalar"});
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        first.signal = SIGINT;
        first.when = when_there(folder / "refused");
        const Ended ended = run(first);
        ::_exit(ended.status == 130 ? 0 : 1);
    }
    while (!fs::exists(folder / "a.h5")) {
        ASSERT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "the first one ended before it began to write";
        ::usleep(2'000);
    }
    const Ended second = run(part("a.h5", {"1", "auto"}).arguments);
    EXPECT_EQ(second.status, 2) << testing::PrintToString(second);
    EXPECT_EQ(second.out, "");
    EXPECT_NE(second.err.find("is being written by another run"), std::string::npos) << second.err;
    write_bytes(folder / "refused", "");
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << "the first one did not end as an interrupted run does";
}

TEST_F(Resume, AnInterruptedReplayLeavesNothing)
{
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "a.h5"})).status, 0);
    // a stiff column is long at work
    Words stiff = eight_realizations;
    stiff.push_back("contact.normal_stiffness_n_m2=1e11");
    ProgramRun program{.arguments = run_words(column_study, stiff, {"-o", "stiff.h5"}), .signal = SIGKILL};
    program.when = when_there(folder / "stiff.h5");
    run(program);
    ASSERT_TRUE(fs::exists(folder / "stiff.h5"));
    const auto before = contents();
    program = {.arguments = {"replay", "stiff.h5", "--realization", "0", "-o", "t.h5"}, .signal = SIGINT};
    const Ended ended = run(program);
    EXPECT_EQ(ended.signal, SIGINT) << testing::PrintToString(ended);
    EXPECT_TRUE(contents() == before);
}

} // namespace
} // namespace stylobate
