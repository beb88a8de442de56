/// Surfaces that keep counts and no rows: the same tables as with rows, whatever interrupts the run, in memory that
/// does not grow with the number of realizations.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

#include <random>
#include <sstream>
#include <sys/resource.h>

namespace stylobate {
namespace {

std::vector<std::string> without_rows(std::vector<std::string> settings)
{
    settings.emplace_back("output.realizations=\"none\"");
    return settings;
}

/// All but what says how long it took.
std::string same_part(const Ended& ended)
{
    const std::size_t from = ended.out.find("\"limit_states\""), to = ended.out.find("\"seconds\"");
    EXPECT_NE(from, std::string::npos) << testing::PrintToString(ended);
    return ended.out.substr(from, to - from);
}

std::vector<std::vector<std::string>> table_of(const fs::path& csv)
{
    std::vector<std::vector<std::string>> lines;
    std::istringstream text(read_bytes(csv));
    for (std::string line; std::getline(text, line);) {
        std::istringstream fields(line);
        lines.emplace_back();
        for (std::string field; std::getline(fields, field, ',');)
            lines.back().push_back(field);
    }
    return lines;
}

using Counted = Program;

TEST_F(Counted, TheSameTablesAsWithRows)
{
    const std::vector<std::string> settings = short_surface(50); // 800: no whole number of chunks
    const Ended rows = run(run_words(column_study, settings, {"-o", "rows.h5", "--json"}));
    const Ended counts = run(run_words(column_study, without_rows(settings), {"-o", "counts.h5", "--json"}));
    ASSERT_EQ(rows.status, 0) << testing::PrintToString(rows);
    ASSERT_EQ(counts.status, 0) << testing::PrintToString(counts);
    EXPECT_EQ(same_part(counts), same_part(rows));
    EXPECT_EQ(names(), (Words{"counts.h5", "rows.h5"}));
    EXPECT_LT(fs::file_size(folder / "counts.h5"), fs::file_size(folder / "rows.h5") / 3);

    for (const char* results : {"rows.h5", "counts.h5"})
        ASSERT_EQ(run({"export", results, "--to", "csv"}).status, 0);
    EXPECT_EQ(read_bytes(folder / "counts_csv/surface.csv"), read_bytes(folder / "rows_csv/surface.csv"));
    EXPECT_EQ(read_bytes(folder / "counts_csv/blocks.csv"), read_bytes(folder / "rows_csv/blocks.csv"));
    EXPECT_FALSE(fs::exists(folder / "counts_csv/realizations.csv"));

    // every limit state and the first falls, cell by cell, from the rows
    const ResultReader reader(folder / "rows.h5");
    const auto table = table_of(folder / "counts_csv/counts.csv");
    ASSERT_EQ(table.size(), 17U);
    std::uint64_t first_falls = 0;
    for (std::size_t cell = 0; cell < 16; ++cell) {
        std::vector<std::uint64_t> want(2 + limit_state_names().size() + 5); // four blocks, and several
        for (const ResultRow& row : reader.rows()) {
            if (row.cell != cell)
                continue;
            const bool invalid = row.outcome.state == State::invalid;
            ++want[invalid ? 1 : 0];
            for (std::size_t k = 0; k < limit_state_names().size() && !invalid; ++k)
                want[2 + k] += reached(static_cast<LimitState>(k), row.outcome);
            if (!invalid && row.outcome.first_collapse_block >= 0) {
                ++want[2 + limit_state_names().size() + static_cast<std::size_t>(row.outcome.first_collapse_block)];
                ++first_falls;
            }
            want.back() += !invalid && row.outcome.first_collapse_block == several_blocks;
        }
        const auto& line = table[cell + 1];
        ASSERT_EQ(line.size(), 3 + want.size());
        for (std::size_t i = 0; i < want.size(); ++i)
            EXPECT_EQ(line[3 + i], std::to_string(want[i])) << cell << ' ' << table[0][3 + i];
    }
    EXPECT_GT(first_falls, 100U);

    // other limit states' surfaces are drawn from the counts
    SurfaceCounts rocked(reader.header(), LimitState::rocked);
    reader.for_each_row([&](const ResultRow& row) { rocked.add(row); });
    const ResultReader counted(folder / "counts.h5");
    const SurfaceTable of_counts = surface_of(counted.header(), *counted.tally(), LimitState::rocked);
    EXPECT_EQ(of_counts.collapses, rocked.table().collapses);
    EXPECT_EQ(of_counts.upper, rocked.table().upper);
    const Ended png = run({"export", "counts.h5", "--to", "png", "--limit", "rocked"});
    EXPECT_EQ(png.status, 0) << testing::PrintToString(png);
}

TEST_F(Counted, ThreadsAndInstructionSetsDoNotChangeTheFile)
{
    const std::vector<std::string> settings = without_rows(short_surface(24));
    std::string first;
    for (const Isa isa : usable_isas())
        for (const char* threads : {"1", "3"}) {
            const std::string name = std::string(to_string(isa)) + threads + ".h5";
            ASSERT_EQ(
                run(run_words(column_study, settings, {"-o", name, "--threads", threads, "--simd", to_string(isa)}))
                    .status,
                0);
            const std::string bytes = read_bytes(folder / name);
            if (first.empty())
                first = bytes;
            EXPECT_TRUE(bytes == first) << name;
        }
}

/// Killed or interrupted again and again, at most so many times.
TEST_F(Counted, KilledAndContinuedItIsTheSameLong)
{
    const std::vector<std::string> settings = without_rows(short_surface(slow_build ? 160 : 640));
    const auto total = static_cast<std::uint64_t>(16 * (slow_build ? 160 : 640));
    ASSERT_EQ(run(run_words(column_study, settings, {"-o", "whole.h5"})).status, 0);
    std::mt19937_64 random(3);
    std::uint64_t kept = 0;
    int continued = 0;
    for (int i = 0; i < 12 && kept < total / 2; ++i) {
        ProgramRun part{
            .arguments = run_words(column_study, settings, {"-o", "parts.h5", "--threads", "1", "--simd", "scalar"})};
        part.signal = i % 3 == 2 ? SIGINT : SIGKILL;
        part.when = [&, more = random() % (total / 20)](const std::string&) {
            return fs::exists(folder / "parts.h5") &&
                   ResultReader(folder / "parts.h5").done() > kept + (i > 0 ? more : 0);
        };
        const Ended ended = run(part);
        EXPECT_TRUE(ended.status == 130 || ended.signal == part.signal) << testing::PrintToString(ended);
        const ResultReader reader(folder / "parts.h5");
        EXPECT_FALSE(reader.complete());
        EXPECT_GT(reader.done(), kept);
        if (ended.status == 130) {
            EXPECT_NE(ended.out.find(std::to_string(reader.done()) + " realizations are kept"), std::string::npos);
        }
        EXPECT_EQ(reader.done(), reader.tally()->added());
        continued += kept > 0 && reader.done() > kept;
        kept = reader.done();
    }
    EXPECT_GT(kept, 0U);
    EXPECT_LT(kept, total);
    EXPECT_GT(continued, 0) << "no part began where another one had stopped: nothing was tested";
    const Ended last = run(run_words(column_study, settings, {"-o", "parts.h5"}));
    EXPECT_EQ(last.status, 0) << testing::PrintToString(last);
    EXPECT_TRUE(read_bytes(folder / "parts.h5") == read_bytes(folder / "whole.h5"));
    EXPECT_EQ(names(), (Words{"parts.h5", "whole.h5"})); // no leftovers
}

TEST_F(Counted, WhatIsLeftToDoWithoutRows)
{
    const std::vector<std::string> settings = short_surface(8);
    ASSERT_EQ(run(run_words(column_study, settings, {"-o", "rows.h5"})).status, 0);
    ASSERT_EQ(run(run_words(column_study, without_rows(settings), {"-o", "counts.h5"})).status, 0);
    const ResultReader rows(folder / "rows.h5");
    std::uint64_t fallen = 0;
    while (rows.row(fallen).outcome.state != State::collapsed)
        ++fallen;

    // any realization can be run again, and nothing can be compared with it
    const std::string index = std::to_string(fallen);
    const JsonValue json = json_of(run({"replay", "counts.h5", "--realization", index, "--json", "-o", "t.h5"}));
    EXPECT_FALSE(json["in_results"].boolean);
    EXPECT_EQ(json["collapse_time_s"].number, rows.row(fallen).outcome.collapse_time_s);
    EXPECT_EQ(json["energy_residual"].number, rows.row(fallen).outcome.energy_residual);
    EXPECT_TRUE(same_bits(ResultReader(folder / "t.h5").row(fallen), rows.row(fallen)));
    const Ended plain = run({"replay", "counts.h5", "--realization", index});
    EXPECT_EQ(plain.status, 0);
    EXPECT_NE(plain.out.find("have no rows of realizations: no comparison"), std::string::npos) << plain.out;
    expect_refused({"replay", "counts.h5", "--realization", "128"}, {"has realizations 0 to 127"});

    const JsonValue info = json_of(run({"info", "counts.h5", "--json"}));
    EXPECT_EQ(info["done"].number, 128);
    EXPECT_TRUE(info["complete"].boolean);

    expect_refused({"export", "counts.h5", "--to", "png", "--picture", "order"}, {"has no rows", "counts.csv"});
    const Ended report = run({"report", "counts.h5"});
    ASSERT_EQ(report.status, 0) << testing::PrintToString(report);
    const std::string page = read_bytes(folder / "counts.html");
    for (const char* part : {"128", "Probability of collapse", "First to fall", "Energy audit", "valid realizations"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    for (const char* part : {"Displacements", "Order of falls", ">nan"})
        EXPECT_EQ(page.find(part), std::string::npos) << part;
}

TEST_F(Counted, WhatDoesNotGoWithoutRowsIsRefused)
{
    const auto with = [](std::vector<std::string> settings, const std::string& more) {
        settings.push_back(more);
        return settings;
    };
    const std::vector<std::string> settings = without_rows(short_surface(8));
    const Words parts = {"output.realizations", "is not available with", "omit it"};
    expect_refused(run_words(column_study, with(settings, "surface.adaptive={budget=1000,minimum=8}")), parts);
    expect_refused(
        run_words(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml", {"output.realizations=\"none\""}), parts);
    expect_refused(run_words(column_study, with(short_surface(8), "output.realizations=\"non\"")),
                   {"output.realizations", "none"});
    // a file of the one sort is not continued as the other
    ASSERT_EQ(run(run_words(column_study, short_surface(8), {"-o", "a.h5"})).status, 0);
    expect_refused(run_words(column_study, settings, {"-o", "a.h5"}), {"another study"});
}

/// Peak memory [kB] of a run of that many short realizations of a single drum.
long peak_kb(const fs::path& folder, const std::string& kept, int realizations)
{
    std::vector<std::string> words =
        run_words(column_study,
                  {"study.realizations=" + std::to_string(realizations / 4), "structure.blocks=2",
                   "contact.normal_stiffness_n_m2=1e6", "contact.tangential_stiffness_n_m=5e4", "excitation.cycles=2",
                   "excitation.ramp_cycles=0.5", "surface.frequency_hz={from=6.0,to=8.0,count=2}",
                   "surface.pga_m_s2={from=40.0,to=80.0,count=2}", "output.realizations=\"" + kept + "\""},
                  {"-o", kept + std::to_string(realizations) + ".h5", "--threads", "2", "--quiet"});
    words.insert(words.begin(), STYLOBATE_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        if (::chdir(folder.c_str()) == 0)
            ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    rusage used = {};
    EXPECT_EQ(::wait4(child, &status, 0, &used), child);
    EXPECT_EQ(status, 0);
    return used.ru_maxrss;
}

TEST_F(Counted, MemoryDoesNotGrowWithTheNumberOfRealizationsLong)
{
    if (slow_build)
        GTEST_SKIP() << "a sanitizer's memory is not the program's";
    const int few = 100'000, many = 400'000;
    for (const char* kept : {"all", "none"}) {
        const long small = peak_kb(folder, kept, few), large = peak_kb(folder, kept, many);
        // a list of the times of collapse and of the indices would take 6000; what HDF5 keeps from one writing of the
        // file to the next grows for some seconds, to about 5000, most of it before the first 100,000
        EXPECT_LT(large - small, 5000) << kept << ": " << small << " kB, then " << large;
    }
    EXPECT_LT(fs::file_size(folder / "none400000.h5"), 3 * fs::file_size(folder / "none100000.h5"));
    EXPECT_GT(fs::file_size(folder / "all400000.h5"), 3 * fs::file_size(folder / "all100000.h5"));
    std::uint64_t collapsed = 0;
    ResultReader(folder / "all400000.h5").for_each_row([&](const ResultRow& row) {
        collapsed += row.outcome.state == State::collapsed;
    });
    EXPECT_GT(collapsed, 60'000U) << "too few fall: nothing was tested";
}

} // namespace
} // namespace stylobate
