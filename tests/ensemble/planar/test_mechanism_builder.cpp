/// What the mechanisms of a study make of its realizations: mechanisms, draws, and what cannot be built.

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace stylobate {
namespace {

/// Seven drums, the lowest one fixed; six joints.
Study specimen()
{
    Study study;
    study.seed = 11;
    study.realizations = 1000;
    study.structure = equal_column(7, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 4.8e6;
    study.contact.friction = 0.68;
    study.excitation.kind = ExcitationKind::harmonic;
    study.excitation.frequency_hz = 2.5;
    study.excitation.pga_m_s2 = 2.15;
    return study;
}

void add(Study& study, Mechanism mechanism, std::array<double, most_parameters> values, std::vector<int> places = {})
{
    study.mechanisms.push_back({mechanism, std::move(places), values});
}

Realization made(const Study& study, std::uint64_t index = 0)
{
    return Sampler(study, nullptr).realization(index);
}

MechanismPerturbation normal(Mechanism mechanism, std::size_t parameter, Per per, double sd)
{
    MechanismPerturbation p;
    p.mechanism = mechanism;
    p.parameter = parameter;
    p.per = per;
    p.sd = sd;
    return p;
}

TEST(MechanismBuilder, EveryParameterReachesItsMember)
{
    Study study = specimen();
    add(study, Mechanism::stribeck, {0.51, 0.05}, {3});
    add(study, Mechanism::joint_friction, {0.57}, {0});
    add(study, Mechanism::drag, {0.1}, {6});
    add(study, Mechanism::corner_loss, {0.002, 0.003}, {1});
    add(study, Mechanism::hertz, {1.2, 3e-7}, {2});
    add(study, Mechanism::rate_damping, {0.3});
    add(study, Mechanism::face_damping, {0.4});
    add(study, Mechanism::friction_wear, {0.5});
    add(study, Mechanism::corner_wear, {0.001});
    add(study, Mechanism::table_pitch, {1e-4});
    add(study, Mechanism::vertical_motion, {0.25});
    add(study, Mechanism::harmonic_distortion, {0.01, 0.02, 0.03, 0.04});
    add(study, Mechanism::time_offset, {-0.0127});
    add(study, Mechanism::sensor_gain, {0.88});
    add(study, Mechanism::dowel, {1e5, 20, 1e-3}, {5});
    add(study, Mechanism::adhesion, {3});
    add(study, Mechanism::eccentricity, {-0.001}, {2, 4});
    add(study, Mechanism::wedge, {0.0041}, {0});
    add(study, Mechanism::drum_offset, {0.0005}, {2});
    const Realization r = made(study), plain = made(specimen());
    ASSERT_EQ(r.joints.size(), 6u);
    const auto joint = [&](std::size_t j) { return r.joints[j].mechanisms; };
    EXPECT_DOUBLE_EQ(joint(3).dynamic_ratio, 0.75);
    EXPECT_EQ(joint(3).stribeck_velocity_m_s, 0.05);
    EXPECT_EQ(joint(2).dynamic_ratio, 1);
    EXPECT_EQ(r.joints[0].friction, 0.57 * 0.68);
    EXPECT_EQ(r.joints[1].friction, 0.68);
    EXPECT_EQ(r.blocks[6].mechanisms.drag_n_s2_m2, 0.1);
    EXPECT_EQ(r.blocks[5].mechanisms.drag_n_s2_m2, 0);
    EXPECT_EQ(joint(1).chip_left_m, 0.002);
    EXPECT_EQ(joint(1).chip_right_m, 0.003);
    EXPECT_EQ(joint(2).force_exponent, 1.2);
    EXPECT_EQ(joint(2).reference_overlap_m2, 3e-7);
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_EQ(joint(j).rate_s_m, 0.3);
        EXPECT_EQ(joint(j).face_damping, 0.4);
        EXPECT_EQ(joint(j).wear_per_m, 0.5);
        EXPECT_EQ(joint(j).corner_wear_m_rad, 0.001);
        EXPECT_EQ(joint(j).adhesion_n_m, 3);
    }
    EXPECT_EQ(r.base, (BaseMechanisms{1e-4, 0.25}));
    EXPECT_EQ(r.change, (BaseChange{0.88, -0.0127, 0.01, 0.02, 0.03, 0.04}));
    EXPECT_EQ(joint(5).dowel_stiffness_n_m, 1e5);
    EXPECT_EQ(joint(5).dowel_yield_n, 20);
    EXPECT_EQ(joint(5).dowel_gap_m, 1e-3);
    EXPECT_EQ(r.blocks[4].mechanisms.eccentricity_m, -0.001);
    EXPECT_EQ(r.blocks[3].mechanisms.eccentricity_m, 0);
    EXPECT_EQ(joint(0).wedge_rad, 0.0041);
    EXPECT_EQ(r.blocks[2].x_m, plain.blocks[2].x_m + 0.0005);
    EXPECT_EQ(r.blocks[3].x_m, plain.blocks[3].x_m);
    EXPECT_TRUE(r.with_mechanisms);
    EXPECT_FALSE(plain.with_mechanisms);
    EXPECT_TRUE(r.inputs.empty());
}

TEST(MechanismBuilder, NeutralValuesLeaveTheBaseline)
{
    const Realization plain = made(specimen());
    for (const MechanismRule& rule : mechanism_rules()) {
        Study study = specimen();
        study.mechanisms.push_back(neutral_spec(rule.mechanism, study.contact.friction));
        const Realization r = made(study);
        EXPECT_FALSE(r.with_mechanisms) << rule.name;
        EXPECT_EQ(r.base, BaseMechanisms{}) << rule.name;
        EXPECT_EQ(r.change, BaseChange{}) << rule.name;
        EXPECT_EQ(r.step_s, plain.step_s) << rule.name;
        for (std::size_t j = 0; j < r.joints.size(); ++j) {
            EXPECT_EQ(r.joints[j].mechanisms, JointMechanisms{}) << rule.name;
            EXPECT_EQ(r.joints[j].friction, plain.joints[j].friction) << rule.name;
        }
        for (std::size_t i = 0; i < r.blocks.size(); ++i) {
            EXPECT_EQ(r.blocks[i].mechanisms, BlockMechanisms{}) << rule.name;
            EXPECT_EQ(r.blocks[i].x_m, plain.blocks[i].x_m) << rule.name;
        }
    }
}

TEST(MechanismBuilder, WhatIsOfTheBaseAloneNeedsNoExtendedStep)
{
    for (const Mechanism mechanism : {Mechanism::joint_friction, Mechanism::drum_offset, Mechanism::time_offset,
                                      Mechanism::sensor_gain, Mechanism::harmonic_distortion}) {
        Study study = specimen();
        add(study, mechanism, {0.001});
        EXPECT_FALSE(made(study).with_mechanisms) << to_string(mechanism);
    }
    for (const Mechanism mechanism : {Mechanism::stribeck, Mechanism::hertz, Mechanism::table_pitch, Mechanism::drag}) {
        Study study = specimen();
        study.mechanisms.push_back(neutral_spec(mechanism, 0.68));
        study.mechanisms.back().values[0] *= 1.1;
        study.mechanisms.back().values[0] += 1e-4;
        EXPECT_TRUE(made(study).with_mechanisms) << to_string(mechanism);
    }
}

TEST(MechanismBuilder, ContactFormsAndDampingAtTheEnds)
{
    Study study = specimen();
    study.contact.form = ContactForm::two_corner;
    EXPECT_EQ(made(study).form, ContactForm::two_corner);
    EXPECT_FALSE(made(study).with_mechanisms); // a form by itself has a step of its own
    study.contact.damping = DampingAt::ends;
    EXPECT_FALSE(made(study).with_mechanisms); // where its dashpots are at its points anyway
    study.contact.form = ContactForm::area;
    study.contact.damping = DampingAt::ends;
    const Realization r = made(study);
    EXPECT_TRUE(r.with_mechanisms);
    for (const Joint& joint : r.joints)
        EXPECT_EQ(joint.mechanisms.face_damping, 1);
}

TEST(MechanismBuilder, TheReferenceOfHertzIsTheWeightOnTheBed)
{
    Study study = specimen();
    add(study, Mechanism::hertz, {1.5, 0});
    const Realization r = made(study);
    for (int j = 0; j < 6; ++j) // six free drums, so many of which stand on the bed
        EXPECT_NEAR(r.joints[static_cast<std::size_t>(j)].mechanisms.reference_overlap_m2,
                    (6 - j) * 0.1355 * 9.81 / 1e8, 1e-20);
}

TEST(MechanismBuilder, StribeckOnBedsWithTheirOwnFriction)
{
    Study study = specimen();
    study.structure.columns[0].drums[2].bed.friction = 0.4; // of joint 1
    add(study, Mechanism::stribeck, {0.51, 0.05});
    const Realization r = made(study);
    EXPECT_EQ(r.joints[1].friction, 0.4);
    EXPECT_DOUBLE_EQ(r.joints[1].mechanisms.dynamic_ratio, 0.75); // of its own, 0.3
}

TEST(MechanismBuilder, DrawsForEachPlaceWhereItActs)
{
    Study study = specimen();
    add(study, Mechanism::joint_friction, {0.6}, {1, 4});
    add(study, Mechanism::wedge, {0.002}, {3});
    add(study, Mechanism::drag, {0.1});
    study.mechanism_perturbations = {normal(Mechanism::joint_friction, 0, Per::joint, 0.05),
                                     normal(Mechanism::drag, 0, Per::structure, 0.01),
                                     normal(Mechanism::wedge, 0, Per::joint, 0.001)};
    const Sampler sampler(study, nullptr);
    const std::vector<std::string> names = {
        "joint_friction_ratio[0]", "joint_friction_ratio[1]", "joint_friction_ratio[2]", "joint_friction_ratio[3]",
        "joint_friction_ratio[4]", "joint_friction_ratio[5]", "drag_coefficient",        "wedge_angle"};
    EXPECT_EQ(sampler.input_names(), names);
    const Realization r = sampler.realization(5);
    ASSERT_EQ(r.inputs.size(), names.size());
    for (const std::size_t j : {0u, 2u, 3u, 5u})
        EXPECT_EQ(r.inputs[j], 1);
    EXPECT_NE(r.inputs[1], r.inputs[4]);
    EXPECT_EQ(r.joints[1].friction, 0.68 * r.inputs[1]);
    EXPECT_EQ(r.joints[4].friction, 0.68 * r.inputs[4]);
    EXPECT_EQ(r.joints[0].friction, 0.68);
    for (std::size_t i = 1; i < 7; ++i)
        EXPECT_EQ(r.blocks[i].mechanisms.drag_n_s2_m2, r.inputs[6]);
    EXPECT_EQ(r.blocks[0].mechanisms.drag_n_s2_m2, 0); // fixed
    EXPECT_EQ(r.joints[3].mechanisms.wedge_rad, r.inputs[7]);

    // another place, another mechanism: the draws stay
    study.mechanisms[0].places = {1, 2, 4};
    study.mechanisms.pop_back();
    study.mechanism_perturbations.erase(study.mechanism_perturbations.begin() + 1);
    const Realization other = Sampler(study, nullptr).realization(5);
    EXPECT_EQ(other.inputs[1], r.inputs[1]);
    EXPECT_EQ(other.inputs[4], r.inputs[4]);
    EXPECT_EQ(other.inputs[6], r.inputs[7]);
}

TEST(MechanismBuilder, DrawsHaveTheirDistribution)
{
    Study study = specimen();
    add(study, Mechanism::wedge, {0.002}, {0, 2});
    study.mechanism_perturbations = {normal(Mechanism::wedge, 0, Per::joint, 0.001)};
    const Sampler sampler(study, nullptr);
    double sum = 0, squares = 0, product = 0;
    constexpr int count = 1000;
    for (std::uint64_t i = 0; i < count; ++i) {
        const Realization r = sampler.realization(i);
        const double a = (r.joints[0].mechanisms.wedge_rad - 0.002) / 0.001;
        const double b = (r.joints[2].mechanisms.wedge_rad - 0.002) / 0.001;
        sum += a;
        squares += a * a;
        product += a * b;
    }
    // four standard deviations: fails once in 16,000 seeds, and the seed is fixed
    EXPECT_NEAR(sum / count, 0, 4 / std::sqrt(count));
    EXPECT_NEAR(squares / count, 1, 4 * std::sqrt(2.0 / count));
    EXPECT_NEAR(product / count, 0, 4 / std::sqrt(count));
}

TEST(MechanismBuilder, StreamsStayAndAreDistinct)
{
    // numbers of the results that exist: they never change
    EXPECT_EQ(static_cast<int>(stream_of(Mechanism::stribeck, 0)), 128);
    EXPECT_EQ(static_cast<int>(stream_of(Mechanism::joint_friction, 0)), 136);
    EXPECT_EQ(static_cast<int>(stream_of(Mechanism::harmonic_distortion, 3)), 128 + 8 * 11 + 3);
    EXPECT_EQ(static_cast<int>(stream_of(Mechanism::drum_offset, 0)), 128 + 8 * 18);
    EXPECT_LE(most_parameters, 8u);
}

TEST(MechanismBuilder, WhatALaboratoryDoesReachesItsMembers)
{
    Study study = specimen();
    add(study, Mechanism::rod, {2e4, 1e4, 0.02, -0.03, 0.2, 0.01, 1}, {3});
    add(study, Mechanism::table_tilt, {-0.5, 0.04, 0.3});
    study.initial.lift_m = 0.002;
    const Realization r = made(study);
    EXPECT_TRUE(r.with_mechanisms);
    EXPECT_FALSE(r.strengthened);
    const BlockMechanisms& e = r.blocks[3].mechanisms;
    EXPECT_EQ(e.rod_right_n_m, 2e4);
    EXPECT_EQ(e.rod_left_n_m, 1e4);
    EXPECT_EQ(e.rod_height_m, 0.02);
    EXPECT_EQ(e.rod_speed_m_s, -0.03);
    EXPECT_EQ(e.rod_start_s, 0.2);
    EXPECT_EQ(e.rod_travel_m, 0.01);
    EXPECT_EQ(e.rod_laboratory, 1);
    EXPECT_EQ(r.blocks[2].mechanisms, BlockMechanisms{});
    EXPECT_EQ(r.initial_lift_m, 0.002);
    // from 0 to the angle in |angle| / rate and a sample more, at that rate in between
    ASSERT_TRUE(r.tilt);
    EXPECT_EQ(r.base.tilt_start_s, 0.3);
    const Motion& tilt = *r.tilt;
    EXPECT_NEAR(tilt.displacement_m.back(), -0.5, 1e-12);
    EXPECT_NEAR(tilt.velocity_m_s.back(), 0, 1e-12);
    EXPECT_NEAR(tilt.velocity_m_s[tilt.velocity_m_s.size() / 2], -0.04, 1e-12);
    EXPECT_NEAR(tilt.duration_s(), 0.5 / 0.04 + 3 * tilt.dt_s, 1e-9);
    EXPECT_LT(tilt.dt_s, 0.11);
}

TEST(MechanismBuilder, AdhesionAgainstOpeningNeedsTheRowsOfABond)
{
    Study study = specimen();
    add(study, Mechanism::adhesion, {30, 0, 0}, {1});
    EXPECT_FALSE(made(study).strengthened);
    EXPECT_FALSE(made(study).joints[1].bonded());
    EXPECT_EQ(made(study).joints[1].adhesion_n_m(), 30);
    Study bonded = specimen();
    add(bonded, Mechanism::adhesion, {30, 0, 50}, {1});
    const Realization r = made(bonded);
    EXPECT_TRUE(r.strengthened);
    EXPECT_TRUE(r.joints[1].bonded());
    EXPECT_EQ(r.joints[1].adhesion_n_m(), 0) << "the bond has it";
    EXPECT_EQ(r.joints[1].bond_cohesion_n_m(), 30);
    EXPECT_EQ(r.joints[1].bond_tension_n_m(), 50);
    EXPECT_FALSE(r.joints[2].bonded());
}

TEST(MechanismBuilder, StrengtheningReachesTheirMembers)
{
    Study study = specimen();
    add(study, Mechanism::tendon, {1e4, 30, 200});
    add(study, Mechanism::bearing, {2e4, 30, 0.5});
    add(study, Mechanism::mortar, {2e5, 3e5}, {2});
    add(study, Mechanism::pull_out, {50, 1e6, 0.01, 0.012}, {1, 3});
    const Realization r = made(study);
    EXPECT_TRUE(r.with_mechanisms);
    EXPECT_TRUE(r.strengthened);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(r.blocks[i].strengthening.tendon_n_m, i == 6 ? 1e4 : 0) << i;
        EXPECT_EQ(r.blocks[i].strengthening.tendon_prestress_n, i == 6 ? 30 : 0) << i;
    }
    EXPECT_EQ(r.blocks[6].strengthening.tendon_yield_n, 200);
    EXPECT_EQ(r.joints[0].strengthening.bearing_n_m, 2e4);
    EXPECT_EQ(r.joints[0].strengthening.bearing_n_s_m, 30);
    EXPECT_EQ(r.joints[0].strengthening.bearing_per_m, 0.5);
    EXPECT_EQ(r.joints[1].strengthening.bearing_n_m, 0);
    EXPECT_EQ(r.joints[2].strengthening.bond_tension_n_m, 2e5 * 0.048);
    EXPECT_EQ(r.joints[2].strengthening.bond_cohesion_n_m, 3e5 * 0.048);
    EXPECT_FALSE(r.joints[1].bonded());
    EXPECT_EQ(r.joints[3].strengthening.hold_n, 50);
    EXPECT_EQ(r.joints[3].strengthening.hold_stiffness_n_m, 1e6);
    EXPECT_EQ(r.joints[3].strengthening.hold_length_m, 0.01);
    EXPECT_EQ(r.joints[3].strengthening.hold_spread_m, 0.012);
    // neutral ones need no rows
    Study neutral = specimen();
    add(neutral, Mechanism::tendon, {0, 0, 1e12});
    EXPECT_FALSE(made(neutral).with_mechanisms);
    EXPECT_FALSE(made(neutral).strengthened);
    EXPECT_EQ(made(neutral).step_s, made(specimen()).step_s);
}

TEST(MechanismBuilder, WhatCannotBeBuiltIsRefused)
{
    const auto message = [](const Study& study) {
        try {
            made(study);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    Study chipped = specimen();
    add(chipped, Mechanism::corner_loss, {0.03, 0.02}, {1});
    EXPECT_NE(message(chipped).find("realization 0 joint 1 loses 0.05 m of its face of 0.048 m"), std::string::npos)
        << message(chipped);
    Study eccentric = specimen();
    add(eccentric, Mechanism::eccentricity, {0.03}, {4});
    EXPECT_NE(message(eccentric).find("block 4 lies 0.03 m from its middle"), std::string::npos) << message(eccentric);
    Study tensioned = specimen();
    add(tensioned, Mechanism::tendon, {1e4, 300, 200});
    EXPECT_NE(message(tensioned).find("realization 0 at block 6: prestress_n = 300 is above yield_n = 200"),
              std::string::npos)
        << message(tensioned);
}

} // namespace
} // namespace stylobate
