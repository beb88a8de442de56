/// The canonical text holds every key that a study uses, its defaults too. Which keys there are comes from the reader's
/// own messages, and whether a study uses one from whether the reader takes it: a key that somebody adds and forgets in
/// the text is found by itself.

#include "ensemble/model/input_error.hpp"
#include "io/files/toml_document.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace stylobate {
namespace {

namespace fs = std::filesystem;
const fs::path root = STYLOBATE_SOURCE_DIR;

/// Keys without a default: what is not given is not there.
const std::set<std::string> without_default = {
    "study.title",          // none
    "structure.dimensions", // of the plane: texts are as before there was space
    "initial.lift_m",       // 0: texts are as before a block could be dropped
    // of a file: the only component, the unit that it states, as strong as it stands, not filtered
    "excitation.component", "excitation.run", "excitation.unit", "excitation.scale_to_pga_m_s2",
    "excitation.band_pass_hz",
    "structure.capital",                                       // none
    "structure.epistyles",                                     // written where there are any columns
    "surface.adaptive",                                        // as many realizations in each cell
    "fragility.folder", "fragility.pattern", "fragility.unit", // become fragility.records
    "fragility.intensity.period_s",                            // of "sa"
    "fragility.pause_s", "survival.pause_s",                   // until the structure rests, as long as each takes
    // whole tables, whose every entry is what the study says
    "study.allow"};

/// Other ways to write what the text has, as the sizes of equal drums.
const std::set<std::string> other_ways = {"structure.drums",
                                          "structure.blocks",
                                          "structure.drum_width_m",
                                          "structure.drum_height_m",
                                          "structure.drum_mass_kg",
                                          "structure.density_kg_m3",
                                          "structure.top_width_m",
                                          "structure.fixed_blocks",
                                          "structure.columns",
                                          "structure.column_spacing_m",
                                          "structure.epistyle_height_m",
                                          "structure.epistyle_mass_kg",
                                          "structure.epistyle_density_kg_m3",
                                          "structure.epistyle_bays",
                                          "structure.epistyle_length_m",
                                          "structure.column_list",
                                          "structure.shape",
                                          "structure.drum_depth_m",
                                          "structure.bed_inner_ratio",
                                          "structure.epistyle_width_m",
                                          "structure.epistyle_abreast"};

/// What the study says of a text with one setting more; empty if it is taken.
std::string message(const std::string& text, const std::string& setting)
{
    try {
        parse_study(text, "text.toml", {setting});
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// The words after "Known keys of X: " and the like, up to the full stop.
std::vector<std::string> listed(const std::string& message, const std::string& after)
{
    std::vector<std::string> words;
    const std::size_t at = message.find(after);
    if (at == std::string::npos)
        return words;
    const std::string list =
        message.substr(at + after.size(), message.find('.', at + after.size()) - at - after.size());
    static const std::regex word("[a-z0-9_]+");
    for (std::sregex_iterator i(list.begin(), list.end(), word), end; i != end; ++i)
        words.push_back(i->str());
    return words;
}

constexpr const char* no_key = "zzzzqqqq";

std::vector<std::string> sections(const std::string& text)
{
    return listed(message(text, std::string(no_key) + "=1"), "Known sections: ");
}

/// The keys that a table may have.
std::vector<std::string> keys_of(const std::string& text, const std::string& table)
{
    return listed(message(text, table + "." + no_key + "=1"), "Known keys of " + table + ": ");
}

bool has(const TomlValue& tree, const std::string& path)
{
    const TomlValue* at = &tree;
    for (std::size_t from = 0; at != nullptr && from <= path.size();) {
        const std::size_t dot = std::min(path.find('.', from), path.size());
        at = at->find(path.substr(from, dot - from));
        from = dot + 1;
    }
    return at != nullptr;
}

/// Whether a study takes a value of the key: of all sorts, and of the words that the refusals name.
bool takes(const std::string& text, const std::string& path)
{
    std::vector<std::string> values = {"1",    "0",     "0.5", "0.01", "2",     "10",       "100",       "1e6",
                                       "true", "\"x\"", "[]",  "[1]",  "[0.1]", "[0.1, 9]", "[\"pga\"]", "{}"};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string said = message(text, path + "=" + values[i]);
        if (said.empty())
            return true;
        if (values[i] == "\"x\"")
            for (const std::string& word : listed(said, "Allowed: "))
                values.push_back("\"" + word + "\"");
    }
    return false;
}

/// Tables whose keys have defaults; the others are lists of what the study says.
const std::vector<std::string> tables = {"study",
                                         "structure",
                                         "contact",
                                         "excitation",
                                         "surface",
                                         "twins",
                                         "fragility",
                                         "sensitivity",
                                         "rare",
                                         "survival",
                                         "initial",
                                         "output",
                                         "outcome",
                                         "run",
                                         "surface.adaptive",
                                         "surface.frequency_hz",
                                         "surface.pga_m_s2",
                                         "fragility.intensity",
                                         "survival.observed",
                                         "survival.hazard",
                                         "outcome.collapse"};

void expect_every_default(const Study& study, const std::string& name)
{
    const TomlValue tree = parse_toml(study.text, name);
    for (const std::string& table : tables) {
        if (!has(tree, table))
            continue;
        const std::vector<std::string> keys = keys_of(study.text, table);
        EXPECT_FALSE(keys.empty()) << name << ": " << table;
        for (const std::string& key : keys) {
            const std::string path = table + "." + key;
            if (study.structure.spatial() && path == "contact.damping")
                continue; // in space its default is no word: spread over the contact
            if (!has(tree, path) && !without_default.contains(path) && !other_ways.contains(path)) {
                EXPECT_FALSE(takes(study.text, path))
                    << name << ": the study uses " << path << ", and its canonical text lacks it:\n"
                    << study.text;
            }
        }
    }
    EXPECT_EQ(parse_study(study.text, name).text, study.text) << name;
}

TEST(StudyDefaults, EverySectionIsKnownHere)
{
    const Study study = read_study(root / "studies/inputs/free_rocking.toml");
    std::vector<std::string> known = sections(study.text);
    EXPECT_GE(known.size(), 14U);
    for (const std::string& section : known)
        if (section != "perturbation" && section != "mechanisms" && section != "claim" && section != "variants" &&
            section != "optimise") { // lists of what is said
            EXPECT_NE(std::find(tables.begin(), tables.end(), section), tables.end()) << section;
        }
}

TEST(StudyDefaults, TheTextOfEachReadyStudyHasThemAll)
{
    std::set<StudyKind> kinds;
    for (const auto& entry : fs::directory_iterator(root / "studies/inputs")) {
        if (entry.path().extension() != ".toml")
            continue;
        std::vector<std::string> settings;
        if (entry.path().filename() == "record.toml") // that the user names
            settings = {"excitation.file=a.txt"};
        const Study study = read_study(entry.path(), settings);
        kinds.insert(study.kind);
        expect_every_default(study, entry.path().filename());
    }
    EXPECT_EQ(kinds.size(), study_kind_names.size()) << "every kind of study";
}

TEST(StudyDefaults, TheTextOfEachExcitationHasThemAll)
{
    const std::string motion = "frequency_hz = 1.7\npga_m_s2 = 3.3\n";
    const std::map<std::string, std::string> excitations = {
        {"harmonic", motion},
        {"half_sine", motion},
        {"full_sine", motion},
        {"ricker", motion},
        {"pulse", motion},
        {"tapered", motion},
        {"noise", motion},
        {"none", "duration_s = 1\n"},
        {"record", "file = \"a\"\n"},
        {"table", "file = \"a\"\n"},
        {"sweep", "from_hz = 0.3\nto_hz = 7.7\nduration_s = 41.3\npga_m_s2 = 3.3\n"}};
    for (const auto& [kind, keys] : excitations)
        expect_every_default(parse_study("[study]\nkind = \"single\"\n[structure]\nblocks = 3\ndrum_width_m = 1\n"
                                         "drum_height_m = 1\ndepth_m = 1\ndrum_mass_kg = 2700\n[contact]\n"
                                         "normal_stiffness_n_m2 = 3e9\nfriction = 0.7\n[excitation]\nkind = \"" +
                                             kind + "\"\n" + keys,
                                         kind + ".toml"),
                             kind);
}

TEST(StudyDefaults, TheValuesThatWereMissing)
{
    const Study study = read_study(root / "studies/inputs/small_scale_column.toml");
    // 12 / p: p = sqrt(3 g / (4 R)) of six drums of 48 x 29 mm, R = hypot(24, 87) mm: 9.029056 rad/s
    EXPECT_NE(
        study.text.find("tail_s = \"structure\" # 12 / p of each realization; of the structure as given 1.329 s\n"),
        std::string::npos)
        << study.text;
    for (const char* line : {"\nstep_bound = \"block\"\n", "\nrealizations = \"all\"\n", "\nprecision = \"double\"\n"})
        EXPECT_NE(study.text.find(line), std::string::npos) << line << study.text;
    EXPECT_FALSE(parse_study(study.text, "again").excitation.tail_s) << "each realization has its own still";
}

/// Where residual displacements are counted, a realization is followed until it lies still.
TEST(StudyDefaults, TailsLastUntilRestWhereResidualsAreCounted)
{
    const auto column = [](const std::vector<std::string>& settings) {
        return read_study(root / "studies/inputs/fragility_column.toml", settings);
    };
    const Study study = column({});
    EXPECT_EQ(study.excitation.tail, Tail::rest);
    // 240 / p of six drums of 1 x 0.8 m: R = hypot(0.5, 2.4) m, p = 1.7325 rad/s
    EXPECT_NE(study.text.find("tail_s = \"rest\" # until it lies still, at most 240 / p of each realization; of the "
                              "structure as given 138.5 s\n"),
              std::string::npos)
        << study.text;
    EXPECT_EQ(parse_study(study.text, "again").excitation.tail, Tail::rest);
    EXPECT_EQ(column({"excitation.tail_s=\"structure\""}).excitation.tail, Tail::structure);
    EXPECT_EQ(column({"excitation.tail_s=3"}).excitation.tail_s, 3);
    EXPECT_EQ(read_study(root / "studies/inputs/sensitivity_column.toml").excitation.tail, Tail::rest);
    for (const char* name : {"small_scale_column", "mechanisms", "rare_collapse"})
        EXPECT_EQ(read_study(root / "studies/inputs" / (std::string(name) + ".toml")).excitation.tail, Tail::structure);
}

TEST(StudyDefaults, TheRateOfTrajectoriesFollowsTheStructureAndItsShaking)
{
    const std::string marble = "[study]\nkind = \"single\"\n[structure]\nblocks = 3\ndrum_width_m = 1\n"
                               "drum_height_m = 1\ndepth_m = 1\ndrum_mass_kg = 2700\n[contact]\n"
                               "normal_stiffness_n_m2 = 3e9\nfriction = 0.7\n";
    const auto rate = [&](const std::string& excitation, const std::vector<std::string>& settings = {}) {
        return parse_study(marble + "[excitation]\n" + excitation, "marble.toml", settings).output.trajectory_rate_hz;
    };
    const std::string sine = "kind = \"harmonic\"\npga_m_s2 = 1\nfrequency_hz = ";
    EXPECT_EQ(rate(sine + "2"), 100); // p = 3.2255 rad/s: 51.3 a second, and 40 of the sine
    EXPECT_EQ(rate(sine + "8.2"), 170) << "20 in a period, up to whole tens";
    EXPECT_EQ(rate(sine + "2", {"output.trajectory_rate_hz=1234"}), 1234);
    EXPECT_EQ(rate(sine + "2",
                   {"structure.drum_height_m=1e-9", "structure.drum_width_m=1e-9", "structure.drum_mass_kg=1e-15"}),
              1e6)
        << "the largest allowed";
    // drums of 48 x 29 mm: R = 28.04 mm, p = 16.198 rad/s: 257.8 a second; a block of 48 x 174 mm: 143.7
    EXPECT_EQ(read_study(root / "studies/inputs/mechanisms.toml").output.trajectory_rate_hz, 260);
    EXPECT_EQ(read_study(root / "studies/inputs/small_scale_monolith.toml").output.trajectory_rate_hz, 200)
        << "of 10 Hz on its axis";
}

} // namespace
} // namespace stylobate
