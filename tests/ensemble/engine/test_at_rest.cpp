/// Whether a structure lies still at the end, and what is known of its residual displacements then.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"
#include "kernels/isa.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace stylobate {
namespace {

/// A block of 1 x 4 m. @param excitation, more lines of the study file
Outcome outcome_of(const std::string& excitation, const std::string& more = {})
{
    const Study study =
        parse_study("[study]\nkind = \"single\"\n[structure]\nblocks = 1\ndrum_width_m = 1\n"
                    "drum_height_m = 4\ndepth_m = 1\ndensity_kg_m3 = 2700\n[excitation]\n" +
                        excitation + "\n[contact]\nnormal_stiffness_n_m2 = 1e9\nfriction = 0.7\n" + more,
                    "block.toml");
    const Experiment experiment(study);
    Outcome outcome;
    RunPlan plan;
    plan.total = 1;
    plan.sink = [&](const Realization&, const Outcome& ended) { outcome = ended; };
    Observer nobody;
    run_ensemble(experiment, {best_isa(), 1}, plan, nobody);
    return outcome;
}

void expect_known(const Outcome& o, bool known)
{
    EXPECT_EQ(o.at_rest, known ? 1 : 0);
    for (const double residual : {o.residual_top_displacement_m, o.residual_sliding_m, o.residual_dislocation})
        EXPECT_EQ(std::isfinite(residual), known);
}

TEST(AtRest, ABlockThatStands)
{
    const Outcome o = outcome_of("kind = \"none\"\nduration_s = 3");
    expect_known(o, true);
    EXPECT_LT(std::fabs(o.residual_top_displacement_m), 1e-9);
}

TEST(AtRest, ABlockThatRocksIsNot)
{
    const std::string released = "[initial]\ntilt_rad = 0.12\n";
    expect_known(outcome_of("kind = \"none\"\nduration_s = 3", released), false);
    expect_known(
        outcome_of("kind = \"none\"\nduration_s = 60", "damping = \"ends\"\nnormal_damping_ratio = 0.5\n" + released),
        true);
}

/// 2 / p of rest are seen after the shaking: p = sqrt(3 g / (4 R)) = 1.889 rad/s, 1.06 s.
TEST(AtRest, IsSeenForAWhileAfterTheShaking)
{
    const std::string weak = "kind = \"half_sine\"\nfrequency_hz = 5\npga_m_s2 = 0.5\ntail_s = ";
    expect_known(outcome_of(weak + "1"), false);
    expect_known(outcome_of(weak + "1.2"), true);
}

/// Until it lies still: with dashpots at the ends long before the limit, with none never.
TEST(AtRest, TailsUntilRest)
{
    const std::string pulse = "kind = \"half_sine\"\nfrequency_hz = 1\npga_m_s2 = 3\ntail_s = ";
    const std::string ends = "damping = \"ends\"\nnormal_damping_ratio = 0.3\n";
    const Outcome rested = outcome_of(pulse + "\"rest\"", ends);
    expect_known(rested, true);
    EXPECT_GT(rested.max_relative_rotation_rad, 0.01);
    EXPECT_LT(rested.end_time_s, 60);
    const Outcome rocks = outcome_of(pulse + "\"rest\"", "normal_damping_ratio = 0\ntangential_damping_ratio = 0\n");
    expect_known(rocks, false);
    EXPECT_NEAR(rocks.end_time_s, 0.5 + 240 / 1.889, 0.2);
    const Outcome usual = outcome_of(pulse + "\"structure\"", ends);
    EXPECT_LT(usual.end_time_s, 0.5 + 12 / 1.889 + 0.1);
}

/// A pulse that just does not overturn it brings the block so near to its balance, and so slowly, that it hovers there
/// for longer than 2 / p: it falls or it comes back, but it does not lie still half a width aside.
TEST(AtRest, ABlockThatHoversNearItsBalanceIsNot)
{
    const auto at = [](double pga) {
        return outcome_of("kind = \"half_sine\"\nfrequency_hz = 1\ntail_s = \"rest\"\npga_m_s2 = " +
                              std::to_string(pga),
                          "damping = \"ends\"\nnormal_damping_ratio = 0.3\n");
    };
    double stands = 3, falls = 12;
    while (falls - stands > 1e-5) {
        const double middle = 0.5 * (stands + falls);
        const Outcome o = at(middle);
        (o.state == State::collapsed ? falls : stands) = middle;
        if (o.at_rest == 1) {
            EXPECT_LT(std::fabs(o.residual_top_displacement_m), 0.1) << middle;
        }
    }
    EXPECT_EQ(at(stands).at_rest, 1);
    EXPECT_LT(std::fabs(at(stands).residual_top_displacement_m), 0.1);
}

} // namespace
} // namespace stylobate
