/// "Did you mean": distances by hand, and silence where nothing is near.

#include "io/files/suggest.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

TEST(Suggest, EditDistanceCountsASwapOnce)
{
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("width", "widht"), 1u);
    EXPECT_EQ(edit_distance("ca", "abc"), 3u); // no part is edited twice
    EXPECT_EQ(edit_distance("friction", "friction"), 0u);
}

TEST(Suggest, SaysNothingWhereNothingIsNear)
{
    EXPECT_EQ(nearest_word("smoth", {"abrupt", "smooth"}), "smooth");
    EXPECT_EQ(nearest_word("SMOOTH", {"abrupt", "smooth"}), "smooth");
    EXPECT_EQ(nearest_word("zebra", {"abrupt", "smooth"}), std::nullopt);
    EXPECT_EQ(meant_key("drum_width_inch", {"drum_height_m", "drum_width_m"}), "drum_width_m");
    EXPECT_EQ(meant_key("normal_damping", {"damping", "normal_damping_n_s_m"}), "normal_damping_n_s_m");
    EXPECT_EQ(without_unit("normal_damping_n_s_m"), "normal_damping");
    EXPECT_EQ(without_unit("kind"), "kind");
}

} // namespace
} // namespace stylobate
