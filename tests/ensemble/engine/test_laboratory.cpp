/// Studies of what a laboratory does to a block, from their text to their outcome.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "kernels/isa.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace stylobate {
namespace {

constexpr double width = 1, height = 4, weight = width * height * 2700 * 9.81;

/// A block of 1 x 4 m. @param excitation, more lines of the study file
Outcome outcome_of(const std::string& excitation, const std::string& more, double friction = 0.7)
{
    const Study study = parse_study(
        "[study]\nkind = \"single\"\n[structure]\nblocks = 1\ndrum_width_m = 1\ndrum_height_m = 4\n"
        "depth_m = 1\ndensity_kg_m3 = 2700\n[excitation]\n" +
            excitation + "\n[contact]\nnormal_stiffness_n_m2 = 1e9\nfriction = " + std::to_string(friction) + "\n" +
            more,
        "block.toml");
    EXPECT_EQ(parse_study(study.text, "again.toml").text, study.text);
    Outcome outcome;
    RunPlan plan;
    plan.total = 1;
    plan.sink = [&](const Realization&, const Outcome& ended) { outcome = ended; };
    Observer nobody;
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, nobody);
    EXPECT_LT(std::fabs(outcome.energy_residual), 0.02);
    return outcome;
}

const std::string still = "kind = \"none\"\nduration_s = 20";

} // namespace

TEST(LaboratoryStudies, ARodPushesABlockOverWhenItGoesFarEnough)
{
    // at its top it overturns it after a way of its width
    const auto pushed = [](double travel_m) {
        return outcome_of(still,
                          "[mechanisms]\nrod = { to_right_n_m = 1e6, height_m = 4, speed_m_s = 0.2, travel_m = " +
                              std::to_string(travel_m) + " }\n");
    };
    EXPECT_EQ(pushed(0.6).state, State::rocked);
    const Outcome over = pushed(1.2);
    EXPECT_EQ(over.state, State::collapsed);
    // its work lifts the centre of mass over the corner, and no more than a part of it is kinetic
    const double barrier = weight * (std::hypot(width, height) - height) / 2;
    EXPECT_GT(over.energy_base_work_j, 0.9 * barrier) << "its bed yields";
    EXPECT_LT(over.energy_base_work_j, 1.3 * barrier);
}

TEST(LaboratoryStudies, ATableTiltsUntilTheBlockSlidesOrFalls)
{
    const auto tilted = [](double angle, double friction) {
        return outcome_of(still,
                          "[mechanisms]\ntable_tilt = { angle_rad = " + std::to_string(angle) +
                              ", rate_rad_s = 0.02, start_s = 1 }\n",
                          friction);
    };
    EXPECT_EQ(tilted(0.15, 0.7).state, State::stood);
    EXPECT_EQ(tilted(0.27, 0.7).state, State::collapsed) << "atan(1 / 4) = 0.245";
    EXPECT_EQ(tilted(-0.27, 0.7).state, State::collapsed);
    EXPECT_EQ(tilted(0.15, 0.12).state, State::slid) << "atan(0.12) = 0.119";
}

TEST(LaboratoryStudies, ARaisedBlockFallsOntoItsBed)
{
    const Outcome o = outcome_of(still, "[initial]\nlift_m = 0.01\n");
    EXPECT_NE(o.state, State::collapsed);
    EXPECT_NEAR(o.energy_damping_j + o.energy_friction_j, weight * 0.01, 0.2 * weight * 0.01);
    EXPECT_LT(o.energy_kinetic_j, 1e-3 * weight * 0.01);
}

TEST(LaboratoryStudies, ARodIsWaitedForAfterTheShaking)
{
    const std::string shaken = "kind = \"half_sine\"\nfrequency_hz = 2\npga_m_s2 = 0.5";
    const std::string rod = "[mechanisms]\nrod = { to_right_n_m = 1e6, height_m = 4, speed_m_s = 0.2, start_s = 30, "
                            "travel_m = 1.2 }\n";
    EXPECT_EQ(outcome_of(shaken, {}).state, State::stood);
    EXPECT_EQ(outcome_of(shaken, rod).state, State::collapsed);
}

} // namespace stylobate
