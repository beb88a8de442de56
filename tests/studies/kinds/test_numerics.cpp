/// What the numerics change in a collapse probability: counted again from single runs; and what an accuracy chooses.

#include "studies/experiment/numerics.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/outcome.hpp"
#include "io/study/study_file.hpp"
#include "tests/studies/kinds/single_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace stylobate {
namespace {

const std::string input = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/rigid_column.toml";

Study rigid_surface(const std::vector<std::string>& more = {})
{
    std::vector<std::string> settings{"study.realizations=12",
                                      "surface.frequency_hz={ from = 2.0, to = 4.0, count = 2 }",
                                      "surface.pga_m_s2={ from = 3.0, to = 7.0, count = 3 }"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(input, settings);
}

TEST(Numerics, ThePilotCountsWhatTheRunsGive)
{
    const Study study = rigid_surface();
    Observer quiet;
    const NumericsCheck check = check_numerics(Experiment(study), {best_isa(), 2}, 24, quiet);
    const auto plain = collapsed_of(study), fine = collapsed_of(finer(study));
    std::uint64_t first = 0, second = 0, apart = 0;
    for (std::uint64_t i = 0; i < 24; ++i) { // of 72: every third
        first += plain.at(3 * i);
        second += fine.at(3 * i);
        apart += plain.at(3 * i) != fine.at(3 * i);
    }
    EXPECT_EQ(check.realizations, 24U);
    EXPECT_EQ(check.collapsed, first);
    EXPECT_EQ(check.finer, second);
    const double d = (static_cast<double>(first) - static_cast<double>(second)) / 24;
    EXPECT_DOUBLE_EQ(check.difference, d);
    EXPECT_NEAR(check.sd, std::sqrt(std::max(static_cast<double>(apart), 1.0) / 576 - d * d / 24), 1e-12);
    EXPECT_GT(first, 4U);
    EXPECT_LT(first, 20U);
}

TEST(Numerics, AnAccuracyChoosesTheStep)
{
    const auto step = [](const Study& study) { return Experiment(study).sampler().realization(0).step_s; };
    const double coarse = step(rigid_surface({"run.accuracy=0.02"}));
    EXPECT_DOUBLE_EQ(step(rigid_surface({"run.accuracy=0.01"})), coarse / 2);
    EXPECT_DOUBLE_EQ(step(finer(rigid_surface({"run.accuracy=0.02"}))), coarse / 4);
    Study fixed = rigid_surface();
    fixed.run.accuracy.reset();
    fixed.run.step_s = 1e-3;
    EXPECT_DOUBLE_EQ(step(finer(fixed)), 2.5e-4);
    // 1 / (120 p) of a drum of 48 x 29 mm, p2 = 3 g / (4 R): 1/1944 s; drums of other sizes by a few per mille
    EXPECT_NEAR(1 / step(rigid_surface({"run.accuracy=0.05"})), 1944, 15);
}

/// What an accuracy has chosen is a part of the numerics, and what a study gives is not.
TEST(Numerics, TheFinerPilotIsWithoutWhatWasChosen)
{
    const std::string column = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/small_scale_column.toml";
    const Study area = finer(read_study(column, {"run.accuracy=0.05"}));
    EXPECT_EQ(area.run.precision, Precision::double_);
    EXPECT_DOUBLE_EQ(area.run.step_fraction, RunSpec{}.step_fraction / 2);
    EXPECT_DOUBLE_EQ(area.contact.normal_stiffness_n_m2, 1e8);
    const Study given = finer(read_study(column, {"run.accuracy=0.05", "run.precision=\"single\""}));
    EXPECT_EQ(given.run.precision, Precision::single);
    const Study ends = finer(read_study(column, {"run.accuracy=0.05", "contact.damping=\"ends\""}));
    EXPECT_EQ(ends.run.step_bound, StepBasis::block);
    const Study rest = rigid_surface({"contact.form=\"two_corner\"", "run.accuracy=0.1"});
    EXPECT_DOUBLE_EQ(finer(rest).contact.normal_stiffness_n_m2, 10 * rest.contact.normal_stiffness_n_m2);
    EXPECT_DOUBLE_EQ(finer(rest).contact.tangential_stiffness_n_m, 10 * rest.contact.tangential_stiffness_n_m);
}

/// Without a stiffness the blocks are rigid; with one they keep their form, and only the step is chosen.
TEST(Numerics, AnAccuracyChoosesTheForm)
{
    const std::string head = "[study]\nkind = \"single\"\n[structure]\nblocks = 3\nfixed_blocks = 1\ndrum_width_m = 1\n"
                             "drum_height_m = 1\ndepth_m = 1\ndensity_kg_m3 = 2700\n[contact]\nfriction = 0.7\n";
    const std::string tail = "[excitation]\nkind = \"harmonic\"\nfrequency_hz = 1\npga_m_s2 = 4\n[run]\naccuracy = ";
    EXPECT_EQ(parse_study(head + tail + "0.02\n", "a.toml").contact.form, ContactForm::rigid);
    const Study stiff = parse_study(head + "normal_stiffness_n_m2 = 3e9\n" + tail + "0.01\n", "a.toml");
    EXPECT_EQ(stiff.contact.form, ContactForm::area);
    EXPECT_DOUBLE_EQ(stiff.run.step_fraction, RunSpec{}.step_fraction / 2);
    const std::string wrong = head + tail + "0.02\nstep_s = 0.001\n";
    EXPECT_THROW(parse_study(wrong, "a.toml"), InputError);
    const std::string rest = head + tail + "0.02\n[outcome]\nfollow = \"rest\"\n"; // hands over what falls
    EXPECT_EQ(parse_study(rest, "a.toml").contact.form, ContactForm::rigid);
    const std::string dragged = head + tail + "0.02\n[mechanisms]\ndrag = { coefficient_n_s2_m2 = 1 }\n";
    EXPECT_THROW(parse_study(dragged, "a.toml"), InputError); // what no form here reaches
    // what is written reads the same
    const Study once = parse_study(head + tail + "0.02\n", "a.toml");
    EXPECT_EQ(parse_study(once.text, "b.toml").text, once.text);
}

} // namespace
} // namespace stylobate
