/// What is true of planar blocks alone stays where planar blocks are described: a second model shall need no change
/// elsewhere.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace {

/// The floors that are searched, and the words.
const std::set<std::string> floors_of_any_model = {"kernels", "ensemble", "io",    "studies",
                                                   "library", "include",  "python"};
const std::set<std::string> planar_words = {"theta", "half_width_m"};

/// Folders and files that may have them, and why.
const std::map<std::string, std::string> planar_places = {
    {"kernels/planar/", "the planar model"},
    {"kernels/lanes/", "the planar model, with a lane for every bed"},
    {"ensemble/planar/", "the planar model"},
    {"ensemble/realization/planar_structure.hpp", "the planar model"},
    {"ensemble/model/campaign.hpp", "measured data, which give planar poses"},
    {"ensemble/tracking/", "the planar model, nudged along measured data"},
    {"io/measured/", "measured data, which give planar poses"},
    {"studies/measured/", "their diagnoses and pictures"},
    {"studies/evidence/", "derivations and reference solutions of the planar model"},
    {"studies/check/rocking_decay.cpp", "releases a block from a lean in the plane"},
    {"library/trajectory.hpp", "the public lists of a planar trajectory"},
    {"include/stylobate/trajectory.hpp", "the public lists of a planar trajectory"},
    {"python/stylobate/__init__.pyi", "the public lists of a planar trajectory"},
    {"python/stylobate/_replay.py", "the public lists of a planar trajectory, and its corners"},
    {"python/tests/", "tests"},
};

bool has_planar_word(const std::string& text)
{
    for (const std::string& word : planar_words)
        if (text.find(word) != std::string::npos)
            return true;
    return false;
}

/// The entry of `planar_places` that a file belongs to; empty: none.
std::string planar_place_of(const std::string& file)
{
    for (const auto& [place, why] : planar_places)
        if (place.ends_with('/') ? file.starts_with(place) : file == place)
            return place;
    return {};
}

} // namespace

TEST(House, WordsOfPlanarBlocksStayWhereTheseAreDescribed)
{
    const fs::path root = STYLOBATE_SOURCE_DIR;
    std::set<std::string> used;
    std::size_t files = 0;
    for (const std::string& floor : floors_of_any_model)
        for (const auto& entry : fs::recursive_directory_iterator(root / floor)) {
            if (!std::set<std::string>{".cpp", ".hpp", ".py", ".pyi"}.contains(entry.path().extension().string()))
                continue;
            ++files;
            std::stringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            if (!has_planar_word(text.str()))
                continue;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            const std::string place = planar_place_of(file);
            EXPECT_NE(place, "") << file << " has a word of planar blocks: loop over the channels of the trajectory "
                                 << "(ensemble/model/trajectory.hpp), or ask for the rectangle that is drawn "
                                 << "(ensemble/planar/planar_poses.hpp); what the engine needs of a structure, the "
                                 << "model computes";
            used.insert(place);
        }
    EXPECT_GT(files, 200U) << "the files were not found";
    for (const auto& [place, why] : planar_places)
        EXPECT_TRUE(used.contains(place)) << place << " has none of the words any more: take it from the list";
}

TEST(Rules, FindWordsOfPlanarBlocks)
{
    EXPECT_TRUE(has_planar_word("t[\"theta_rad\"]"));
    EXPECT_TRUE(has_planar_word("block.half_width_m"));
    EXPECT_FALSE(has_planar_word("adaptive.half_width = 0.05"));
    EXPECT_EQ(planar_place_of("io/measured/measured_motion.cpp"), "io/measured/");
    EXPECT_EQ(planar_place_of("io/store/export.cpp"), "");
    EXPECT_EQ(planar_place_of("ensemble/engine/lanes.hpp"), "");
    EXPECT_EQ(planar_place_of("kernels/planar/step.hpp"), "kernels/planar/");
    EXPECT_EQ(planar_place_of("library/trajectory.hpp.orig"), "");
}
