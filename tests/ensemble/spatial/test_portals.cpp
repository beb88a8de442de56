/// Portals in plan, from studies: beside one another, with epistyles abreast, with echini, and turned by a quarter of a
/// turn.

#include "ensemble/spatial/structure/builder.hpp"
#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/spatial/standing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace stylobate {
namespace {

using PortalJoint = spatial::OfJoint;

/// @param columns a list, or the number of equal ones
std::string colonnade(const std::string& columns, const std::string& epistyles, const std::string& capital = "")
{
    return "[structure]\ndimensions = 3\nkind = \"colonnade\"\n" + columns +
           "blocks = 2\ndrum_width_m = 0.8\ndrum_height_m = 1.2\ndensity_kg_m3 = 2700\n"
           "capital = { width_m = 1.0, height_m = 0.4" +
           capital + " }\nepistyle_height_m = 0.6\n" + epistyles;
}

Study portal_study(const std::string& structure, const std::string& excitation = "kind = \"none\"\nduration_s = 1\n",
                   const std::string& contact = "")
{
    return parse_study("[study]\nkind = \"single\"\nrealizations = 20\n" + structure +
                           "[contact]\nnormal_stiffness_n_m3 = 1e9\nfriction = 0.7\n" + contact + "[excitation]\n" +
                           excitation,
                       "portal.toml");
}

/// The nominal structure at rest.
struct AtRest {
    Standing s;
    double weight = 0;

    explicit AtRest(const Study& study)
    {
        const SpatialBuilder builder(study);
        s.r = builder.build(builder.nominal(), {});
        s.r.step_s = builder.step_s(s.r);
        for (const Solid& solid : s.r.space.solids)
            weight += solid.fixed ? 0 : solid.mass_kg * Standing::g;
        s.settle();
    }
    /// Sum of the loads on the ground after so many steps.
    double base_after(int steps)
    {
        s.run(steps);
        double sum = 0;
        for (std::size_t j = 0; j < s.r.space.joints.size(); ++j)
            if (s.solid(s.r.space.joints[j].lower).role == BlockRole::ground)
                sum += s.at(static_cast<PortalJoint::Field>(PortalJoint::force + 1), static_cast<int>(j));
        return sum;
    }
};

/// At the start, and after a while: lateral forces may jump where edges lie over each other (`settle`).
void expect_rests(const Study& study, std::size_t columns)
{
    AtRest rest(study);
    std::size_t feet = 0;
    for (const SolidJoint& joint : rest.s.r.space.joints)
        feet += rest.s.solid(joint.lower).role == BlockRole::ground;
    EXPECT_EQ(feet, columns);
    EXPECT_NEAR(rest.base_after(1) / rest.weight, 1, 1e-6);
    std::vector<Standing::Vec> places, turns;
    for (int i = 0; i < rest.s.r.space.drums; ++i) {
        places.push_back(rest.s.u(i));
        turns.push_back(rest.s.turn(i));
    }
    EXPECT_NEAR(rest.base_after(4096) / rest.weight, 1, 1e-4);
    for (int i = 0; i < rest.s.r.space.drums; ++i) {
        const Standing::Vec moved = rest.s.u(i) - places[static_cast<std::size_t>(i)],
                            turned = rest.s.turn(i) - turns[static_cast<std::size_t>(i)];
        EXPECT_LT(std::sqrt(dot(moved, moved)), 1e-7) << i;
        EXPECT_LT(std::sqrt(dot(turned, turned)), 1e-7) << i;
    }
}

const std::string four_corners = "column_list = [ { x_m = -1.5, z_m = -2 }, { x_m = 1.5, z_m = -2 }, { x_m = -1.5, z_m "
                                 "= 2 }, { x_m = 1.5, z_m = 2 } ]\n";
const std::string pair_of_beams = "epistyle_width_m = 0.8\nepistyles = [ { first_column = 0, last_column = 1, length_m "
                                  "= 4 }, { first_column = 2, last_column = 3, length_m = 4 } ]\n";

TEST(Portals, BesideOneAnotherStandEachOnItsOwn)
{
    const Study study = portal_study(colonnade(four_corners, pair_of_beams));
    const Realization r = AtRest(study).s.r;
    ASSERT_EQ(r.space.drums, 4 * 3 + 2);
    EXPECT_EQ(r.space.solids[12].middle_m()[2], -2);
    EXPECT_EQ(r.space.solids[13].middle_m()[2], 2);
    EXPECT_EQ(r.space.solids[13].middle_m()[0], 0);
    expect_rests(study, 4);
}

/// The beams of a portal along z lie on beams along x nowhere: a box of four needs them at the corners.
TEST(Portals, AlongBothAxesMeetAtTheCorners)
{
    const std::string box =
        "epistyle_width_m = 0.5\nepistyles = [ { first_column = 0, last_column = 1, length_m = 3.5 }, { first_column = "
        "2, last_column = 3, length_m = 3.5 }, { first_column = 0, last_column = 2, length_m = 3.5 }, { first_column = "
        "1, last_column = 3, length_m = 3.5 } ]\n";
    const Study study = portal_study(colonnade(four_corners, box));
    EXPECT_EQ(study.structure.epistyles[2].along, Along::z);
    const Realization r = AtRest(study).s.r;
    // each beam along z has its ends against the sides of two beams along x
    const auto butts = std::ranges::count_if(r.space.joints, [](const SolidJoint& j) { return j.normal == Normal::z; });
    EXPECT_EQ(butts, 4);
    expect_rests(study, 4);
}

TEST(Portals, EpistylesAbreastShareTheCapitals)
{
    const Study study = portal_study(
        colonnade("columns = 2\ncolumn_spacing_m = 3\n", "epistyle_width_m = 0.4\nepistyle_abreast = 2\n"));
    const Realization r = AtRest(study).s.r;
    ASSERT_EQ(r.space.drums, 2 * 3 + 2);
    const Solid &back = r.space.solids[6], &front = r.space.solids[7];
    EXPECT_DOUBLE_EQ(back.middle_m()[2], -0.2);
    EXPECT_DOUBLE_EQ(front.middle_m()[2], 0.2);
    EXPECT_EQ(back.mass_kg, front.mass_kg);
    const SolidJoint& joint = r.space.joints.back(); // face against face along the whole length
    EXPECT_EQ(joint.normal, Normal::z);
    EXPECT_EQ(joint.lower, 6);
    EXPECT_EQ(joint.upper, 7);
    EXPECT_NEAR(joint.area_m2, 4.0 * 0.6, 1e-12);
    expect_rests(study, 2);
}

/// At rest nothing moves, so dashpots have no part in it, wherever they act.
TEST(Portals, DashpotsDoNotChangeTheRest)
{
    const std::string portal =
        colonnade("columns = 2\ncolumn_spacing_m = 3\n", "epistyle_width_m = 0.4\nepistyle_abreast = 2\n");
    const std::string still = "kind = \"none\"\nduration_s = 1\n";
    AtRest spread(portal_study(portal, still));
    AtRest ends(portal_study(portal, still, "damping = \"ends\"\nnormal_damping_ratio = 0.5\n"));
    for (int i = 0; i < spread.s.r.space.drums; ++i) {
        const Standing::Vec a = spread.s.u(i), b = ends.s.u(i);
        EXPECT_LT(a.y, -1e-6);
        EXPECT_NEAR(a.x, b.x, 1e-15) << i;
        EXPECT_NEAR(a.y, b.y, 1e-15) << i;
        EXPECT_NEAR(a.z, b.z, 1e-15) << i;
    }
}

/// Two bays, two pieces abreast in each: what is drawn pushes a piece away from the one beside it, or before it, by
/// millimetres, and no piece out of its bay.
TEST(Portals, PiecesAreLaidBesideEachOtherAndBehindEachOther)
{
    const Study study = portal_study(
        colonnade("columns = 3\ncolumn_spacing_m = 3\n", "epistyle_width_m = 0.4\nepistyle_abreast = 2\n") +
        "[perturbation]\ndrum_offset = { distribution = \"normal\", sd_m = 0.003, per = \"block\" }\n"
        "drum_width = { distribution = \"normal\", sd_m = 0.003, per = \"block\" }\n");
    const SpatialBuilder builder(study);
    const std::vector<Solid> nominal = builder.build(builder.nominal(), {}).space.solids;
    const Experiment experiment(study);
    for (std::uint64_t i = 0; i < 20; ++i) {
        Standing s;
        s.r = experiment.sampler().realization(i);
        s.r.step_s = builder.step_s(s.r);
        EXPECT_NO_THROW(s.settle()) << i; // some pieces press each other lightly
        const std::vector<Solid>& drawn = s.r.space.solids;
        ASSERT_EQ(drawn.size(), nominal.size());
        for (std::size_t b = 0; b < drawn.size(); ++b) {
            if (drawn[b].role != BlockRole::epistyle)
                continue;
            for (const std::size_t axis : {0U, 2U})
                EXPECT_NEAR(drawn[b].middle_m()[axis], nominal[b].middle_m()[axis], 0.03) << i << ", " << b;
            for (std::size_t other = b + 1; other < drawn.size(); ++other) {
                const auto apart = [&](std::size_t axis, double half) {
                    return std::abs(drawn[b].middle_m()[axis] - drawn[other].middle_m()[axis]) - half;
                };
                if (drawn[other].role == BlockRole::epistyle) {
                    EXPECT_GE(std::max(apart(0, drawn[b].bottom.half_x_m + drawn[other].bottom.half_x_m),
                                       apart(2, drawn[b].bottom.half_z_m + drawn[other].bottom.half_z_m)),
                              -1e-9)
                        << i << ": " << b << ", " << other;
                }
            }
        }
    }
}

TEST(Portals, CapitalsWithEchiniAreRoundBelowAndSquareAbove)
{
    const Study study = portal_study(
        colonnade("columns = 2\ncolumn_spacing_m = 3\n", "epistyle_width_m = 0.8\n", ", echinus_height_m = 0.25"));
    const Realization r = AtRest(study).s.r;
    const Solid& capital = r.space.solids[2];
    EXPECT_TRUE(capital.bottom.round);
    EXPECT_DOUBLE_EQ(capital.bottom.half_x_m, 0.4);
    EXPECT_FALSE(capital.top.round);
    EXPECT_DOUBLE_EQ(capital.top.half_x_m, 0.5);
    const SolidJoint &bed = r.space.joints[2], &seat = r.space.joints[6];
    EXPECT_EQ(bed.upper, 2);
    EXPECT_TRUE(bed.lower_face.round && bed.upper_face.round);
    EXPECT_EQ(seat.lower, 2);
    EXPECT_FALSE(seat.lower_face.round || seat.upper_face.round);
    expect_rests(study, 2);
}

/// The same portal along z, shaken along z: its outcome is the one along x, turned.
TEST(Portals, AQuarterOfATurnTurnsTheOutcome)
{
    const std::string pulse = "kind = \"full_sine\"\nfrequency_hz = 1.2\ntail_s = 1\n";
    const std::string beam =
        "epistyle_width_m = 0.8\nepistyles = [ { first_column = 0, last_column = 1, length_m = 4 } ]\n";
    for (const std::string pga : {"3", "14"}) {
        const auto outcome = [&](const std::string& list, const std::string& direction) {
            return outcomes_of(portal_study(colonnade("column_list = " + list, beam),
                                            pulse + "pga_m_s2 = " + pga + "\ndirection_deg = " + direction + "\n"),
                               {})[0];
        };
        const Outcome x = outcome("[ { x_m = -1.5 }, { x_m = 1.5 } ]\n", "0");
        const Outcome z = outcome("[ { x_m = 0, z_m = -1.5 }, { x_m = 0, z_m = 1.5 } ]\n", "90");
        EXPECT_EQ(x.state, z.state);
        EXPECT_GT(x.peak_top_displacement_m, 0.02);
        EXPECT_NEAR(x.peak_top_displacement_m, z.peak_top_displacement_m, 1e-5 * x.peak_top_displacement_m);
        EXPECT_NEAR(x.total_rocking_rad, z.total_rocking_rad, 1e-5 * x.total_rocking_rad);
        EXPECT_NEAR(x.collapse_time_s, z.collapse_time_s, 1e-3);
        EXPECT_EQ(x.state == State::collapsed, pga == "14");
    }
}

} // namespace
} // namespace stylobate
