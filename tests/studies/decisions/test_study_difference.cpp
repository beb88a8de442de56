/// The keys in which studies differ.

#include "studies/decisions/compare/study_difference.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace stylobate {
namespace {

const std::string plain_keys = "[study]\ntitle = \"a\"\nseed = 1\n[contact]\nfriction = 0.5\n[structure]\ndrums = "
                               "[{ width_m = 1.0, mass_kg = 2.0 }, { width_m = 1.0, mass_kg = 2.0 }]\n";

std::string replaced_once(std::string text, const std::string& from, const std::string& to)
{
    return text.replace(text.find(from), from.size(), to);
}

TEST(StudyDifference, HasOnlyTheKeysThatDiffer)
{
    const std::string other = replaced_once(plain_keys, "friction = 0.5", "friction = 0.4") +
                              "[mechanisms]\ndowel = { stiffness_n_m = 1e8, yield_n = 5.0 }\n";
    const std::vector<DifferentKey> keys =
        different_keys({plain_keys, replaced_once(other, "\"a\"", "\"b\""), plain_keys});
    ASSERT_EQ(keys.size(), 3U);
    EXPECT_EQ(keys[0].key, "contact.friction");
    EXPECT_EQ(keys[0].values, (std::vector<std::optional<std::string>>{"0.5", "0.4", "0.5"}));
    EXPECT_EQ(keys[1].key, "mechanisms.dowel.stiffness_n_m");
    EXPECT_EQ(keys[1].values, (std::vector<std::optional<std::string>>{std::nullopt, "100000000", std::nullopt}));
    EXPECT_EQ(keys[2].key, "mechanisms.dowel.yield_n");
    EXPECT_TRUE(different_keys({plain_keys, plain_keys}).empty());
}

TEST(StudyDifference, ListsOfTablesDifferEntryByEntry)
{
    std::string many = "[structure]\ndrums = [", other = many;
    for (int i = 0; i < 12; ++i) {
        many += "{ mass_kg = 2.0 }, ";
        other += i == 2 || i == 10 ? "{ mass_kg = 3.0 }, " : "{ mass_kg = 2.0 }, ";
    }
    const std::vector<DifferentKey> keys = different_keys({many + "]\n", other + "]\n"});
    ASSERT_EQ(keys.size(), 2U);
    EXPECT_EQ(keys[0].key, "structure.drums[2].mass_kg");
    EXPECT_EQ(keys[1].key, "structure.drums[10].mass_kg");
}

} // namespace
} // namespace stylobate
