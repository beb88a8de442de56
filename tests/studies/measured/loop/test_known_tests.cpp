/// What tests have given, and the model that follows, in a laboratory of Gaussian estimators.

#include "studies/measured/loop/known_tests.hpp"
#include "tests/studies/measured/loop/gaussian_laboratory.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

/// Healthy specimens alone; `push` (columns 6 to 8) tells of the law, which is one number between 5 and 15 there.
TestSamples healthy_alone()
{
    gaussian::Specimens specimens(gaussian::covariance(), 21);
    TestSamples out{gaussian::columns(), Eigen::MatrixXd(400, 15), {}};
    for (Eigen::Index i = 0; i < 400; ++i)
        out.healthy.row(i) = specimens.draw().transpose().array() + 10;
    for (std::size_t j = 0; j < 15; ++j)
        out.columns[j].own_sd = 0.1;
    for (std::size_t j = 6; j < 9; ++j)
        out.columns[j].of_the_law = true;
    return out;
}

Estimate seen(double value, double sd)
{
    return {"", 0, value, sd};
}

TEST(KnownTests, ATestThatScattersMoreKnowsLessInAllItsEstimatesTogether)
{
    TestSamples samples = healthy_alone();
    samples.columns[3].test = RunKind::pull; // a second estimator of pull at joint 0
    const SequencePrior prior;
    KnownTests quiet(samples, prior), restless(samples, prior);
    for (const Eigen::Index column : {0, 3, 1}) {
        quiet.add(column, seen(10, 0.1));
        restless.add(column, seen(10, column == 1 ? 0.05 : 0.5));
    }
    const Signatures was = quiet.model().signatures, is = restless.model().signatures;
    const double more = 0.5 * 0.5 - 0.1 * 0.1;
    EXPECT_NEAR(is.covariance(0, 0) - was.covariance(0, 0), more, 1e-12);
    EXPECT_NEAR(is.covariance(3, 3) - was.covariance(3, 3), more, 1e-12);
    EXPECT_NEAR(is.covariance(0, 3) - was.covariance(0, 3), more, 1e-12) << "one bad landing moves both";
    EXPECT_NEAR(is.covariance(1, 1) - was.covariance(1, 1), 0, 1e-12) << "less than simulated ones is not more";
    EXPECT_NEAR(is.covariance(0, 1) - was.covariance(0, 1), 0, 1e-12) << "another joint";
}

TEST(KnownTests, WhatATestDidNotGiveIsNotExpectedOfItsRepeat)
{
    const TestSamples samples = healthy_alone();
    const SequencePrior prior;
    KnownTests known(samples, prior);
    EXPECT_FALSE(known.was_done(RunKind::pull));
    known.done(RunKind::pull, 0);
    known.done(RunKind::pull, 1);
    known.add(1, seen(10, 0.1));
    EXPECT_TRUE(known.was_done(RunKind::pull));
    for (const SequenceModel& model : {known.model(), known.models_after(RunKind::push).at(0)}) {
        EXPECT_FALSE(model.signatures.used[0]);
        EXPECT_TRUE(model.signatures.used[1]) << "it was given";
        EXPECT_TRUE(model.signatures.used[2]) << "not done";
    }
}

TEST(KnownTests, ATestShowsWhatTheSpecimenIsLike)
{
    const TestSamples samples = healthy_alone();
    const SequencePrior prior;
    const KnownTests known(samples, prior);
    EXPECT_TRUE(known.models_after(RunKind::drop).empty()) << "it shows nothing of the law";
    const std::vector<SequenceModel> after = known.models_after(RunKind::push);
    ASSERT_EQ(after.size(), 4U);
    const double wide = known.model().signatures.covariance(7, 7);
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_LT(after[i].signatures.covariance(7, 7), 0.5 * wide) << "the law is known then";
        if (i > 0) {
            EXPECT_GT(after[i].signatures.mean(7), after[i - 1].signatures.mean(7)) << "one quarter after the other";
        }
    }
}

} // namespace
} // namespace stylobate
