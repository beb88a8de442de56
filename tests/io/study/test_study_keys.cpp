/// The description of every key of the study file is that of the reader: its type and words are tried on the reader
/// itself, and so are the ranges and defaults that docs/study_reference.md states.

#include "ensemble/model/input_error.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_tables.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::test_study_keys {
namespace {

const std::string drums = "[structure]\nblocks = 3\ndrum_width_m = 1\ndrum_height_m = 1\ndepth_m = 1\n"
                          "density_kg_m3 = 2700\n";
const std::string colonnade =
    "[structure]\nkind = \"colonnade\"\ndepth_m = 1\ndensity_kg_m3 = 2700\ncolumns = 2\ncolumn_spacing_m = 3\n"
    "blocks = 2\ndrum_width_m = 1\ndrum_height_m = 2\nepistyle_height_m = 0.5\n";
const std::string listed = "[structure]\nkind = \"colonnade\"\ndepth_m = 1\ndensity_kg_m3 = 2700\n"
                           "column_list = [ { x_m = 0, drums = [ { width_m = 1, height_m = 2 } ], capital = { width_m "
                           "= 1.2, height_m = 0.3 } }, { x_m = 3, drums = [ { width_m = 1, height_m = 2 } ], capital = "
                           "{ width_m = 1.2, height_m = 0.3 } } ]\n"
                           "epistyles = [ { first_column = 0, last_column = 1, length_m = 4, height_m = 0.5 } ]\n";
/// With two epistyles side by side, as clamps need them.
const std::string bays =
    "[structure]\nkind = \"colonnade\"\ndepth_m = 1\ndensity_kg_m3 = 2700\ncolumns = 3\ncolumn_spacing_m = 3\n"
    "blocks = 2\ndrum_width_m = 1\ndrum_height_m = 2\nepistyle_height_m = 0.5\nepistyle_bays = 1\n";
const std::string contact = "[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n";

// in space
const std::string solid_drums =
    "[structure]\ndimensions = 3\nshape = \"rectangle\"\nblocks = 3\ndrum_width_m = 1\ndrum_depth_m = 1\n"
    "drum_height_m = 1\ndensity_kg_m3 = 2700\n"
    "capital = { width_m = 1.2, height_m = 0.3, shape = \"rectangle\", depth_m = 1.2, echinus_height_m = 0.1, "
    "echinus_width_m = 1.1 }\n";
const std::string solid_bays =
    "[structure]\ndimensions = 3\nkind = \"colonnade\"\ndensity_kg_m3 = 2700\ncolumns = 3\ncolumn_spacing_m = 3\n"
    "blocks = 2\ndrum_width_m = 1\ndrum_height_m = 2\ncapital = { width_m = 1.2, height_m = 0.3 }\n"
    "epistyle_height_m = 0.5\nepistyle_width_m = 1\n";
const std::string area_contact = "[contact]\nnormal_stiffness_n_m3 = 3e9\nfriction = 0.7\n";

const std::string rigid = "[contact]\nform = \"rigid\"\nfriction = 0.7\n";

std::string single(const std::string& excitation, const std::string& structure = drums,
                   const std::string& contacts = contact)
{
    return "[study]\nkind = \"single\"\n" + structure + contacts + "[excitation]\n" + excitation;
}

bool has(MechanismModels models, bool spatial)
{
    return models == MechanismModels::both || models == (spatial ? MechanismModels::spatial : MechanismModels::planar);
}

/// A mechanism with all of its parameters.
std::string whole(const MechanismRule& rule, bool spatial = false)
{
    std::string text = std::string(rule.name) + " = {";
    for (const MechanismParameter& parameter : rule.parameters)
        if (has(parameter.models, spatial))
            text += (text.ends_with('{') ? " " : ", ") + parameter.key() + " = 0.1";
    // hertz has no exponent that small, and a ratio of friction may be any
    const std::size_t exponent = text.find("exponent = 0.1");
    if (exponent != std::string::npos)
        text.replace(exponent, 14, "exponent = 1.1");
    // nor is there stone so weak
    const std::size_t strength = text.find("stone_strength_pa = 0.1");
    if (strength != std::string::npos)
        text.replace(strength, 23, "stone_strength_pa = 1e8");
    return text + " }\n";
}

std::string every_mechanism(bool spatial = false)
{
    std::string text = "[mechanisms]\n";
    for (const MechanismRule& rule : mechanism_rules())
        if (has(rule.models, spatial))
            text += whole(rule, spatial);
    return text;
}

/// A uniform distribution inside the range, and inside a block of 1 m.
std::string uniform_in(const Range& range)
{
    const double high = std::min(range.high, range.low < 0 ? 1 : range.low + 1);
    return "{ distribution = \"uniform\", from = " + toml_number(0.7 * high) + ", to = " + toml_number(0.8 * high) +
           " }";
}

const std::string harmonic = "kind = \"harmonic\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3\n";

/// Studies of which each key is used by one at least.
std::vector<std::string> samples()
{
    const std::string motion = "\"\nfrequency_hz = 1.7\npga_m_s2 = 3.3\n";
    const std::string range = " = { from = 1, to = 2, count = 2 }\n";
    const std::string axes = "[surface]\nfrequency_hz" + range + "pga_m_s2" + range;
    const std::string surface = "[study]\nkind = \"surface\"\nrealizations = 40\n" + drums + contact;
    const std::string fragility = "[study]\nkind = \"fragility\"\nrealizations = 4\n" + drums + contact;
    const std::string pulses =
        fragility + "[excitation]\nkind = \"pulse\"\nfrequency_hz = 1\n[fragility]\nmotions = 9\n";
    std::string records = "records = [";
    for (int i = 0; i < 8; ++i)
        records += "{ file = \"a" + std::to_string(i) + "\" }, ";
    std::vector<std::string> all = {
        single("kind = \"none\"\nduration_s = 1\n"),
        single(harmonic),
        single(harmonic, drums, rigid),
        single(harmonic, colonnade),
        single(harmonic, listed),
        single(harmonic,
               "[structure]\nblocks = 3\ndrum_width_m = 1\ndrum_height_m = 1\ndepth_m = 1\ndrum_mass_kg = 2700\n"),
        single(harmonic, "[structure]\ndepth_m = 1\ndensity_kg_m3 = 2700\ndrums = [ { width_m = 1, height_m = 1 } ]\n"
                         "capital = { width_m = 1.2, height_m = 0.3 }\n"),
        single("kind = \"pulse" + motion),
        single("kind = \"tapered" + motion),
        single("kind = \"noise" + motion),
        single("kind = \"record\"\nfile = \"a\"\n"),
        single("kind = \"table\"\nfile = \"a\"\n"),
        single("kind = \"sweep\"\nfrom_hz = 0.3\nto_hz = 7.7\nduration_s = 41.3\npga_m_s2 = 3.3\n"),
        single(harmonic, bays) + every_mechanism(),
        surface + "[excitation]\nkind = \"harmonic\"\n" + axes + "adaptive = { budget = 100 }\n",
        surface + "[excitation]\nkind = \"harmonic\"\n" + axes + "[twins]\n",
        "[study]\nkind = \"surface\"\nrealizations = 40\n" + solid_drums + area_contact +
            "[excitation]\nkind = \"harmonic\"\nfrequency_hz = 2\n[surface]\ndirection_deg" + range + "pga_m_s2" +
            range,
        pulses + "intensity = { measure = \"sa\", period_s = 1, from = 1, to = 2, count = 2 }\n",
        pulses + "intensity = { from = 1, to = 2, count = 2 }\n",
        fragility + "[excitation]\nkind = \"record\"\n[fragility]\nmethod = \"cloud\"\n" + records + "]\n",
        fragility + "[excitation]\nkind = \"record\"\n[fragility]\nfolder = \"" STYLOBATE_SOURCE_DIR
                    "/studies/inputs\"\n"
                    "intensity = { from = 1, to = 2, count = 2 }\n",
        "[study]\nkind = \"sensitivity\"\n" + drums + contact + "[excitation]\n" + harmonic +
            "[sensitivity]\nsamples = 10\n[perturbation]\nfriction = { distribution = \"normal\", cov = 0.01 }\n",
        "[study]\nkind = \"rare\"\n" + drums + contact + "[excitation]\n" + harmonic +
            "[rare]\n[perturbation]\nfriction = { distribution = \"normal\", cov = 0.01 }\n"};
    all.push_back(single(harmonic) + "[variants]\nNAME = { }\n[optimise]\nbudget = 100\nKEY = { from = 1, to = 2 }\n");
    const std::string survival = "[study]\nkind = \"survival\"\nrealizations = 40\n" + drums + contact +
                                 "[excitation]\nkind = \"pulse\"\n[surface]\nfrequency_hz = { from = 1, to = 2, count "
                                 "= 2 }\npga_m_s2 = { from = 1, to = 2, count = 3 }\n[survival]\n";
    all.push_back(survival +
                  "observed = { tolerance_m = 0.01 }\nstands_for_years = 100\nhazard = { k0_per_year = 0.1, k "
                  "= 2, sigma_ln = 1 }\n");
    all.push_back(survival +
                  "observed = { joints = [0, 2], joint_offset_m = [0.01, -0.02], tolerance_m = 0.01, "
                  "rotation_rad = [0, 0, 0], rotation_tolerance_rad = 0.1 }\nhazard = { intensity_m_s2 = [1, "
                  "2], rate_per_year = [0.1, 0.01], sigma_ln = 1 }\n");
    for (const std::string& structure : {solid_drums, solid_bays})
        for (const std::string& shaking :
             {"kind = \"harmonic" + motion + "second_ratio = 0.5\n", "kind = \"noise" + motion + "second_ratio = 0.5\n",
              std::string("kind = \"record\"\nfile = \"a\"\nsecond = { }\nvertical = { }\n")})
            all.push_back(single(shaking, structure, area_contact));
    all.push_back("[study]\nkind = \"fragility\"\nrealizations = 4\n" + solid_drums + area_contact +
                  "[excitation]\nkind = \"noise\"\nfrequency_hz = 1.7\nsecond_ratio = 0.5\n[fragility]\nmotions = 9\n"
                  "intensity = { from = 1, to = 2, count = 2 }\n");
    all.push_back(single(harmonic, solid_bays, area_contact) + every_mechanism(true));
    all.push_back(single(harmonic) + "[mechanisms]\nvertical_motion = { file = \"v\" }\n");
    // each mechanism with as little as it takes
    for (const MechanismRule& rule : mechanism_rules()) {
        std::string values;
        for (const MechanismParameter& parameter : rule.parameters)
            if (parameter.role == ParameterRole::needed || &parameter == &rule.parameters.front())
                values += (values.empty() ? "" : ", ") + parameter.key() + " = " +
                          toml_number(std::max(1.2 * parameter.low, 0.4));
        all.push_back(single(harmonic, bays) + "[mechanisms]\n" + rule.name + " = { " + values + " }\n");
    }
    // of each distribution one
    const auto spreads = [](const SpreadKey& key) {
        std::vector<std::string> texts = {"{ distribution = \"normal\", " + key.sd.name + " = 0.001 }",
                                          uniform_in(key.value)};
        if (key.relative)
            texts.insert(texts.end(), {"{ distribution = \"normal\", cov = 0.001 }",
                                       "{ distribution = \"lognormal\", sigma_ln = 0.01 }"});
        return texts;
    };
    for (int i = 0; i < perturbable_count; ++i) {
        const SpreadKey& key = spread_key(static_cast<Quantity>(i));
        const std::string kind = key.name.starts_with("pulse") ? "pulse" : "harmonic";
        const bool planar = key.used_where(model_key, "2");
        for (const std::string& spread : spreads(key))
            all.push_back(
                single("kind = \"" + kind + motion, planar ? drums : solid_drums, planar ? contact : area_contact) +
                "[perturbation]\n" + key.name + " = " + spread + "\n");
    }
    for (const MechanismRule& rule : mechanism_rules())
        for (std::size_t i = 0; i < rule.parameters.size(); ++i) {
            const SpreadKey& key = spread_key(rule.mechanism, i);
            const bool spatial = !key.used_where(model_key, "2");
            for (const std::string& spread : spreads(key))
                all.push_back(single(harmonic, spatial ? solid_bays : bays, spatial ? area_contact : contact) +
                              "[mechanisms]\n" + whole(rule, spatial) + "[perturbation.mechanisms]\n" + rule.name +
                              "." + key.name + " = " + spread + "\n");
        }
    return all;
}

/// What the reader says of a study with one setting more; empty: it takes it.
std::string refusal(const std::string& text, const std::string& path, const std::string& value)
{
    try {
        parse_study(text, "study.toml", {path + "=" + value});
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

/// In a list of tables a setting goes to its first entry.
std::string in_list(std::string path)
{
    for (const char* list : {"structure.column_list.drums", "structure.column_list", "structure.drums",
                             "structure.epistyles", "fragility.records"})
        if (path.starts_with(std::string(list) + "."))
            return {};
    return path;
}

/// A value that no key of this type takes, and the words of the refusal.
std::pair<std::string, std::string> of_another_type(const TomlKey& key)
{
    switch (key.type) {
    case KeyType::number:
        return {"true", "not a number"};
    case KeyType::whole:
        return {"true", "not a whole number"};
    case KeyType::boolean:
        return {"3", "not true or false"};
    case KeyType::word:
        return {"true", "not a string"};
    case KeyType::text: // anything that is typed on the command line is text
        return {"\"\"", "is empty"};
    case KeyType::numbers:
    case KeyType::wholes:
    case KeyType::texts:
        return {"true", "not a list"};
    case KeyType::interval:
        return {"true", "is not two numbers in brackets"};
    case KeyType::table:
    case KeyType::named:
    case KeyType::table_or_list:
        return {"true", "not a table"};
    case KeyType::tables:
        return {"true", "not an array"};
    }
    return {};
}

/// What the page of the keys states of one of them.
struct StatedKey {
    std::string type;   ///< with the range: "number in (0, 40], m"
    std::string absent; ///< "`0.1`" of a default that is a value, else words
};

/// The cells of a row of a table.
std::vector<std::string> cells_of(const std::string& row)
{
    std::vector<std::string> cells;
    for (std::size_t at = row.find("| "); at != std::string::npos && at + 2 < row.size();) {
        const std::size_t end = row.find(" |", at + 1);
        cells.push_back(row.substr(at + 2, end == std::string::npos ? end : end - at - 2));
        at = end == std::string::npos ? end : end + 1;
    }
    return cells;
}

std::string without_quotes(const std::string& cell)
{
    return cell.size() > 1 && cell.front() == '`' && cell.back() == '`' ? cell.substr(1, cell.size() - 2)
                                                                        : std::string();
}

/// By path. The page is a file of its own: `StudyReference.ThePageIsThatOfTheProgram` compares it with the
/// descriptions, and here the reader is compared with it.
std::map<std::string, StatedKey> stated_keys()
{
    std::map<std::string, StatedKey> all, spread;
    std::ifstream page(STYLOBATE_SOURCE_DIR "/docs/study_reference.md");
    std::string table, columns;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## `[") || line.starts_with("### `["))
            table = line.substr(line.find('[') + 1, line.find(']') - line.find('[') - 1);
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() < 4)
            continue;
        const std::string name = without_quotes(cells[0]);
        if (name.empty())
            columns = cells[0];
        else if (columns == "key" && table == "perturbation")
            spread[name] = {cells[1], cells[2]};
        else if (columns == "key")
            all[table + "." + name] = {cells[1], cells[2]};
        else // a quantity that is drawn, with the range of its values
            for (const auto& [key, stated] : spread) {
                const bool value = key == "from" || key == "to" || key == "min" || key == "max";
                all[table + "." + name + "." + key] =
                    value ? StatedKey{"number in " + cells[2], stated.absent} : stated;
            }
    }
    return all;
}

/// "number in (0, 40], m", "whole number in [1, 200]; or ...", "list of numbers in [0, 10], m".
struct StatedRange {
    bool open = false, whole = false, list = false;
    double low = 0, high = 0;

    std::string value(double x) const
    {
        const std::string text = whole ? std::to_string(static_cast<std::int64_t>(x)) : toml_number(x);
        return list ? "[" + text + "]" : text;
    }
    std::string text() const { return fmt::format("{}{:g}, {:g}]", open ? '(' : '[', low, high); }
    /// The least and the largest value, and those just beyond them.
    std::vector<std::string> inside() const { return {value(open ? 1e-30 : low), value(high)}; }
    std::vector<std::string> outside() const
    {
        const auto beyond = [&](double end, double sign) {
            return value(end + sign * (whole ? 1 : end == 0 ? 1e-300 : 1e-9 * std::fabs(end)));
        };
        return {open ? value(low) : beyond(low, -1), beyond(high, 1)};
    }
};

std::optional<StatedRange> range_in(const std::string& type)
{
    StatedRange range;
    range.whole = type.find("whole number") != std::string::npos;
    range.list = type.starts_with("list of ");
    const std::string begin = range.list ? (range.whole ? "list of whole numbers in " : "list of numbers in ")
                                         : (range.whole ? "whole number in " : "number in ");
    if (!type.starts_with(begin) || type.size() < begin.size() + 2)
        return std::nullopt;
    const char bracket = type[begin.size()];
    const std::size_t comma = type.find(", ", begin.size());
    if ((bracket != '(' && bracket != '[') || comma == std::string::npos)
        return std::nullopt;
    range.open = bracket == '(';
    range.low = std::stod(type.substr(begin.size() + 1));
    const std::string high = type.substr(comma + 2);
    range.high = std::stod(high);
    return high.starts_with("2^") ? std::nullopt : std::optional(range); // as large as a whole number can be
}

class StudyKeys : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        for (const std::string& text : samples())
            if (text.find("folder") == std::string::npos) {
                EXPECT_NO_THROW(parse_study(text, "sample.toml")) << text;
            }
    }
    /// Calls for each key that can be set by its path.
    static void for_each_settable(const std::function<void(const std::string&, const TomlKey&)>& call)
    {
        for_each_key([&](const std::string& path, const TomlKey& key) {
            if (!in_list(path).empty())
                call(path, key);
        });
    }
    /// The samples, those first in which most parts of a path occur: nearly always the first one uses the key.
    std::vector<const std::string*> likely(const std::string& path) const
    {
        std::vector<std::pair<int, const std::string*>> order;
        for (const std::string& text : texts_) {
            int absent = 0;
            for (std::size_t begin = 0; begin < path.size();) {
                const std::size_t end = std::min(path.find('.', begin), path.size());
                absent += text.find(path.substr(begin, end - begin)) == std::string::npos;
                begin = end + 1;
            }
            order.emplace_back(absent, &text);
        }
        std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<const std::string*> all;
        for (const auto& [absent, text] : order)
            all.push_back(text);
        return all;
    }
    /// Some samples that use a key, at most so many: they refuse a value of another type.
    std::vector<const std::string*> users(const std::string& path, const TomlKey& key, std::size_t most) const
    {
        constexpr int enough = 2; // samples that are tried after the first user
        const auto [value, words] = of_another_type(key);
        std::vector<const std::string*> all;
        int further = 0;
        for (const std::string* text : likely(path)) {
            const std::string said = refusal(*text, path, value);
            const bool list_of_words =
                key.type == KeyType::texts && said.find("not a list of names") != std::string::npos;
            if (said.find(path + " = " + value) != std::string::npos &&
                (said.find(words) != std::string::npos || list_of_words))
                all.push_back(text);
            if (all.size() == most || (!all.empty() && ++further > enough))
                break;
        }
        return all;
    }
    const std::vector<std::string> texts_ = samples();
};

TEST_F(StudyKeys, TheReaderKnowsEachByItsType)
{
    int keys = 0;
    for_each_settable([&](const std::string& path, const TomlKey& key) {
        ++keys;
        const std::pair<std::string, std::string> wrong = of_another_type(key);
        EXPECT_FALSE(users(path, key, 1).empty())
            << path << " = " << wrong.first << " is refused in no study by \"" << wrong.second
            << "\"; in the first: " << refusal(texts_[1], path, wrong.first);
    });
    EXPECT_GT(keys, 300);
}

/// Whether a study narrows the range of a key: by the number of its blocks, joints, columns or realizations, or by the
/// size of a block.
bool narrower_in_a_study(const std::string& path)
{
    static const std::set<std::string> names = {"block",           "blocks",           "joint",           "joints",
                                                "fixed_blocks",    "contacts",         "offset_m",        "moves_m",
                                                "offset_z_m",      "echinus_height_m", "echinus_width_m", "followed",
                                                "tilt_from_block", "minimum",          "first_column"};
    static const std::set<std::string> paths = {"structure.epistyle_bays", "surface.adaptive.budget", "fragility.twins",
                                                "sensitivity.samples", "mechanisms.clamp.height_m"};
    return names.contains(path.substr(path.rfind('.') + 1)) || paths.contains(path) ||
           path.starts_with("perturbation.drum_offset.");
}

/// The least and the largest value that the page states are taken, and what is just beyond them is refused.
TEST_F(StudyKeys, TheReaderHasTheRangesOfThePage)
{
    const std::map<std::string, StatedKey> stated = stated_keys();
    int tried = 0;
    for_each_settable([&](const std::string& path, const TomlKey& key) {
        if (!stated.contains(path)) {
            const bool deviation = path.substr(path.rfind('.') + 1).starts_with("sd"); // no larger than nominal values
            EXPECT_TRUE(key.type == KeyType::table || path.find('.') == std::string::npos || deviation) << path;
            return;
        }
        const std::optional<StatedRange> range = range_in(stated.at(path).type);
        if (!range)
            return;
        ++tried;
        const std::vector<const std::string*> of_key = users(path, key, 2);
        const auto refused = [&](const std::string& text, const std::string& value) {
            const std::string said = refusal(text, path, value);
            return said.find(path) != std::string::npos && (said.find(" is outside ") != std::string::npos ||
                                                            said.find(", which is not a ") != std::string::npos);
        };
        const auto expect = [&](const std::string& value, bool refusal_wanted) {
            EXPECT_TRUE(std::any_of(of_key.begin(), of_key.end(),
                                    [&](const std::string* text) { return refused(*text, value) == refusal_wanted; }))
                << path << " = " << value << " of " << range->text() << ": "
                << (of_key.empty() ? "" : refusal(*of_key.front(), path, value));
        };
        for (const std::string& value : range->outside())
            expect(value, true);
        if (!narrower_in_a_study(path))
            for (const std::string& value : range->inside())
                expect(value, false);
    });
    EXPECT_GT(tried, 250);
}

TEST_F(StudyKeys, TheReaderTakesEachWordAndNoOther)
{
    for_each_settable([&](const std::string& path, const TomlKey& key) {
        if (key.type != KeyType::word)
            return;
        bool asked = false;
        for (const std::string* text : users(path, key, 3)) {
            const std::string said = refusal(*text, path, "\"zzzz\"");
            const std::size_t at = said.find("Allowed: ");
            if (said.find(path + " = ") == std::string::npos || at == std::string::npos)
                continue;
            asked = true;
            std::string words;
            for (const std::string& word : key.words)
                words += (words.empty() ? "" : ", ") + toml_quoted(word);
            EXPECT_EQ(said.substr(at + 9, words.size() + 1), words + ".") << path;
        }
        EXPECT_TRUE(asked) << path;
    });
}

/// A study in which a key is absent is the one in which it has the default that the page states, and another one with
/// another value.
TEST_F(StudyKeys, TheReaderHasTheDefaultsOfThePage)
{
    const std::map<std::string, StatedKey> stated = stated_keys();
    const auto text_with = [](const std::string& text, const std::string& path, const std::string& value) {
        try {
            return parse_study(text, "study.toml", {path + "=" + value}).text;
        } catch (const InputError&) {
            return std::string();
        }
    };
    int tried = 0, told_apart = 0;
    for_each_settable([&](const std::string& path, const TomlKey& key) {
        const std::string absent = stated.contains(path) ? without_quotes(stated.at(path).absent) : "";
        if (absent.empty())
            return;
        std::vector<std::string> others = {"true", "false", "7"};
        others.insert(others.end(), key.words.begin(), key.words.end());
        for (std::string& word : others)
            word = key.type == KeyType::word ? toml_quoted(word) : word;
        if (const std::optional<StatedRange> range = range_in(stated.at(path).type)) {
            const double value = std::atof(absent.c_str());
            for (const double other : {value * 0.9, value * 1.1, value + 1, value + 0.1, range->low, range->high})
                others.push_back(range->value(other));
        }
        bool known = false, changed = false, apart = path.starts_with("optimise."); // which is no part of a study
        for (const std::string* text : users(path, key, 3)) {
            // a mechanism that is not named is not there, whatever its neutral value
            const std::string table = path.substr(0, path.rfind('.'));
            const std::string name = table.substr(table.rfind('.') + 1);
            const std::size_t mechanisms = std::min(text->find("[mechanisms]\n"), text->size());
            const bool unnamed =
                path.starts_with("mechanisms.") && text->find("\n" + name + " = ", mechanisms) == std::string::npos;
            if (unnamed || text->find(key.name + " = ") != std::string::npos)
                continue;
            const std::string given = text_with(*text, path, absent);
            if (given.empty())
                continue;
            const std::string plain = parse_study(*text, "study.toml").text;
            EXPECT_EQ(plain, given) << path << " = " << absent;
            known = true;
            for (const std::string& other : others)
                if (const std::string with_other = text_with(*text, path, other);
                    other != absent && !with_other.empty()) {
                    changed = true;
                    apart = apart || with_other != plain;
                }
        }
        tried += known;
        told_apart += apart;
        EXPECT_TRUE(apart || !changed) << path << ": no other value makes another study";
    });
    EXPECT_GT(tried, 60);
    EXPECT_GT(told_apart, tried - 5) << "few defaults are the only value that a sample takes";
}

TEST_F(StudyKeys, EachIsNeededWhereItsDescriptionSaysSo)
{
    for_each_settable([&](const std::string& path, const TomlKey& key) {
        if (!key.needed() || !key.used.empty() || std::count(path.begin(), path.end(), '.') != 1)
            return;
        const std::string table = path.substr(0, path.find('.'));
        int asked = 0;
        for (const std::string& text : texts_) {
            const std::size_t section = text.find("[" + table + "]\n");
            const std::size_t begin =
                section == std::string::npos ? section : text.find("\n" + key.name + " = ", section);
            const bool spatial = text.find("\ndimensions = 3\n") != std::string::npos;
            if (begin == std::string::npos || !key.used_where(model_key, spatial ? "3" : "2"))
                continue;
            std::string without = text;
            without.erase(begin, text.find('\n', begin + 1) - begin);
            try {
                parse_study(without, "study.toml");
                ADD_FAILURE() << path << " is said to be needed, and is not:\n" << without;
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
            }
            ++asked;
        }
        EXPECT_GT(asked, 0) << path;
    });
}

} // namespace
} // namespace stylobate::test_study_keys
