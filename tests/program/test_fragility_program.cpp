/// A fragility study as its user runs it: the same bytes whatever the threads and interruptions, curves that agree with
/// its rows, replay, picture, page and tables, and what is said where there is no curve.

#include "tests/program/program.hpp"

#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/kind_tables.hpp"
#include "kernels/isa.hpp"

#include <array>
#include <cmath>

namespace stylobate {
namespace {

const std::string study = STYLOBATE_SOURCE_DIR "/studies/inputs/fragility_column.toml";
const std::vector<std::string> small_fragility = {
    "study.realizations=12", "fragility.motions=20",
    "fragility.intensity={measure=\"pgv\",from=0.3,to=2.5,count=5,spacing=\"log\"}"};

class FragilityProgram : public Program {
protected:
    ProgramRun words(const std::string& results, const char* threads, const std::string& simd = "auto",
                     std::vector<std::string> more = {}) const
    {
        std::vector<std::string> settings = small_fragility;
        settings.insert(settings.end(), more.begin(), more.end());
        return {.arguments =
                    run_words(study, settings, {"-o", results, "--threads", threads, "--simd", simd, "--json"})};
    }
};

TEST_F(FragilityProgram, ThreadsInstructionSetsAndInterruptionsChangeNoByteLong)
{
    expect_no_byte_changes([this](const std::string& results, const char* threads, const std::string& simd) {
        return words(results, threads, simd);
    });

    // any realization is there again, by the file's own word
    const Ended again = run(std::vector<std::string>{"replay", "whole.h5", "--realization", "911", "-o", "one.h5"});
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    EXPECT_NE(again.out.find("bitwise identical"), std::string::npos) << again.out;
}

TEST_F(FragilityProgram, CurvesSayWhatTheRowsSay)
{
    const Ended ended = run(words("f.h5", "2"));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = JsonParser::parse(ended.out);
    const JsonValue& f = json["fragility"];
    EXPECT_EQ(f["motions"].number, 20);
    const ResultReader reader(folder / "f.h5");
    std::map<std::string, double> counted;
    std::vector<double> by_stripe(5);
    double at_rest = 0;
    for (const ResultRow& row : reader.rows()) {
        const bool fell = row.outcome.state == State::collapsed;
        counted["collapse"] += fell;
        by_stripe[row.cell % 5] += fell;
        counted["peak_0.35"] += fell || row.outcome.peak_top_displacement_m > 0.35;
        at_rest += fell || row.outcome.at_rest != 0;
        counted["residual_0.01"] += fell || row.outcome.residual_dislocation > 0.01;
    }
    int seen = 0;
    for (const JsonValue& state : f["states"].items) {
        const std::string name = state["name"].text;
        if (!counted.contains(name))
            continue;
        ++seen;
        EXPECT_EQ(state["reached"].number, counted[name]) << name;
        EXPECT_EQ(state["trials"].number, name == "residual_0.01" ? at_rest : 1200);
        ASSERT_TRUE(state["curve"].boolean);
        const JsonValue& median = state["median"];
        EXPECT_LT(median["lower"].number, median["value"].number);
        EXPECT_GT(median["upper"].number, median["value"].number);
        if (name != "collapse")
            continue;
        for (std::size_t i = 0; i < 5; ++i)
            EXPECT_EQ(state["stripes"].items[i]["reached"].number, by_stripe[i]);
        double shares = 0;
        for (const char* level : {"record", "imperfection", "contact", "chaos"})
            shares += state["scatter"][level]["share"].number;
        EXPECT_NEAR(shares, 1, 1e-9);
    }
    EXPECT_EQ(seen, 3);
    EXPECT_GE(f["measures"].items.size(), 8U);

    // the whole share is by the motions too, each of which is one observation: with 20 of them no narrower than this
    const JsonValue& limits = json["limit_states"];
    EXPECT_EQ(limits["interval"].text, "motions 0.95");
    std::array<RecordCount, 20> by_motion{};
    for (const ResultRow& row : reader.rows()) {
        by_motion[row.cell / 5].trials += 1;
        by_motion[row.cell / 5].reached += row.outcome.state == State::collapsed;
    }
    const Limits want = record_share_limits(by_motion, 0.95);
    EXPECT_EQ(limits["collapse"]["lower"].number, want.lower);
    EXPECT_EQ(limits["collapse"]["upper"].number, want.upper);
    EXPECT_GT(want.upper - want.lower, 0.1);

    // what the file keeps of it: motion and intensity of each realization, and the curves
    const FragilityTable table = fragility_table(reader.table("fragility"));
    EXPECT_EQ(table.measure, "pgv_m_s");
    ASSERT_EQ(table.motion.size(), 1200U);
    for (const ResultRow& row : reader.rows()) {
        EXPECT_EQ(table.motion[row.index], static_cast<std::int32_t>(row.cell / 5));
        EXPECT_EQ(table.intensity[row.index], f["states"].items[0]["stripes"].items[row.cell % 5]["intensity"].number);
    }
    ASSERT_EQ(table.states.size(), f["states"].items.size());
    for (std::size_t k = 0; k < table.states.size(); ++k) {
        const JsonValue& state = f["states"].items[k];
        EXPECT_EQ(table.states[k], state["name"].text);
        EXPECT_EQ(static_cast<double>(table.reached[k]), state["reached"].number);
        EXPECT_EQ(table.median.lower[k], state["median"]["lower"].number);
        EXPECT_EQ(table.dispersion.value[k], state["dispersion"]["value"].number);
        for (std::size_t j = 0; j < 5; ++j)
            EXPECT_EQ(table.share.upper[5 * k + j], state["stripes"].items[j]["upper"].number);
        const std::size_t points = table.grid.size();
        ASSERT_EQ(table.curve.value.size(), points * table.states.size());
        for (std::size_t i = 0; i < points; ++i) { // the lognormal curve of these two numbers
            const double z = std::log(table.grid[i] / table.median.value[k]) / table.dispersion.value[k];
            EXPECT_NEAR(table.curve.value[k * points + i], std::erfc(-z / std::sqrt(2)) / 2, 1e-9);
        }
    }
    ASSERT_EQ(run(std::vector<std::string>{"export", "f.h5", "--to", "csv"}).status, 0);
    const std::string csv = bytes("f_csv/realizations.csv");
    EXPECT_NE(csv.substr(0, csv.find('\n')).find(",pga_m_s2,motion,motion_name,intensity_pgv_m_s,"), std::string::npos);
    EXPECT_EQ(csv.find(",-1,-1,-1"), std::string::npos) << "a time that never came is nan";
    EXPECT_NE(csv.find(",nan,"), std::string::npos);

    EXPECT_EQ(run(std::vector<std::string>{"export", "f.h5", "--to", "png"}).status, 0);
    EXPECT_TRUE(fs::exists(folder / "f_fragility.png"));
    EXPECT_EQ(run(std::vector<std::string>{"export", "f.h5", "--to", "png", "--limit", "residual_0.01", "-o", "r.png"})
                  .status,
              0);
    const Ended no_state = run(std::vector<std::string>{"export", "f.h5", "--to", "png", "--limit", "fallen"});
    EXPECT_EQ(no_state.status, 2);
    EXPECT_NE(no_state.err.find("peak_0.15"), std::string::npos) << no_state.err;
    EXPECT_EQ(run(std::vector<std::string>{"report", "f.h5", "-o", "f.html"}).status, 0);
    const std::string page = read_page(folder / "f.html");
    const std::string summary = page.substr(page.find(">1&ensp;Summary"), 1000);
    // the answer first, with its interval
    const std::size_t answer = summary.find("<div class=\"box main\"><strong>At PGV ");
    EXPECT_NE(answer, std::string::npos) << summary;
    EXPECT_NE(summary.find("half of the structures fall", answer), std::string::npos) << summary;
    // each remark once, with the limit states that it concerns
    std::string remarks = page.substr(page.find("Limits of the curves"));
    remarks = remarks.substr(0, remarks.find("</ul>"));
    EXPECT_GE(count_of(remarks, "<li>"), 1U) << remarks;
    EXPECT_EQ(count_of(remarks, "<li>"), count_of(remarks, " This concerns ")) << remarks;
    EXPECT_LE(count_of(remarks, "fewer than 10, the coverage"), 1U) << remarks;
    EXPECT_LE(count_of(remarks, "stand and still moved at the end"), 1U) << remarks;
    // one limit state is shown at first: the collapse
    EXPECT_NE(page.find("\"name\": \"a block falls"), std::string::npos);
    EXPECT_NE(page.find("\"shown\": false"), std::string::npos);
    const std::size_t shown = page.find("\"shown\": true");
    ASSERT_NE(shown, std::string::npos);
    EXPECT_NE(page.rfind("\"name\": \"a block falls", shown), std::string::npos);
    EXPECT_LT(shown, page.find("\"shown\": false"));
    // realizations are known by their motion
    EXPECT_NE(page.find(" at PGV "), std::string::npos);
    EXPECT_NE(page.find("\"motion\": \"motion "), std::string::npos);
    EXPECT_NE(summary.find("95 % interval, clustered by motion"), std::string::npos) << summary;
    EXPECT_EQ(page.find("Jeffreys"), std::string::npos) << "an interval as if runs of one motion were independent";
    for (const char* words : {"Variance components", "Intensity measures ranked", "clustered by motion"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
}

/// Too few motions for an interval: shares without one, in text, JSON, page and file.
TEST_F(FragilityProgram, FewMotionsHaveNoInterval)
{
    for (const char* motions : {"1", "4"}) {
        const std::vector<std::string> few = {std::string("fragility.motions=") + motions};
        const Ended ended = run(words("few.h5", "2", "auto", few));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        const JsonValue json = JsonParser::parse(ended.out);
        EXPECT_EQ(json["limit_states"]["interval"].text, "none");
        EXPECT_EQ(json["limit_states"]["collapse"]["lower"].kind, JsonValue::Kind::null);
        const JsonValue& state = json["fragility"]["states"].items[0];
        ASSERT_EQ(state["stripes"].items.size(), 5U);
        EXPECT_EQ(state["stripes"].items[0]["lower"].kind, JsonValue::Kind::null);
        EXPECT_NE(json["fragility"]["says"].items[0].text.find("too few for an interval over motions (at least 8)"),
                  std::string::npos);
        ASSERT_EQ(run(std::vector<std::string>{"report", "few.h5", "-o", "few.html"}).status, 0);
        const std::string page = bytes("few.html");
        EXPECT_NE(page.find("too few for an interval over motions"), std::string::npos);
        for (const char* no_number : {"nan to", ">nan", "nan %", "(nan"})
            EXPECT_EQ(page.find(no_number), std::string::npos) << no_number;
        EXPECT_EQ(run(std::vector<std::string>{"export", "few.h5", "--to", "nrml"}).status, 0);
        EXPECT_EQ(run(std::vector<std::string>{"export", "few.h5", "--to", "png"}).status, 0);
        EXPECT_EQ(run(std::vector<std::string>{"verify-file", "few.h5"}).status, 0);
        fs::remove_all(folder / "few.h5");
        fs::remove_all(folder / "few.html");
        fs::remove_all(folder / "few_nrml");
        fs::remove_all(folder / "few_fragility.png");
    }
}

/// What has fallen by the end of each shaking is counted from the rows, and so is what would have if each shaking found
/// new structures: 1 - (1 - p)^k of the share p of the first one, stripe by stripe. The interval of the difference is
/// Student's, by the differences without each of the twenty motions in turn (jackknife).
TEST_F(FragilityProgram, ASequenceCarriesItsDamageAlong)
{
    const Ended ended = run(words("seq.h5", "2", "auto", {"fragility.shakings=3", "fragility.pause_s=3"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = JsonParser::parse(ended.out);
    const auto& sequence = json["fragility"]["sequence"].items;
    ASSERT_EQ(sequence.size(), 3U);
    const ResultReader reader(folder / "seq.h5");
    const std::vector<double>& ends = reader.header().motions.shaking_end_s;
    ASSERT_EQ(ends.size(), 60U);
    constexpr std::size_t motions = 20, stripes = 5, shakings = 3, structures = 12;
    std::array<std::array<std::array<double, shakings>, stripes>, motions> fallen{}; // of 12
    for (const ResultRow& row : reader.rows())
        for (std::size_t k = 0; k < shakings; ++k)
            fallen[row.cell / stripes][row.cell % stripes][k] +=
                row.outcome.state == State::collapsed &&
                (k == 2 || row.outcome.collapse_time_s <= ends[row.cell / stripes * shakings + k] + 3);
    // shares by shaking k and as new, means over the stripes
    const auto shares = [&](std::size_t k, std::size_t without) {
        std::pair<double, double> mean{0, 0};
        for (std::size_t stripe = 0; stripe < stripes; ++stripe) {
            double trials = 0, first = 0, by_k = 0;
            for (std::size_t motion = 0; motion < motions; ++motion)
                if (motion != without) {
                    trials += structures;
                    first += fallen[motion][stripe][0];
                    by_k += fallen[motion][stripe][k];
                }
            mean.first += by_k / trials / stripes;
            mean.second += (1 - std::pow(1 - first / trials, static_cast<double>(k + 1))) / stripes;
        }
        return mean;
    };
    for (std::size_t k = 0; k < shakings; ++k) {
        const auto [by_k, as_new] = shares(k, motions);
        EXPECT_NEAR(sequence[k]["fallen"].number, by_k, 1e-12);
        EXPECT_NEAR(sequence[k]["as_new"].number, as_new, 1e-12);
        double sum = 0, squares = 0;
        for (std::size_t motion = 0; motion < motions; ++motion) {
            const auto [a, b] = shares(k, motion);
            sum += a - b;
            squares += (a - b) * (a - b);
        }
        const double deviation = std::sqrt(19 * (squares / 20 - sum / 20 * (sum / 20)));
        const double half = 2.0930241 * deviation; // t(0.975) of 19 degrees of freedom
        EXPECT_NEAR(sequence[k]["difference_lower"].number, by_k - as_new - half, 1e-6);
        EXPECT_NEAR(sequence[k]["difference_upper"].number, by_k - as_new + half, 1e-6);
        if (k > 0) {
            EXPECT_GT(half, 0.001);
        }
    }
    EXPECT_GT(sequence[2]["fallen"].number, sequence[0]["fallen"].number);
}

TEST_F(FragilityProgram, WhereNothingFallsThereIsNoCurveButABound)
{
    const Ended ended = run(words("still.h5", "2", "auto",
                                  {"fragility.intensity={measure=\"pgv\",from=0.01,to=0.02,count=3,spacing=\"log\"}"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = JsonParser::parse(ended.out);
    for (const JsonValue& state : json["fragility"]["states"].items) {
        EXPECT_FALSE(state["curve"].boolean);
        EXPECT_FALSE(state["says"].items.empty()) << "silence about " << state["name"].text;
    }
}

TEST_F(FragilityProgram, WithoutACurveItsTablesAreExportedAllTheSame)
{
    const Ended ended = run(words("still.h5", "2", "auto",
                                  {"fragility.intensity={measure=\"pgv\",from=0.01,to=0.01,count=1,spacing=\"log\"}"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(run(std::vector<std::string>{"export", "still.h5", "--to", "csv", "-o", "tables"}).status, 0);
    EXPECT_TRUE(fs::exists(folder / "tables" / "realizations.csv"));
    EXPECT_TRUE(fs::exists(folder / "tables" / "motions.csv"));
    const Ended curves = run(std::vector<std::string>{"export", "still.h5", "--to", "nrml"});
    EXPECT_EQ(curves.status, 2) << testing::PrintToString(curves);
    EXPECT_NE(curves.err.find("no limit state has a curve"), std::string::npos) << curves.err;
    EXPECT_NE(curves.err.find("--to csv"), std::string::npos) << curves.err;
    EXPECT_FALSE(fs::exists(folder / "still_nrml"));
}

} // namespace
} // namespace stylobate
