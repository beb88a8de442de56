/// Fragility functions in NRML, JSON and CSV: what is written comes back, OpenQuake's numbers, the schema, models
/// that are refused.

#include "ensemble/model/input_error.hpp"
#include "io/tables/fragility_exchange.hpp"
#include "tests/io/tables/nrml_reader.hpp"
#include "tests/program/json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace stylobate;
namespace fs = std::filesystem;

namespace {

constexpr double gravity = 9.80665; ///< m/s2: PGA and SA are in g in NRML

FragilityModel model()
{
    FragilityModel model;
    model.id = "two columns";
    model.description = "A <test> & its \"intervals\"";
    model.limit_states = {"rocking", "drum_lost", "collapse"};
    FragilityFunction curve{.id = "column/7", .measure = "PGA", .least = 0.5, .most = 12, .note = "fits -- well"};
    for (const double median : {1.7, 4.1, 6.3})
        curve.states.push_back({.median = {median, median * 0.9, median * 1.1}, .dispersion = {0.4, 0.31, 0.55}});
    FragilityFunction steps{.id = "column, cut", .measure = "SA(0.3)", .discrete = true, .intensity = {1, 2.5, 7}};
    for (const double most : {1.0, 0.8, 0.1})
        steps.states.push_back({.probability = {{0, 0, 0.1}, {most / 3, 0, most}, {most, 0, 1}}});
    model.functions = {curve, steps};
    return model;
}

/// A file that is gone at the end of the test.
class TextFile {
public:
    explicit TextFile(const std::string& text) : path_(fs::path(testing::TempDir()) / "fragility_exchange.xml")
    {
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TextFile() { fs::remove(path_); }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace

TEST(FragilityExchange, NrmlRoundTrip)
{
    const FragilityModel written = model();
    const NrmlModel read = read_nrml(fragility_nrml(written));
    EXPECT_EQ(read.id, written.id);
    EXPECT_EQ(read.description, written.description);
    EXPECT_EQ(read.limit_states, written.limit_states);
    ASSERT_EQ(read.functions.size(), 2U);
    const NrmlFunction &curve = read.functions[0], &steps = read.functions[1];
    EXPECT_EQ(curve.id, "column/7");
    EXPECT_EQ(curve.format, "continuous");
    EXPECT_EQ(curve.shape, "logncdf");
    EXPECT_EQ(curve.measure, "PGA");
    EXPECT_NEAR(curve.least * gravity, 0.5, 1e-14);
    EXPECT_NEAR(curve.most * gravity, 12, 1e-13);
    EXPECT_EQ(steps.id, "column, cut");
    EXPECT_EQ(steps.format, "discrete");
    EXPECT_EQ(steps.measure, "SA(0.3)");
    ASSERT_EQ(steps.intensity.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(steps.intensity[i] * gravity, written.functions[1].intensity[i], 1e-14);
    ASSERT_EQ(curve.states.size(), 3U);
    ASSERT_EQ(steps.states.size(), 3U);
    for (std::size_t s = 0; s < 3; ++s) {
        EXPECT_EQ(curve.states[s].name, written.limit_states[s]);
        EXPECT_EQ(steps.states[s].name, written.limit_states[s]);
        // openquake.risklib.scientific: sigma = sqrt(ln(1 + (stddev/mean)^2)), scale = mean^2 / sqrt(stddev^2 + mean^2)
        const double mean = curve.states[s].mean, stddev = curve.states[s].stddev;
        EXPECT_NEAR(std::sqrt(std::log(1 + stddev * stddev / (mean * mean))), 0.4, 1e-12);
        EXPECT_NEAR(mean * mean / std::sqrt(stddev * stddev + mean * mean) * gravity,
                    written.functions[0].states[s].median.value, 1e-12);
        ASSERT_EQ(steps.states[s].probability.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(steps.states[s].probability[i], written.functions[1].states[s].probability[i].value);
    }
}

/// One SI unit of each measure as an intensity, in the unit of OpenQuake's hazard library.
TEST(FragilityExchange, MeasuresAreInOpenQuakesUnits)
{
    const struct {
        const char *measure, *unit;
        double value; ///< of one SI unit
    } measures[] = {{"PGA", "g", 1 / 9.80665}, {"SA(1.0)", "g", 1 / 9.80665}, {"PGV", "cm/s", 100}, {"PGD", "cm", 100},
                    {"IA", "m/s", 1},          {"CAV", "g s", 0.101971621}};
    for (const auto& [measure, unit, value] : measures) {
        FragilityModel one = model();
        one.functions.erase(one.functions.begin());
        one.functions[0].measure = measure;
        const std::string text = fragility_nrml(one);
        EXPECT_NE(text.find(std::string("intensities in ") + unit + " "), std::string::npos) << text;
        EXPECT_NEAR(read_nrml(text).functions.at(0).intensity.at(0), value, 1e-8) << measure;
    }
}

TEST(FragilityExchange, NrmlKeepsTheSchemaAndTheIntervals)
{
    const std::string text = fragility_nrml(model());
    EXPECT_NE(text.find("dispersion 0.4 (0.31 to 0.55)"), std::string::npos) << text;
    if (std::system("xmllint --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
    const TextFile file(text);
    const std::string check = "xmllint --noout --schema '" STYLOBATE_SOURCE_DIR
                              "/tests/io/tables/nrml_fragility.xsd' '" +
                              file.path().string() + "'";
    EXPECT_EQ(std::system((check + " 2>/dev/null").c_str()), 0) << text;
    const TextFile wrong(replaced(text, "assetCategory", "category"));
    EXPECT_NE(std::system((check + " 2>/dev/null").c_str()), 0) << "the schema must be able to refuse";
}

TEST(FragilityExchange, JsonRoundTrip)
{
    FragilityModel written = model();
    written.functions[0].states[2].dispersion.upper = std::numeric_limits<double>::infinity();
    const JsonValue json = JsonParser::parse(fragility_json(written));
    EXPECT_EQ(json["id"].text, written.id);
    EXPECT_EQ(json["description"].text, written.description);
    EXPECT_EQ(json["level"].number, 0.95);
    EXPECT_EQ(json["limit_states"].items[1].text, "drum_lost");
    const JsonValue& curve = json["functions"].items[0];
    EXPECT_EQ(curve["note"].text, "fits -- well");
    EXPECT_EQ(curve["least"].number, 0.5);
    for (std::size_t s = 0; s < 3; ++s) {
        const JsonValue& state = curve["states"].items[s];
        const FragilityState& want = written.functions[0].states[s];
        EXPECT_EQ(state["median"].number, want.median.value);
        EXPECT_EQ(state["median_lower"].number, want.median.lower);
        EXPECT_EQ(state["dispersion_lower"].number, want.dispersion.lower);
    }
    EXPECT_EQ(curve["states"].items[2]["dispersion_upper"].kind, JsonValue::Kind::null);
    const JsonValue& steps = json["functions"].items[1];
    EXPECT_EQ(steps["intensity"].items[1].number, 2.5);
    EXPECT_EQ(steps["states"].items[1]["probability"].items[1].number, 0.8 / 3);
    EXPECT_EQ(steps["states"].items[1]["upper"].items[1].number, 0.8);
}

TEST(FragilityExchange, CsvHasEveryNumberAndItsInterval)
{
    std::istringstream lines(fragility_csv(model()));
    std::string line;
    std::vector<std::string> all;
    while (std::getline(lines, line))
        all.push_back(line);
    ASSERT_EQ(all.size(), 1U + 3 + 9);
    EXPECT_EQ(all[2], "column/7,PGA,drum_lost,,,,,4.1,3.69,4.51,0.4,0.31,0.55");
    EXPECT_EQ(all[6], "\"column, cut\",SA(0.3),rocking,7,1,0,1,,,,,,");
    for (const std::string& each : all)
        EXPECT_EQ(std::count(each.begin(), each.end(), ','),
                  std::count(all[0].begin(), all[0].end(), ',') + (each.starts_with('"') ? 1 : 0));
}

TEST(FragilityExchange, RefusesModelsThatOthersCannotUse)
{
    const auto refused = [](auto change) {
        FragilityModel changed = model();
        change(changed);
        try {
            fragility_nrml(changed);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("written");
    };
    EXPECT_NE(
        refused([](auto& m) { std::swap(m.functions[0].states[0], m.functions[0].states[2]); }).find("wrong order"),
        std::string::npos);
    EXPECT_NE(
        refused([](auto& m) { std::swap(m.functions[1].states[0], m.functions[1].states[2]); }).find("wrong order"),
        std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[0].measure = "ABC"; }).find("'ABC'"), std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[0].measure = "SA(x)"; }).find("'SA(x)'"), std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.limit_states[1] = "drum lost"; }).find("blank"), std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[0].states[1].median.value = std::nan(""); }).find("discrete"),
              std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[0].states[1].median.lower = 5; }).find("interval"), std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[0].states.pop_back(); }).find("limit states"), std::string::npos);
    EXPECT_NE(refused([](auto& m) { m.functions[1].intensity[1] = 9; }).find("ascending"), std::string::npos);
}
