/// From studies in space to structures: bodies, beds, butt joints, mechanisms, draws in two directions, scales.

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/structure_builder.hpp"
#include "ensemble/sampling/value_sampler.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

constexpr double pi = std::numbers::pi;

Study in_space(const std::string& structure, const std::string& rest = "", const std::string& contact = "")
{
    return parse_study("[study]\nkind = \"single\"\nrealizations = 100\n[structure]\ndimensions = 3\n" + structure +
                           "[contact]\nnormal_stiffness_n_m3 = 3e9\nfriction = 0.7\n" + contact +
                           "[excitation]\nkind = \"none\"\nduration_s = 1\n" + rest,
                       "study.toml");
}

const std::string three_drums = "blocks = 3\nfixed_blocks = 1\ndrum_width_m = 1.0\ndrum_height_m = 0.8\n"
                                "density_kg_m3 = 2700\n";
const std::string free_drums = "blocks = 6\ndrum_width_m = 1.0\ndrum_height_m = 1.0\ndensity_kg_m3 = 2700\n";
const std::string two_bays = R"(kind = "colonnade"
columns = 3
column_spacing_m = 4.0
blocks = 2
drum_width_m = 1.0
drum_height_m = 1.5
density_kg_m3 = 2700
capital = { width_m = 1.2, height_m = 0.4 }
epistyle_height_m = 0.8
epistyle_width_m = 1.0
)";

Realization nominal(const Study& study)
{
    const SpatialBuilder builder(study);
    return builder.build(builder.nominal(), {});
}

TEST(SpatialBuilder, ADrumIsACylinderOnItsBed)
{
    const Realization r = nominal(in_space(three_drums));
    ASSERT_TRUE(r.spatial());
    EXPECT_TRUE(r.blocks.empty());
    ASSERT_EQ(r.space.solids.size(), 3U);
    EXPECT_EQ(r.space.drums, 3);
    EXPECT_EQ(r.space.free_solids(), 2U);
    EXPECT_TRUE(r.space.solids[0].fixed);
    const Solid& drum = r.space.solids[2];
    const double mass = 2700 * pi / 4 * 0.8;
    EXPECT_NEAR(drum.mass_kg, mass, 1e-9);
    EXPECT_NEAR(drum.inertia_kg_m2[0], mass * (3 * 0.25 + 0.64) / 12, 1e-9);
    EXPECT_NEAR(drum.inertia_kg_m2[1], mass * 0.125, 1e-9);
    EXPECT_NEAR(drum.centre_m[1], 2.0, 1e-12);
    ASSERT_EQ(r.space.joints.size(), 2U);
    const SolidJoint& joint = r.space.joints[1];
    EXPECT_EQ(joint.lower, 1);
    EXPECT_EQ(joint.upper, 2);
    EXPECT_EQ(joint.normal, Normal::y);
    EXPECT_NEAR(joint.point_m[1], 1.6, 1e-12);
    EXPECT_TRUE(joint.lower_face.round && joint.upper_face.round);
    EXPECT_EQ(joint.upper_face.half_x_m, 0.5);
    const double area = pi / 4;
    EXPECT_EQ(joint.normal_stiffness_n_m3, 3e9);
    EXPECT_NEAR(joint.tangential_stiffness_n_m, 3e9 * area, 1e-3);
    // 0.1 of critical: 2 sqrt(k A m) over the area
    EXPECT_NEAR(joint.normal_damping_n_s_m3 * area, 0.1 * 2 * std::sqrt(3e9 * area * mass), 1e-6);
    EXPECT_EQ(joint.tangential_damping_n_s_m3, joint.normal_damping_n_s_m3);
}

TEST(SpatialBuilder, OnTheGroundADiscStandsOnAWideOne)
{
    const Realization r = nominal(in_space(free_drums));
    ASSERT_EQ(r.space.solids.size(), 7U);
    const Solid& ground = r.space.solids.back();
    EXPECT_EQ(ground.role, BlockRole::ground);
    EXPECT_TRUE(ground.fixed);
    EXPECT_EQ(ground.centre_m[1] + ground.height_m / 2, 0);
    const SolidJoint& foot = r.space.joints.front();
    EXPECT_EQ(foot.lower, 6);
    EXPECT_TRUE(foot.lower_face.round);
    EXPECT_GT(foot.lower_face.half_x_m, 100);
    EXPECT_EQ(foot.lower_middle_m, (std::array<double, 2>{}));
}

TEST(SpatialBuilder, OffsetsTapersAndHollowBeds)
{
    const Realization r = nominal(in_space("drum_width_m = 1.0\ndrum_height_m = 1.0\ndensity_kg_m3 = 2700\n"
                                           "bed_inner_ratio = 0.5\n"
                                           "drums = [ { top_width_m = 0.9 }, { width_m = 0.9, offset_m = 0.02, "
                                           "offset_z_m = -0.03 } ]\n"));
    const Solid &lower = r.space.solids[0], &upper = r.space.solids[1];
    EXPECT_DOUBLE_EQ(lower.top.half_x_m, 0.45);
    EXPECT_LT(lower.centre_height_m, 0.5);
    EXPECT_NEAR(lower.middle_m()[1], 0.5, 1e-15);
    EXPECT_EQ(upper.centre_m[0], 0.02);
    EXPECT_EQ(upper.centre_m[2], -0.03);
    const SolidJoint& joint = r.space.joints[1];
    EXPECT_EQ(joint.inner_ratio, 0.5);
    // along z, then along x
    EXPECT_NEAR(joint.lower_middle_m[0], 0.03, 1e-15);
    EXPECT_NEAR(joint.lower_middle_m[1], -0.02, 1e-15);
    EXPECT_EQ(joint.upper_middle_m, (std::array<double, 2>{}));
    EXPECT_NEAR(joint.tangential_stiffness_n_m, 3e9 * pi * 0.45 * 0.45 * 0.75, 1e-3);
}

TEST(SpatialBuilder, EpistylesHaveSeatsAndButtJoints)
{
    const Realization r = nominal(in_space(two_bays));
    ASSERT_EQ(r.space.drums, 3 * 3 + 2);
    const Solid &left = r.space.solids[9], &right = r.space.solids[10];
    EXPECT_NEAR(left.middle_m()[0], (-4.6 + 0) / 2, 1e-12);
    EXPECT_EQ(left.role, BlockRole::epistyle);
    EXPECT_EQ(left.column, -1);
    ASSERT_EQ(r.space.joints.size(), 9U + 4U + 1U);
    // half of the middle capital, 1.2 m wide, under a beam of 1 m
    const SolidJoint& seat = r.space.joints[10];
    EXPECT_EQ(seat.upper, 9);
    EXPECT_NEAR(seat.point_m[0], -0.3, 1e-12);
    EXPECT_NEAR(seat.tangential_stiffness_n_m, 3e9 * 0.6 * 1.0, 1e-3);
    EXPECT_NEAR(seat.upper_middle_m[1], left.middle_m()[0] + 0.3, 1e-12);
    EXPECT_NEAR(seat.lower_middle_m[1], 0.3, 1e-12);
    const SolidJoint& butt = r.space.joints.back();
    EXPECT_EQ(butt.normal, Normal::x);
    EXPECT_EQ(butt.lower, 9);
    EXPECT_EQ(butt.upper, 10);
    EXPECT_EQ(butt.gap_m, 0);
    EXPECT_NEAR(butt.point_m[0], 0, 1e-12);
    EXPECT_NEAR(butt.point_m[1], 3.4 + 0.4, 1e-12);
    EXPECT_EQ(butt.lower_face.half_x_m, 0.4); // along y
    EXPECT_EQ(butt.lower_face.half_z_m, 0.5);
    EXPECT_NEAR(butt.tangential_stiffness_n_m, 3e9 * 0.8, 1e-3);
    EXPECT_EQ(right.mass_kg, left.mass_kg);
}

/// An epistyle that is drawn too long pushes the next one; a shorter one leaves a gap.
TEST(SpatialBuilder, LengthsOfEpistylesAreDrawn)
{
    const Study study = in_space(two_bays);
    const SpatialBuilder builder(study);
    RealizationValues values = builder.nominal();
    values[Quantity::drum_width][9] *= 1.01;
    const Realization longer = builder.build(values, {});
    const Solid &left = longer.space.solids[9], &right = longer.space.solids[10];
    EXPECT_EQ(left.bottom.half_z_m, 0.5);
    EXPECT_NEAR(right.middle_m()[0] - right.bottom.half_x_m, left.middle_m()[0] + left.bottom.half_x_m, 1e-12);
    EXPECT_EQ(longer.space.joints.back().gap_m, 0);
    values[Quantity::drum_width][9] *= 0.98;
    const Realization shorter = builder.build(values, {});
    EXPECT_NEAR(shorter.space.joints.back().gap_m, 4.6 / 2 * (1 - 1.01 * 0.98), 1e-12);
}

TEST(SpatialBuilder, DrawsInTwoDirectionsAndNoOthersMove)
{
    const std::string perturbed = "[perturbation]\ndrum_offset = { distribution = \"normal\", sd_m = 0.01 }\n"
                                  "tilt = { distribution = \"normal\", sd_rad = 0.001 }\n"
                                  "friction = { distribution = \"normal\", cov = 0.1, min = 0.4 }\n";
    const Study space = in_space(free_drums, perturbed);
    const Study plane =
        parse_study("[study]\nkind = \"single\"\nrealizations = 100\n[structure]\ndepth_m = 1\n" + free_drums +
                        "[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.7\n"
                        "[excitation]\nkind = \"none\"\nduration_s = 1\n" +
                        perturbed,
                    "plane.toml");
    const StructureBuilder in_three(space), in_two(plane);
    const ValueSampler of_space(space, in_three.nominal(), in_three.mechanisms());
    const ValueSampler of_plane(plane, in_two.nominal(), in_two.mechanisms());
    EXPECT_EQ(of_plane.input_names().size() + 6 + 1, of_space.input_names().size());
    double sum = 0, sum_z = 0, across = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        std::vector<double> inputs, planar_inputs;
        const RealizationValues a = of_space.values(of_space.points(), i, inputs);
        const RealizationValues b = of_plane.values(of_plane.points(), i, planar_inputs);
        EXPECT_EQ(a[Quantity::drum_offset], b[Quantity::drum_offset]);
        EXPECT_EQ(a[Quantity::tilt], b[Quantity::tilt]);
        EXPECT_EQ(a[Quantity::friction], b[Quantity::friction]);
        EXPECT_EQ(b[Quantity::drum_offset_z], std::vector<double>(6, 0.0));
        EXPECT_EQ(b[Quantity::tilt_x], std::vector<double>(1, 0.0));
        for (std::size_t k = 0; k < 6; ++k) {
            sum += std::pow(a[Quantity::drum_offset][k] / 0.01, 2);
            sum_z += std::pow(a[Quantity::drum_offset_z][k] / 0.01, 2);
            across += a[Quantity::drum_offset][k] * a[Quantity::drum_offset_z][k] / 1e-4;
        }
        const Realization r = in_three.build(a, {});
        EXPECT_EQ(r.space.base_tilt_rad[0], a[Quantity::tilt][0]);
        EXPECT_EQ(r.space.base_tilt_rad[1], a[Quantity::tilt_x][0]);
        EXPECT_EQ(r.space.solids[3].centre_m[2], a[Quantity::drum_offset_z][3]);
        EXPECT_FALSE(in_two.build(b, {}).spatial());
    }
    // 600 standard normal numbers: 1 within 4 sqrt(2 / 600), no correlation within 4 / sqrt(600)
    EXPECT_NEAR(sum / 600, 1, 0.231);
    EXPECT_NEAR(sum_z / 600, 1, 0.231);
    EXPECT_NEAR(across / 600, 0, 0.164);
}

TEST(SpatialBuilder, DrawnSizesKeepTheDensity)
{
    const Study study = in_space(free_drums + "top_width_m = 0.8\n");
    const SpatialBuilder builder(study);
    RealizationValues values = builder.nominal();
    values[Quantity::drum_width][2] *= 1.1;
    values[Quantity::drum_height][2] *= 0.9;
    const Realization r = builder.build(values, {}), plain = builder.build(builder.nominal(), {});
    EXPECT_NEAR(r.space.solids[2].mass_kg / plain.space.solids[2].mass_kg, 1.1 * 1.1 * 0.9, 1e-12);
    EXPECT_NEAR(r.space.solids[2].top.half_x_m / plain.space.solids[2].top.half_x_m, 1.1, 1e-12);
    EXPECT_NEAR(r.space.solids[3].middle_m()[1], 3.4, 1e-12);
    for (std::size_t i = 0; i < 6; ++i) // without a change to the last bit
        EXPECT_EQ(plain.space.solids[i].mass_kg, study.structure.columns[0].drums[i].mass_kg);
}

TEST(SpatialBuilder, Mechanisms)
{
    const Realization r =
        nominal(in_space(free_drums, "[mechanisms]\n"
                                     "stribeck = { dynamic_friction = 0.35, velocity_m_s = 0.02 }\n"
                                     "joint_friction = { joint = 1, ratio = 0.5 }\n"
                                     "face_damping = { joint = 1, share = 0.5 }\n"
                                     "friction_wear = { joint = 2, rate_per_m = 0.3 }\n"
                                     "adhesion = { joint = 3, strength_pa = 2e4 }\n"
                                     "dowel = { joint = 4, stiffness_n_m = 1e8, yield_n = 5e4 }\n"
                                     "eccentricity = { block = 2, offset_m = 0.03, offset_z_m = -0.02 }\n"
                                     "wedge = { joint = 5, angle_rad = 0.001, angle_x_rad = -0.002 }\n"
                                     "drum_offset = { block = 5, offset_m = 0.04, offset_z_m = 0.05 }\n"
                                     "tie = { block = 1, stiffness_n_m = 1e5 }\n"));
    const auto& joints = r.space.joints;
    EXPECT_DOUBLE_EQ(joints[0].mechanisms.dynamic_ratio, 0.5);
    EXPECT_EQ(joints[0].mechanisms.stribeck_velocity_m_s, 0.02);
    EXPECT_DOUBLE_EQ(joints[1].friction, 0.35);
    EXPECT_EQ(joints[1].mechanisms.face_damping, 0.5);
    EXPECT_EQ(joints[2].mechanisms.wear_per_m, 0.3);
    EXPECT_EQ(joints[3].mechanisms.adhesion_pa, 2e4);
    EXPECT_EQ(joints[4].mechanisms.dowel_yield_n, 5e4);
    EXPECT_EQ(joints[5].mechanisms.wedge_rad, 0.001);
    EXPECT_EQ(joints[5].mechanisms.wedge_x_rad, -0.002);
    const Solid& eccentric = r.space.solids[2];
    EXPECT_EQ(eccentric.eccentricity_m, (std::array<double, 2>{0.03, -0.02}));
    EXPECT_EQ(eccentric.centre_m[0], 0.03);
    EXPECT_EQ(eccentric.centre_m[2], -0.02);
    EXPECT_EQ(eccentric.middle_m()[0], 0);
    EXPECT_EQ(joints[2].point_m[0], 0); // the bed stays where it was
    EXPECT_EQ(r.space.solids[5].centre_m[0], 0.04);
    EXPECT_EQ(r.space.solids[5].centre_m[2], 0.05);
    EXPECT_EQ(r.space.solids[1].mechanisms.tie_n_m, 1e5);
}

TEST(SpatialBuilder, AStudyWithMechanismsOfTheStepIsMarkedSo)
{
    const auto marked = [](const std::string& mechanism) {
        return nominal(in_space(free_drums, "[mechanisms]\n" + mechanism + "\n")).space.with_mechanisms;
    };
    EXPECT_TRUE(marked("friction_wear = { joint = 2, rate_per_m = 0.3 }"));
    EXPECT_TRUE(marked("face_damping = { share = 0.1 }"));
    EXPECT_TRUE(marked("wedge = { joint = 5, angle_x_rad = 0.002 }"));
    EXPECT_TRUE(marked("tie = { block = 1, stiffness_n_m = 1e5 }"));
    // values of the plain step
    EXPECT_FALSE(marked("joint_friction = { joint = 1, ratio = 0.5 }"));
    EXPECT_FALSE(marked("eccentricity = { block = 2, offset_m = 0.03 }"));
    EXPECT_FALSE(nominal(in_space(free_drums)).space.with_mechanisms);
}

TEST(SpatialBuilder, DashpotsAtTheEndsAreThoseOfEveryJoint)
{
    Study study = in_space(free_drums);
    study.contact.damping = DampingAt::ends;
    const Realization r = nominal(study);
    EXPECT_TRUE(r.space.with_mechanisms);
    for (const SolidJoint& joint : r.space.joints) {
        EXPECT_EQ(joint.mechanisms.face_damping, 1);
        EXPECT_NEAR(joint.area_m2, std::numbers::pi * 0.25, 1e-12);
    }
}

TEST(SpatialBuilder, StructuresThatCannotBeBuilt)
{
    const auto message = [](const Study& study, const auto& change) {
        try {
            const SpatialBuilder builder(study);
            RealizationValues values = builder.nominal();
            change(values);
            RealizationHeader header;
            header.index = 7;
            builder.build(values, header);
            return std::string();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
    };
    const std::string apart = message(in_space(free_drums), [](RealizationValues& values) {
        values[Quantity::drum_offset][3] = 0.8;
        values[Quantity::drum_offset_z][3] = -0.8;
    });
    EXPECT_NE(apart.find("in realization 7 drum 4 lies at x = 0.8 m, z = -0.8 m"), std::string::npos) << apart;
    const std::string room =
        message(in_space(two_bays), [](RealizationValues& values) { values[Quantity::drum_width][9] = 9; });
    EXPECT_NE(room.find("realization 7"), std::string::npos) << room;
    std::string outside = "[mechanisms]\neccentricity = { block = 2, offset_m = 0.3, offset_z_m = 0.3 }\n";
    EXPECT_EQ(message(in_space(free_drums, outside), [](RealizationValues&) {}), "");
    const std::string edge = message(in_space(free_drums, outside), [](RealizationValues& values) {
        values.all[RealizationValues::slot(0, 1)][2] = 0.45;
    });
    EXPECT_NE(edge.find("mechanisms.eccentricity: in realization 7 the centre of mass of drum 3"), std::string::npos)
        << edge;
}

/// A single cylinder: the least energy that overturns it is m g (sqrt(R2 + h2) - h), h half its height.
TEST(SpatialScales, OfACylinderAndOfItsNarrowestFace)
{
    const Realization one = nominal(in_space("blocks = 1\ndrum_width_m = 1.0\ndrum_height_m = 4.0\n"
                                             "density_kg_m3 = 2700\n"));
    const Scales s = spatial_scales(one);
    const double mass = 2700 * pi / 4 * 4;
    EXPECT_NEAR(s.barrier_j, mass * 9.81 * (std::hypot(0.5, 2) - 2), 1e-6);
    EXPECT_NEAR(s.p_rad_s, std::sqrt(0.75 * 9.81 / std::hypot(0.5, 2)), 1e-12);
    EXPECT_EQ(s.width_m, 1);
    EXPECT_EQ(s.least_size_m, 0.5);

    const Realization slab = nominal(in_space("blocks = 1\nshape = \"rectangle\"\ndrum_width_m = 2.0\n"
                                              "drum_depth_m = 0.6\ndrum_height_m = 3.0\ndensity_kg_m3 = 2700\n"));
    EXPECT_NEAR(spatial_scales(slab).barrier_j, 2 * 0.6 * 3 * 2700 * 9.81 * (std::hypot(0.3, 1.5) - 1.5), 1e-6);
    EXPECT_EQ(spatial_scales(slab).least_size_m, 0.3);

    // of six drums the uppermost alone is overturned with the least energy, unless others are eccentric
    const Scales six = spatial_scales(nominal(in_space(free_drums)));
    const double drum = 2700 * pi / 4;
    double least = 1e300;
    for (int above = 1; above <= 6; ++above)
        least = std::min(least, above * drum * 9.81 * (std::hypot(0.5, above / 2.0) - above / 2.0));
    EXPECT_NEAR(six.barrier_j, least, 1e-6);
}

} // namespace
} // namespace stylobate
