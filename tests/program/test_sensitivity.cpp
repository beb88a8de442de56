/// A study of sensitivity as its user runs it: the points of its design, the same bytes whatever the threads and
/// interruptions, its tables and pictures, refusals.

#include "tests/program/program.hpp"

#include "ensemble/estimators/designs/sobol_indices.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/kind_tables.hpp"

#include <cmath>
#include <set>

namespace stylobate {
namespace {

const std::string sensitivity_study = STYLOBATE_SOURCE_DIR "/studies/inputs/sensitivity_column.toml";

/// A second of work: a short column on soft joints.
const std::vector<std::string> quick = {"structure.blocks=4",
                                        "contact.normal_stiffness_n_m2=4e6",
                                        "contact.tangential_stiffness_n_m=2e5",
                                        "excitation.cycles=4",
                                        "excitation.frequency_hz=6",
                                        "excitation.pga_m_s2=14",
                                        "sensitivity.samples=60",
                                        "sensitivity.inner=2"};

/// Of numbers that may be undetermined.
bool same(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// Which factor, "" for the rest, an input belongs to.
std::string factor_of(const Study& study, const std::string& input)
{
    const std::string name = input.substr(0, input.find('['));
    return study.design().factor(name) >= 0 ? name : "";
}

TEST(SensitivityDesign, APointDiffersInItsFactorAlone)
{
    for (const char* sampling : {"independent", "sobol"}) {
        const Study study = read_study(sensitivity_study,
                                       with(quick, {std::string("study.sampling=") + sampling, "sensitivity.inner=3"}));
        const Sampler sampler(study, nullptr);
        const FactorDesign& spec = *study.sensitivity;
        ASSERT_EQ(spec.points(), 8U);
        ASSERT_EQ(study.total(), 60U * 8 * 3);
        const auto inputs = [&](std::uint64_t row, std::uint64_t point, std::uint64_t draw) {
            return sampler.realization((row * 8 + point) * 3 + draw).inputs;
        };
        const std::vector<std::string>& names = sampler.input_names();
        std::set<double> seen;
        for (const std::uint64_t row : {0, 1, 59})
            for (std::uint64_t point = 0; point < 8; ++point)
                for (std::uint64_t draw = 0; draw < 3; ++draw) {
                    const auto here = inputs(row, point, draw), a = inputs(row, 0, 0), b = inputs(row, 1, 0);
                    const auto rest = inputs(row, 0, draw);
                    for (std::size_t i = 0; i < names.size(); ++i) {
                        const std::string factor = factor_of(study, names[i]);
                        if (factor.empty()) {
                            EXPECT_EQ(here[i], rest[i]) << "the rest is that of the row: " << names[i];
                            if (point == 0) {
                                EXPECT_TRUE(seen.insert(here[i]).second) << "and of no other: " << names[i];
                            }
                            continue;
                        }
                        const bool of_b =
                            point == 1 || point == 2 + static_cast<std::uint64_t>(study.design().factor(factor));
                        EXPECT_EQ(here[i], of_b ? b[i] : a[i]) << names[i] << ", point " << point;
                        EXPECT_NE(a[i], b[i]);
                    }
                }
    }
}

/// The ranges of all numbers of the factors are filled evenly: of 64 rows each 64th of each range has one in A, one in
/// B.
TEST(SensitivityDesign, SobolPointsFillTheRanges)
{
    const Study study = read_study(sensitivity_study, with(quick, {"study.sampling=sobol", "sensitivity.samples=64"}));
    const Sampler sampler(study, nullptr);
    const auto phase = std::find(sampler.input_names().begin(), sampler.input_names().end(), "phase");
    const auto at = static_cast<std::size_t>(phase - sampler.input_names().begin());
    for (const std::uint64_t point : {0, 1}) {
        std::set<int> taken;
        for (std::uint64_t row = 0; row < 64; ++row)
            taken.insert(static_cast<int>(sampler.realization((row * 8 + point) * 2).inputs[at] / 6.283185307 * 64));
        EXPECT_EQ(taken.size(), 64U);
    }
}

TEST(SensitivityDesign, MorrisMovesAFactorByHalfItsRange)
{
    const Study study = read_study(sensitivity_study, with(quick, {"sensitivity.method=morris"}));
    const Sampler sampler(study, nullptr);
    const FactorDesign& spec = *study.sensitivity;
    ASSERT_EQ(spec.points(), 7U);
    const std::vector<std::string>& names = sampler.input_names();
    const auto phase = static_cast<std::size_t>(std::find(names.begin(), names.end(), "phase") - names.begin());
    for (std::uint64_t row = 0; row < 60; ++row) {
        const auto a = sampler.realization(row * 14).inputs;
        const auto moved =
            sampler.realization(row * 14 + 2 * (1 + std::uint64_t(study.design().factor("phase")))).inputs;
        EXPECT_NEAR(std::abs(moved[phase] - a[phase]), 3.141592653589793, 1e-12); // uniform from 0 to 2 pi
        for (std::size_t i = 0; i < names.size(); ++i)
            if (i != phase) {
                EXPECT_EQ(moved[i], a[i]);
            }
    }
}

class Sensitivity : public Program {
protected:
    Ended study(const std::vector<std::string>& settings, const std::string& results, const char* threads = "2",
                const std::string& simd = "auto") const
    {
        return run(
            run_words(sensitivity_study, settings, {"-o", results, "--threads", threads, "--simd", simd, "--json"}));
    }
};

TEST_F(Sensitivity, ThreadsInstructionSetsAndInterruptionsChangeNoByte)
{
    const Ended whole = study(quick, "whole.h5");
    ASSERT_EQ(whole.status, 0) << testing::PrintToString(whole);
    ASSERT_EQ(study(quick, "scalar.h5", "1", "scalar").status, 0);
    EXPECT_TRUE(bytes("whole.h5") == bytes("scalar.h5"));
    ProgramRun part{.arguments = run_words(sensitivity_study, quick, {"-o", "parts.h5", "--threads", "1"})};
    part.signal = SIGKILL;
    part.terminal = true;
    part.when = when_done(ResultReader(folder / "whole.h5").done() / 2);
    run(part);
    const Ended rest = study(quick, "parts.h5");
    EXPECT_EQ(rest.status, 0) << testing::PrintToString(rest);
    EXPECT_TRUE(bytes("whole.h5") == bytes("parts.h5"));
}

/// What the program tells is what its rows say, read back and estimated here again.
TEST_F(Sensitivity, TellsWhatItsRowsSay)
{
    const Ended ended = study(with(quick, {"sensitivity.samples=300"}), "factors.h5");
    const JsonValue found = json_of(ended)["sensitivity"];
    const ResultReader reader(folder / "factors.h5");
    EXPECT_EQ(reader.header().kind, "sensitivity");
    const SensitivityTable table = sensitivity_table(reader.table("sensitivity"));
    ASSERT_EQ(table.outcomes.size(), 4U);
    ASSERT_EQ(table.factors.size(), 7U);
    EXPECT_EQ(table.factors.back(), rest_name);
    ASSERT_EQ(table.rows, 300U);

    DesignValues collapse{300, 6, 2, {}}, peak{300, 6, 2, {}};
    for (const ResultRow& row : reader.rows()) {
        const bool fell = row.outcome.state == State::collapsed;
        collapse.value.push_back(fell ? 1 : 0);
        peak.value.push_back(fell ? 0.048 : std::min(row.outcome.peak_top_displacement_m, 0.048));
    }
    for (const auto& [outcome, design] : {std::pair{std::size_t{0}, &collapse}, {std::size_t{2}, &peak}}) {
        const SobolIndices again = possible_shares(sobol_indices(*design, {.seed = 1}));
        EXPECT_EQ(table.mean.value[outcome], again.mean.value);
        for (std::size_t k = 0; k < 6; ++k) {
            const std::size_t i = outcome * 7 + k;
            EXPECT_TRUE(same(table.find("first")->of.value[i], again.of_mean[k].first.value));
            EXPECT_TRUE(same(table.find("total")->of.upper[i], again.of_mean[k].total.upper));
            EXPECT_TRUE(same(table.find("value_total")->of.lower[i], again.of_value[k].total.lower));
            const JsonValue& told = found["outcomes"][table.outcomes[outcome]]["factors"][table.factors[k]];
            const JsonValue& first = told["value_first"]["value"];
            if (std::isnan(again.of_value[k].first.value))
                EXPECT_EQ(first.kind, JsonValue::Kind::null);
            else
                EXPECT_EQ(first.number, again.of_value[k].first.value);
        }
        EXPECT_TRUE(same(table.find("value_total")->of.value[outcome * 7 + 6], again.of_value[6].total.value));
        EXPECT_TRUE(std::isnan(table.find("total")->of.value[outcome * 7 + 6]));
    }

    ASSERT_EQ(run({"export", "factors.h5", "--to", "csv", "--quiet"}).status, 0);
    EXPECT_EQ(count_of(bytes("factors_csv/sensitivity.csv"), "\n"), 1U + 4 * (2 + 4 * 7));
    ASSERT_EQ(run({"export", "factors.h5", "--to", "png", "--quiet"}).status, 0);
    EXPECT_GT(fs::file_size(folder / "factors_sensitivity.png"), 20000U);
    ASSERT_EQ(run({"report", "factors.h5", "--quiet"}).status, 0);
    EXPECT_NE(bytes("factors.html").find("Sensitivity to the factors"), std::string::npos);
    const Ended replayed = run({"replay", "factors.h5", "--realization", "1234", "--json"});
    EXPECT_EQ(replayed.status, 0) << testing::PrintToString(replayed);
}

TEST_F(Sensitivity, ScreeningByMorris)
{
    const Ended ended = study(with(quick, {"sensitivity.method=morris"}), "screening.h5");
    const JsonValue factors = json_of(ended)["sensitivity"]["outcomes"]["peak_displacement"]["factors"];
    EXPECT_TRUE(factors["phase"]["sigma"]["value"].kind == JsonValue::Kind::number);
    EXPECT_TRUE(factors["friction"]["sigma"]["value"].kind == JsonValue::Kind::null) << "of each joint one";
    for (const auto& [name, factor] : factors.members) {
        EXPECT_GE(factor["mu_star"]["value"].number, factor["mu_star"]["lower"].number) << name;
        EXPECT_LE(factor["mu_star"]["value"].number, factor["mu_star"]["upper"].number) << name;
    }
    ASSERT_EQ(run({"export", "screening.h5", "--to", "png", "--quiet"}).status, 0);
}

/// A perturbation without effect is named, and so is an outcome that does not vary: no index without data.
TEST_F(Sensitivity, SaysWhatHasNoEffect)
{
    const std::vector<std::string> calm =
        with(quick, {"excitation.pga_m_s2=0.001", "sensitivity.samples=20", "outcome.collapse.height_fraction=0.6"});
    const JsonValue found = json_of(study(calm, "calm.h5"))["sensitivity"];
    std::string remarks;
    for (const JsonValue& remark : found["remarks"].items)
        remarks += remark.text + "\n";
    EXPECT_NE(remarks.find("collapse: its mean's variance is not significantly different from zero"), std::string::npos)
        << remarks;
    EXPECT_TRUE(found["outcomes"]["collapse"]["factors"]["tilt"]["total"]["value"].kind == JsonValue::Kind::null);

    // friction that no force comes near
    const JsonValue stuck =
        json_of(study(with(calm, {"contact.friction=9", "study.allow=[\"friction\"]",
                                  "perturbation.friction={distribution=\"uniform\",from=8.0,to=10.0,per=\"joint\"}"}),
                      "stuck.h5"))["sensitivity"];
    remarks.clear();
    for (const JsonValue& remark : stuck["remarks"].items)
        remarks += remark.text + "\n";
    EXPECT_NE(remarks.find("friction has no effect"), std::string::npos) << remarks;
}

TEST_F(Sensitivity, RefusesWhatCannotBeAnswered)
{
    const auto refused = [&](const std::vector<std::string>& settings, const Words& parts) {
        expect_refused(run_words(sensitivity_study, settings, {"-o", "x.h5"}), parts);
    };
    refused({"sensitivity.factors=[\"fricton\"]"}, {"sensitivity.factors", "'fricton'", "Did you mean 'friction'?"});
    refused({"sensitivity.factors=[\"tilt\", \"tilt\"]"}, {"sensitivity.factors", "'tilt' twice"});
    refused({"sensitivity.factors=[]"}, {"sensitivity.factors", "list of names"});
    refused({"sensitivity.factors=[3]"}, {"sensitivity.factors", "3"});
    refused({"sensitivity.inner=1"}, {"sensitivity.inner", "Give 2 or more"});
    refused({"sensitivity.samples=1"}, {"sensitivity.samples", "[2, "});
    refused({"sensitivity.method=fast"}, {"sensitivity.method", "sobol"});
    refused({"study.realizations=5"}, {"study.realizations", "sensitivity.samples"});
    refused({"sensitivity.second=true"}, {"sensitivity.second"});
    refused({"study.kind=single"}, {"sensitivity", "is not used by study.kind = \"single\""});
    refused({"sensitivity.factors=[\"friction\", \"normal_stiffness\", \"damping_ratio\", \"drum_width\", "
             "\"drum_height\", \"drum_offset\", \"density\", \"tilt\", \"phase\"]"},
            {"sensitivity.inner", "the same realizations again"});
    ASSERT_EQ(run(run_words(column_study, eight_realizations, {"-o", "surface.h5", "--quiet"})).status, 0);
    expect_refused({"export", "surface.h5", "--to", "png", "--picture", "sensitivity"},
                   {"surface.h5", "--picture sensitivity", "has the pictures surface, slice", "a sensitivity study"});
}

} // namespace
} // namespace stylobate
