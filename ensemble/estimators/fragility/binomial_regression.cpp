#include "ensemble/estimators/fragility/binomial_regression.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/eigen_blocks.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

/// The contribution of one point to the likelihood, its slope and its (negative) curvature in the linear predictor.
struct PointTerm {
    double log_likelihood = 0, slope = 0, weight = 0;
};

PointTerm term_at(Link link, double eta, double trials, double reached)
{
    if (trials == 0)
        return {};
    const double missed = trials - reached;
    eta = std::clamp(eta, -36.0, 36.0); // within it, both tails are above 1e-300
    const LinkValue at = link_at(link, eta);
    PointTerm term;
    if (reached > 0)
        term.log_likelihood += reached * std::log(at.below);
    if (missed > 0)
        term.log_likelihood += missed * std::log(at.above);
    if (link == Link::logit) {
        term.slope = reached * at.above - missed * at.below;
        term.weight = trials * at.density;
    } else {
        const double up = at.density / at.below, down = at.density / at.above;
        term.slope = reached * up - missed * down;
        term.weight = reached * up * (up + eta) + missed * down * (down - eta);
    }
    return term;
}

Eigen::VectorXd predictor(const Eigen::MatrixXd& predictors, const ParameterVector& coefficients,
                          const Eigen::VectorXd& offset)
{
    Eigen::VectorXd eta = predictors * coefficients;
    if (offset.size() > 0)
        eta += offset;
    return eta;
}

/// Whether the plane separates the outcomes: nothing that reached lies below it and nothing that did not lies above?
bool parts(const Eigen::VectorXd& eta, const BinomialCounts& counts)
{
    const double small = 1e-7 * eta.cwiseAbs().maxCoeff();
    bool any = false;
    for (Eigen::Index i = 0; i < eta.size(); ++i) {
        if ((counts.reached[i] > 0 && eta[i] < -small) || (counts.reached[i] < counts.trials[i] && eta[i] > small))
            return false;
        any = any || (counts.trials[i] > 0 && std::abs(eta[i]) > small);
    }
    return any;
}

/// Whether one value of x parts the outcomes, in either direction; runs at that value itself may have both. Then a
/// slope without end is the likeliest, and rounding decides where the search for it ends.
bool parts_at_one_value(const Eigen::VectorXd& x, const BinomialCounts& counts)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double first_reached = infinity, last_reached = -infinity, first_missed = infinity, last_missed = -infinity;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        if (counts.reached[i] > 0) {
            first_reached = std::min(first_reached, x[i]);
            last_reached = std::max(last_reached, x[i]);
        }
        if (counts.reached[i] < counts.trials[i]) {
            first_missed = std::min(first_missed, x[i]);
            last_missed = std::max(last_missed, x[i]);
        }
    }
    const bool differ = std::max(last_reached, last_missed) > std::min(first_reached, first_missed);
    return differ && (last_missed <= first_reached || last_reached <= first_missed);
}

/// Points that carry information on the coefficients: all others are certain to rounding.
Eigen::Index telling_points(Link link, const Eigen::VectorXd& eta, const BinomialCounts& counts)
{
    Eigen::VectorXd weight(eta.size());
    for (Eigen::Index i = 0; i < eta.size(); ++i)
        weight[i] = std::abs(term_at(link, eta[i], counts.trials[i], counts.reached[i]).weight);
    return (weight.array() > 1e-10 * weight.maxCoeff()).count();
}

} // namespace

BinomialCounts counts_of(const FragilityData& data, const Eigen::VectorXd& weight)
{
    const auto points = static_cast<Eigen::Index>(data.points());
    BinomialCounts counts{Eigen::VectorXd::Zero(points), Eigen::VectorXd::Zero(points)};
    for (const FragilityRow& row : data.rows) {
        const double times = weight.size() > 0 ? weight[row.record] : 1;
        counts.trials[row.point] += times * row.trials;
        counts.reached[row.point] += times * row.reached;
    }
    return counts;
}

Eigen::MatrixXd log_predictors(const FragilityData& data)
{
    const auto points = static_cast<Eigen::Index>(data.points()), measures = static_cast<Eigen::Index>(data.measures);
    Eigen::MatrixXd predictors(points, 1 + measures);
    predictors.col(0).setOnes();
    for (Eigen::Index i = 0; i < points; ++i)
        for (Eigen::Index j = 0; j < measures; ++j)
            predictors(i, 1 + j) = std::log(data.intensity[static_cast<std::size_t>(i * measures + j)]);
    return predictors;
}

BinomialFit fit_binomial(Link link, const Eigen::MatrixXd& predictors, const BinomialCounts& counts,
                         const Eigen::VectorXd& offset, const ParameterVector& start)
{
    const Eigen::Index parameters = predictors.cols();
    assert(parameters <= most_coefficients);
    BinomialFit fit;
    fit.coefficients = start.size() > 0 ? start : ParameterVector(ParameterVector::Zero(parameters));
    fit.information.resize(parameters, parameters);
    const double reached = counts.reached.sum(), trials = counts.trials.sum();
    if (offset.size() == 0 && (reached == 0 || reached == trials)) {
        fit.maximum = reached == 0 ? Maximum::none : Maximum::all;
        return fit;
    }
    const bool one_measure = offset.size() == 0 && parameters == 2 && (predictors.col(0).array() == 1).all();
    const bool separated = one_measure && parts_at_one_value(predictors.col(1), counts);
    fit.log_likelihood = -std::numeric_limits<double>::infinity();
    // where fewer points than coefficients carry information, the others are 0 or 1 to rounding: it grows without bound
    const auto found = [&] {
        if (offset.size() > 0)
            return fit;
        const Eigen::VectorXd eta = predictor(predictors, fit.coefficients, offset);
        if (separated || parts(eta, counts) || telling_points(link, eta, counts) < parameters)
            fit.maximum = Maximum::separated;
        return fit;
    };
    ParameterVector step = ParameterVector::Zero(parameters);
    for (int iteration = 0; iteration < 200; ++iteration) {
        // halve the step until the likelihood grows: it is concave, so that this ends at its maximum
        Eigen::VectorXd eta;
        double log_likelihood = 0;
        ParameterVector slope;
        bool grown = false;
        for (int halving = 0; halving < 40 && !grown; ++halving) {
            const ParameterVector tried = fit.coefficients + step;
            eta = predictor(predictors, tried, offset);
            log_likelihood = 0;
            slope = ParameterVector::Zero(parameters);
            ParameterMatrix information = ParameterMatrix::Zero(parameters, parameters);
            for (Eigen::Index i = 0; i < eta.size(); ++i) {
                const PointTerm term = term_at(link, eta[i], counts.trials[i], counts.reached[i]);
                log_likelihood += term.log_likelihood;
                for (Eigen::Index j = 0; j < parameters; ++j) {
                    slope[j] += term.slope * predictors(i, j);
                    for (Eigen::Index k = 0; k <= j; ++k)
                        information(j, k) += term.weight * predictors(i, j) * predictors(i, k);
                }
            }
            grown = log_likelihood >= fit.log_likelihood - 1e-12 * std::abs(fit.log_likelihood);
            if (grown) {
                fit.coefficients = tried;
                fit.log_likelihood = log_likelihood;
                fit.information = information.selfadjointView<Eigen::Lower>();
            } else
                step /= 2;
        }
        if (!grown) // a start far away may lead nowhere
            return start.size() > 0 ? fit_binomial(link, predictors, counts, offset) : found();
        if (offset.size() == 0 && eta.cwiseAbs().maxCoeff() > 12 && parts(eta, counts)) {
            fit.maximum = Maximum::separated;
            // what lies on the plane itself keeps its share; the rest costs nothing in the limit
            const double small = 1e-7 * eta.cwiseAbs().maxCoeff();
            fit.log_likelihood = 0;
            for (Eigen::Index i = 0; i < eta.size(); ++i) {
                const double n = counts.trials[i], k = counts.reached[i];
                if (std::abs(eta[i]) <= small && k > 0 && k < n)
                    fit.log_likelihood += k * std::log(k / n) + (n - k) * std::log1p(-k / n);
            }
            return fit;
        }
        const Eigen::LDLT<ParameterMatrix> solver(fit.information);
        step = solver.solve(slope);
        if (iteration == 0 && !(solver.rcond() > 1e-14)) {
            if (start.size() > 0) // too steep there for information in most points: start from the beginning
                return fit_binomial(link, predictors, counts, offset);
            throw InputError("fragility: the predictors of a regression are not independent.\n  Give at least as many "
                             "different intensities as coefficients, and no measure that depends on others.");
        }
        if (slope.dot(step) < 1e-16 * (1 + std::abs(fit.log_likelihood)))
            return found();
    }
    return start.size() > 0 ? fit_binomial(link, predictors, counts, offset) : found();
}

Eigen::MatrixXd record_influence(Link link, const Eigen::MatrixXd& predictors, const FragilityData& data,
                                 const BinomialFit& fit, const Eigen::VectorXd& weight)
{
    const Eigen::Index parameters = predictors.cols();
    const Eigen::VectorXd eta = predictors * fit.coefficients;
    Eigen::MatrixXd influence(static_cast<Eigen::Index>(data.records), parameters);
    // a point's terms are linear in its counts: two evaluations serve all records
    std::vector<PointTerm> reached(data.points()), missed(data.points());
    for (std::size_t i = 0; i < data.points(); ++i) {
        reached[i] = term_at(link, eta[static_cast<Eigen::Index>(i)], 1, 1);
        missed[i] = term_at(link, eta[static_cast<Eigen::Index>(i)], 1, 0);
    }
    for (std::size_t g = 0; g < data.records; ++g) {
        const auto record = static_cast<Eigen::Index>(g);
        if (weight.size() > 0 && weight[record] == 0) {
            influence.row(record).setZero();
            continue;
        }
        ParameterVector slope = ParameterVector::Zero(parameters);
        ParameterMatrix rest = fit.information;
        for (const FragilityRow& row : data.of_record(g)) {
            const PointTerm& up = reached[row.point];
            const PointTerm& down = missed[row.point];
            const double k = row.reached, m = row.trials - row.reached;
            const auto x = predictors.row(row.point);
            slope += (k * up.slope + m * down.slope) * x.transpose();
            rest -= (k * up.weight + m * down.weight) * x.transpose() * x;
        }
        influence.row(record) = Eigen::LDLT<ParameterMatrix>(rest).solve(slope).transpose();
    }
    return influence;
}

ParameterMatrix record_covariance(Link link, const Eigen::MatrixXd& predictors, const FragilityData& data,
                                  const BinomialFit& fit, const Eigen::VectorXd& weight)
{
    const Eigen::MatrixXd influence = record_influence(link, predictors, data, fit, weight);
    const double records = static_cast<double>(data.records);
    if (weight.size() == 0)
        return (records - 1) / records * influence.transpose() * influence;
    return (records - 1) / records * influence.transpose() * weight.asDiagonal() * influence;
}

} // namespace stylobate
