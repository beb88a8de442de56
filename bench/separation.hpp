#pragma once
/// How well two sorts of campaigns can be told apart by their numbers, by an observer who knows both sorts: a linear
/// discriminant (Fisher, "The use of multiple measurements in taxonomic problems", Annals of Eugenics 7 (1936)) with a
/// shrunk correlation, each campaign judged by a fit that has not seen it.

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/campaigns/law_adjustment.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate {

struct Separation {
    std::vector<double> nulls, others; ///< scores of the campaigns left out, in standard deviations of the fit's nulls
    /// Part of the others above what a part `alpha` of the nulls exceeds.
    double power(double alpha) const
    {
        std::vector<double> sorted = nulls;
        std::sort(sorted.begin(), sorted.end());
        const double bar = sorted_quantile(sorted, 1 - alpha, QuantileDefinition::linear);
        const auto above = std::count_if(others.begin(), others.end(), [&](double score) { return score > bar; });
        return static_cast<double>(above) / static_cast<double>(others.size());
    }
};

/// A value that a campaign does not have is the mean of the nulls that have it; a column that fewer than half of the
/// nulls have, or that does not vary, is left out.
/// @param nulls (n x p), others (m x p)  NaN: missing   @param parts so many fits, each without one of them
inline Separation separate(const Eigen::MatrixXd& nulls, const Eigen::MatrixXd& others, int parts = 10)
{
    constexpr double farthest = 8; // beyond which a number counts no more, in standard deviations
    const Eigen::Index n = nulls.rows(), m = others.rows();
    Eigen::MatrixXd rows(n + m, nulls.cols());
    rows << nulls, others;
    const auto is_null = [&](Eigen::Index i) { return i < n; };
    const auto part_of = [&](Eigen::Index i) { return static_cast<int>((is_null(i) ? i : i - n) % parts); };
    Separation out;
    for (int part = 0; part < parts; ++part) {
        Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(rows.rows(), rows.cols());
        for (Eigen::Index k = 0; k < rows.cols(); ++k) {
            std::vector<double> seen;
            for (Eigen::Index i = 0; i < n; ++i)
                if (part_of(i) != part && std::isfinite(rows(i, k)))
                    seen.push_back(rows(i, k));
            if (2 * seen.size() < static_cast<std::size_t>(n - n / parts))
                continue;
            const Eigen::Map<const Eigen::ArrayXd> values(seen.data(), static_cast<Eigen::Index>(seen.size()));
            const double mean = values.mean();
            const double sd = std::sqrt((values - mean).square().mean());
            if (!(sd > 1e-12 * (1 + std::fabs(mean))))
                continue;
            for (Eigen::Index i = 0; i < rows.rows(); ++i)
                if (std::isfinite(rows(i, k)))
                    scaled(i, k) = std::clamp((rows(i, k) - mean) / sd, -farthest, farthest);
        }
        Eigen::VectorXd shift = Eigen::VectorXd::Zero(rows.cols());
        Eigen::Index count = 0;
        for (Eigen::Index i = n; i < n + m; ++i)
            if (part_of(i) != part) {
                shift += scaled.row(i).transpose();
                ++count;
            }
        shift /= static_cast<double>(count);
        std::vector<Eigen::Index> fitted;
        for (Eigen::Index i = 0; i < n + m; ++i)
            if (part_of(i) != part)
                fitted.push_back(i);
        Eigen::MatrixXd residuals = scaled(fitted, Eigen::all);
        for (std::size_t i = 0; i < fitted.size(); ++i)
            if (!is_null(fitted[i]))
                residuals.row(static_cast<Eigen::Index>(i)) -= shift.transpose();
        const Eigen::MatrixXd correlation = shrunk_correlation(residuals, Eigen::VectorXd::Ones(residuals.rows()));
        const Eigen::VectorXd direction = correlation.ldlt().solve(shift);
        const double sd = std::sqrt(std::max(direction.dot(correlation * direction), 1e-300));
        for (Eigen::Index i = 0; i < n + m; ++i)
            if (part_of(i) == part)
                (is_null(i) ? out.nulls : out.others).push_back(scaled.row(i).dot(direction) / sd);
    }
    return out;
}

} // namespace stylobate
