#include "studies/measured/diagnosis/campaigns/force_test.hpp"

#include "studies/measured/diagnosis/campaigns/conformal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

// The unit of a score is this quantile of its size in healthy campaigns,
constexpr double unit_quantile = 0.9;
// together with a score that noise alone gives. Healthy campaigns that do not show a variant count with 0: that a joint
// slides where it would not is what a low friction shows.
constexpr double least_unit = 0.7;
constexpr int score_parts = 6;

// Of a normal score, in standard deviations: what a unit is.
constexpr double unit_sd = 1.6449;

double weighted_quantile(std::vector<std::pair<double, double>> weighted, double part)
{
    std::sort(weighted.begin(), weighted.end());
    double all = 0;
    for (const auto& [value, weight] : weighted)
        all += weight;
    double below = 0;
    for (const auto& [value, weight] : weighted) {
        below += weight;
        if (below >= part * all)
            return value;
    }
    return weighted.back().first;
}

class Units {
public:
    /// @param left_out every `score_parts`-th campaign from here is left out; -1: none is
    Units(const ForceEvidence& evidence, int left_out)
    {
        for (Eigen::Index v = 0; v < evidence.nulls.cols(); ++v) {
            std::vector<std::pair<double, double>> sizes;
            for (Eigen::Index i = 0; i < evidence.nulls.rows(); ++i) {
                if (left_out >= 0 && i % score_parts == left_out)
                    continue;
                const double weight = evidence.likeness.empty() ? 1 : evidence.likeness[static_cast<std::size_t>(i)];
                const double size = std::fabs(evidence.nulls(i, v));
                sizes.emplace_back(std::isfinite(size) ? size : 0, weight);
            }
            unit_.push_back(std::hypot(weighted_quantile(std::move(sizes), unit_quantile), least_unit));
        }
    }

    double score(const Eigen::VectorXd& scores, std::size_t variant) const
    {
        const double value = scores(static_cast<Eigen::Index>(variant)) / unit_[variant];
        return std::isfinite(value) ? std::fabs(value) : 0;
    }

    ForceTest largest(const Eigen::VectorXd& scores) const
    {
        ForceTest out;
        for (std::size_t v = 0; v < unit_.size(); ++v)
            if (const double s = score(scores, v); s > out.score) {
                out.score = s;
                out.variant = static_cast<int>(v);
            }
        return out;
    }

    const std::vector<double>& each() const { return unit_; }

private:
    std::vector<double> unit_;
};

} // namespace

double nats_of_score(double score)
{
    return 0.5 * std::pow(unit_sd * score, 2);
}

ForceTest force_test(const ForceEvidence& evidence)
{
    const Units all(evidence, -1);
    ForceTest out = all.largest(evidence.campaign);
    out.unit = all.each();
    out.likeness = evidence.likeness;
    std::vector<Units> without;
    for (int part = 0; part < score_parts; ++part)
        without.emplace_back(evidence, part);
    for (Eigen::Index i = 0; i < evidence.nulls.rows(); ++i)
        out.nulls.push_back(without[static_cast<std::size_t>(i % score_parts)].largest(evidence.nulls.row(i)).score);
    out.p_value = conformal_p_value(out.nulls, out.score, evidence.likeness);
    return out;
}

} // namespace stylobate
