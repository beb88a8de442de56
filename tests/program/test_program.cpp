/// The verbs of the program as their users see them: what they print, what they write, and that it is right.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "studies/experiment/conventions.hpp"

#include <algorithm>
#include <sstream>

namespace stylobate {
namespace {

using JsonKind = JsonValue::Kind;

void expect_members(const JsonValue& object, JsonKind kind, const std::vector<std::string>& keys)
{
    ASSERT_EQ(object.kind, JsonKind::object);
    for (const std::string& key : keys) {
        ASSERT_TRUE(object.has(key)) << key;
        EXPECT_EQ(object[key].kind, kind) << key;
    }
}

/// The table of a CSV file: header first.
std::vector<std::vector<std::string>> table(const fs::path& file)
{
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(read_bytes(file));
    for (std::string line; std::getline(text, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
    }
    return rows;
}

std::size_t column_of(const std::vector<std::vector<std::string>>& rows, const std::string& name)
{
    const auto at = std::find(rows.at(0).begin(), rows.at(0).end(), name);
    EXPECT_NE(at, rows[0].end()) << name;
    return static_cast<std::size_t>(at - rows[0].begin());
}

double value(const std::string& cell)
{
    return std::strtod(cell.c_str(), nullptr);
}

/// Width and height of a picture with a whole frame: signature, header, IEND at its end. {0, 0} if it is none.
std::pair<unsigned, unsigned> png_size(const fs::path& file)
{
    const std::string bytes = read_bytes(file);
    if (bytes.size() < 1000 || !bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.substr(12, 4) != "IHDR" ||
        bytes.substr(bytes.size() - 8, 4) != "IEND")
        return {};
    const auto number = [&](std::size_t at) {
        unsigned n = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            n = n << 8 | static_cast<unsigned char>(bytes[i]);
        return n;
    };
    return {number(16), number(20)};
}

class Verbs : public Program {
protected:
    Ended run_eight(const Words& more = {}) const
    {
        Ended ended = run(run_words(column_study, eight_realizations, more));
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        return ended;
    }
};

TEST_F(Verbs, HelpAndVersion)
{
    for (const Words& words : {Words{"--help"}, Words{"run", "--help"}, Words{"--version"}}) {
        const Ended ended = run(words);
        EXPECT_EQ(ended.status, 0);
        EXPECT_FALSE(ended.out.empty());
        EXPECT_EQ(ended.err, "");
    }
    const Ended help = run({"--help"});
    for (const char* verb : {"run", "replay", "record", "export", "info"})
        EXPECT_NE(help.out.find(std::string("  ") + verb), std::string::npos) << verb;
}

TEST_F(Verbs, Info)
{
    const Ended plain = run({"info"});
    EXPECT_EQ(plain.status, 0);
    EXPECT_EQ(plain.err, "");
    for (const char* part : {"stylobate ", "processor: ", "instruction sets: scalar", "threads: ", "GPU", "MPI"})
        EXPECT_NE(plain.out.find(part), std::string::npos) << part;

    const JsonValue json = json_of(run({"info", "--json", "--threads", "3", "--simd", "scalar"}));
    expect_members(json, JsonKind::text, {"version", "simd_used"});
    expect_members(json, JsonKind::boolean, {"gpu", "mpi"});
    ASSERT_EQ(json["simd"].kind, JsonKind::list);
    EXPECT_EQ(json["simd"].items.at(0).text, "scalar");
    EXPECT_EQ(json["simd_used"].text, "scalar");
    EXPECT_EQ(json["lanes"].number, 1);
    EXPECT_EQ(json["threads"].number, 3);
}

TEST_F(Verbs, RunSaysWhatItDid)
{
    const Ended ended = run_eight({"-o", "eight.h5", "--json", "--threads", "2"});
    EXPECT_EQ(ended.err, "");
    const JsonValue json = json_of(ended);
    expect_members(json, JsonKind::number,
                   {"seconds", "realizations_per_second", "block_steps_per_second", "occupancy"});
    EXPECT_EQ(json["kind"].text, "surface");
    EXPECT_EQ(json["results"].text, "eight.h5");
    EXPECT_TRUE(json["complete"].boolean);
    EXPECT_EQ(json["realizations"].number, 8);
    EXPECT_EQ(json["total"].number, 8);
    EXPECT_EQ(json["invalid"].number, 0);
    EXPECT_EQ(json["threads"].number, 2);
    EXPECT_GT(json["occupancy"].number, 0);
    EXPECT_LE(json["occupancy"].number, 1);
    EXPECT_EQ(names(), Words{"eight.h5"}); // and nothing beside it

    const ResultReader reader(folder / "eight.h5");
    ASSERT_TRUE(reader.complete());
    const auto rows = reader.rows();
    ASSERT_EQ(rows.size(), 8u);
    EXPECT_EQ(json["collapsed"].number, std::count_if(rows.begin(), rows.end(), [](const ResultRow& row) {
                  return row.outcome.state == State::collapsed;
              }));
    EXPECT_GT(json["collapsed"].number, 0);
    EXPECT_EQ(rows[5].cell, 2u);
    EXPECT_EQ(rows[5].frequency_hz, 8);
    EXPECT_EQ(rows[5].pga_m_s2, 1);
    // the study inside is the one that was given, with its settings
    EXPECT_EQ(parse_study(reader.header().study_toml, "inside").text,
              read_study(column_study, eight_realizations).text);
}

/// The conventions of the study stand in every summary and on the page (the line itself: test_conventions).
TEST_F(Verbs, SummariesHaveTheConventions)
{
    const std::string line = conventions_text(read_study(column_study, eight_realizations));
    EXPECT_EQ(json_of(run_eight({"-o", "eight.h5", "--json"}))["conventions"].text, line);
    EXPECT_NE(run_eight({"-o", "eight.h5"}).out.find("\nconventions: " + line + "\n"), std::string::npos);
    EXPECT_NE(run(Words{"info", "eight.h5"}).out.find("\nconventions: " + line + "\n"), std::string::npos);
    EXPECT_EQ(json_of(run(Words{"info", "eight.h5", "--json"}))["conventions"].text, line);
    Words of_study = run_words(column_study, eight_realizations);
    of_study.front() = "info";
    EXPECT_NE(run(of_study).out.find("  Conventions: " + line + "\n"), std::string::npos);
    ASSERT_EQ(run(Words{"report", "eight.h5", "-o", "eight.html"}).status, 0);
    EXPECT_NE(read_page(folder / "eight.html").find("Conventions: " + line + "."), std::string::npos);
}

TEST_F(Verbs, RunNamesItsResultsAfterTheStudyAndSpeaksPlainWords)
{
    const Ended ended = run_eight();
    EXPECT_EQ(names(), Words{"small_scale_column.h5"});
    EXPECT_TRUE(ended.out.starts_with("small_scale_column.h5: 8 of 8 realizations")) << ended.out;
    EXPECT_EQ(count_of(ended.out, "\n"),
              7u); // its limit states, what still moved, conventions, what is left out, contact law
    EXPECT_EQ(ended.err, "");
}

/// The results of every verb are on standard output with --quiet too; standard error is empty. (compare, risk, past,
/// calibrate and diagnose have tests of their own.)
TEST_F(Verbs, QuietPrintsResultsAlone)
{
    for (const bool terminal : {false, true}) {
        fs::remove(folder / "a.h5");
        const Ended ended = run({.arguments = run_words(column_study, eight_realizations, {"-o", "a.h5", "--quiet"}),
                                 .terminal = terminal});
        EXPECT_EQ(ended.status, 0);
        EXPECT_TRUE(ended.out.starts_with("a.h5: 8 of 8 realizations")) << ended.out;
        EXPECT_EQ(ended.err, "");
    }
    for (const char* shard : {"1/2", "2/2"}) {
        const Words words = run_words(column_study, eight_realizations,
                                      {"--shard", shard, "-o", shard[0] == '1' ? "p.h5" : "q.h5", "--quiet"});
        const Ended ended = run(words);
        EXPECT_NE(ended.out.find("The shard is complete"), std::string::npos) << testing::PrintToString(ended);
        EXPECT_EQ(ended.err, "");
    }
    write_bytes(folder / "record.at2", Burst{}.at2());
    Words check = run_words(column_study, eight_realizations, {"--pilot", "0", "--trial-seconds", "0"});
    check.front() = "check";
    const std::vector<std::pair<Words, std::string>> verbs = {
        {{"merge", "p.h5", "q.h5", "-o", "m.h5"}, "m.h5: 8 of 8 realizations"},
        {check, "run: 8 realizations"},
        {{"replay", "a.h5", "--realization", "0"}, "realization 0"},
        {{"verify-file", "a.h5", "--replay", "1"}, "a.h5: 8 of 8 realizations"},
        {{"record", "record.at2"}, "record.at2"},
        {{"export", "a.h5", "--to", "csv"}, "a_csv\n"},
        {{"report", "a.h5"}, "a.html\n"},
        {{"new", "single"}, "single.toml\n"},
        {{"info", "a.h5"}, "a.h5: results of a study"}};
    for (const auto& [words, part] : verbs) {
        Words quiet = words;
        quiet.push_back("--quiet");
        const Ended ended = run(quiet);
        EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_NE(ended.out.find(part), std::string::npos) << testing::PrintToString(ended);
        EXPECT_EQ(ended.err, "") << words.front();
    }
}

TEST_F(Verbs, QuietSilencesWarnings)
{
    const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";
    const Words settings = {"contact.friction=0.05"}; // lower than any stone's
    const Ended loud = run(run_words(study, settings, {"-o", "loud.h5"}));
    ASSERT_NE(loud.err.find("warning: "), std::string::npos) << testing::PrintToString(loud);
    const Ended quiet = run(run_words(study, settings, {"-o", "quiet.h5", "--quiet"}));
    EXPECT_EQ(quiet.err, "");
    EXPECT_TRUE(quiet.out.starts_with("quiet.h5: ")) << quiet.out;
}

TEST_F(Verbs, HelpIsFoundByItsOtherNames)
{
    const Ended whole = run({"--help"}), of_run = run({"run", "--help"});
    ASSERT_EQ(whole.status + of_run.status, 0);
    EXPECT_TRUE(of_run.out.find("Usage: stylobate run") != std::string::npos) << of_run.out;
    EXPECT_EQ(run(Words{"help"}).out, whole.out);
    EXPECT_EQ(run(Words{"help", "run"}).out, of_run.out);
    EXPECT_EQ(run(Words{"help", "help"}).out, whole.out);
    expect_refused(Words{"help", "rnu"}, {"'rnu' is not a command", "Did you mean run?"});
    expect_refused(Words{"hlep"}, {"'hlep' is not a command", "Did you mean help?"});
    expect_refused(Words{"verify"}, {"'verify' is not a command", "Did you mean verify-file?"});
    expect_refused(Words{"--hlep"}, {"--hlep is not an option", "Did you mean --help?"});
    expect_refused(Words{"--versoin"}, {"Did you mean --version?"});
    for (const char* verb : {"run", "check", "merge", "compare", "replay", "verify-file", "record", "calibrate",
                             "diagnose", "risk", "past", "export", "report", "new", "schema", "info", "bench"}) {
        expect_refused(Words{verb, "--helpp"}, {"--helpp is not an option of " + std::string(verb),
                                                "Did you mean --help?", "stylobate " + std::string(verb) + " --help"});
        expect_refused(Words{verb, "-help"}, {"-help is not an option of", "Did you mean --help?"});
    }
    expect_refused(Words{"run", column_study, "--thread=2"}, {"--thread is not an option of run", "--threads?"});
    expect_refused(Words{"run", column_study, "--zzzzzz"}, {"--zzzzzz is not an option of run", "lists the options"});
    // a value is no option, whatever it looks like
    expect_refused(Words{"export", "none.h5", "--title", "--helpp", "--to", "png"}, {"none.h5", "no such file"});
}

TEST_F(Verbs, OneProgressLineIsRewrittenOnATerminal)
{
    const Ended ended =
        run({.arguments = run_words(column_study, eight_realizations, {"-o", "a.h5", "--json", "--threads", "1"}),
             .terminal = true});
    ASSERT_EQ(ended.status, 0);
    EXPECT_EQ(json_of(ended)["realizations"].number, 8);
    // each state of the line begins by erasing the one before; the last one is erased too
    const std::string erase = "\r\x1b[K";
    EXPECT_GE(count_of(ended.err, erase), 2u);
    EXPECT_TRUE(ended.err.starts_with(erase) && ended.err.ends_with(erase)) << ended.err;
    EXPECT_EQ(count_of(ended.err, "\n"), 0u) << ended.err;
    EXPECT_NE(ended.err.find("8 of 8 realizations"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find(" % collapsed"), std::string::npos) << ended.err;
}

TEST_F(Verbs, PlainLinesWhereThereIsNoTerminal)
{
    // the first line; then it is stopped
    const Ended ended = run({.arguments = run_words(column_study, {"study.realizations=100"}, {"--threads", "1"}),
                             .signal = SIGINT,
                             .when = [](const std::string& err) { return err.find('\n') != std::string::npos; }});
    ASSERT_EQ(ended.status, 130) << testing::PrintToString(ended);
    EXPECT_NE(ended.err.find(" of 25600 realizations, "), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find(" left, "), std::string::npos) << ended.err;
    EXPECT_EQ(count_of(ended.err, "\n"), 1u) << ended.err;
    EXPECT_EQ(ended.err.find_first_of("\r\x1b"), std::string::npos) << ended.err;
    EXPECT_NE(ended.out.find("The same command continues"), std::string::npos) << ended.out;
}

TEST_F(Verbs, TooManyInvalidRealizations)
{
    // a step far above the bound: what does not end as a number is set aside, counted, and kept
    Words settings = eight_realizations;
    for (const char* setting : {"run.step_s=2e-3", "run.allow_step_above_bound=true", "run.max_invalid_fraction=0.0"})
        settings.push_back(setting);
    const Ended ended = run(run_words(column_study, settings, {"-o", "a.h5", "--json"}));
    EXPECT_EQ(ended.status, 3) << testing::PrintToString(ended);
    expect_one_message(ended.err, ended.err);
    EXPECT_NE(ended.err.find("max_invalid_fraction"), std::string::npos);
    const JsonValue json = json_of(ended);
    const ResultReader reader(folder / "a.h5");
    EXPECT_TRUE(reader.complete() && json["complete"].boolean);
    const auto rows = reader.rows();
    const auto invalid = std::count_if(rows.begin(), rows.end(),
                                       [](const ResultRow& row) { return row.outcome.state == State::invalid; });
    EXPECT_GT(invalid, 0);
    EXPECT_EQ(json["invalid"].number, invalid);

    settings.back() = "run.max_invalid_fraction=1.0";
    EXPECT_EQ(run(run_words(column_study, settings, {"-o", "b.h5"})).status, 0);
}

TEST_F(Verbs, ReplayGivesTheSameBits)
{
    run_eight({"-o", "a.h5"});
    const auto rows = ResultReader(folder / "a.h5").rows();
    const char* sets[] = {"auto", "scalar"};
    for (const std::size_t i : {0u, 2u, 3u, 7u}) {
        const Words words = {"replay", "a.h5", "--realization", std::to_string(i), "--simd", sets[i % 2]};
        const Ended plain = run(words);
        EXPECT_EQ(plain.status, 0) << testing::PrintToString(plain);
        EXPECT_NE(plain.out.find("bitwise identical"), std::string::npos) << plain.out;
        EXPECT_EQ(plain.err, "");

        Words json_words = words;
        json_words.push_back("--json");
        const JsonValue json = json_of(run(json_words));
        EXPECT_TRUE(json["same_bits"].boolean && json["in_results"].boolean);
        EXPECT_EQ(json["realization"].number, static_cast<double>(i));
        EXPECT_EQ(json["state"].text, to_string(rows[i].outcome.state));
        EXPECT_EQ(json["peak_top_displacement_m"].number, rows[i].outcome.peak_top_displacement_m);
        EXPECT_EQ(json["energy_residual"].number, rows[i].outcome.energy_residual);
        if (rows[i].outcome.state == State::collapsed) {
            EXPECT_EQ(json["collapse_time_s"].number, rows[i].outcome.collapse_time_s);
        } else {
            EXPECT_EQ(json["collapse_time_s"].kind, JsonValue::Kind::null);
        }
    }
    EXPECT_EQ(names(), Words{"a.h5"});
}

TEST_F(Verbs, ReplayKeepsATrajectory)
{
    run_eight({"-o", "a.h5", "--set", "output.trajectory_rate_hz=1000"});
    const auto rows = ResultReader(folder / "a.h5").rows();
    const auto collapsed = std::find_if(rows.begin(), rows.end(),
                                        [](const ResultRow& row) { return row.outcome.state == State::collapsed; });
    ASSERT_NE(collapsed, rows.end());
    for (const std::uint64_t index : {std::uint64_t{0}, collapsed->index}) {
        const std::string file = "t" + std::to_string(index) + ".h5";
        const JsonValue json =
            json_of(run({"replay", "a.h5", "--realization", std::to_string(index), "-o", file, "--json"}));
        EXPECT_EQ(json["trajectory"].text, file);
        // its picture is the strip, without being asked for by name; and it can be replayed itself
        EXPECT_EQ(run({"export", file, "--to", "png", "-o", "strip.png", "--force"}).status, 0);
        EXPECT_EQ(run({"replay", file, "--realization", std::to_string(index)}).status, 0);
        const ResultReader reader(folder / file);
        ASSERT_TRUE(reader.complete());
        EXPECT_EQ(reader.header().kind, "replay");
        EXPECT_EQ(reader.header().first, index);
        EXPECT_EQ(reader.header().total, 1u);
        EXPECT_TRUE(same_bits(reader.row(index), rows[index]));
        ASSERT_EQ(reader.trajectory_indices(), std::vector<std::uint64_t>{index});
        const Trajectory t = reader.trajectory(index);
        ASSERT_EQ(t.blocks(), 7u);
        const Outcome& o = rows[index].outcome;
        const std::size_t nt = t.time_s.size(), nb = t.blocks(), top = nb - 1;

        // 1000 samples a second from 0 to the last one within the run
        EXPECT_EQ(t.time_s[0], 0);
        EXPECT_NEAR(t.time_s[nt - 1], o.end_time_s, 1e-3);
        EXPECT_LE(t.time_s[nt - 1], o.end_time_s);
        for (std::size_t i = 0; i < nt; ++i)
            ASSERT_NEAR(t.time_s[i], 1e-3 * static_cast<double>(i), 1e-9);

        // at rest, upright: centres one above the other but for offsets of millimetres, and no motion in the first ms
        // beyond that of an acceleration of 12 m/s2
        EXPECT_NEAR(t["base_x_m"][0], 0, 1e-12);
        double height = 0;
        for (std::size_t block = 0; block < nb; ++block) {
            height += t["half_height_m"][block];
            EXPECT_NEAR(t["y_m"][block] - t["y_m"][0], height - t["half_height_m"][0], 1e-4) << block;
            height += t["half_height_m"][block];
            EXPECT_NEAR(t["x_m"][block], 0, 5e-3) << block;
            EXPECT_NEAR(t["theta_rad"][block], 0, 1e-3) << block;
            EXPECT_NEAR(t["x_m"][nb + block], t["x_m"][block], 12e-6) << block;
            EXPECT_NEAR(t["y_m"][nb + block], t["y_m"][block], 12e-6) << block;
        }

        // the end is that of the outcome
        double peak = 0;
        for (std::size_t i = 0; i < nt; ++i)
            peak = std::max(peak, std::abs(t["x_m"][i * nb + top] - t["x_m"][top]));
        EXPECT_LE(peak, o.peak_top_displacement_m + 1e-4); // that is from where it would stand if it were rigid
        EXPECT_GE(peak, o.peak_top_displacement_m * 0.9);
        const double residual = t["x_m"][(nt - 1) * nb + top] - t["x_m"][top];
        if (o.state == State::collapsed) {
            // the block that fell first has lost its height or turned past its corner, or is within a millisecond of it
            EXPECT_EQ(o.at_rest, 0);
            EXPECT_LE(o.collapse_time_s, o.end_time_s);
            const auto block = static_cast<std::size_t>(
                std::find(o.fall_time_s.begin(), o.fall_time_s.end(), o.collapse_time_s) - o.fall_time_s.begin());
            const std::size_t last = (nt - 1) * nb + block;
            const double corner = std::atan(t["half_width_m"][block] / t["half_height_m"][block]);
            const double face = t["y_m"][0] + t["half_height_m"][0]; // of the fixed drum: heights count from there
            EXPECT_TRUE(t["y_m"][last] - face < 0.65 * (t["y_m"][block] - face) ||
                        std::abs(t["theta_rad"][last]) > 0.9 * corner)
                << t["y_m"][last] << " of " << t["y_m"][block] << ", " << t["theta_rad"][last];
        } else if (o.at_rest == 0) {
            EXPECT_TRUE(std::isnan(o.residual_top_displacement_m));
        } else {
            EXPECT_NEAR(residual, o.residual_top_displacement_m, 0.05 * peak); // the mean of the last vibrations
        }
    }
}

TEST_F(Verbs, SinglesKeepTheirTrajectories)
{
    const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";
    const Ended ended = run({"run", study, "-o", "rocking.h5", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(json_of(ended)["kind"].text, "single");
    const ResultReader reader(folder / "rocking.h5");
    const Trajectory t = reader.trajectory(0);
    // leaned about its corner to the right or left by the tilt, and back through upright after its quarter period
    EXPECT_NEAR(t["theta_rad"][0], 0.1346, 1e-4);
    const auto crossing =
        std::find_if(t["theta_rad"].begin(), t["theta_rad"].end(), [](double theta) { return theta < 0; });
    ASSERT_NE(crossing, t["theta_rad"].end());
    // Housner: p t = acosh(1 / (1 - theta0 / alpha)), p2 = 3 g / (4 R)
    const double R = std::hypot(0.024, 0.087), alpha = std::atan2(0.024, 0.087);
    const double quarter = std::acosh(1 / (1 - 0.1346 / alpha)) / std::sqrt(3 * 9.81 / (4 * R));
    EXPECT_NEAR(t.time_s[static_cast<std::size_t>(crossing - t["theta_rad"].begin())], quarter, 0.05 * quarter);

    ASSERT_EQ(run({"export", "rocking.h5", "--to", "csv", "-o", "csv"}).status, 0);
    const auto rows = table(folder / "csv" / "trajectory_0.csv");
    ASSERT_EQ(rows.size(), t.time_s.size() + 1);
    const std::size_t theta = column_of(rows, "theta_rad[0]"), time = column_of(rows, "time_s");
    for (std::size_t i = 0; i < t.time_s.size(); ++i) {
        ASSERT_EQ(value(rows[i + 1][theta]), t["theta_rad"][i]);
        ASSERT_EQ(value(rows[i + 1][time]), t.time_s[i]);
    }
}

TEST_F(Verbs, ExportToCsvHasTheNumbersOfTheStore)
{
    run_eight({"-o", "a.h5"});
    const Ended ended = run({"export", "a.h5", "--to", "csv", "--json"});
    ASSERT_EQ(ended.status, 0);
    EXPECT_EQ(json_of(ended)["written"].text, "a_csv");
    EXPECT_EQ(ended.err, "");
    const ResultReader reader(folder / "a.h5");

    const auto rows = table(folder / "a_csv" / "realizations.csv");
    ASSERT_EQ(rows.size(), 9u);
    for (std::size_t i = 0; i < 8; ++i) {
        const ResultRow row = reader.row(i);
        const auto cell = [&](const char* name) { return rows[i + 1].at(column_of(rows, name)); };
        EXPECT_EQ(value(cell("index")), static_cast<double>(row.index));
        EXPECT_EQ(value(cell("cell")), static_cast<double>(row.cell));
        EXPECT_EQ(cell("state"), to_string(row.outcome.state));
        EXPECT_EQ(value(cell("frequency_hz")), row.frequency_hz);
        EXPECT_EQ(value(cell("peak_top_displacement_m")), row.outcome.peak_top_displacement_m);
        EXPECT_EQ(value(cell("energy_residual")), row.outcome.energy_residual);
        EXPECT_EQ(value(cell("step_s")), row.outcome.step_s);
        for (std::size_t k = 0; k < row.inputs.size(); ++k) // the inputs follow the first four columns
            EXPECT_EQ(value(rows[i + 1].at(4 + k)), row.inputs[k]) << rows[0][4 + k];
    }
    const SurfaceTable surface = reader.surface();
    const auto cells = table(folder / "a_csv" / "surface.csv");
    ASSERT_EQ(cells.size(), 5u);
    for (std::size_t i = 0; i < 4; ++i) {
        // counted anew from the rows
        double collapsed = 0;
        for (std::size_t k = 0; k < 8; ++k)
            collapsed += rows[k + 1][column_of(rows, "cell")] == std::to_string(i) &&
                         rows[k + 1][column_of(rows, "state")] == "collapsed";
        EXPECT_EQ(cells[i + 1][column_of(cells, "trials")], "2");
        EXPECT_EQ(value(cells[i + 1][column_of(cells, "collapses")]), collapsed);
        EXPECT_EQ(value(cells[i + 1][column_of(cells, "probability")]), collapsed / 2);
        EXPECT_EQ(value(cells[i + 1][column_of(cells, "lower")]), surface.lower[i]);
        EXPECT_EQ(value(cells[i + 1][column_of(cells, "upper")]), surface.upper[i]);
    }
}

TEST_F(Verbs, ExportDrawsPictures)
{
    run_eight({"-o", "a.h5"});
    // the strip has no trajectory in the file: the realization is run again
    const std::vector<std::pair<Words, std::string>> pictures = {
        {{}, "a_surface.png"},
        {{"--picture", "slice", "--frequency", "4.4,8"}, "a_slice_4Hz_8Hz.png"},
        {{"--realization", "3"}, "a_strip_realization_3.png"},
        {{"--picture", "surface", "-o", "other.png"}, "other.png"},
    };
    for (const auto& [more, name] : pictures) {
        Words words = {"export", "a.h5", "--to", "png", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_EQ(json_of(ended)["written"].text, name);
        const auto [width, height] = png_size(folder / name);
        EXPECT_GE(width, 400u) << name;
        EXPECT_GE(height, 300u) << name;
    }
    EXPECT_EQ(names(),
              (Words{"a.h5", "a_slice_4Hz_8Hz.png", "a_strip_realization_3.png", "a_surface.png", "other.png"}));
}

} // namespace
} // namespace stylobate
