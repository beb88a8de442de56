/// What is written from the descriptions of the keys: the reference page, the JSON Schema and the templates.

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/keys/study_tables.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"
#include "studies/reference/study_reference.hpp"
#include "tests/program/json.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(StudyReference, ThePageIsThatOfTheProgram)
{
    EXPECT_EQ(content(fs::path(STYLOBATE_SOURCE_DIR) / "docs/study_reference.md"), study_reference())
        << "write it anew: stylobate schema --markdown > docs/study_reference.md";
}

TEST(StudyReference, HasEveryKey)
{
    const std::string page = study_reference();
    for_each_key([&](const std::string& path, const TomlKey& key) {
        // the parameters of mechanisms have one table: [perturbation.mechanisms]
        const std::string perturbed = "perturbation.mechanisms.";
        const bool group = path.starts_with(perturbed) && !key.keys.empty() && !key.keys.front()->keys.empty();
        bool shown = group;
        for (const std::string& words :
             {key.name, "[" + path + "]", path.substr(std::min(path.size(), perturbed.size()))})
            shown = shown || page.find("`" + words + "`") != std::string::npos;
        EXPECT_TRUE(shown) << path;
        EXPECT_FALSE(key.meaning.empty()) << path;
        EXPECT_FALSE(key.meaning.ends_with('.')) << path << ": a phrase";
    });
}

TEST(StudyReference, StatesTheModelsOfAKeyThatDoesNotHoldForAll)
{
    const NumberKey all("drift_m", Range{0, 1}, "drift"), one("drift_m", Range{0, 1}, "drift", {.models = {"spatial"}});
    EXPECT_EQ(use_words(all), std::nullopt);
    EXPECT_EQ(use_words(one), "structure.dimensions = 3");
    for_each_key([&](const std::string& path, const TomlKey& key) {
        EXPECT_FALSE(key.models.empty()) << path;
        for (const std::string& model : key.models)
            EXPECT_TRUE(model == "planar" || model == "spatial") << path;
    });
    EXPECT_TRUE(all.used_where(model_key, "2"));
    EXPECT_TRUE(all.used_where(model_key, "3"));
    EXPECT_FALSE(one.used_where(model_key, "2"));
    EXPECT_TRUE(one.used_where(model_key, "3"));
}

TEST(StudySchema, IsJsonAndHasEveryTable)
{
    const JsonValue schema = JsonParser::parse(study_schema());
    for (const TomlKey* table : study_file_keys().keys)
        EXPECT_TRUE(schema["properties"].has(table->name)) << table->name;
    EXPECT_EQ(schema["properties"]["contact"]["properties"]["friction"]["maximum"].number, 10);
}

/// Every pair of kinds that goes together.
std::vector<TemplateChoice> choices()
{
    std::vector<TemplateChoice> all;
    for (const auto& study : study_kind_names)
        for (const auto& structure : structure_kind_names)
            for (const auto& excitation : excitation_kind_names)
                for (const int dimensions : {2, 3}) {
                    const TemplateChoice choice{study.value, structure.value, excitation.value, dimensions};
                    try {
                        study_template(choice);
                        all.push_back(choice);
                    } catch (const InputError&) {
                    }
                }
    return all;
}

std::string name_of(const TemplateChoice& choice)
{
    return std::string(word_for(study_kind_names, choice.study)) + ", " +
           word_for(structure_kind_names, choice.structure) + ", " +
           word_for(excitation_kind_names, *choice.excitation) + ", " + std::to_string(choice.dimensions);
}

/// With a folder of records that is there.
bool names_a_folder(const TemplateChoice& choice)
{
    return choice.study == StudyKind::fragility && choice.excitation == ExcitationKind::record;
}

TEST(StudyTemplate, OfEveryKindIsAStudyOfThatKind)
{
    const std::vector<TemplateChoice> all = choices();
    EXPECT_GE(all.size(), 5U * 2U * 4U * 2U);
    for (const TemplateChoice& choice : all) {
        const std::string text = study_template(choice);
        if (names_a_folder(choice))
            continue;
        Study study;
        ASSERT_NO_THROW(study = parse_study(text, "new.toml")) << name_of(choice) << "\n" << text;
        EXPECT_EQ(study.kind, choice.study) << name_of(choice);
        EXPECT_EQ(study.structure.kind, choice.structure) << name_of(choice);
        EXPECT_EQ(study.structure.dimensions, choice.dimensions) << name_of(choice);
        EXPECT_EQ(study.excitation.kind, choice.excitation) << name_of(choice);
        const std::vector<Implausibility> found = implausibilities(study);
        EXPECT_TRUE(found.empty()) << name_of(choice) << ": " << found.front().text;
    }
}

/// Where residual displacements are counted, new studies have dashpots that bring the structure to rest.
TEST(StudyTemplate, StructuresComeToRestWhereResidualsAreCounted)
{
    const auto damping = [](StudyKind kind) {
        return parse_study(study_template({.study = kind}), "new.toml").contact.damping;
    };
    EXPECT_EQ(damping(StudyKind::surface), DampingAt::centroid);
    EXPECT_EQ(damping(StudyKind::rare), DampingAt::centroid);
    for (const StudyKind kind : {StudyKind::single, StudyKind::fragility, StudyKind::sensitivity, StudyKind::survival})
        EXPECT_EQ(damping(kind), DampingAt::ends);
}

TEST(StudyTemplate, ADefaultThatIsUncommentedChangesNothing)
{
    int tried = 0;
    for (const TemplateChoice& choice : choices()) {
        if (names_a_folder(choice))
            continue;
        const std::string text = study_template(choice);
        const std::string plain = parse_study(text, "new.toml").text;
        std::string given;
        std::istringstream lines(text);
        bool table_given = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with('['))
                table_given = true;
            if (line.starts_with("# ["))
                table_given = false;
            const bool is_key = line.starts_with("# ") && line.find(" = ") != std::string::npos;
            const bool is_default = is_key && line.find("...") == std::string::npos &&
                                    line.find("default: ") == std::string::npos &&
                                    line.find("= {") == std::string::npos && line.find("= [ {") == std::string::npos;
            // what two components have in common is given where there are two
            const bool of_pair = line.starts_with("# second_") || line.starts_with("# pga_of_pair");
            if (table_given && is_default && !of_pair && line.find('#', 2) != std::string::npos) {
                line.erase(0, 2);
                ++tried;
            }
            given += line + "\n";
        }
        try {
            EXPECT_EQ(parse_study(given, "given.toml").text, plain) << name_of(choice);
        } catch (const InputError& error) {
            ADD_FAILURE() << name_of(choice) << ": " << error.what() << "\n" << given;
        }
    }
    EXPECT_GT(tried, 500);
}

TEST(StudyTemplate, RefusesKindsThatDoNotGoTogether)
{
    try {
        study_template({StudyKind::surface, StructureKind::column, ExcitationKind::none});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("\"surface\" cannot have excitation.kind = \"none\""),
                  std::string::npos)
            << error.what();
    }
    EXPECT_THROW(study_template({StudyKind::rare, StructureKind::column, ExcitationKind::noise}), InputError);
    EXPECT_THROW(study_template({.study = StudyKind::survival, .dimensions = 3}), InputError);
    EXPECT_THROW(study_template({StudyKind::fragility, StructureKind::column, ExcitationKind::table}), InputError);
    EXPECT_THROW(study_template({StudyKind::fragility, StructureKind::column, ExcitationKind::ricker}), InputError);
}

} // namespace
} // namespace stylobate
