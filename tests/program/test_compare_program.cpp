/// `stylobate compare` as its user runs it.

#include "tests/program/program.hpp"

#include "studies/report/left_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stylobate {
namespace {

class Compare : public Program {
protected:
    void SetUp() override
    {
        Program::SetUp();
        write_study(24, "[variants]\nneutral = {}\nsmoother = { \"contact.friction\" = 0.3 }\n");
    }

    /// 16 cells of a short column, with more behind it.
    void write_study(int per_cell, const std::string& more) const
    {
        std::string text = R"([study]
kind = "surface"
realizations = )" + std::to_string(per_cell) +
                           R"(
[structure]
blocks = 4
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 4e6
tangential_stiffness_n_m = 2e5
friction = 0.68
[excitation]
kind = "harmonic"
cycles = 4
[surface]
frequency_hz = { from = 4.0, to = 8.0, count = 4 }
pga_m_s2 = { from = 4.0, to = 25.0, count = 4 }
[perturbation]
friction = { distribution = "normal", cov = 0.10, per = "joint" }
drum_offset = { distribution = "normal", sd_m = 0.00024, per = "block" }
phase = { distribution = "uniform" }
)" + more;
        write_bytes(folder / "col.toml", text);
    }

    void replace(const std::string& file, const std::string& from, const std::string& to) const
    {
        std::string text = read_bytes(folder / file);
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        write_bytes(folder / file, text.replace(at, from.size(), to));
    }

    JsonValue variant(const JsonValue& comparison, const std::string& name) const
    {
        for (const JsonValue& each : comparison["variants"].items)
            if (each["name"].text == name)
                return each;
        ADD_FAILURE() << name;
        return {};
    }
};

TEST_F(Compare, ANeutralVariantHasNoDiscordantPair)
{
    const Ended ended = run(Words{"compare", "col.toml", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const JsonValue neutral = variant(json, "neutral");
    for (const JsonMember& limit : neutral["limit_states"].members) {
        EXPECT_EQ(limit.value["overall"]["base_only"].number, 0) << limit.name;
        EXPECT_EQ(limit.value["overall"]["variant_only"].number, 0) << limit.name;
        EXPECT_EQ(limit.value["overall"]["verdict"].text, "open") << limit.name;
        EXPECT_EQ(limit.value["worse_cells"].items.size() + limit.value["better_cells"].items.size(), 0U);
    }
    EXPECT_EQ(variant(json, "neutral")["notes"].items[0].text,
              "It is the study of the base: the variant changes nothing.");
    EXPECT_TRUE(variant(json, "smoother")["notes"].items.empty());
    const JsonValue smoother = variant(json, "smoother")["limit_states"]["collapse"]["overall"];
    EXPECT_GT(smoother["base_only"].number + smoother["variant_only"].number, 0);
    EXPECT_EQ(names(), (Words{"col.h5", "col.toml", "col_comparison.h5", "col_neutral.h5", "col_smoother.h5"}));
    const Ended info = run(Words{"info", "col_comparison.h5"});
    EXPECT_EQ(info.status, 0);
    EXPECT_EQ(info.out.find("stylobate risk"), std::string::npos) << "a surface has no hazard: " << info.out;
    expect_refused(Words{"risk", "col_comparison.h5", "--hazard", "k0=1e-3,k=3,measure=pga_g"},
                   {"col_comparison.h5", "is a comparison of studies of kind 'surface'"});
    const Ended quiet = run(Words{"compare", "col.toml", "--quiet"}); // nothing is left to run
    EXPECT_TRUE(quiet.out.starts_with("col_comparison.h5: ")) << testing::PrintToString(quiet);
    EXPECT_EQ(quiet.err, "");
    EXPECT_EQ(json_of(run(Words{"info", "col_comparison.h5", "--json"}))["holds"].text, "comparison");
}

/// The counts of pairs from the rows of the two results files.
TEST_F(Compare, PairsAreTheRowsOfOneIndex)
{
    const Ended ended = run(Words{"compare", "col.toml", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue collapse = variant(json_of(ended), "smoother")["limit_states"]["collapse"];
    const std::vector<ResultRow> base = ResultReader(folder / "col.h5").rows(),
                                 other = ResultReader(folder / "col_smoother.h5").rows();
    ASSERT_EQ(base.size(), other.size());
    std::vector<std::array<int, 4>> counts(16);
    for (std::size_t i = 0; i < base.size(); ++i) {
        const bool a = base[i].outcome.state == State::collapsed, b = other[i].outcome.state == State::collapsed;
        ++counts[base[i].cell][a ? (b ? 0U : 1U) : b ? 2U : 3U];
    }
    std::array<int, 4> all{};
    for (std::size_t cell = 0; cell < 16; ++cell) {
        const char* keys[] = {"both", "base_only", "variant_only", "neither"};
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(collapse["cells"].items[cell][keys[k]].number, counts[cell][k]) << cell << keys[k];
            all[k] += counts[cell][k];
        }
    }
    EXPECT_NEAR(collapse["overall"]["difference"].number, (all[2] - all[1]) / 384.0, 1e-12);
    // the same numbers were drawn
    EXPECT_EQ(base[17].inputs.back(), other[17].inputs.back());
    const JsonValue common = variant(json_of(ended), "smoother")["common"];
    EXPECT_EQ(common.items[0]["quantity"].text, "friction");
    EXPECT_EQ(common.items[0]["draws"].text, "same quantiles");
    EXPECT_EQ(common.items[1]["draws"].text, "same numbers");
}

/// The differences in the thirds of each quantity, counted here from the rows of the two results files.
TEST_F(Compare, WhatTheAnswerDependsOnIsCountedInTheRows)
{
    const Ended ended = run(Words{"compare", "col.toml", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const std::vector<JsonValue> depends = variant(json_of(ended), "smoother")["depends_on"].items;
    const ResultReader reader(folder / "col.h5");
    const std::vector<std::string>& inputs = reader.header().input_names;
    const std::vector<ResultRow> base = reader.rows(), other = ResultReader(folder / "col_smoother.h5").rows();
    ASSERT_EQ(depends.size(), 3U);
    for (const JsonValue& each : depends) {
        const std::string quantity = each["quantity"].text;
        std::vector<double> values;
        for (const ResultRow& row : base) {
            double sum = 0, number = 0;
            for (std::size_t i = 0; i < inputs.size(); ++i)
                if (inputs[i] == quantity || inputs[i].starts_with(quantity + "[")) {
                    sum += row.inputs[i];
                    number += 1;
                }
            values.push_back(sum / number);
        }
        std::vector<double> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        // 384 values: a third of the others lie below place 127.67 of 0 to 383
        const double low = sorted[127] + (sorted[128] - sorted[127]) * (383.0 / 3 - 127);
        EXPECT_NEAR(each["between_low"].number, low, 1e-12 * std::abs(low)) << quantity;
        for (std::size_t third = 0; third < 3; ++third) {
            std::array<double, 16> sum{}, pairs{};
            for (std::size_t i = 0; i < base.size(); ++i)
                if (const bool above = values[i] > each["between_high"].number;
                    third == (values[i] <= each["between_low"].number ? 0U
                              : above                                 ? 2U
                                                                      : 1U)) {
                    pairs[base[i].cell] += 1;
                    sum[base[i].cell] +=
                        (other[i].outcome.state == State::collapsed) - (base[i].outcome.state == State::collapsed);
                }
            double mean = 0, cells = 0;
            for (std::size_t cell = 0; cell < 16; ++cell)
                if (pairs[cell] > 0) {
                    mean += sum[cell] / pairs[cell];
                    cells += 1;
                }
            EXPECT_NEAR(each["thirds"].items[third]["difference"].number, mean / cells, 1e-12) << quantity << third;
        }
    }
    EXPECT_LE(depends[0]["p"].number, depends[1]["p"].number);
    EXPECT_NEAR(depends[0]["p_adjusted"].number, std::min(1.0, 3 * depends[0]["p"].number), 1e-12);
}

/// Results are those of `run`, and finished results give the same numbers.
TEST_F(Compare, TakesFinishedResultsToo)
{
    ASSERT_EQ(run(Words{"compare", "col.toml"}).status, 0);
    ASSERT_EQ(run(Words{"run", "col.toml", "--set", "contact.friction=0.3", "-o", "own.h5"}).status, 0);
    EXPECT_TRUE(read_bytes(folder / "own.h5") == read_bytes(folder / "col_smoother.h5"));
    const Ended by_results = run(Words{"compare", "col.h5", "own.h5", "-o", "r.h5", "--json"});
    ASSERT_EQ(by_results.status, 0) << testing::PrintToString(by_results);
    const JsonValue a = json_of(by_results)["variants"].items[0];
    const JsonValue b = variant(json_of(run(Words{"compare", "col.toml", "--json"})), "smoother");
    EXPECT_EQ(a["name"].text, "own");
    // of one name in two folders they are known by their paths
    fs::create_directory(folder / "dowels");
    fs::copy_file(folder / "own.h5", folder / "dowels" / "col.h5");
    const Ended two_folders = run(Words{"compare", "col.h5", "dowels/col.h5", "-o", "folders.h5", "--json"});
    ASSERT_EQ(two_folders.status, 0) << testing::PrintToString(two_folders);
    EXPECT_EQ(json_of(two_folders)["base"].text, "col");
    EXPECT_EQ(json_of(two_folders)["variants"].items[0]["name"].text, "dowels/col");
    for (const char* key : {"difference", "lower", "upper", "unpaired_realizations", "p"})
        EXPECT_EQ(a["limit_states"]["collapse"]["overall"][key].number,
                  b["limit_states"]["collapse"]["overall"][key].number);
}

TEST_F(Compare, TwoStudyFilesAreThoseOfTheirVariants)
{
    write_bytes(folder / "other.toml", read_bytes(folder / "col.toml"));
    replace("other.toml", "friction = 0.68", "friction = 0.3");
    ASSERT_EQ(run(Words{"compare", "col.toml", "other.toml"}).status, 0);
    ASSERT_EQ(run(Words{"compare", "col.toml", "-o", "both.h5"}).status, 0);
    EXPECT_TRUE(read_bytes(folder / "other.h5") == read_bytes(folder / "col_smoother.h5"));
    EXPECT_TRUE(fs::exists(folder / "col_comparison.h5"));
}

TEST_F(Compare, ThreadsAndInterruptionsChangeNoByte)
{
    write_study(slow_build ? 24 : 160, "[variants]\nsmoother = { \"contact.friction\" = 0.3 }\n");
    ASSERT_EQ(run(Words{"compare", "col.toml", "-o", "whole.h5"}).status, 0);
    const std::string whole = read_bytes(folder / "whole.h5"), base = read_bytes(folder / "col.h5");
    fs::remove(folder / "col.h5");
    fs::remove(folder / "col_smoother.h5");
    ASSERT_EQ(run(Words{"compare", "col.toml", "-o", "one.h5", "--threads", "1", "--simd", "scalar"}).status, 0);
    EXPECT_TRUE(read_bytes(folder / "one.h5") == whole);
    fs::remove(folder / "col.h5");
    fs::remove(folder / "col_smoother.h5");

    int interruptions = 0;
    Ended ended;
    for (int part = 0; part < 6; ++part) {
        ProgramRun program{.arguments = {"compare", "col.toml", "-o", "parts.h5", "--threads", part % 2 ? "2" : "1"}};
        program.terminal = true;
        program.signal = part % 2 == 0 ? SIGINT : SIGKILL;
        program.when = part < 2 ? when_done(100) : when_there(folder / "col_smoother.h5");
        if (part == 5)
            program.signal = 0;
        ended = run(program);
        if (ended.status == 0)
            break;
        interruptions += ended.status == 130;
        if (ended.status == 130) {
            EXPECT_NE(ended.out.find("The same command continues"), std::string::npos) << ended.out;
            EXPECT_FALSE(fs::exists(folder / "parts.h5"));
        }
    }
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_GT(interruptions, 0);
    EXPECT_TRUE(read_bytes(folder / "parts.h5") == whole);
    EXPECT_TRUE(read_bytes(folder / "col.h5") == base);
    // again: nothing is run, and the comparison is the same
    const Ended again = run(Words{"compare", "col.toml", "-o", "parts.h5"});
    EXPECT_EQ(again.status, 0);
    EXPECT_EQ(again.err, "");
    EXPECT_TRUE(read_bytes(folder / "parts.h5") == whole);
}

TEST_F(Compare, AFragilityStudyIsComparedByMotions)
{
    write_bytes(folder / "frag.toml", short_fragility_study("from = 4, to = 12, count = 3", R"([variants]
dowel = { mechanisms = { dowel = { stiffness_n_m = 1e6, yield_n = 20 } } }
neutral = {}
)"));
    const Ended ended = run(Words{"compare", "frag.toml", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    EXPECT_EQ(json["adjustment"].text, "holm");
    EXPECT_EQ(json["motions"].number, 12);
    const JsonValue limits = variant(json, "dowel")["limit_states"];
    EXPECT_EQ(limits.members.front().name, "collapse");
    EXPECT_TRUE(limits.has("peak_0.35"));
    EXPECT_EQ(limits["collapse"]["cells"].items.size(), 3U);
    EXPECT_EQ(limits["collapse"]["overall"]["pairs"].number, 72);
    const JsonValue neutral = variant(json, "neutral");
    for (const JsonMember& limit : neutral["limit_states"].members)
        EXPECT_EQ(limit.value["overall"]["base_only"].number + limit.value["overall"]["variant_only"].number, 0);
}

TEST_F(Compare, AnAdaptiveComparisonDependsOnNothingButItsStudies)
{
    write_study(96, "[variants]\nsmoother = { \"contact.friction\" = 0.3 }\n");
    const Words words = {"compare", "col.toml", "--adaptive", "600", "--margin", "0.1", "-o", "a.h5"};
    const Ended ended = run(with(words, {"--json"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended), smoother = variant(json, "smoother");
    EXPECT_EQ(json["adaptive"]["budget"].number, 600);
    EXPECT_GT(json["adaptive"]["rounds"].number, 2);
    EXPECT_LE(smoother["pairs"].number, 600);
    EXPECT_GE(smoother["pairs"].number, 16 * 8);
    double fewest = 1e9, most = 0;
    for (const JsonValue& cell : smoother["limit_states"]["collapse"]["cells"].items) {
        fewest = std::min(fewest, cell["pairs"].number);
        most = std::max(most, cell["pairs"].number);
    }
    EXPECT_LT(fewest, most);
    const std::string whole = read_bytes(folder / "a.h5");
    ASSERT_EQ(run(Words{"report", "a.h5"}).status, 0);
    const std::string page = read_bytes(folder / "a.html");
    EXPECT_NE(page.find("--adaptive 600 --margin 0.1 -o a.h5"), std::string::npos) << "the command that repeats it";
    EXPECT_NE(page.find("an adaptive comparison chooses the number of pairs"), std::string::npos);
    // what is there already is not run again, and more than is asked for is left out
    EXPECT_EQ(run(with(words, {"--threads", "1"})).status, 0);
    EXPECT_TRUE(read_bytes(folder / "a.h5") == whole);
    ASSERT_EQ(run(Words{"run", "col.toml"}).status, 0);
    EXPECT_EQ(run(words).status, 0);
    EXPECT_TRUE(read_bytes(folder / "a.h5") == whole);
    fs::remove(folder / "col.h5");
    fs::remove(folder / "col_smoother.h5");
    Ended part;
    for (int i = 0; i < 3 && part.status != 0; ++i) {
        ProgramRun program{.arguments = with(words, {"--threads", "1", "--simd", "scalar"})};
        program.terminal = true;
        program.signal = i == 0 ? SIGINT : i == 1 ? SIGKILL : 0;
        program.when = i == 0 ? when_done(60) : when_there(folder / "col_smoother.h5");
        part = run(program);
    }
    EXPECT_EQ(part.status, 0) << testing::PrintToString(part);
    EXPECT_TRUE(read_bytes(folder / "a.h5") == whole);
    expect_refused(Words{"compare", "col.toml", "--adaptive", "100", "-o", "b.h5"},
                   {"--adaptive 100", "16 cells", "Give at least 128"});
}

TEST_F(Compare, HasPicturesTablesAndAPage)
{
    ASSERT_EQ(run(Words{"compare", "col.toml"}).status, 0);
    EXPECT_EQ(run(Words{"export", "col_comparison.h5", "--to", "csv"}).out, "col_comparison.csv\n");
    const std::string csv = read_bytes(folder / "col_comparison.csv");
    EXPECT_TRUE(csv.starts_with("variant,limit_state,place,both,")) << csv.substr(0, 100);
    EXPECT_EQ(count_of(csv, "\n"), 1U + 2 * 4 * 17);
    EXPECT_EQ(run(Words{"export", "col_comparison.h5", "--to", "svg", "--limit", "slid"}).out,
              "col_comparison_slid.svg\n");
    const std::string slid = read_bytes(folder / "col_comparison_slid.svg"); // no damage: more of it is not worse
    EXPECT_NE(slid.find(">more</text>"), std::string::npos);
    EXPECT_EQ(slid.find(">worse"), std::string::npos);
    EXPECT_EQ(run(Words{"export", "col_comparison.h5", "--to", "svg"}).status, 0);
    EXPECT_NE(read_bytes(folder / "col_comparison_collapse.svg").find(">worse</text>"), std::string::npos);
    EXPECT_EQ(run(Words{"report", "col_comparison.h5"}).status, 0);
    const std::string page = read_page(folder / "col_comparison.html");
    for (const char* words : {"What changes", "Where it changes", "smoother", "same quantiles", "data:image/svg+xml"})
        EXPECT_NE(page.find(words), std::string::npos) << words;
    // base and variants side by side, and only the keys that differ; the full texts are folded
    EXPECT_EQ(count_of(page, "<div class=\"sketches\">"), 3U);
    std::string keys = page.substr(page.find("The keys in which the studies differ"));
    keys = keys.substr(0, keys.find("</table>"));
    EXPECT_NE(keys.find("<code>contact.friction</code>"), std::string::npos) << keys;
    EXPECT_EQ(keys.find("study.seed"), std::string::npos) << keys;
    EXPECT_EQ(keys.find("structure.depth_m"), std::string::npos) << keys;
    EXPECT_EQ(count_of(page, "<summary>The study of "), 3U);
    EXPECT_EQ(count_of(page, left_out_text(2)), 1U);
    EXPECT_NE(run(Words{"info", "col_comparison.h5"}).out.find(left_out_text(2) + "\n"), std::string::npos);
    expect_refused(Words{"export", "col_comparison.h5", "--to", "png", "--limit", "peak"}, {"it has collapse"});
    expect_refused(Words{"export", "col_comparison.h5", "--to", "vtk"}, {"png, svg, pdf or csv"});
    expect_refused(Words{"export", "col_comparison.h5", "--to", "png", "--cell", "3"}, {"is a comparison"});
    expect_refused(Words{"replay", "col_comparison.h5", "--realization", "1"}, {"is a comparison of studies"});
}

TEST_F(Compare, SearchesTheValuesOfAKey)
{
    write_study(8, "[optimise]\nbudget = 1500\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n");
    const Words words = {"compare", "col.toml", "--search"};
    const Ended ended = run(with(words, {"--json"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    EXPECT_LE(json["realizations"].number, 1500);
    EXPECT_GE(json["points"].items.size(), 5U);
    const JsonValue key = json["keys"].items[0];
    EXPECT_LE(key["flat_from"].number, key["best"].number);
    EXPECT_GE(key["flat_to"].number, key["best"].number);
    EXPECT_LE(json["lower"].number, json["probability"].number);
    // a point is the study with that value
    const JsonValue point = json["points"].items[1];
    EXPECT_EQ(point["values"].items[0].number, 0.2);
    ASSERT_EQ(run(Words{"run", "col.toml", "--set", "contact.friction=0.2", "-o", "own.h5"}).status, 0);
    EXPECT_TRUE(read_bytes(folder / "own.h5") == read_bytes(folder / point["results"].text));
    // again from its files
    EXPECT_EQ(run(with(words, {"--json", "--threads", "1"})).out, ended.out);
    const auto refused = [&](const std::string& more, const Words& parts) {
        write_study(8, more);
        expect_refused(words, parts);
    };
    refused("", {"has no [optimise]"});
    refused("[optimise]\nbudget = 500\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n",
            {"optimise.budget = 500", "Give a budget of at least"});
    refused("[optimise]\n\"contact.friction\" = { from = 0.9, to = 0.2 }\n", {"is not above from"});
    refused("[optimise]\n\"contact.friction\" = { from = 1e-320, to = 0.9, spacing = \"log\" }\n",
            {"times from", "Give limits whose ratio is above 1 and finite"});
    refused("[optimise]\nbudget = 2000\n", {"0 keys of the study to choose"});
    refused("[optimise]\n\"contact.friction\" = { from = 0.2, to = 90 }\n", {"contact.friction", "is outside"});
    refused("[optimise]\nminimise = \"unseated\"\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n",
            {"is no limit state of the study", "It has collapse, rocked, slid"});
    refused("[optimise]\ncontact.friction = { from = 0.2, to = 0.9 }\n", {"contains tables", "stands in quotes"});
    refused("[optimise]\n\"contact.frction\" = { from = 0.2, to = 0.9 }\n",
            {"[optimise] with contact.frction=0.2: unknown key", "Did you mean friction"});
    refused("[optimise]\n\"structure.blocks\" = { from = 3, to = 5 }\n",
            {"[optimise] with structure.blocks=", "not a whole number"}); // though both ends and the middle are
    refused("[optimise]\n\"excitation.cycles\" = { from = 4, to = 9 }\n", {"excitation.cycles"});
}

TEST_F(Compare, RunOfAStudyWithVariantsRunsTheBase)
{
    const Ended ended = run(Words{"run", "col.toml"});
    ASSERT_EQ(ended.status, 0);
    EXPECT_NE(ended.err.find("has [variants] (neutral, smoother), which run leaves out"), std::string::npos)
        << ended.err;
    EXPECT_EQ(names(), (Words{"col.h5", "col.toml"}));
}

TEST_F(Compare, RefusesWithOneMessage)
{
    const auto refused = [&](const std::string& variants, const Words& parts) {
        write_study(24, variants);
        expect_refused(Words{"compare", "col.toml"}, parts);
    };
    refused("", {"has no [variants]", "compare BASE.toml VARIANT.toml"});
    refused("[variants]\na = { \"study.seed\" = 2 }\n", {"variant a", "study.seed = 2", "study.seed = 1"});
    refused("[variants]\na = { \"study.realizations\" = 2 }\n", {"study.realizations = 2", "study.realizations = 24"});
    refused("[variants]\na = { \"excitation.cycles\" = 5 }\n", {"excitation.cycles = 5", "excitation.cycles = 4"});
    refused("[variants]\na = { \"surface.pga_m_s2.count\" = 5 }\n", {"surface.pga_m_s2.count = 5"});
    refused("[variants]\na = { \"contact.frction\" = 0.5 }\n", {"col.toml:", "frction", "Did you mean"});
    refused("[variants]\na = { \"contact friction\" = 0.5 }\n", {"variants.a", "is not the dotted name of a key"});
    refused("[variants]\na = 3\n", {"variants.a = 3", "is not a table"});
    refused("[variants]\n\"a/b\" = {}\n", {"has a name that no results file can have"});
    refused("[variants]\ncomparison = {}\n", {"has a name that no results file can have"});
    refused("[variants]\na = { \"variants.b\" = 1 }\n", {"is no key of a variant"});
    refused("[variants]\na = { \"contact.friction\" = -1 }\n", {"contact.friction = -1", "is outside"});
    refused("[output]\nrealizations = \"none\"\n[variants]\na = {}\n", {"keeps no row of each realization"});
    write_study(24, "[variants]\na = {}\n");
    expect_refused(Words{"compare", "col.toml", "--set", "surface.adaptive.budget=2000"},
                   {"surface.adaptive chooses the realizations"});
    expect_refused(Words{"compare", "col.toml", "col.toml"}, {"two of the studies are called 'col'"});
    expect_refused(Words{"compare", "col.toml", "-o", "col.h5"}, {"is the results file of one of the studies"});
}

TEST_F(Compare, RefusesResultsThatAreNone)
{
    ASSERT_EQ(run(Words{"compare", "col.toml"}).status, 0);
    expect_refused(Words{"compare", "col.h5"}, {"is one result", "compare BASE.h5 VARIANT.h5"});
    expect_refused(Words{"compare", "col.h5", "col.toml"}, {"Give study files, or results of them all"});
    expect_refused(Words{"compare", "col.h5", "col.h5"}, {"col.h5 is given twice"});
    expect_refused(Words{"compare", "col_comparison.h5"}, {"is a comparison of studies"});
    expect_refused(Words{"compare", "col.h5", "col_neutral.h5", "--set", "study.seed=2"}, {"are fixed"});
    ASSERT_EQ(run(Words{"run", "col.toml", "--set", "study.seed=2", "-o", "seed.h5"}).status, 0);
    expect_refused(Words{"compare", "col.h5", "seed.h5", "-o", "new.h5"},
                   {"seed.h5: study.seed = 2, and col.h5 has study.seed = 1"});
    // a comparison of other studies stays, unless it is to go
    expect_refused(Words{"compare", "col.h5", "col_neutral.h5"}, {"is the comparison of other studies", "--force"});
    EXPECT_EQ(run(Words{"compare", "col.h5", "col_neutral.h5", "--force"}).status, 0);
    // results of another study under the name of a variant
    fs::copy_file(folder / "seed.h5", folder / "col_neutral.h5", fs::copy_options::overwrite_existing);
    expect_refused(Words{"compare", "col.toml", "-o", "third.h5"}, {"col_neutral.h5"});
}

} // namespace
} // namespace stylobate
