/// The shaking of a study in space: what is read, written and refused.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::test_study_shaking_in_space {
namespace {

const std::string in_space = R"([structure]
dimensions = 3
blocks = 6
drum_width_m = 1.0
drum_height_m = 1.0
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m3 = 3e9
friction = 0.7
)";
const std::string in_plane = R"([structure]
blocks = 6
drum_width_m = 1.0
drum_height_m = 1.0
depth_m = 1.0
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m2 = 3e9
friction = 0.7
)";

/// A study with [excitation] in line 3.
std::string single(const std::string& excitation, const std::string& structure = in_space)
{
    return "[study]\nkind = \"single\"\n[excitation]\n" + excitation + "\n" + structure;
}
const std::string noise = "kind = \"noise\"\nfrequency_hz = 2\npga_m_s2 = 3\n";
const std::string noise_of_2_hz = "kind = \"noise\"\nfrequency_hz = 2\n";
const std::string harmonic = "kind = \"harmonic\"\nfrequency_hz = 2\npga_m_s2 = 3\n";
const std::string record = "kind = \"record\"\nfile = \"A000.AT2\"\n";

Study read(const std::string& excitation, const std::string& more = "")
{
    return parse_study(single(excitation) + more, "temple.toml");
}

void expect_refused(const std::string& text, int line, const std::vector<std::string>& words)
{
    try {
        parse_study(text, "temple.toml");
        ADD_FAILURE() << "accepted; expected a refusal in line " << line << "\n" << text;
    } catch (const InputError& error) {
        const std::string message = error.what(), place = "temple.toml:" + std::to_string(line) + ": ";
        EXPECT_EQ(message.substr(0, place.size()), place) << message;
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in:\n" << message;
    }
}

/// The canonical text is read as the same study.
void expect_same_again(const Study& study)
{
    const Study again = parse_study(study.text, "again.toml");
    EXPECT_EQ(again.text, study.text);
    EXPECT_TRUE(again.excitation == study.excitation) << study.text;
    ASSERT_EQ(again.vertical.has_value(), study.vertical.has_value());
    EXPECT_TRUE(!study.vertical || again.vertical->file == study.vertical->file);
}

TEST(ShakingInSpace, ReadsDirectionAndComponents)
{
    const Study plain = read(noise);
    EXPECT_EQ(plain.excitation.direction_deg, 0);
    EXPECT_FALSE(plain.excitation.has_second());
    EXPECT_EQ(plain.excitation.vertical_ratio, 0);
    expect_same_again(plain);
    EXPECT_EQ(plain.text.find("second_correlation"), std::string::npos) << "not used without a second component";

    const Study pair = read(noise + "direction_deg = 30.1\nsecond_ratio = 0.8\nsecond_correlation = -0.2\n"
                                    "vertical_ratio = 0.5\npga_of_pair = \"at_once\"");
    EXPECT_EQ(pair.excitation.direction_deg, 30.1);
    EXPECT_EQ(pair.excitation.second_ratio, 0.8);
    EXPECT_EQ(pair.excitation.second_correlation, -0.2);
    EXPECT_EQ(pair.excitation.vertical_ratio, 0.5);
    EXPECT_EQ(pair.excitation.pga_of_pair, OfPair::at_once);
    EXPECT_NE(pair.text.find("direction_deg = 30.1\n"), std::string::npos) << pair.text;
    expect_same_again(pair);

    const Study turning = read(harmonic + "second_ratio = 1");
    EXPECT_EQ(turning.excitation.second_phase_deg, 90);
    EXPECT_EQ(turning.excitation.pga_of_pair, OfPair::first);
    expect_same_again(turning);
    for (const OfPair definition : {OfPair::first, OfPair::larger, OfPair::geometric_mean, OfPair::at_once}) {
        const char* words[] = {"first", "larger", "geometric_mean", "at_once"};
        const Study study =
            read(harmonic + "second_ratio = 1\npga_of_pair = \"" + words[static_cast<int>(definition)] + "\"");
        EXPECT_EQ(study.excitation.pga_of_pair, definition);
        expect_same_again(study);
    }
}

TEST(ShakingInSpace, ReadsComponentsOfRecords)
{
    const Study found = read(record + "second = {}\nvertical = {}");
    ASSERT_TRUE(found.excitation.second);
    EXPECT_FALSE(found.excitation.second->file);
    ASSERT_TRUE(found.vertical);
    EXPECT_NE(found.text.find("second = {}\n"), std::string::npos) << found.text;
    expect_same_again(found);

    const Study named = read(record + "baseline = false\n"
                                      "second = { file = \"B.AT2\", component = \"2\", unit = \"gal\" }\n"
                                      "vertical = { component = \"up\" }");
    EXPECT_EQ(named.excitation.second->file, "B.AT2");
    EXPECT_EQ(named.excitation.second->component, "2");
    EXPECT_EQ(named.excitation.second->unit, "cm/s2");
    EXPECT_EQ(named.vertical->component, "up");
    EXPECT_FALSE(named.vertical->baseline) << "one correction for all components";
    expect_same_again(named);

    EXPECT_EQ(read(record + "vertical_ratio = 0.4").excitation.vertical_ratio, 0.4);
}

TEST(ShakingInSpace, ADirectionIsDrawnInDegrees)
{
    const Study drawn = read(noise, "[perturbation]\ndirection = { distribution = \"uniform\" }\n");
    ASSERT_EQ(drawn.perturbations.size(), 1U);
    EXPECT_EQ(drawn.perturbations[0].quantity, Quantity::direction);
    EXPECT_EQ(drawn.perturbations[0].from, 0);
    EXPECT_EQ(drawn.perturbations[0].to, 360);
    expect_same_again(drawn);
    const Study about =
        read(noise + "direction_deg = 20", "[perturbation]\ndirection = { distribution = \"normal\", sd_deg = 15 }\n");
    EXPECT_EQ(about.perturbations[0].sd, 15);
    expect_refused(single(noise + "direction_deg = 20") +
                       "[perturbation]\ndirection = { distribution = \"uniform\" }\n",
                   7, {"excitation.direction_deg", "give it twice"});
}

/// A surface with its axes from line 7.
std::string surface(const std::string& axes, const std::string& excitation = noise_of_2_hz,
                    const std::string& structure = in_space)
{
    return "[study]\nkind = \"surface\"\nrealizations = 2\n[surface]\npga_m_s2 = { from = 1, to = 3, count = 3 }\n" +
           axes + "\n[excitation]\n" + excitation + structure;
}
const std::string directions = "direction_deg = { from = -45, to = 90, count = 4 }";
const std::string frequencies = "frequency_hz = { from = 1, to = 2, count = 2 }";

TEST(ShakingInSpace, ReadsDirectionsAsRowsOfASurface)
{
    const Study study = parse_study(surface(directions), "temple.toml");
    ASSERT_TRUE(study.surface->direction_deg);
    EXPECT_EQ(study.surface->cells(), 12);
    EXPECT_EQ(study.surface->rows().value(1), 0);
    EXPECT_EQ(study.excitation.frequency_hz, 2);
    const StudyDesign design = study.design();
    EXPECT_EQ(design.cells, 12U);
    EXPECT_EQ(design.columns, 3U);
    EXPECT_EQ(design.frequency_hz, nullptr);
    ASSERT_NE(design.direction_deg, nullptr);
    EXPECT_NE(study.text.find("[surface]\ndirection_deg = {"), std::string::npos) << study.text;
    EXPECT_EQ(study.text.find("\ndirection_deg = 0"), std::string::npos) << study.text;
    expect_same_again(study);
    EXPECT_EQ(parse_study(study.text, "again.toml").design().direction_deg->to, 90);
    // the frequency stays that of [excitation] in all rows, and may be drawn
    const Study pulses = parse_study(surface(directions, "kind = \"pulse\"\nfrequency_hz = 1\n") +
                                         "[perturbation]\npulse_frequency = { distribution = \"normal\", cov = 0.1 }\n",
                                     "temple.toml");
    EXPECT_EQ(pulses.perturbations.size(), 1U);
    EXPECT_FALSE(parse_study(surface(frequencies, "kind = \"noise\"\n"), "temple.toml").surface->direction_deg);
}

TEST(ShakingInSpace, RefusesDirectionsThatARowCannotHave)
{
    expect_refused(surface(directions, noise_of_2_hz, in_plane), 6,
                   {"surface.direction_deg", "is not used by structure.dimensions = 2", "structure.dimensions = 3"});
    expect_refused(surface(directions + "\n" + frequencies), 6,
                   {"direction_deg", "frequency_hz", "exclude each other"});
    expect_refused(surface("direction_deg = { from = 0, to = 400, count = 2 }"), 6,
                   {"surface.direction_deg.to", "[-360, 360]"});
    expect_refused(surface("direction_deg = { from = 0, to = 90, count = 2, spacing = \"log\" }"), 6,
                   {"surface.direction_deg.spacing", "linear"});
    expect_refused(surface(directions, "kind = \"noise\"\n"), 7, {"excitation.frequency_hz is missing"});
    expect_refused(surface(directions, noise_of_2_hz + "direction_deg = 10\n"), 10,
                   {"excitation.direction_deg", "a study with surface.direction_deg", "[surface]"});
    expect_refused(surface(directions, noise_of_2_hz + "pga_m_s2 = 10\n"), 10, {"excitation.pga_m_s2", "[surface]"});
    expect_refused(surface(frequencies), 9, {"excitation.frequency_hz", "a study with surface.frequency_hz"});
    expect_refused(surface(directions) + "[perturbation]\ndirection = { distribution = \"uniform\" }\n", 20,
                   {"perturbation.direction", "a study with surface.direction_deg"});
}

TEST(ShakingInSpace, TheTextDiffersWhereverTheShakingDoes)
{
    const auto up = [](double& x) { x = std::nextafter(x, 1e300); };
    const Study pair = read(noise + "second_ratio = 0.8"), turning = read(harmonic + "second_ratio = 0.8"),
                recorded = read(record + "second = {}\nvertical = {}");
    const std::vector<std::pair<Study, std::function<void(Study&)>>> changes = {
        {pair, [&](Study& s) { up(s.excitation.direction_deg); }},
        {pair, [&](Study& s) { up(s.excitation.second_ratio); }},
        {pair, [&](Study& s) { up(s.excitation.second_correlation); }},
        {pair, [&](Study& s) { up(s.excitation.vertical_ratio); }},
        {pair, [](Study& s) { s.excitation.pga_of_pair = OfPair::larger; }},
        {turning, [&](Study& s) { up(s.excitation.second_phase_deg); }},
        {recorded, [](Study& s) { s.excitation.second->file = "b"; }},
        {recorded, [](Study& s) { s.excitation.second->component = "b"; }},
        {recorded, [](Study& s) { s.excitation.second->unit = "g"; }},
        {recorded, [](Study& s) { s.excitation.second.reset(); }},
        {recorded, [](Study& s) { s.vertical->file = "b"; }},
        {recorded, [](Study& s) { s.vertical->component = "b"; }},
        {recorded, [](Study& s) { s.vertical->unit = "g"; }},
        {recorded, [](Study& s) { s.vertical.reset(); }},
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Study changed = changes[i].first;
        changes[i].second(changed);
        EXPECT_NE(study_text(changed), changes[i].first.text) << "change " << i;
    }
}

TEST(ShakingInSpace, KeysWithoutMeaningAreRefused)
{
    // in the plane
    for (const char* key :
         {"direction_deg = 10", "second_ratio = 0.8", "vertical_ratio = 0.5", "second_correlation = 0"})
        expect_refused(single(noise + key, in_plane), 7,
                       {"excitation.", "is not used by structure.dimensions = 2", "structure.dimensions = 3"});
    expect_refused(single(noise, in_plane) + "[perturbation]\ndirection = { distribution = \"uniform\" }\n", 18,
                   {"perturbation.direction", "is not used by structure.dimensions = 2"});
    // the planar notion of a vertical motion in space
    expect_refused(single(noise) + "[mechanisms]\nvertical_motion = { ratio = 0.5 }\n", 18,
                   {"mechanisms.vertical_motion", "excitation.vertical_ratio"});
    // without a second component
    for (const char* key : {"second_correlation = 0.5", "pga_of_pair = \"larger\""})
        expect_refused(single(noise + key), 7, {"needs a second component", "Give excitation.second_ratio"});
    expect_refused(single(harmonic + "second_phase_deg = 45"), 7, {"needs a second component"});
    expect_refused(single(record + "pga_of_pair = \"larger\""), 6, {"needs a second component", "excitation.second,"});
    // of other motions
    expect_refused(single(harmonic + "second_correlation = 0.1\nsecond_ratio = 1"), 7,
                   {"excitation.second_correlation", "is not used by excitation.kind = \"harmonic\""});
    expect_refused(single("kind = \"ricker\"\nfrequency_hz = 2\npga_m_s2 = 3\nsecond_ratio = 1"), 7,
                   {"excitation.second_ratio", "is not used by excitation.kind = \"ricker\""});
    expect_refused(single(noise + "second = {}"), 7,
                   {"excitation.second", "is not used by excitation.kind = \"noise\""});
    expect_refused(single(record + "vertical_ratio = 0.4\nvertical = {}"), 7,
                   {"vertical", "vertical_ratio", "exclude each other"});
    // of tables
    const std::string table = "kind = \"table\"\nfile = \"base.csv\"\n";
    expect_refused(single(table + "second = {}"), 6, {"excitation.second.file is missing"});
    expect_refused(single(table + "second = { file = \"other.csv\", unit = \"g\" }"), 6,
                   {"excitation.second.unit", "is not used by excitation.kind = \"table\""});
}

} // namespace
} // namespace stylobate::test_study_shaking_in_space
