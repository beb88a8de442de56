/// The verdict from simulated campaigns, in a world whose truth is known.

#include "studies/measured/diagnosis/campaigns/ensemble_verdict.hpp"
#include "tests/studies/measured/diagnosis/campaigns/world.hpp"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

using namespace test_world;

class EnsembleVerdictStatistics : public testing::Test {
protected:
    EnsembleVerdictStatistics() : world_(21)
    {
        evidence_.nulls = world_.nulls(300);
        constexpr int of_each = 9;
        LabelledCampaigns& labelled = evidence_.labelled;
        labelled.table = {Eigen::MatrixXd(causes * of_each, descriptors),
                          Eigen::MatrixXd(causes * of_each, statistics)};
        for (int i = 0; i < causes * of_each; ++i) {
            const Eigen::VectorXd law = world_.law();
            labelled.cause.push_back(i % causes);
            labelled.size.push_back((1 + i / causes % 3) / 3.0);
            labelled.table.descriptors.row(i) = law.transpose();
            labelled.table.statistics.row(i) =
                world_.campaign(law, labelled.cause.back(), labelled.size.back()).transpose();
        }
        for (int i = 0; i < 300; ++i)
            evidence_.null_fold.push_back(i % 5);
        for (int i = 0; i < causes * of_each; ++i)
            evidence_.labelled_fold.push_back(i % 5);
        for (int c = 0; c < causes; ++c)
            evidence_.mechanism.push_back(c);
        for (int j = 0; j < statistics; ++j)
            evidence_.common.push_back(j % 5); // eight joints of five statistics each
    }

    EnsembleVerdict judge(const Eigen::VectorXd& law, const Eigen::VectorXd& campaign)
    {
        evidence_.descriptors = law;
        evidence_.statistics = campaign;
        return ensemble_verdict(evidence_);
    }

    World world_;
    EnsembleEvidence evidence_;
};

TEST_F(EnsembleVerdictStatistics, HealthyCampaignsAreSeldomNamed)
{
    int named = 0;
    const int n = 120;
    for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd law = world_.law();
        const EnsembleVerdict verdict = judge(law, world_.campaign(law, -1, 0));
        named += verdict.named ? 1 : 0;
    }
    EXPECT_LE(named, 6) << "0.9 of 120 are expected";
}

/// Who knows law, covariance and shifts: the largest likelihood ratio over causes and sizes, by least squares.
class Oracle {
public:
    explicit Oracle(World& world) : world_(world), inverse_(world.covariance().inverse())
    {
        for (int i = 0; i < 2000; ++i) {
            const Eigen::VectorXd law = world.law();
            nulls_.push_back(gain(law, world.campaign(law, -1, 0)));
        }
    }
    bool names(const Eigen::VectorXd& law, const Eigen::VectorXd& campaign) const
    {
        return conformal_p_value(nulls_, gain(law, campaign)) <= EnsembleRule{}.named;
    }

private:
    double gain(const Eigen::VectorXd& law, const Eigen::VectorXd& campaign) const
    {
        const Eigen::VectorXd seen = inverse_ * world_.without_law(law, campaign);
        double best = 0;
        for (int c = 0; c < causes; ++c) {
            const Eigen::VectorXd shift = world_.shift(c);
            const double size = std::clamp(shift.dot(seen) / shift.dot(inverse_ * shift), 0.0, 1.0);
            best = std::max(best, size * shift.dot(seen) - 0.5 * size * size * shift.dot(inverse_ * shift));
        }
        return best;
    }
    World& world_;
    Eigen::MatrixXd inverse_;
    std::vector<double> nulls_;
};

TEST_F(EnsembleVerdictStatistics, CausesAreNamedWithProbabilitiesThatHold)
{
    const Oracle oracle(world_);
    int named = 0, right = 0, alone = 0, possible = 0;
    double stated = 0;
    for (int i = 0; i < 80; ++i) {
        const Eigen::VectorXd law = world_.law();
        const int rank = i / causes;
        const Eigen::VectorXd campaign = world_.campaign(law, i % causes, 0.3 + 0.07 * rank);
        possible += oracle.names(law, campaign) ? 1 : 0;
        const EnsembleVerdict verdict = judge(law, campaign);
        if (!verdict.named)
            continue;
        ++named;
        stated += verdict.probability;
        right += verdict.best == i % causes ? 1 : 0;
        alone += verdict.set.empty() ? 1 : 0;
    }
    EXPECT_GT(possible, 40);
    EXPECT_GE(named, 0.6 * possible) << "of those that can be named at all";
    EXPECT_GE(right, 0.95 * named);
    EXPECT_NEAR(stated / named, static_cast<double>(right) / named, 0.1);
    EXPECT_GE(alone, 0.7 * named) << "shifts of different statistics are told apart";
}

TEST_F(EnsembleVerdictStatistics, PowerIsTheShareThatIsNamed)
{
    const Eigen::VectorXd law = world_.law();
    const EnsembleVerdict verdict = judge(law, world_.campaign(law, -1, 0));
    ASSERT_EQ(verdict.labelled_right.size(), evidence_.labelled.cause.size());
    std::vector<double> power(causes, 0);
    for (std::size_t i = 0; i < verdict.labelled_right.size(); ++i)
        power[static_cast<std::size_t>(evidence_.labelled.cause[i])] += verdict.labelled_right[i] ? 1.0 / 9 : 0;
    const Oracle oracle(world_);
    for (int c = 0; c < causes; ++c) {
        int named = 0;
        const int n = 90;
        for (int i = 0; i < n; ++i) {
            const Eigen::VectorXd of = world_.law();
            named += oracle.names(of, world_.campaign(of, c, (1 + i % 3) / 3.0)) ? 1 : 0;
        }
        // nine labelled campaigns: standard deviation 0.17
        EXPECT_NEAR(power[static_cast<std::size_t>(c)], static_cast<double>(named) / n, 0.5) << c;
        EXPECT_GT(power[static_cast<std::size_t>(c)], 0.2) << c;
    }
    EXPECT_EQ(verdict.null_gains.size(), 300U) << "each is left out once";
}

} // namespace
} // namespace stylobate
