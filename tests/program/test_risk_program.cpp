/// `stylobate risk` as its user runs it: the closed form, the same bytes for every number of threads, histories of
/// earthquakes with known answers, what reads the file, and refusals that leave nothing.

#include "tests/program/program.hpp"

#include "ensemble/model/observer.hpp"
#include "io/store/result_store.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/sequences.hpp"
#include "studies/report/left_out.hpp"

#include <cmath>
#include <sstream>

namespace stylobate {
namespace {

const std::string risk_study = STYLOBATE_SOURCE_DIR "/studies/inputs/fragility_column.toml";
const std::vector<std::string> risk_settings = {
    "study.realizations=6", "fragility.contacts=1", "fragility.twins=1", "fragility.motions=20",
    "fragility.intensity={measure=\"pgv\",from=0.3,to=2.5,count=6,spacing=\"log\"}"};

class RiskProgram : public Program {
protected:
    void SetUp() override
    {
        Program::SetUp();
        ran_ = run(ProgramRun{.arguments = run_words(risk_study, risk_settings, {"-o", "f.h5", "--json"})});
        ASSERT_EQ(ran_.status, 0) << testing::PrintToString(ran_);
    }
    Ended risk(Words more) const
    {
        Words words = {"risk", "f.h5"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    Ended ran_;
};

/// The form of a limit state in the JSON.
const JsonValue& state_of(const JsonValue& json, const std::string& name, const std::string& form)
{
    for (const JsonValue& s : json["states"].items)
        if (s["state"].text == name && s["form"].text == form)
            return s;
    throw std::runtime_error("no " + name + " " + form);
}

TEST_F(RiskProgram, LognormalIsTheClosedFormAndTheFileIsRead)
{
    const Ended ended = risk({"--hazard", "k0=1e-3,k=3,measure=pgv,sigma_ln=0.4", "--years", "50,100", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const Ended quiet = risk({"--hazard", "k0=1e-3,k=3,measure=pgv", "-o", "quiet.h5", "--quiet"});
    EXPECT_TRUE(quiet.out.ends_with("\nquiet.h5\n")) << testing::PrintToString(quiet);
    EXPECT_EQ(quiet.out.find("the mean hazard is"), std::string::npos) << "without fractiles there is none";
    EXPECT_EQ(quiet.err, "");
    const JsonValue json = json_of(ended), fragility = json_of(ran_);
    int compared = 0;
    for (const JsonValue& s : fragility["fragility"]["states"].items) {
        if (!s["curve"].boolean)
            continue;
        const double median = s["median"]["value"].number, beta = s["dispersion"]["value"].number;
        const JsonValue& found = state_of(json, s["name"].text, "lognormal");
        if (!found["determined"].boolean)
            continue;
        const double want = 1e-3 * std::pow(median, -3) * std::exp(9 * beta * beta / 2);
        const JsonValue& frequency = found["frequency_1_year"];
        EXPECT_NEAR(frequency["value"].number / want, 1, 1e-6) << s["name"].text;
        EXPECT_LT(frequency["lower"].number, frequency["fragility_lower"].number);
        EXPECT_GT(frequency["upper"].number, frequency["hazard_upper"].number);
        EXPECT_NEAR(frequency["hazard_upper"].number / want, std::exp(0.4 * 1.6448536), 1e-5);
        EXPECT_GT(frequency["fragility_part"].number, 0);
        EXPECT_LT(frequency["fragility_part"].number, 1);
        const JsonValue& hundred = found["over_years"].items[1];
        EXPECT_EQ(hundred["years"].number, 100);
        EXPECT_NEAR(hundred["probability"]["value"].number, 1 - std::exp(-100 * want), 1e-6);
        // the mean of a lognormal hazard is exp(sigma2 / 2) of its median
        const JsonValue& mean = found["mean_hazard"];
        EXPECT_NEAR(mean["frequency_1_year"].number / want, std::exp(0.08), 1e-6);
        EXPECT_NEAR(mean["over_years"].items[1]["probability"].number, 1 - std::exp(-100 * want * std::exp(0.08)),
                    1e-6);
        ++compared;
    }
    EXPECT_GE(compared, 3);

    // what reads the file
    const Ended info = run(Words{"info", "f_risk.h5"});
    EXPECT_EQ(info.status, 0) << info.err;
    EXPECT_NE(info.out.find("a risk estimate"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("stylobate export f_risk.h5 --to png"), std::string::npos) << info.out;
    // all numbers are those of the file
    std::istringstream lines(
        risk({"--hazard", "k0=1e-3,k=3,measure=pgv,sigma_ln=0.4", "-o", "f_risk.h5", "--force"}).out);
    int shown = 0;
    for (std::string line; std::getline(lines, line); ++shown)
        if (line != "f_risk.h5") {
            EXPECT_NE(info.out.find(line), std::string::npos) << line << "\nis not in\n" << info.out;
        }
    EXPECT_GT(shown, 15);
    const Ended page = run(Words{"report", "f_risk.h5"});
    EXPECT_EQ(page.status, 0) << page.err;
    EXPECT_NE(read_bytes(folder / "f_risk.html").find("Contributing intensities"), std::string::npos);
    EXPECT_NE(info.out.find(left_out_text(2) + "\n"), std::string::npos) << info.out;
    EXPECT_EQ(json["left_out"].text, left_out_text(2));
    EXPECT_EQ(count_of(read_page(folder / "f_risk.html"), left_out_text(2)), 1U);
    EXPECT_EQ(run(Words{"export", "f_risk.h5", "--to", "csv"}).status, 0);
    const std::string states = read_bytes(folder / "f_risk_csv/states.csv");
    EXPECT_EQ(count_of(states, "\n"), json["states"].items.size() + 1) << states;
    EXPECT_EQ(run(Words{"export", "f_risk.h5", "--to", "svg", "--limit", "peak_0.35"}).status, 0);
    EXPECT_TRUE(fs::exists(folder / "f_risk_peak_0.35.svg"));
    expect_refused(Words{"export", "f_risk.h5", "--to", "nrml"}, {"f_risk.h5 is a risk estimate"});
    expect_refused(Words{"replay", "f_risk.h5", "--realization", "0"}, {"is a risk estimate"});
    const std::string whole = read_bytes(folder / "f_risk.h5");
    write_bytes(folder / "torn.h5", whole.substr(0, whole.size() / 2));
    expect_refused(Words{"report", "torn.h5"}, {"torn.h5"});
}

/// By a table of the same power law: the same numbers, and what lies beyond the table is counted.
TEST_F(RiskProgram, TableAndThreadsChangeNothing)
{
    std::string table = "pgv_cm_s,annual_frequency\n";
    for (const double cm : {1.0, 5.0, 30.0, 100.0, 300.0, 1000.0})
        table += fmt::format("{},{}\n", cm, 1e-3 * std::pow(cm / 100, -3));
    write_bytes(folder / "hazard.csv", table);
    const Ended by_table = risk({"--hazard", "hazard.csv", "--json", "-o", "t.h5"}),
                by_law = risk({"--hazard", "k0=1e-3,k=3,measure=pgv", "--json", "-o", "l.h5"});
    ASSERT_EQ(by_table.status, 0) << by_table.err;
    ASSERT_EQ(by_law.status, 0) << by_law.err;
    for (const char* form : {"lognormal", "shares"}) {
        const JsonValue a = json_of(by_table), b = json_of(by_law);
        EXPECT_NEAR(state_of(a, "collapse", form)["frequency_1_year"]["value"].number /
                        state_of(b, "collapse", form)["frequency_1_year"]["value"].number,
                    1, 1e-9);
    }
    const Words sequences = {
        "--hazard", "k0=1e-3,k=3,measure=pgv", "--sequences", "40", "--years", "30", "--pause", "5", "-o"};
    const auto bytes = [&](const char* name, const char* threads) {
        Words words = sequences;
        words.insert(words.end(), {name, "--threads", threads});
        const Ended ended = risk(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return read_bytes(folder / name);
    };
    const std::string one = bytes("one.h5", "1");
    EXPECT_EQ(one, bytes("two.h5", "2"));
    EXPECT_GT(one.size(), 1000U);
}

TEST_F(RiskProgram, HistoriesWhereEveryEarthquakeTopples)
{
    // each of 0.01 a year is at 30 m/s or more, which nothing survives
    const Ended ended = risk({"--hazard", "k0=270,k=3,measure=pgv", "--sequences", "400", "--threshold", "30",
                              "--most-outside", "1", "--state", "collapse", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const JsonValue& s = json["sequences"];
    EXPECT_NEAR(s["events_1_year"].number, 0.01, 1e-12);
    EXPECT_EQ(s["fallen_carried"].number, s["fallen_fresh"].number);
    EXPECT_EQ(s["difference"]["value"].number, 0);
    const double want = 1 - std::exp(-1.0), error = std::sqrt(want * (1 - want) / 400);
    EXPECT_NEAR(s["fresh"]["value"].number, want, 4 * error); // 1 in 16,000 by chance
    EXPECT_NEAR(s["events"].number, 400, 4 * std::sqrt(400));
}

TEST_F(RiskProgram, HistoriesWhereNothingMoves)
{
    // 5 earthquakes in a hundred years, nearly all below 0.03 m/s
    const Ended ended = risk({"--hazard", "k0=5e-53,k=30,measure=pgv", "--sequences", "100", "--threshold", "0.02",
                              "--pause", "5", "--most-outside", "1", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const JsonValue& s = json["sequences"];
    EXPECT_GT(s["events"].number, 300);
    EXPECT_EQ(s["fallen_carried"].number, 0);
    EXPECT_EQ(s["fallen_fresh"].number, 0);
    EXPECT_EQ(s["difference"]["value"].number, 0);
    EXPECT_LT(s["difference"]["lower"].number, 0);
    EXPECT_GT(s["difference"]["upper"].number, 0);
}

/// Histories of seven earthquakes, of which any can topple the column: those that are new in each agree with the
/// fragility, and no earthquake of those that are carried along is lost.
TEST_F(RiskProgram, HistoriesOfSeveralEarthquakesAgreeWithTheFragilityLong)
{
    const Ended ended = risk({"--hazard", "k0=0.03,k=3,measure=pgv", "--sequences", "60", "--threshold", "0.5",
                              "--years", "30", "--pause", "5", "--state", "collapse", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    const JsonValue& s = json["sequences"];
    EXPECT_NEAR(s["events"].number, 60 * 7.2, 4 * std::sqrt(60 * 7.2)); // 1 in 16,000 by chance
    const double expected = s["closed_form"]["value"].number, fresh = s["fresh"]["value"].number;
    EXPECT_GT(expected, 0.4);
    EXPECT_LT(expected, 0.8);
    // the curve is fitted to 20 motions: its limits, and four standard errors of the histories
    EXPECT_GT(fresh, s["closed_form"]["lower"].number - 4 * 0.064);
    EXPECT_LT(fresh, s["closed_form"]["upper"].number + 4 * 0.064);
    EXPECT_GT(fresh, 0.35);
    // after so short a pause the next one finds the column still rocking
    EXPECT_GT(s["carried"]["value"].number, fresh - 0.1);
    EXPECT_GT(s["histories_with_two_events"].number, 54);
}

TEST_F(RiskProgram, TheThresholdIsTheStrongestHarmlessStripe)
{
    const std::uint64_t stripes = 6;
    std::vector<int> trials(stripes), moved(stripes), fallen(stripes);
    for (const ResultRow& row : ResultReader(folder / "f.h5").rows()) {
        const std::size_t j = row.cell % stripes;
        const bool fell = row.outcome.state == State::collapsed;
        if (!fell && row.outcome.at_rest == 0) // what stays of it is not known
            continue;
        ++trials[j];
        moved[j] += fell || row.outcome.residual_dislocation > 0.001;
        fallen[j] += row.outcome.state == State::collapsed;
    }
    std::size_t harmless = 0;
    while (harmless < stripes && fallen[harmless] == 0 && 100 * moved[harmless] <= trials[harmless])
        ++harmless;
    const double want = 0.3 * std::pow(2.5 / 0.3, harmless > 0 ? static_cast<double>(harmless - 1) / 5 : 0);
    const Ended ended = risk(
        {"--hazard", "k0=1e-3,k=3,measure=pgv", "--sequences", "5", "--pause", "5", "--state", "collapse", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_NEAR(json_of(ended)["sequences"]["threshold"].number, want, 1e-9);
}

/// Where the frequency of the collapse is not determined, the histories have nothing to be compared with.
TEST_F(RiskProgram, NothingIsComparedWithWhatIsNotDetermined)
{
    const Ended ended = risk({"--hazard", "k0=1e-3,k=1.5,measure=pgv", "--sequences", "5", "--pause", "5", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    ASSERT_FALSE(state_of(json, "collapse", "lognormal")["determined"].boolean);
    EXPECT_NE(ended.out.find("\"closed_form\": {\"value\": null"), std::string::npos) << ended.out;
    EXPECT_NE(run(Words{"info", "f_risk.h5"}).out.find("By the fragility, new in each:   not determined"),
              std::string::npos);
}

/// The same study with less friction, compared with the base; what it changes at a site, counted here from the rows.
TEST_F(RiskProgram, TheChangeOfAComparisonIsThatOfTheRows)
{
    std::vector<std::string> smoother = risk_settings;
    smoother.emplace_back("contact.friction=0.45");
    ASSERT_EQ(run(ProgramRun{.arguments = run_words(risk_study, smoother, {"-o", "s.h5", "--quiet"})}).status, 0);
    ASSERT_EQ(run(Words{"compare", "f.h5", "s.h5", "-o", "c.h5", "--quiet"}).status, 0);
    EXPECT_NE(run(Words{"info", "c.h5"}).out.find("stylobate risk c.h5 --hazard HAZARD"), std::string::npos);
    const Ended ended =
        run(Words{"risk", "c.h5", "--hazard", "k0=1e-3,k=3,measure=pgv,sigma_ln=0.5", "--years", "100", "--json"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended);
    ASSERT_EQ(json["variants"].items.size(), 1U);

    // shares of the stripes
    std::vector<double> trials(6), base(6), variant(6), im(6);
    const auto a = ResultReader(folder / "f.h5").rows(), b = ResultReader(folder / "s.h5").rows();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].index, b[i].index);
        const std::size_t j = a[i].cell % 6;
        trials[j] += 1;
        base[j] += a[i].outcome.state == State::collapsed;
        variant[j] += b[i].outcome.state == State::collapsed;
        im[j] = 0.3 * std::pow(2.5 / 0.3, static_cast<double>(j) / 5);
    }
    // of P that is linear in x = ln im between the stripes, -d lambda = 3e-3 exp(-3 x) dx, by small steps
    const auto frequency = [&](const std::vector<double>& reached) {
        const double spacing = std::log(im[1] / im[0]), end = std::log(im[5]);
        double sum = 1e-3 * std::exp(-3 * end) * reached[5] / trials[5];
        const int steps = 60000;
        for (int i = 0; i < steps; ++i) {
            const double x = std::log(im[0]) - spacing + (i + 0.5) / steps * 6 * spacing;
            const double place = (x - std::log(im[0])) / spacing;
            const int j = static_cast<int>(std::floor(place));
            const auto share = [&](int k) {
                return k < 0 ? 0 : reached[static_cast<std::size_t>(k)] / trials[static_cast<std::size_t>(k)];
            };
            const double p = share(j) + (place - j) * (share(std::min(j + 1, 5)) - share(j));
            sum += p * 3e-3 * std::exp(-3 * x) * 6 * spacing / steps;
        }
        return sum;
    };
    const double of_base = frequency(base), of_variant = frequency(variant);
    bool seen = false;
    for (const JsonValue& state : json["variants"].items[0]["states"].items) {
        if (state["state"].text != "collapse")
            continue;
        seen = true;
        EXPECT_NEAR(state["base_1_year"]["value"].number / of_base, 1, 1e-5);
        EXPECT_NEAR(state["variant_1_year"]["value"].number / of_variant, 1, 1e-5);
        const JsonValue& change = state["change_1_year"];
        EXPECT_NEAR(change["value"].number, of_variant - of_base, 1e-5 * of_base);
        EXPECT_LE(change["lower"].number, change["fragility_lower"].number);
        EXPECT_GE(change["upper"].number, change["value"].number);
        const JsonValue& over = state["over_years"].items[0]["change"];
        EXPECT_NEAR(over["value"].number, std::exp(-100 * of_base) - std::exp(-100 * of_variant), 1e-5);
        EXPECT_LE(over["lower"].number, over["value"].number);
        EXPECT_GE(over["upper"].number, over["value"].number);
        // pairs: the change is known better than either frequency
        EXPECT_LT(change["fragility_upper"].number - change["fragility_lower"].number,
                  state["base_1_year"]["upper"].number - state["base_1_year"]["lower"].number);
    }
    EXPECT_TRUE(seen);

    // what reads the file
    const Ended info = run(Words{"info", "c_risk.h5"});
    EXPECT_NE(info.out.find("a risk estimate of a comparison"), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("percentage points"), std::string::npos) << info.out;
    ASSERT_EQ(run(Words{"report", "c_risk.h5"}).status, 0);
    EXPECT_NE(read_bytes(folder / "c_risk.html").find("In 100 years the limit state"), std::string::npos);
    EXPECT_NE(info.out.find("  - " + left_out_text(2) + "\n"), std::string::npos) << info.out;
    EXPECT_EQ(count_of(read_page(folder / "c_risk.html"), left_out_text(2)), 1U);
    EXPECT_EQ(run(Words{"export", "c_risk.h5", "--to", "svg"}).status, 0);
    EXPECT_TRUE(fs::exists(folder / "c_risk.svg"));
    EXPECT_EQ(run(Words{"export", "c_risk.h5", "--to", "csv"}).status, 0);
    EXPECT_EQ(count_of(read_bytes(folder / "c_risk_csv/changes.csv"), "\n"),
              1 + json["variants"].items[0]["states"].items.size());
    // the same bytes again
    const std::string bytes = read_bytes(folder / "c_risk.h5");
    ASSERT_EQ(run(Words{"risk", "c.h5", "--hazard", "k0=1e-3,k=3,measure=pgv,sigma_ln=0.5", "--years", "100", "--force",
                        "--quiet"})
                  .status,
              0);
    EXPECT_EQ(read_bytes(folder / "c_risk.h5"), bytes);
    expect_refused(Words{"risk", "c.h5", "--hazard", "k0=1e-3,k=3,measure=pga_g", "-o", "x.h5"},
                   {"the hazard is of pga_m_s2, the study of pgv_m_s"});
    expect_refused(Words{"risk", "c.h5", "--hazard", "k0=1e-3,k=3,measure=pgv", "--sequences", "9", "-o", "x.h5"},
                   {"--sequences: c.h5 is a comparison", "Give its results"});
    expect_refused(Words{"risk", "c.h5", "--hazard", "k0=1e-3,k=3,measure=pgv", "--state", "colapse", "-o", "x.h5"},
                   {"--state colapse", "Did you mean collapse"});
    expect_refused(Words{"export", "c_risk.h5", "--to", "svg", "--limit", "colapse", "-o", "y.svg"},
                   {"--limit colapse: no limit state of c.h5"});
}

/// Two stripes far apart: none falls at the lower one and all fall at the upper one.
TEST_F(RiskProgram, SeparatedStripesHaveARangeAndNoCurve)
{
    const std::vector<std::string> apart = {
        "study.realizations=2",
        "fragility.contacts=1",
        "fragility.twins=1",
        "fragility.motions=15",
        "perturbation.pulse_frequency.sigma_ln=0.01",
        "perturbation.pulse_gamma.to=1.1",
        "perturbation.phase.from=1.5",
        "perturbation.phase.to=1.6",
        "study.allow=[\"pga\"]",
        "fragility.intensity={measure=\"pgv\",from=0.12,to=5.5,count=2,spacing=\"log\"}"};
    const Ended ran = run(ProgramRun{.arguments = run_words(risk_study, apart, {"-o", "sep.h5"})});
    ASSERT_EQ(ran.status, 0) << testing::PrintToString(ran);
    EXPECT_NE(ran.out.find("30 of 60      no curve  between 0.12 and 5.5"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("The stripes separate"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("nan"), std::string::npos) << ran.out;
    const Ended told =
        run(Words{"risk", "sep.h5", "--hazard", "k0=1e-3,k=3,measure=pgv", "--state", "collapse", "--json"});
    ASSERT_EQ(told.status, 0) << testing::PrintToString(told);
    const JsonValue& frequency = state_of(json_of(told), "collapse", "shares")["frequency_1_year"];
    EXPECT_NEAR(frequency["upper"].number, 1e-3 * std::pow(0.12, -3), 1e-9); // all events above 0.12 m/s
    EXPECT_LT(frequency["lower"].number, 1e-3 * std::pow(5.5, -3));
    ASSERT_EQ(run(Words{"export", "sep.h5", "--to", "nrml"}).status, 0);
    const std::string nrml = read_bytes(folder / "sep_nrml/peak.xml");
    EXPECT_NE(nrml.find("collapse: no lognormal curve, median between 12 and 550 cm/s"), std::string::npos) << nrml;
    EXPECT_EQ(nrml.find("logncdf"), std::string::npos);
}

/// A run of the histories is a whole history or one of its earthquakes: its share is not that of the histories.
TEST_F(RiskProgram, HistoriesShowNoShareWhileTheyRun)
{
    ASSERT_EQ(risk({"--hazard", "k0=1e-3,k=3,measure=pgv", "--quiet"}).status, 0);
    struct Seen : Observer {
        void progress(const Progress& p) override
        {
            ++calls;
            shares += !std::isnan(p.share);
        }
        int calls = 0, shares = 0;
    } seen;
    const Results results((folder / "f.h5").string(), {});
    SequenceOptions options;
    options.histories = 8;
    options.threshold = 0.5;
    options.pause_s = 5;
    RunOptions two;
    two.threads = 2;
    ASSERT_TRUE(simulate_sequences(results, read_risk(folder / "f_risk.h5"), options, two, seen));
    EXPECT_GT(seen.calls, 0);
    EXPECT_EQ(seen.shares, 0);
}

TEST_F(RiskProgram, Refusals)
{
    const std::string law = "k0=1e-3,k=3,measure=pgv";
    expect_refused(Words{"risk", "f.h5", "--hazard", "k0=1e-3,k=3,measure=pga_g"},
                   {"the hazard is of pga_m_s2, the study of pgv_m_s"});
    expect_refused(Words{"risk", "f.h5", "--hazard", "nothing.csv"}, {"nothing.csv"});
    expect_refused(Words{"risk", "f.h5", "--hazard", law, "--state", "colapse"},
                   {"--state colapse", "Did you mean collapse"});
    expect_refused(Words{"risk", "f.h5", "--hazard", law, "--years", "0"}, {"--years 0: is outside (0, 1e6]"});
    expect_refused(Words{"risk", "f.h5", "--hazard", law, "--level", "0.3"}, {"--level 0.3: is outside (0.5, 1)"});
    expect_refused(
        Words{"risk", "f.h5", "--hazard", "k0=1e-3,k=0.2,measure=pgv", "--state", "collapse"},
        {"f.h5: collapse: ", "% of the frequency would come from intensities outside of the range of the runs",
         "Or accept it: --most-outside"});
    expect_refused(Words{"risk", "f.h5", "--hazard", law, "--sequences", "10", "--threshold", "0.001"},
                   {"--threshold 0.001: a history of 100 years would have"});
    expect_refused(Words{"risk", risk_study, "--hazard", law}, {"is a study file"});
    expect_refused(Words{"risk", "f.h5", "--hazard", law, "--sequences", "10", "--threshold", "inf"},
                   {"--threshold inf: is not above 0 and finite", "pgv_m_s"});
    // a hazard that is of far stronger earthquakes than the study: the hazard's range is the fault
    write_bytes(folder / "far.csv", "pgv_m_s,annual_frequency\n20,1e-5\n30,1e-6\n");
    expect_refused(Words{"risk", "f.h5", "--hazard", "far.csv", "--state", "collapse"},
                   {"intensities outside of the hazard's points", "Give the hazard over a wider range"});
    for (const char* option : {"--threshold", "--pause", "--seed"}) // of histories that are not asked for
        expect_refused(Words{"risk", "f.h5", "--hazard", law, option, "3"}, {option, "--sequences"});
    expect_refused(Words{"risk", "f.h5", "--hazard", "far.csv", "-o", "far.csv", "--force"},
                   {"-o far.csv: is the input file"});
    EXPECT_EQ(read_bytes(folder / "far.csv").substr(0, 7), "pgv_m_s");
    ASSERT_EQ(risk({"--hazard", law}).status, 0);
    expect_refused(Words{"risk", "f.h5", "--hazard", law}, {"f_risk.h5", "--force"});
}

} // namespace
} // namespace stylobate
