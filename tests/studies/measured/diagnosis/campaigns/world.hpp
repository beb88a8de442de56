#pragma once
/// A world whose truth is known, for the tests of likelihood and verdict: statistics that are linear in the law
/// descriptors, with correlated noise, and causes that shift a few of them. It shares nothing with the estimators.

#include "studies/measured/diagnosis/campaigns/synthetic_likelihood.hpp"

#include <random>
#include <vector>

namespace stylobate::test_world {

inline constexpr int descriptors = 3, statistics = 40, causes = 8;

/// What is counted of a campaign.
inline Eigen::VectorXd seen(const LawAdjustment& adjustment, const Eigen::VectorXd& law,
                            const Eigen::VectorXd& campaign)
{
    return adjustment.decorrelated(adjustment.residual(law, campaign));
}

class World {
public:
    explicit World(unsigned seed) : random_(seed)
    {
        loadings_ = draw(statistics, descriptors);
        common_ = draw(statistics, 4); // four hidden factors correlate the noise
        shifts_ = Eigen::MatrixXd::Zero(causes, statistics);
        for (int c = 0; c < causes; ++c)
            for (int k = 0; k < 3; ++k)
                shifts_(c, 5 * c + k) = (k % 2 ? -1 : 1) * 4.0;
    }

    Eigen::VectorXd law() { return draw(descriptors, 1); }
    /// A campaign of this law with a cause of this size; -1: none.
    Eigen::VectorXd campaign(const Eigen::VectorXd& law, int cause, double size)
    {
        Eigen::VectorXd out = loadings_ * law + common_ * draw(4, 1) * 0.5 + draw(statistics, 1);
        if (cause >= 0)
            out += size * shifts_.row(cause).transpose();
        return out;
    }
    /// What an observer who knows the law would see of a campaign: noise and a cause.
    Eigen::VectorXd without_law(const Eigen::VectorXd& law, const Eigen::VectorXd& campaign) const
    {
        return campaign - loadings_ * law;
    }
    Eigen::MatrixXd covariance() const
    {
        return 0.25 * common_ * common_.transpose() + Eigen::MatrixXd::Identity(statistics, statistics);
    }
    Eigen::VectorXd shift(int cause) const { return shifts_.row(cause).transpose(); }
    CampaignTable nulls(int n)
    {
        CampaignTable table{Eigen::MatrixXd(n, descriptors), Eigen::MatrixXd(n, statistics)};
        for (int i = 0; i < n; ++i) {
            const Eigen::VectorXd l = law();
            table.descriptors.row(i) = l.transpose();
            table.statistics.row(i) = campaign(l, -1, 0).transpose();
        }
        return table;
    }
    std::vector<ShiftModel> learnt(const LawAdjustment& adjustment)
    {
        std::vector<ShiftModel> models;
        for (int c = 0; c < causes; ++c) {
            Eigen::MatrixXd residuals(12, statistics);
            Eigen::VectorXd sizes(12);
            for (int i = 0; i < 12; ++i) {
                sizes(i) = (1 + i % 3) / 3.0;
                const Eigen::VectorXd l = law();
                residuals.row(i) = seen(adjustment, l, campaign(l, c, sizes(i))).transpose();
            }
            models.emplace_back(residuals, sizes);
        }
        return models;
    }

private:
    Eigen::MatrixXd draw(int rows, int columns)
    {
        return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return normal_(random_); });
    }
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    Eigen::MatrixXd loadings_, common_, shifts_;
};

} // namespace stylobate::test_world
