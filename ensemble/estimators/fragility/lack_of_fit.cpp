#include "ensemble/estimators/fragility/lack_of_fit.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <boost/math/distributions/fisher_f.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

/// (points x terms) powers beyond the first of each predictor, orthonormal for the trials to all terms before.
Eigen::MatrixXd bending_terms(const FittedCurve& curve)
{
    const Eigen::Index points = curve.predictors.rows(), parameters = curve.predictors.cols();
    Eigen::MatrixXd all = curve.predictors;
    const auto append = [&](const Eigen::VectorXd& column) {
        all.conservativeResize(Eigen::NoChange, all.cols() + 1);
        all.col(all.cols() - 1) = column;
    };
    if (parameters == 2) {
        // from the middle of the data, so that powers stay apart
        const Eigen::ArrayXd x = curve.predictors.col(1).array();
        const Eigen::ArrayXd centred = (x - (x * curve.counts.trials.array()).sum() / curve.counts.trials.sum());
        const Eigen::ArrayXd u = centred / centred.abs().maxCoeff();
        for (Eigen::Index power = 2; power <= std::min<Eigen::Index>(4, points - 1); ++power)
            append(u.pow(static_cast<double>(power)).matrix());
    } else
        for (Eigen::Index j = 1; j < parameters; ++j)
            append(curve.predictors.col(j).array().square().matrix());
    const Eigen::VectorXd root = curve.counts.trials.cwiseSqrt();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * all);
    const Eigen::MatrixXd thin = qr.householderQ() * Eigen::MatrixXd::Identity(points, std::min(points, all.cols()));
    Eigen::MatrixXd terms = root.cwiseInverse().asDiagonal() * thin.rightCols(thin.cols() - parameters);
    return terms;
}

} // namespace

LackOfFit lack_of_fit(const FittedCurve& curve, double significance)
{
    LackOfFit found;
    const auto records = static_cast<Eigen::Index>(curve.data.records);
    const char* const form = curve.link == Link::probit && curve.predictors.cols() == 2 ? "lognormal curve"
                             : curve.link == Link::probit                               ? "probit surface"
                                                                                        : "logistic form";
    if (curve.fit.maximum != Maximum::inside || curve.predictors.rows() <= curve.predictors.cols()) {
        found.says = fmt::format(
            "The fit of the {} cannot be tested: there is no curve, or no more intensities than coefficients.", form);
        return found;
    }
    const Eigen::MatrixXd bends = bending_terms(curve);
    const Eigen::Index terms = bends.cols();
    if (records < terms + 5) {
        found.says = fmt::format("The fit of the {} cannot be tested with {} records.", form, records);
        return found;
    }
    // efficient scores: the scores of the additional terms, orthogonal to the fitted coefficients
    const Eigen::VectorXd eta = curve.predictors * curve.fit.coefficients;
    Eigen::VectorXd rate(eta.size()), weight(eta.size());
    Eigen::VectorXd below(eta.size());
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        const LinkValue at = link_at(curve.link, std::clamp(eta[i], -36.0, 36.0));
        below[i] = at.below;
        rate[i] = at.density / (at.below * at.above);
        weight[i] = curve.counts.trials[i] * at.density * rate[i];
    }
    const Eigen::MatrixXd weighted = weight.asDiagonal() * curve.predictors;
    const Eigen::MatrixXd fitted_part =
        (curve.predictors.transpose() * weighted).ldlt().solve(weighted.transpose() * bends);
    const Eigen::MatrixXd efficient = bends - curve.predictors * fitted_part;
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(records, terms);
    for (Eigen::Index g = 0; g < records; ++g)
        for (const FragilityRow& row : curve.data.of_record(static_cast<std::size_t>(g)))
            scores.row(g) += (row.reached - row.trials * below[row.point]) * rate[row.point] * efficient.row(row.point);

    const double n = static_cast<double>(records), q = static_cast<double>(terms);
    const Eigen::VectorXd mean = scores.colwise().mean();
    const Eigen::MatrixXd centred = scores.rowwise() - mean.transpose();
    const Eigen::LDLT<Eigen::MatrixXd> spread(centred.transpose() * centred / (n - 1));
    if (!(spread.rcond() > 1e-13)) {
        found.says = fmt::format("The fit of the {} cannot be tested: too few records have runs where it bends.", form);
        return found;
    }
    found.terms = static_cast<int>(terms);
    found.statistic = (n - q) / (q * (n - 1)) * n * mean.dot(spread.solve(mean));
    found.p_value = cdf(complement(boost::math::fisher_f_distribution<double>(q, n - q), found.statistic));
    if (found.p_value >= significance) {
        found.says =
            fmt::format("No lack of fit of the {} was found (p = {:.3f}, {} records).", form, found.p_value, records);
        return found;
    }
    // where the shares deviate most from the curve, in standard errors of independent runs
    Eigen::Index worst = 0;
    double most = -1;
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        const double expected = curve.counts.trials[i] * below[i];
        const double away = std::abs(curve.counts.reached[i] - expected) / std::sqrt(expected * (1 - below[i]) + 1e-12);
        if (away > most) {
            most = away;
            worst = i;
        }
    }
    std::string at;
    for (std::size_t j = 0; j < curve.data.measures; ++j)
        at += fmt::format("{}{:.4g}", j > 0 ? ", " : "",
                          curve.data.intensity[static_cast<std::size_t>(worst) * curve.data.measures + j]);
    found.says = fmt::format("The {} does not fit (p = {:.2g}, {} records): at intensity {} the share that reached the "
                             "limit state is {:.3f}, the fit gives {:.3f}. Use the shares by stripe.",
                             form, found.p_value, records, at, curve.counts.reached[worst] / curve.counts.trials[worst],
                             below[worst]);
    return found;
}

} // namespace stylobate
