/// Keys that are refused where they are not given, ranges at their ends, units in names.

#include "ensemble/model/input_error.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_tables.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace stylobate {

TEST(KeyReader, RefusesAKeyThatIsAbsentAtItsTable)
{
    const KeyReader structure(nullptr, "structure", {"temple.toml", 4, false});
    try {
        structure.refuse("drums", "has no bed", "Give one.");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "temple.toml:4: structure.drums has no bed.\n  Give one.");
    }
}

TEST(TomlRange, BeginsAboveZeroWhereProductsDoNotVanish)
{
    const Range open{0, 1, true}, closed{0, 1, false}, about_zero{-1, 1, true};
    EXPECT_FALSE(open.contains(0));
    EXPECT_FALSE(open.contains(5e-324));
    EXPECT_FALSE(open.contains(0.999e-30));
    EXPECT_TRUE(open.contains(1e-30));
    EXPECT_TRUE(closed.contains(0));
    EXPECT_TRUE(closed.contains(5e-324)) << "0 is allowed as well";
    EXPECT_TRUE(about_zero.contains(5e-324));
    EXPECT_EQ(open.text_for(5e-324), "(0, 1], which begins at 1e-30");
    EXPECT_EQ(open.text_for(2), "(0, 1]");
}

TEST(TomlKeys, TheUnitIsPartOfTheName)
{
    const std::map<std::string, std::string> units = {{"structure.depth_m", "m"},
                                                      {"contact.normal_stiffness_n_m2", "N/m2"},
                                                      {"contact.friction", ""},
                                                      {"structure.density_kg_m3", "kg/m3"},
                                                      {"excitation.frequency_hz", "Hz"},
                                                      {"excitation.pga_m_s2", "m/s2"},
                                                      {"run.step_s", "s"},
                                                      {"output.most_mb", "1e6 bytes"},
                                                      {"initial.tilt_rad", "rad"},
                                                      {"mechanisms.drag.coefficient_n_s2_m2", "N s2/m2"},
                                                      {"surface.frequency_hz", "Hz"},
                                                      {"mechanisms.rate_damping.rate_s_m", "s/m"},
                                                      {"structure.columns", ""},
                                                      {"mechanisms.dowel.yield_n", "N"},
                                                      {"mechanisms.tie.turning_dashpot_n_m_s", "N m s"},
                                                      {"contact.normal_damping_n_s_m", "N s/m"},
                                                      {"contact.normal_stiffness_n_m3", "N/m3"},
                                                      {"excitation.direction_deg", "degrees"},
                                                      {"surface.direction_deg", "degrees"},
                                                      {"mechanisms.adhesion.strength_pa", "Pa"}};
    std::set<std::string> seen;
    for_each_key([&](const std::string& path, const TomlKey& key) {
        if (const auto unit = units.find(path); unit != units.end()) {
            EXPECT_EQ(key.unit().value_or(""), unit->second) << path;
            seen.insert(path);
        }
    });
    EXPECT_EQ(seen.size(), units.size());
}

} // namespace stylobate
