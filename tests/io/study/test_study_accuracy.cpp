/// What `run.accuracy` chooses where a study gives nothing, and what it refuses.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stylobate {
namespace {

/// Two free cubes of a metre on a fixed one.
const std::string cubes = R"([study]
kind = "single"
[structure]
blocks = 3
fixed_blocks = 1
drum_width_m = 1
drum_height_m = 1
depth_m = 1
density_kg_m3 = 2700
[contact]
friction = 0.7
[excitation]
kind = "harmonic"
frequency_hz = 1
pga_m_s2 = 4
[run]
accuracy = 0.1
)";

Study with(const std::vector<std::string>& settings)
{
    return parse_study(cubes, "cubes.toml", settings);
}

std::vector<std::string> chosen(const Study& study)
{
    std::vector<std::string> keys;
    for (const NumericsChoice& choice : study.chosen) {
        keys.push_back(choice.key);
        EXPECT_FALSE(choice.reason.empty()) << choice.key;
    }
    return keys;
}

void refused(const std::vector<std::string>& settings, const std::vector<std::string>& words)
{
    try {
        with(settings);
        ADD_FAILURE() << "accepted, without " << words.front();
    } catch (const InputError& error) {
        for (const std::string& word : words)
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

using Keys = std::vector<std::string>;

TEST(StudyAccuracy, BlocksAreRigidWhereNothingMustYield)
{
    const Study study = with({});
    EXPECT_EQ(study.contact.form, ContactForm::rigid);
    EXPECT_EQ(chosen(study), (Keys{"contact.form", "run.precision"}));
    EXPECT_EQ(chosen(with({"contact.form=\"rigid\""})), Keys{"run.precision"}); // the form is given
    EXPECT_EQ(chosen(with({"contact.form=\"rigid\"", "run.precision=\"double\""})), Keys{});
    EXPECT_EQ(with({"run.accuracy=0.019"}).run.precision, Precision::double_);
    EXPECT_EQ(with({"outcome.follow=\"rest\""}).run.precision, Precision::double_);
    // what is written reads the same, and chooses nothing any more
    const Study again = parse_study(study.text, "again.toml");
    EXPECT_EQ(again.text, study.text);
    EXPECT_EQ(chosen(again), Keys{});
}

/// 2 x 2700 kg x 9.81 m/s2 over a width of 1 m, a sinkage of 1e-5 m: 5.3e9 N/m2.
TEST(StudyAccuracy, TwoCornersAndTheirStiffnessWhereSomethingMustYield)
{
    const Study study = with({"mechanisms.stribeck.dynamic_friction=0.5", "mechanisms.stribeck.velocity_m_s=0.01"});
    EXPECT_EQ(study.contact.form, ContactForm::two_corner);
    EXPECT_DOUBLE_EQ(study.contact.normal_stiffness_n_m2, 5.3e9);
    EXPECT_EQ(chosen(study), (Keys{"contact.form", "contact.normal_stiffness_n_m2"}));
    EXPECT_EQ(parse_study(study.text, "again.toml").text, study.text);
    const Study given = with({"contact.form=\"two_corner\""});
    EXPECT_DOUBLE_EQ(given.contact.normal_stiffness_n_m2, 5.3e9);
    EXPECT_EQ(chosen(given), Keys{"contact.normal_stiffness_n_m2"});
}

TEST(StudyAccuracy, RefusesWhatNoChoiceReaches)
{
    refused({"contact.form=\"area\""}, {"contact.normal_stiffness_n_m2 is missing", "two_corner"});
    refused({"contact.form=\"points\""}, {"contact.normal_stiffness_n_m2 is missing", "points"});
    refused({"mechanisms.drag.coefficient_n_s2_m2=1", "run.accuracy=0.09"},
            {"run.accuracy", "not reached by any stiffness", "drag"});
    refused({"mechanisms.hertz.exponent=1.5"}, {"mechanisms.hertz", "how contacts yield", "normal_stiffness_n_m2"});
    refused({"mechanisms.rate_damping.rate_s_m=1"}, {"mechanisms.rate_damping", "how contacts yield"});
    refused({"mechanisms.face_damping.share=0.5"}, {"mechanisms.face_damping", "how contacts yield"});
    refused({"mechanisms.drag.coefficient_n_s2_m2=1",
             "perturbation.normal_stiffness={ distribution = \"lognormal\", sigma_ln = 0.7 }"},
            {"perturbation.normal_stiffness", "a stiffness that the study does not give"});
    refused({"run.step_s=1e-4"}, {"run.accuracy", "step_s exclude each other"});
}

TEST(StudyAccuracy, StepsAndPrecisionOfAGivenStiffness)
{
    const std::string stiff = "contact.normal_stiffness_n_m2=3e9", ends = "contact.damping=\"ends\"";
    const Study plain = with({stiff});
    EXPECT_EQ(plain.contact.form, ContactForm::area);
    EXPECT_EQ(plain.run.precision, Precision::single);
    EXPECT_EQ(plain.run.step_fraction, RunSpec{}.step_fraction);
    EXPECT_EQ(chosen(plain), Keys{"run.precision"});
    const Study again = parse_study(plain.text, "again.toml");
    EXPECT_EQ(again.text, plain.text);
    EXPECT_EQ(again.run.precision, Precision::single);

    EXPECT_EQ(with({stiff, "run.precision=\"double\""}).run.precision, Precision::double_);
    EXPECT_EQ(with({stiff, "outcome.follow=\"rest\""}).run.precision, Precision::double_); // it gains nothing there
    EXPECT_EQ(with({stiff, "contact.form=\"two_corner\""}).run.precision, Precision::double_);
    const Study colonnade = read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/full_scale_colonnade_two.toml",
                                       {"outcome.follow=\"collapse\"", "run.accuracy=0.05"});
    EXPECT_EQ(colonnade.run.precision, Precision::double_); // nor there
    EXPECT_EQ(chosen(colonnade), Keys{});

    const Study at_ends = with({stiff, ends});
    EXPECT_EQ(at_ends.run.step_bound, StepBasis::structure);
    EXPECT_EQ(at_ends.run.precision, Precision::double_); // is not available there
    EXPECT_EQ(chosen(at_ends), Keys{"run.step_bound"});
    EXPECT_EQ(with({stiff, ends, "run.step_bound=\"block\""}).run.step_bound, StepBasis::block);

    EXPECT_EQ(with({stiff, ends, "run.accuracy=0.04"}).run.step_bound, StepBasis::block);

    const Study fine = with({stiff, "run.accuracy=0.01"});
    EXPECT_DOUBLE_EQ(fine.run.step_fraction, RunSpec{}.step_fraction / 2);
    EXPECT_EQ(fine.run.precision, Precision::double_);
    EXPECT_EQ(chosen(fine), Keys{"run.step_fraction"});
    EXPECT_EQ(parse_study(fine.text, "again.toml").text, fine.text);
}

TEST(StudyAccuracy, NothingIsChosenUnlessItIsAsked)
{
    std::string text = cubes;
    text.resize(text.find("[run]"));
    EXPECT_THROW(parse_study(text, "cubes.toml"), InputError); // no stiffness
    const Study study = parse_study(text, "cubes.toml", {"contact.normal_stiffness_n_m2=3e9"});
    EXPECT_EQ(chosen(study), Keys{});
    EXPECT_EQ(study.run.precision, Precision::double_);
}

} // namespace
} // namespace stylobate
