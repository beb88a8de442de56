/// Surfaces over the direction of the shaking: a row is the study in that direction, and a turned shaking of a
/// symmetric column gives the turned outcome.

#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

using OutcomeBits = std::vector<std::vector<std::uint64_t>>;

const std::string square_column = R"(
[structure]
dimensions = 3
shape = "square"
blocks = 3
drum_width_m = 0.5
drum_height_m = 0.8
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m3 = 1e9
friction = 0.7
)";
const std::string drawn_offsets = R"(
[perturbation]
drum_offset = { distribution = "normal", sd_m = 0.002, per = "block" }
)";

Study surface_over(const std::string& directions, const std::string& pga, const std::string& excitation,
                   const std::string& perturbation = drawn_offsets)
{
    return parse_study("[study]\nkind = \"surface\"\nrealizations = 3\n[surface]\ndirection_deg = " + directions +
                           "\npga_m_s2 = " + pga + "\n[excitation]\n" + excitation + square_column + perturbation,
                       "surface.toml");
}

OutcomeBits bits_of(const std::vector<Outcome>& outcomes)
{
    OutcomeBits bits;
    for (const Outcome& outcome : outcomes)
        bits.push_back(outcome_bits(outcome));
    return bits;
}

/// The plain study of this direction and PGA: its realizations have the draws of the first cell of a surface.
OutcomeBits plain(double direction, double pga, const std::string& excitation)
{
    return bits_of(
        outcomes_of(parse_study("[study]\nkind = \"single\"\nrealizations = 3\n[excitation]\ndirection_deg = " +
                                    std::to_string(direction) + "\npga_m_s2 = " + std::to_string(pga) + "\n" +
                                    excitation + square_column + drawn_offsets,
                                "single.toml"),
                    {}));
}

OutcomeBits first_cell(const Study& surface)
{
    OutcomeBits bits = bits_of(outcomes_of(surface, {}));
    bits.resize(3);
    return bits;
}

TEST(DirectionRows, ARowIsTheStudyInItsDirection)
{
    const std::string pulse = "kind = \"full_sine\"\nfrequency_hz = 1.5\ntail_s = 1\n";
    EXPECT_EQ(first_cell(surface_over("{ from = 0, to = 90, count = 2 }", "{ from = 4, to = 7, count = 2 }", pulse)),
              plain(0, 4, pulse));
    EXPECT_EQ(first_cell(surface_over("{ from = 37, to = 37, count = 1 }", "{ from = 5, to = 5, count = 1 }", pulse)),
              plain(37, 5, pulse));
    EXPECT_NE(plain(37, 5, pulse), plain(0, 5, pulse));
}

TEST(DirectionRows, NoiseHasTheFrequencyOfTheExcitationInEveryRow)
{
    const std::string noise = "kind = \"noise\"\nfrequency_hz = 2\nrise_s = 0.3\nstrong_s = 1\ndecay_s = "
                              "0.2\ntail_s = 0.5\npga_of = \"mean\"\nsecond_ratio = 0.8\n";
    EXPECT_EQ(first_cell(surface_over("{ from = 25, to = 65, count = 3 }", "{ from = 3, to = 3, count = 1 }", noise)),
              plain(25, 3, noise));
    const Study study =
        surface_over("{ from = 25, to = 65, count = 3 }", "{ from = 3, to = 3, count = 1 }", noise, drawn_offsets);
    const Experiment experiment(study);
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        const Realization r = experiment.sampler().realization(i);
        EXPECT_EQ(r.frequency_hz, 2) << i;
        EXPECT_NEAR(r.direction_rad, (25 + 20 * static_cast<double>(i / 3)) * std::numbers::pi / 180, 1e-15) << i;
    }
}

/// One component, no imperfection: the rows 0 and 90 degrees of a square column differ in their axes alone. The gentle
/// shaking rocks it, the strong one overturns it; while it falls, rounding in the plane of the shaking grows out of it
/// (spatial motion is unstable), to a few parts in 10,000.
TEST(DirectionRows, ASquareColumnFallsAlikeAlongBothItsAxes)
{
    const std::string pulse = "kind = \"full_sine\"\nfrequency_hz = 1.5\ntail_s = 3\n";
    const Study study =
        surface_over("{ from = 0, to = 90, count = 2 }", "{ from = 2.6, to = 9, count = 2 }", pulse, "");
    const std::vector<Outcome> outcomes = outcomes_of(study, {});
    ASSERT_EQ(outcomes.size(), 12U);
    for (const bool strong : {false, true}) {
        const Outcome &x = outcomes[strong ? 3 : 0], &z = outcomes[strong ? 9 : 6];
        const double rounding = strong ? 1e-5 : 1e-9;
        EXPECT_EQ(x.state, strong ? State::collapsed : State::rocked);
        EXPECT_EQ(x.state, z.state);
        EXPECT_GT(x.peak_top_displacement_m, 0.02);
        EXPECT_NEAR(z.peak_top_displacement_m / x.peak_top_displacement_m, 1, rounding);
        EXPECT_NEAR(z.total_rocking_rad / x.total_rocking_rad, 1, rounding);
        EXPECT_NEAR(x.collapse_time_s, z.collapse_time_s, rounding);
        for (const Outcome* each : {&x, &z})
            EXPECT_LT(each->out_of_plane_share, strong ? 1e-3 : 1e-9);
        if (strong) {
            const double quarter = z.fall_azimuth_rad - x.fall_azimuth_rad - std::numbers::pi / 2;
            EXPECT_NEAR(std::remainder(quarter, 2 * std::numbers::pi), 0, 3e-3);
        }
    }
}

} // namespace
} // namespace stylobate
