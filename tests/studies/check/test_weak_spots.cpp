/// Where a study is weak: each spot on a study that has it and on one that just has not; the ready studies have none.

#include "ensemble/planar/structure/nominal_statics.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/check/weak_spots.hpp"
#include "tests/studies/check/ready_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

namespace stylobate {
namespace {

std::set<std::string> names(const LoadedStudy& loaded, const Trial* trial = nullptr)
{
    std::set<std::string> all;
    for (const WeakSpot& spot : weak_spots(loaded, loaded.implausibilities(), trial)) {
        EXPECT_FALSE(spot.text.empty() || spot.todo.empty()) << spot.name;
        all.insert(spot.name);
    }
    return all;
}

bool has(const std::string& name, const LoadedStudy& loaded, const Trial* trial = nullptr)
{
    return names(loaded, trial).contains(name);
}

/// So many realizations of cell 0, of which the first ones fell, and the last ones were cut off.
Trial trial_of(std::uint64_t count, std::uint64_t fell, std::uint64_t cut = 0)
{
    Trial trial;
    TrialPart part;
    part.total = 100000;
    for (std::uint64_t i = 0; i < count; ++i)
        part.run.push_back({.index = i,
                            .cell = 0,
                            .state = i < fell ? State::collapsed : State::stood,
                            .steps = 100,
                            .cut_off = i >= count - cut,
                            .at_rest = true});
    trial.parts.push_back(part);
    return trial;
}

TEST(WeakSpots, TheStaticLimitIsThatOfOneBlock)
{
    // g B / H and mu g, by hand
    const auto limit = [](const std::string& friction) {
        return static_limit(ready("free_rocking", {"contact.friction=" + friction}).study()).value();
    };
    EXPECT_NEAR(limit("0.68").limit_m_s2, 9.81 * 48 / 174, 1e-9);
    EXPECT_NEAR(limit("0.2").limit_m_s2, 0.2 * 9.81, 1e-9);
    EXPECT_NEAR(limit("0.2").rocking_m_s2, 9.81 * 48 / 174, 1e-9);
}

/// What the implausibilities say of weak shaking; empty: nothing.
std::string weak_shaking(const LoadedStudy& loaded)
{
    for (const Implausibility& one : loaded.implausibilities())
        if (one.check == "weak_shaking") {
            EXPECT_FALSE(one.refused);
            return one.text;
        }
    return {};
}

/// Of the monolith 2.706 m/s2. A harmonic motion exceeds its nominal PGA in its ramps: with two cycles by a factor of
/// 1.0197, which 2.654 m/s2 needs; with half a cycle by 1.6137: 1.677 m/s2 (kernels/THEORY.md, section 4).
TEST(WeakSpots, ShakingBelowTheStaticLimit)
{
    EXPECT_TRUE(has("below_limit", ready("small_scale_monolith", {"surface.pga_m_s2.to=2.65"})));
    EXPECT_FALSE(has("below_limit", ready("small_scale_monolith", {"surface.pga_m_s2.to=2.66"})));
    const auto half = [](const std::string& pga) {
        return has("below_limit",
                   ready("small_scale_monolith", {"surface.pga_m_s2={ from = 1.0, to = " + pga + ", count = 4 }",
                                                  "excitation.ramp_cycles=0.5"}));
    };
    EXPECT_TRUE(half("1.67"));
    EXPECT_FALSE(half("1.68"));
    // without ramps the nominal PGA is the largest acceleration
    const auto abrupt = [](const std::string& pga) {
        return has("below_limit", ready("small_scale_monolith", {"surface.pga_m_s2.to=" + pga,
                                                                 "excitation.start=abrupt", "excitation.end=abrupt"}));
    };
    EXPECT_TRUE(abrupt("2.70"));
    EXPECT_FALSE(abrupt("2.71"));
    EXPECT_EQ(weak_shaking(ready("small_scale_monolith", {"surface.pga_m_s2.to=2.69"})), "")
        << "2.69 g is no earthquake";
    // 0.05 to 0.6 m/s2 is 0.05 to 0.6 g
    const LoadedStudy in_g = ready("small_scale_monolith", {"surface.pga_m_s2={ from = 0.05, to = 0.6, count = 4 }"});
    EXPECT_NE(weak_shaking(in_g).find("Did you mean g (0.6 g is 5.884 m/s2)?"), std::string::npos)
        << weak_shaking(in_g);
    EXPECT_FALSE(has("below_limit", in_g)) << "said once";
    const LoadedStudy weak = ready("small_scale_monolith", {"surface.pga_m_s2={ from = 0.01, to = 0.2, count = 4 }"});
    EXPECT_EQ(weak_shaking(weak), "") << "0.2 g moves it neither";
    EXPECT_TRUE(has("below_limit", weak));
}

TEST(WeakSpots, BlocksThatSlideFirst) // B / H = 0.276
{
    EXPECT_TRUE(has("slides_first", ready("free_rocking", {"contact.friction=0.26"})));
    EXPECT_FALSE(has("slides_first", ready("free_rocking", {"contact.friction=0.28"})));
    // two epistyles that meet over a column slide there as the columns rock: with rough seats, too
    EXPECT_FALSE(has("slides_first", ready("small_scale_clamped", {"contact.friction=0.62"})));
    EXPECT_TRUE(has("slides_first", ready("small_scale_clamped", {"contact.friction=0.3"})));
}

TEST(WeakSpots, ATrialInWhichAllOrNoneFall)
{
    const LoadedStudy surface = ready("small_scale_monolith");
    for (const std::uint64_t fell : {0, 60}) {
        const Trial few = trial_of(59, std::min<std::uint64_t>(fell, 59)), enough = trial_of(60, fell);
        EXPECT_FALSE(has("one_outcome", surface, &few));
        EXPECT_TRUE(has("one_outcome", surface, &enough));
    }
    const Trial both = trial_of(60, 1);
    EXPECT_FALSE(has("one_outcome", surface, &both));
    Trial unfinished = trial_of(60, 60); // the short ones have ended
    unfinished.unfinished = true;
    EXPECT_FALSE(has("one_outcome", surface, &unfinished));
}

TEST(WeakSpots, RowsThatJump)
{
    const std::vector<std::uint64_t> twenty(12, 20), five(12, 5);
    const std::vector<std::uint64_t> fell{0, 0,  20, 20, // jumps
                                          0, 10, 20, 20, // does not
                                          0, 0,  0,  0}; // has no such pair
    const Jumps jumps = jumps_of(twenty, fell, 4);
    EXPECT_EQ(jumps.rows, 2U);
    EXPECT_EQ(jumps.jumping, 1U);
    EXPECT_EQ(jumps_of(five, {0, 0, 5, 5, 0, 0, 5, 5, 0, 0, 5, 5}, 4).rows, 0U) << "of five nothing is known";

    const LoadedStudy surface = ready("small_scale_monolith"); // 8 x 8 cells
    const auto trial = [](bool jump) {
        Trial all;
        all.parts.emplace_back();
        for (std::uint64_t cell = 0; cell < 64; ++cell)
            for (std::uint64_t i = 0; i < 20; ++i) {
                const std::uint64_t column = cell % 8;
                const bool falls = column > 4 || (!jump && column == 4 && i < 10);
                all.parts[0].run.push_back({.index = 128 * cell + i,
                                            .cell = cell,
                                            .state = falls ? State::collapsed : State::stood,
                                            .steps = 100});
            }
        all.parts[0].total = 64 * 128;
        return all;
    };
    const Trial jumps_all = trial(true), rises = trial(false);
    EXPECT_TRUE(has("coarse_axis", surface, &jumps_all));
    EXPECT_FALSE(has("coarse_axis", surface, &rises));
}

TEST(WeakSpots, FewRealizationsLeaveWideIntervals)
{
    EXPECT_NEAR(worst_half_width(10000), 1.96 * 0.5 / 100, 1e-4) << "as the normal law has it";
    EXPECT_TRUE(has("wide_interval", ready("small_scale_monolith", {"study.realizations=16"})));
    EXPECT_FALSE(has("wide_interval", ready("small_scale_monolith", {"study.realizations=32"})));
    EXPECT_TRUE(has("wide_interval", ready("fragility_column", {"fragility.motions=16"})))
        << "structures do not make up for motions";
}

TEST(WeakSpots, RealizationsThatAreTheSame)
{
    EXPECT_TRUE(has("same_realizations", ready("free_rocking", {"study.realizations=30"})));
    EXPECT_FALSE(has("same_realizations", ready("free_rocking")));
    EXPECT_FALSE(has("same_realizations", ready("mechanisms")));
}

TEST(WeakSpots, SoftContacts)
{
    // docs/verification.md, found by runs of the engine: the monolith on K_N = 1e8 N/m2 holds 2.460 instead of 2.706
    EXPECT_NEAR(capacity_lost(ready("small_scale_monolith").study()), 1 - 2.460 / 2.706, 2e-3);
    const auto monolith = [](const std::string& K_n) {
        return ready("small_scale_monolith", {"contact.normal_stiffness_n_m2=" + K_n});
    };
    EXPECT_FALSE(has("soft_contacts", monolith("2e7")));
    EXPECT_TRUE(has("soft_contacts", monolith("5e6")));
    EXPECT_FALSE(has("soft_contacts", monolith("1e6"))) << "the check `sinkage` says it";
    const auto corners = [](const std::string& K_n) {
        return ready("free_rocking", {"contact.form=\"two_corner\"", "contact.normal_stiffness_n_m2=" + K_n});
    };
    EXPECT_TRUE(has("soft_contacts", corners("1e8"))) << "7.98 N / (1e8 N/m2 x 0.048 m) = 3.5e-5 of 0.048 m";
    EXPECT_FALSE(has("soft_contacts", corners("1e9")));
    EXPECT_FALSE(has("soft_contacts", ready("rigid_column")));
}

TEST(WeakSpots, LongSteps)
{
    EXPECT_TRUE(has("long_step", ready("small_scale_monolith", {"run.step_fraction=1"})));
    EXPECT_FALSE(has("long_step", ready("small_scale_monolith", {"run.step_fraction=0.9"})));
    // A rigid block of 48 x 174 mm: p2 = 3 g / (4 R), R = 90.2 mm, so that 1 / (120 p) = 0.923 ms.
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "rigid.toml";
    std::ofstream(file) << "study = { kind = \"single\" }\n"
                           "structure = { kind = \"column\", blocks = 1, drum_width_m = 0.048, drum_height_m = 0.174, "
                           "depth_m = 0.048, drum_mass_kg = 0.813 }\n"
                           "contact = { form = \"rigid\", friction = 0.68 }\n"
                           "excitation = { kind = \"none\", duration_s = 0.5 }\n";
    const auto rigid = [&](const std::string& step_s) {
        return LoadedStudy::from_file(file.string(), {"run.step_s=" + step_s});
    };
    EXPECT_TRUE(has("long_step", rigid("0.94e-3")));
    EXPECT_FALSE(has("long_step", rigid("0.91e-3")));
}

/// A study under a record that is made here.
class WeakRecord : public testing::Test {
protected:
    /// Ten seconds of 5 Hz that begin at once, and end slowly or not.
    LoadedStudy shaken(double step_s, bool whole) const
    {
        const std::string file = (folder_ / "record.txt").string();
        std::ofstream out(file);
        for (int i = 0; i * step_s <= 10; ++i) {
            const double t = i * step_s, envelope = whole ? std::min(1.0, (10 - t) / 3) : 1;
            char line[64];
            std::snprintf(line, sizeof line, "%.6f %.6f\n", t, 3 * envelope * std::sin(2 * std::numbers::pi * 5 * t));
            out << line;
        }
        out.close();
        return ready("record", {"excitation.file=" + file, "excitation.unit=\"m/s2\"", "excitation.baseline=false"});
    }

    const TemporaryFolder folder_;
};

TEST_F(WeakRecord, WithFewSamplesInAPeriod)
{
    EXPECT_TRUE(has("record_step", shaken(0.03, true))) << "6.7 samples";
    EXPECT_FALSE(has("record_step", shaken(0.02, true))) << "10 samples";
}

TEST_F(WeakRecord, ThatEndsInStrongShaking)
{
    EXPECT_TRUE(has("record_end", shaken(0.01, false)));
    EXPECT_FALSE(has("record_end", shaken(0.01, true)));
}

TEST(WeakSpots, RealizationsThatAreCutOff)
{
    const Trial cut = trial_of(100, 50, 5), none = trial_of(100, 50, 1);
    const LoadedStudy shortened = ready("small_scale_monolith", {"excitation.tail_s=0.1"});
    EXPECT_TRUE(has("cut_off", shortened, &cut));
    EXPECT_FALSE(has("cut_off", shortened, &none));
    EXPECT_FALSE(has("cut_off", ready("small_scale_monolith"), &cut)) << "the usual time after the shaking";
}

/// Blocks on beds of K_N = 1e9, damped by 0.1 at the centroid, released from half of their slenderness: the first
/// return over the slenderness, and that of a rigid block, which is Housner's.
TEST(WeakSpots, RockingThatHardlyDecays)
{
    const auto block = [](const std::string& height, const std::vector<std::string>& more = {}) {
        std::vector<std::string> settings = {
            "structure.drum_width_m=0.1",        "structure.depth_m=0.1", "structure.drum_height_m=" + height,
            "contact.normal_stiffness_n_m2=1e9", "contact.friction=3.0",  "contact.damping=\"centroid\"",
            "contact.normal_damping_ratio=0.1"};
        settings.insert(settings.end(), more.begin(), more.end());
        const TemporaryFolder folder;
        const auto file = folder.path() / "block.toml";
        std::ofstream(file)
            << "[study]\nkind = \"single\"\nallow = [\"friction\", \"first_frequency\", \"size\"]\n[structure]\n"
               "blocks = 1\ndensity_kg_m3 = 2700\n[contact]\n[excitation]\nkind = \"none\"\nduration_s = 1\n";
        return LoadedStudy::from_file(file.string(), settings);
    };
    struct Expected {
        const char* height;
        double law, rigid;
    };
    for (const auto& [height, law, rigid] : {Expected{"0.4", 0.476, 0.3865}, Expected{"0.1", 0.258, 0.0246}}) {
        const LoadedStudy loaded = block(height);
        const FreeMotion free = free_motion(loaded.study());
        ASSERT_TRUE(free.decay && free.decay->rigid);
        EXPECT_NEAR(free.decay->law, law, 0.01) << height;
        EXPECT_NEAR(*free.decay->rigid, rigid, 0.004) << height;
        EXPECT_NEAR(free.decay->housner, rigid, 3e-4) << height;
        const std::vector<WeakSpot> found = weak_spots(loaded, loaded.implausibilities(), nullptr, &free);
        const auto spot = std::ranges::find(found, "hardly_damped", &WeakSpot::name);
        ASSERT_NE(spot, found.end()) << height;
        EXPECT_NE(spot->text.find("Housner"), std::string::npos) << spot->text;
        EXPECT_NE(spot->todo.find("\"ends\""), std::string::npos);
    }
    const LoadedStudy ends = block("0.4", {"contact.damping=\"ends\"", "contact.normal_damping_ratio=0.5"});
    const FreeMotion free = free_motion(ends.study());
    const std::vector<WeakSpot> found = weak_spots(ends, ends.implausibilities(), nullptr, &free);
    EXPECT_EQ(std::ranges::find(found, "hardly_damped", &WeakSpot::name), found.end());
    EXPECT_FALSE(free_motion(ready("rigid_column").study()).mode);
}

/// Of a colonnade the first column alone, wherever it stands: `check` refused every colonnade of studies/inputs.
TEST(WeakSpots, RockingOfAColonnadeIsThatOfItsFirstColumn)
{
    const Study colonnade = ready("full_scale_colonnade_one").study();
    Study column = colonnade;
    column.structure.kind = StructureKind::column;
    column.structure.columns = {colonnade.structure.columns.front()};
    column.structure.columns.front().x_m = 0;
    column.structure.epistyles.clear();
    const FreeMotion of_colonnade = free_motion(colonnade), of_column = free_motion(column);
    ASSERT_TRUE(of_colonnade.decay && of_column.decay && of_colonnade.decay->rigid);
    EXPECT_NEAR(of_colonnade.decay->housner, 0.40321, 1e-5); // 1 x 4.4 m
    EXPECT_NEAR(*of_colonnade.decay->rigid, 0.40321, 0.01);
    EXPECT_EQ(of_colonnade.decay->law, of_column.decay->law);
    EXPECT_GT(of_colonnade.decay->law, *of_colonnade.decay->rigid);
}

TEST(WeakSpots, WhatStillMovesAtTheEnd)
{
    Trial trial = trial_of(100, 20);
    for (TrialRealization& r : trial.parts[0].run)
        r.at_rest = r.index % 10 != 0; // 8 of the 80 that stand move
    EXPECT_TRUE(has("still_moving", ready("fragility_column"), &trial));
    EXPECT_FALSE(has("still_moving", ready("small_scale_monolith"), &trial));
    for (TrialRealization& r : trial.parts[0].run)
        r.at_rest = true;
    EXPECT_FALSE(has("still_moving", ready("fragility_column"), &trial));
}

TEST(WeakSpots, WhatIsNotLookedForIsListed)
{
    const auto lines = [](const LoadedStudy& loaded, const Trial* trial) {
        return not_looked_for(loaded, trial, free_motion(loaded.study()));
    };
    const Trial fair = trial_of(60, 30);
    EXPECT_TRUE(lines(ready("small_scale_monolith"), &fair).empty());
    EXPECT_EQ(lines(ready("small_scale_monolith"), nullptr).size(), 1U);
    const auto tall =
        lines(ready("small_scale_column", {"structure.blocks=62", "contact.normal_stiffness_n_m2=1e11"}), &fair);
    ASSERT_FALSE(tall.empty());
    EXPECT_NE(tall[0].find("at most 60 free blocks, and this structure has 61"), std::string::npos) << tall[0];
}

/// Nothing is false that is never said: with a trial of each, as short as it may be.
TEST(WeakSpots, TheReadyStudiesHaveNone)
{
    Observer nobody;
    int studies = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs")) {
        if (entry.path().extension() != ".toml" || entry.path().stem() == "record") // it has no record of its own
            continue;
        const LoadedStudy loaded = ready(entry.path().stem().string());
        const Trial trial = try_study(loaded.experiment(), {best_isa(), 1}, 0.2, 0, nobody);
        std::set<std::string> found = names(loaded, &trial);
        found.erase("still_moving"); // they have the dashpots of the paper, at the centroid
        EXPECT_EQ(found, std::set<std::string>()) << entry.path();
        ++studies;
    }
    EXPECT_GT(studies, 15);
}

} // namespace
} // namespace stylobate
