/// Kinds of studies own their settings: only the files of the kinds, their keys and the reader of studies name them.
/// All others ask a study for its design, or the kind for an answer of its contract.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> files_of_kinds = {"ensemble/model/kind_settings.hpp",
                                                 "ensemble/model/study.hpp",
                                                 "ensemble/model/study_design.cpp",
                                                 "io/keys/",
                                                 "io/study/",
                                                 "studies/reference/",                 // the keys as text
                                                 "studies/workflow/bench/scenes.hpp"}; // studies that are timed

/// Where a text names a kind of study or its settings; empty: nowhere.
std::string kind_named_in(const std::string& text)
{
    static const std::regex named(
        R"re(\bstudy_?(\(\))?(\.|->)(fragility|sensitivity|rare|survival|replicas)\b)re" // a member of a study
        R"re(|(\.|->)(fragility|sensitivity|rare|survival|replicas)(->|\.(reset|emplace|has_value)\())re" // an optional
        R"re(|\b(FragilitySpec|RareSpec|SurvivalSpec|StudyKind::\w+)\b)re");
    std::smatch found;
    return std::regex_search(text, found, named) ? found.str() : "";
}

bool is_of_kinds(const std::string& name)
{
    const bool folder = name.starts_with("studies/kinds/") && std::ranges::count(name, '/') > 2; // of one kind
    return folder || std::ranges::any_of(files_of_kinds, [&](const std::string& of) { return name.starts_with(of); });
}

} // namespace

TEST(House, OnlyKindsNameTheirSettings)
{
    const fs::path root = STYLOBATE_SOURCE_DIR;
    std::size_t files = 0;
    for (const char* folder : {"kernels", "ensemble", "io", "studies", "library", "include", "python"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string name = entry.path().lexically_relative(root).generic_string();
            const std::string ending = entry.path().extension().string();
            if ((ending != ".cpp" && ending != ".hpp" && ending != ".cu") || is_of_kinds(name))
                continue;
            ++files;
            std::ifstream file(entry.path());
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            EXPECT_EQ(kind_named_in(text), "") << name << " names a kind of study: see StudyDesign and Kind";
        }
    EXPECT_GT(files, 200U) << "the files were not found";
}

TEST(Rules, FindKindsByTheirNames)
{
    EXPECT_EQ(kind_named_in("if (study.fragility)"), "study.fragility");
    EXPECT_EQ(kind_named_in("n = study_->replicas->block;"), "study_->replicas");
    EXPECT_EQ(kind_named_in("return !results.study().survival;"), "study().survival");
    EXPECT_EQ(kind_named_in("one.fragility.reset();"), ".fragility.reset(");
    EXPECT_EQ(kind_named_in("own.rare->samples"), ".rare->");
    EXPECT_EQ(kind_named_in("study.kind == StudyKind::single"), "StudyKind::single");
    EXPECT_EQ(kind_named_in("const SurvivalSpec& spec"), "SurvivalSpec");
    for (const char* other : {"risk.fragility = points;", "f.fragility.lower", "data_->rare.probability",
                              "study.kind = \\\"rare\\\"", "kind.fragility()", "study.design().motions"})
        EXPECT_EQ(kind_named_in(other), "");
}
