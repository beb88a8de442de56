/// `stylobate compare --search` as its user runs it: three keys, and the frequency over a hazard.

#include "tests/program/program.hpp"

#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

class SearchProgram : public Program {
protected:
    void write_fragility(const std::string& more, int from = 1) const
    {
        write_bytes(folder / "frag.toml",
                    short_fragility_study(fmt::format("to = 16, count = 6, from = {}", from), more));
    }
    void write_surface(const std::string& more) const
    {
        write_bytes(folder / "col.toml",
                    "[study]\nkind = \"surface\"\nrealizations = 4\n" + short_column + R"([excitation]
kind = "harmonic"
cycles = 4
[surface]
frequency_hz = { from = 3.0, to = 6.0, count = 2 }
pga_m_s2 = { from = 4.0, to = 12.0, count = 2 }
[perturbation]
friction = { distribution = "normal", cov = 0.10, per = "joint" }
phase = { distribution = "uniform" }
)" + more);
    }
    static std::string search_of(const std::string& hazard)
    {
        return "[optimise]\nhazard = \"" + hazard +
               "\"\nbudget = 1200\n\"contact.friction\" = { from = 0.2, to = 0.8 }\n";
    }
    const Words frag_ = {"compare", "frag.toml", "--search"};
    const std::string power_law_ = "k0=0.2,k=2,measure=pga,sigma_ln=0.4";
};

/// The frequency by shares, of `risk` on a results file.
double risk_of_file(const JsonValue& json)
{
    for (const JsonValue& s : json["states"].items)
        if (s["state"].text == "collapse" && s["form"].text == "shares")
            return s["frequency_1_year"]["value"].number;
    ADD_FAILURE() << "no shares";
    return 0;
}

TEST_F(SearchProgram, ThreeKeys)
{
    write_surface("[optimise]\nbudget = 260\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n"
                  "\"contact.normal_stiffness_n_m2\" = { from = 2e6, to = 8e6, spacing = \"log\" }\n"
                  "\"contact.tangential_stiffness_n_m\" = { from = 1e5, to = 4e5, spacing = \"log\" }\n");
    const Words words = {"compare", "col.toml", "--search", "--json"};
    const Ended ended = run(words);
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    EXPECT_LE(json["realizations"].number, 260);
    EXPECT_GE(json["points"].items.size(), 13U);
    ASSERT_EQ(json["keys"].items.size(), 3U);
    for (const JsonValue& key : json["keys"].items) {
        EXPECT_LE(key["from"].number, key["flat_from"].number);
        EXPECT_LE(key["flat_from"].number, key["best"].number);
        EXPECT_LE(key["best"].number, key["flat_to"].number);
        EXPECT_LE(key["flat_to"].number, key["to"].number);
    }
    EXPECT_LE(json["lower"].number, json["probability"].number);
    EXPECT_LE(json["probability"].number, json["upper"].number);
    EXPECT_EQ(run(with(words, {"--threads", "1"})).out, ended.out);
}

/// Steps that are too long break realizations: the search says so, as `run` and `compare` do.
TEST_F(SearchProgram, InvalidRealizationsAreReported)
{
    write_surface("normal_stiffness = { distribution = \"lognormal\", sigma_ln = 0.7 }\n"
                  "[run]\nstep_s = 1.2e-3\nallow_step_above_bound = true\nmax_invalid_fraction = 0\n"
                  "[optimise]\nbudget = 160\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n");
    const Words words = {"compare", "col.toml", "--search", "--json"};
    const Ended some = run(words);
    EXPECT_EQ(some.status, 3) << testing::PrintToString(some);
    EXPECT_TRUE(json_of(some).has("probability"));
    EXPECT_NE(some.err.find("run.max_invalid_fraction = 0 allows"), std::string::npos) << some.err;
    fs::remove(folder / "col.h5"); // of another step
    const Ended none = run(with(words, {"--set", "run.step_s=1e-2"}));
    EXPECT_EQ(none.status, 2) << testing::PrintToString(none);
    EXPECT_NE(none.err.find("no realization is valid at all of the points"), std::string::npos) << none.err;
}

TEST_F(SearchProgram, APictureForAnyNumberOfKeys)
{
    const std::string first = "[optimise]\nbudget = 260\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n";
    const std::string second = "\"contact.normal_stiffness_n_m2\" = { from = 2e6, to = 8e6, spacing = \"log\" }\n";
    const Words words = {"compare", "col.toml", "--search", "-o", "search.svg", "--force"};
    for (const std::string& more : {std::string{}, second}) {
        write_surface(first + more);
        ASSERT_EQ(run(words).status, 0);
        const std::string picture = read_bytes(folder / "search.svg");
        EXPECT_NE(picture.find("Probability of collapse"), std::string::npos);
        EXPECT_NE(picture.find("contact.friction"), std::string::npos);
        EXPECT_EQ(picture.find("contact.normal_stiffness_n_m2") != std::string::npos, !more.empty());
        EXPECT_EQ(picture.find("inside the line: not shown to be worse at 95 %") != std::string::npos, !more.empty());
    }
}

/// The frequencies are those of `risk`, and the least of a grid lies in the interval of the search.
TEST_F(SearchProgram, TheAnnualFrequencyAgainstAGrid)
{
    write_fragility(search_of(power_law_));
    const Ended ended = run(with(frag_, {"--json"}));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const auto frequency_of = [&](const std::string& results) {
        return risk_of_file(
            json_of(run(Words{"risk", results, "--hazard", power_law_, "--most-outside", "1", "--force", "--json"})));
    };
    double least = 1e9;
    for (const JsonValue& point : json["points"].items) {
        const double want = frequency_of(point["results"].text), found = point["frequency"]["value"].number;
        EXPECT_NEAR(found, want, 1e-12 * want) << point["results"].text;
        EXPECT_LT(point["frequency"]["total_lower"].number, point["frequency"]["lower"].number);
    }
    const double base = frequency_of("frag.h5");
    EXPECT_NEAR(json["base_frequency"]["value"].number, base, 1e-12 * base);
    // what the surface is of: the sum of the motions' own frequencies
    const JsonValue best = json["points"].items[static_cast<std::size_t>(json["best_point"].number)];
    const double change = best["frequency"]["value"].number - base;
    ASSERT_NE(change, 0);
    EXPECT_NEAR(json["frequency_difference"].number, change, 1e-12 * base);
    for (const char* friction : {"0.2", "0.35", "0.5", "0.65", "0.8"}) {
        const std::string results = std::string("grid_") + friction + ".h5";
        ASSERT_EQ(
            run(Words{"run", "frag.toml", "--set", std::string("contact.friction=") + friction, "-o", results}).status,
            0);
        least = std::min(least, frequency_of(results));
    }
    EXPECT_GT(least, 0);
    EXPECT_LE(json["lower"].number, least);
    EXPECT_GE(json["upper"].number, least);
    EXPECT_NEAR(json["probability_over_years"].number, 1 - std::exp(-50 * json["frequency"].number), 1e-9);
    EXPECT_LE(json["frequency_difference_lower"].number, json["frequency_difference"].number);
    const Ended text = run(frag_);
    EXPECT_NE(text.out.find("smallest annual frequency of collapse"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("in 50 years"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find(left_out_text(2) + "\n"), std::string::npos) << text.out;
    EXPECT_EQ(json["left_out"].text, left_out_text(2));
    EXPECT_EQ(run(with(frag_, {"--json", "--threads", "1", "-o", "search.svg"})).out, ended.out);
    const std::string picture = read_bytes(folder / "search.svg");
    EXPECT_NE(picture.find("Annual frequency of collapse"), std::string::npos);
    EXPECT_NE(picture.find("contact.friction"), std::string::npos);
}

/// A file lies beside the study file, wherever the program is run.
TEST_F(SearchProgram, AHazardFileAndADamageState)
{
    std::filesystem::create_directory(folder / "site");
    std::string table = "pga_m_s2,annual_frequency\n";
    for (const double a : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0})
        table += fmt::format("{},{}\n", a, 0.2 / (a * a));
    write_bytes(folder / "site/hazard.csv", table);
    write_fragility("[optimise]\nminimise = \"peak_0.35\"\nhazard = \"hazard.csv\"\nbudget = 1200\n"
                    "\"contact.friction\" = { from = 0.2, to = 0.8 }\n");
    std::filesystem::rename(folder / "frag.toml", folder / "site/frag.toml");
    const Ended ended = run(Words{"compare", "site/frag.toml", "--search", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_GT(json_of(ended)["frequency"].number, 0);
    // without a hazard it is the mean share of the stripes
    write_fragility("[optimise]\nbudget = 1200\n\"contact.friction\" = { from = 0.2, to = 0.8 }\n");
    const JsonValue share = json_of(run(with(frag_, {"--json"})));
    EXPECT_GT(share["probability"].number, 0);
    EXPECT_FALSE(share.has("frequency"));
}

TEST_F(SearchProgram, RefusesAHazardThatIsNone)
{
    const auto refused = [&](const std::string& hazard, const Words& parts) {
        write_fragility(search_of(hazard));
        expect_refused(frag_, parts);
    };
    refused("k0=1e-3,k=3,measure=pgv", {"frag.toml", "optimise.hazard", "is of pgv_m_s, the study of pga_m_s2"});
    refused("k0=1e-3,measure=pga", {"optimise.hazard", "k is missing"});
    refused("none.csv", {"optimise.hazard", "none.csv"});
    write_surface(
        "[optimise]\nhazard = \"k0=1e-3,k=3,measure=pga\"\n\"contact.friction\" = { from = 0.2, to = 0.9 }\n");
    expect_refused(Words{"compare", "col.toml", "--search"}, {"optimise.hazard", "of kind \"fragility\""});
    write_fragility(search_of(power_law_));
    expect_refused(with(frag_, {"-o", "points.h5"}), {"-o points.h5", "--search writes a picture there"});
    // most of the frequency is of earthquakes that are weaker than those of the runs
    write_fragility(search_of(power_law_), 10);
    const Ended weak = run(frag_);
    EXPECT_EQ(weak.status, 2);
    EXPECT_NE(weak.err.find("of the frequency would come from intensities outside"), std::string::npos) << weak.err;
}

} // namespace
} // namespace stylobate
