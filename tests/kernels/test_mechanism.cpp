/// Mechanisms as a whole: neutral ones give the baseline's bits; others the same ones on every instruction
/// set and beside any neighbour.

#include "tests/kernels/mechanism_runs.hpp"
#include "tests/kernels/uneven_drums.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace stylobate;
using namespace stylobate::model;

namespace {

/// Six uneven drums that rock and slide.
Realization shaken_drums(unsigned seed, double pga_m_s2)
{
    Realization r = stack(uneven_drums(seed), {1e8, 0.1, 0.3}, 6e-5);
    r.frequency_hz = 4;
    r.pga_m_s2 = pga_m_s2;
    return r;
}

/// A mechanism on its own, at a size that shows.
struct Case {
    std::string name;
    std::function<void(Realization&)> set;
};

void each_joint(Realization& r, const std::function<void(JointMechanisms&)>& set)
{
    for (int j = 0; j < r.beds(); ++j)
        set(r.joints[static_cast<std::size_t>(j)].mechanisms);
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    const auto joint = [&](const char* name, void (*set)(JointMechanisms&)) {
        all.push_back({name, [set](Realization& r) { each_joint(r, set); }});
    };
    joint("stribeck", [](JointMechanisms& e) {
        e.dynamic_ratio = 0.6;
        e.stribeck_velocity_m_s = 0.02;
    });
    joint("friction_wear", [](JointMechanisms& e) { e.wear_per_m = 5; });
    joint("adhesion", [](JointMechanisms& e) { e.adhesion_n_m = 20; });
    joint("dowel", [](JointMechanisms& e) {
        e.dowel_stiffness_n_m = 1e5;
        e.dowel_yield_n = 2;
        e.dowel_gap_m = 1e-4;
    });
    joint("hertz", [](JointMechanisms& e) {
        e.force_exponent = 1.4;
        e.reference_overlap_m2 = 5e-8;
    });
    joint("rate_damping", [](JointMechanisms& e) { e.rate_s_m = 0.5; });
    joint("face_damping", [](JointMechanisms& e) { e.face_damping = 0.7; });
    joint("corner_loss", [](JointMechanisms& e) {
        e.chip_left_m = 0.002;
        e.chip_right_m = 0.001;
    });
    joint("corner_wear", [](JointMechanisms& e) { e.corner_wear_m_rad = 0.003; });
    joint("wedge", [](JointMechanisms& e) { e.wedge_rad = 0.002; });
    all.push_back({"drag", [](Realization& r) {
                       for (Block& block : r.blocks)
                           block.mechanisms.drag_n_s2_m2 = 0.5;
                   }});
    all.push_back({"tie", [](Realization& r) {
                       for (Block& block : r.blocks) {
                           block.mechanisms.tie_n_m = 40;
                           block.mechanisms.tie_n_s_m = 0.5;
                           block.mechanisms.tie_n = 0.05;
                           block.mechanisms.tie_n_m_s = 1e-4;
                       }
                   }});
    all.push_back({"rod", [](Realization& r) {
                       BlockMechanisms& e = r.blocks[3].mechanisms;
                       e.rod_right_n_m = 2e3;
                       e.rod_left_n_m = 1e3;
                       e.rod_height_m = 0.01;
                       e.rod_speed_m_s = -0.02;
                       e.rod_start_s = 0.01;
                       e.rod_travel_m = 0.003;
                       e.rod_laboratory = 0.5;
                   }});
    all.push_back({"table_tilt", [](Realization& r) {
                       std::vector<double> acceleration(100, 0.0);
                       acceleration[1] = 10;
                       acceleration[60] = -10;
                       r.tilt = std::make_shared<const Motion>(motion_of(std::move(acceleration), 0.01));
                   }});
    joint("adhesion with tension", [](JointMechanisms& e) {
        e.adhesion_n_m = 20;
        e.adhesion_tension_n_m = 30;
    });
    all.push_back({"eccentricity", [](Realization& r) {
                       for (Block& block : r.blocks)
                           block.mechanisms.eccentricity_m = block.fixed ? 0 : 0.001;
                   }});
    const auto held = [&](const char* name, void (*set)(JointStrengthening&)) {
        all.push_back({name, [set](Realization& r) {
                           for (int j = 0; j < r.beds(); ++j)
                               set(r.joints[static_cast<std::size_t>(j)].strengthening);
                       }});
    };
    held("bearing", [](JointStrengthening& e) {
        e.bearing_n_m = 50;
        e.bearing_n_s_m = 2;
        e.bearing_per_m = 3;
    });
    held("mortar", [](JointStrengthening& e) {
        e.bond_tension_n_m = 30;
        e.bond_cohesion_n_m = 20;
    });
    held("pull_out", [](JointStrengthening& e) {
        e.hold_n = 0.2;
        e.hold_stiffness_n_m = 1e5;
        e.hold_length_m = 1e-3;
        e.hold_spread_m = 0.01;
    });
    all.push_back({"tendon", [](Realization& r) {
                       r.blocks.back().strengthening.tendon_n_m = 5e3;
                       r.blocks.back().strengthening.tendon_prestress_n = 3;
                       r.blocks.back().strengthening.tendon_yield_n = 5;
                   }});
    all.push_back({"table_pitch", [](Realization& r) { r.base.pitch_rad_s2_m = 1e-3; }});
    all.push_back({"vertical_motion", [](Realization& r) { r.base.vertical_ratio = 0.3; }});
    all.push_back({"two_corner", [](Realization& r) { r.form = ContactForm::two_corner; }});
    all.push_back({"points", [](Realization& r) { r.form = ContactForm::points; }});
    return all;
}

} // namespace

TEST(Mechanism, NeutralOnesGiveTheBitsOfTheFormWithoutThem)
{
    const Study study = harmonic(8, 1);
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        std::vector<Realization> plain;
        for (unsigned seed = 1; seed <= 8; ++seed) {
            plain.push_back(shaken_drums(seed, 1.5 + 0.5 * seed));
            plain.back().form = form;
            if (form != ContactForm::area)
                plain.back().step_s = 3e-5;
        }
        std::vector<Realization> neutral = plain;
        for (Realization& r : neutral)
            r.with_mechanisms = true;
        std::vector<Realization> held = neutral;
        for (Realization& r : held)
            r.strengthened = true;
        const std::vector<Bits> want = run_bits(Isa::scalar, study, plain, 300);
        EXPECT_NE(want[0], want[7]);
        for (const Isa isa : usable_isas()) {
            EXPECT_EQ(run_bits(isa, study, plain, 300), want) << to_string(isa) << ' ' << static_cast<int>(form);
            EXPECT_EQ(run_bits(isa, study, neutral, 300), want) << to_string(isa) << ' ' << static_cast<int>(form);
            EXPECT_EQ(run_bits(isa, study, held, 300), want) << to_string(isa) << ' ' << static_cast<int>(form);
        }
    }
}

TEST(Mechanism, NeutralOnesGiveTheBaselinesBitsInAColonnadeThatFalls)
{
    Study study = harmonic(4, 0.5);
    study.outcome.follow = Follow::rest;
    Bed bed;
    bed.xi = 0.1;
    Realization r = colonnade(paper_colonnade(2), bed, 3e-5);
    r.frequency_hz = 2;
    r.pga_m_s2 = 12;
    Realization neutral = r;
    neutral.with_mechanisms = true;
    const std::vector<Bits> want = run_bits(best_isa(), study, {r}, 1500);
    EXPECT_EQ(run_bits(best_isa(), study, {neutral}, 1500), want);
    EXPECT_EQ(run_bits(Isa::scalar, study, {neutral}, 1500), want);
    neutral.strengthened = true;
    neutral.blocks[1].strengthening.clamp_to = 4; // a clamp of no stiffness
    EXPECT_EQ(run_bits(best_isa(), study, {neutral}, 1500), want);
}

TEST(Mechanism, ClampsHaveTheSameBitsOnEveryInstructionSetBesideAnyNeighbour)
{
    const Study study = harmonic(4, 0.5);
    Bed bed;
    bed.xi = 0.1;
    Realization plain = colonnade(paper_colonnade(2), bed, 3e-5);
    plain.frequency_hz = 2;
    plain.pga_m_s2 = 9;
    plain.strengthened = true;
    // a drum of the left column and the one beside it
    std::vector<int> drums;
    for (std::size_t i = 0; i < plain.blocks.size(); ++i)
        if (!plain.blocks[i].fixed && plain.blocks[i].role == BlockRole::drum)
            drums.push_back(static_cast<int>(i));
    ASSERT_EQ(drums.size(), 4u);
    plain.blocks[static_cast<std::size_t>(drums[1])].strengthening.clamp_to = drums[3];
    std::vector<Realization> all(4, plain);
    for (std::size_t i = 1; i < all.size(); ++i) {
        BlockStrengthening& clamp = all[i].blocks[static_cast<std::size_t>(drums[1])].strengthening;
        clamp.clamp_n_m = 2e4;
        clamp.clamp_strength_n = i == 1 ? 2 : 50;
        clamp.clamp_gap_m = i == 2 ? 1e-4 : 0;
        clamp.clamp_compression = i == 3 ? 0 : 1;
        clamp.clamp_height_m = 0.01;
        clamp.clamp_break_m = i == 3 ? 0.002 : 10;
    }
    std::vector<Bits> want;
    for (const Realization& r : all)
        want.push_back(run_bits(Isa::scalar, study, {r}, 400).front());
    for (std::size_t i = 1; i < all.size(); ++i)
        EXPECT_NE(want[i], want[0]) << i;
    for (const Isa isa : usable_isas()) {
        const std::vector<Bits> got = run_bits(isa, study, all, 400);
        for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_EQ(got[i], want[i]) << i << ' ' << to_string(isa);
    }
}

TEST(Mechanism, EachHasTheSameBitsOnEveryInstructionSetBesideAnyNeighbour)
{
    const Study study = harmonic(6, 1);
    for (const ContactForm form : {ContactForm::area, ContactForm::two_corner, ContactForm::points}) {
        std::vector<Realization> all;
        std::vector<std::string> names;
        Realization plain = shaken_drums(7, 3);
        plain.with_mechanisms = true;
        plain.strengthened = true;
        plain.form = form;
        plain.step_s = 3e-5; // safe for all
        for (const Case& c : cases()) {
            Realization r = plain;
            c.set(r);
            if (r.form != form || (form != ContactForm::area &&
                                   (c.name == "face_damping" || c.name == "mortar"))) // their dashpots are there
                continue;
            all.push_back(r);
            names.push_back(c.name);
        }
        std::vector<Bits> want;
        for (const Realization& r : all)
            want.push_back(run_bits(Isa::scalar, study, {r}, 200).front());
        const Bits neutral = run_bits(Isa::scalar, study, {plain}, 200).front();
        for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_TRUE(want[i] != neutral || names[i] == "two_corner" || names[i] == "points") << names[i];
        for (const Isa isa : usable_isas()) {
            const std::vector<Bits> got = run_bits(isa, study, all, 200);
            for (std::size_t i = 0; i < all.size(); ++i)
                EXPECT_EQ(got[i], want[i]) << names[i] << ' ' << to_string(isa);
        }
    }
}
