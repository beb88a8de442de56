/// Final states against the observed one, as they are and mirrored; the mirror image of a structure.

#include "ensemble/estimators/past/agreeing_states.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

using namespace stylobate;

TEST(Past, AStateAgreesWithinItsTolerancesOrMirrored)
{
    MeasuredState measured{{0, 0.004, 0.007}, {0.002, 0.002, 0.001}, false};
    EXPECT_TRUE(distance(measured, std::vector<double>{0.0019, 0.003, 0.0075}).agrees());
    const StateDistance off = distance(measured, std::vector<double>{0, 0.004, 0.0095});
    EXPECT_NEAR(off.value, 2.5, 1e-12);
    EXPECT_EQ(off.worst, 2U);
    EXPECT_FALSE(distance(measured, std::vector<double>{0, -0.004, -0.007}).agrees());
    measured.mirrored = true;
    EXPECT_TRUE(distance(measured, std::vector<double>{0, -0.004, -0.007}).agrees());
    EXPECT_TRUE(distance(MeasuredState{}, {}).agrees()); // nothing was measured

    // a nearest state is reported as it was compared
    const StateDistance mirror = distance(measured, std::vector<double>{0, -0.004, -0.0085});
    EXPECT_EQ(mirror.worst, 2U);
    EXPECT_EQ(mirror.found, 0.0085);
}

/// Two columns, of the left of which the first joint was measured: the mirror image has that of the right one there.
TEST(Past, InTheMirrorImageOfAColonnadeTheColumnsChangePlaces)
{
    MeasuredState measured{{0.004, 0}, {0.001, 0.001}, true, {2, 3}};
    EXPECT_TRUE(distance(measured, std::vector<double>{0.004, 0, 0.1, 0.1}).agrees());
    EXPECT_TRUE(distance(measured, std::vector<double>{0.1, 0.1, -0.004, 0}).agrees());
    EXPECT_FALSE(distance(measured, std::vector<double>{-0.004, 0, 0.1, 0.1}).agrees());
    EXPECT_FALSE(distance(measured, std::vector<double>{0.1, 0.1, 0.004, 0}).agrees());
}

TEST(Past, MirrorImage)
{
    StructureSpec s = equal_column(3, 1, 1, 0.8, 1, 2000);
    s.columns[0].drums[1].offset_m = 0.01;
    const std::optional<MirrorImage> alone = mirror_image(lay_out(s));
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->blocks, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(alone->beds, (std::vector<std::size_t>{0, 1}));

    s.kind = StructureKind::colonnade;
    s.columns[0].x_m = -2;
    s.columns.push_back(s.columns[0]);
    s.columns[1].x_m = 2;
    s.epistyles.push_back({0, 1, 0, 5, 0.5, 3000});
    const std::optional<MirrorImage> two = mirror_image(lay_out(s));
    ASSERT_TRUE(two);
    EXPECT_EQ(two->blocks, (std::vector<std::size_t>{3, 4, 5, 0, 1, 2, 6}));
    EXPECT_EQ(two->beds, (std::vector<std::size_t>{2, 3, 0, 1, 5, 4}));

    // three columns at unequal distances, or one of other drums: another structure from behind
    StructureSpec uneven = s;
    uneven.epistyles.clear();
    EXPECT_TRUE(mirror_image(lay_out(uneven)));
    uneven.columns.push_back(s.columns[0]);
    uneven.columns[2].x_m = 5;
    EXPECT_FALSE(mirror_image(lay_out(uneven)));
    uneven.columns.pop_back();
    uneven.columns[1].drums[2].mass_kg *= 1.01;
    EXPECT_FALSE(mirror_image(lay_out(uneven)));
}
