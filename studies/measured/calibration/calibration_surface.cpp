#include "studies/measured/calibration/calibration_surface.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "ensemble/sampling/distribution.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

namespace stylobate {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Eigen::Index index(std::size_t i)
{
    return static_cast<Eigen::Index>(i);
}

/// 1, u_i, u_i u_j (i <= j) of the distance from the centre.
Vector terms(const Vector& u)
{
    const Eigen::Index d = u.size();
    Vector t(1 + d + d * (d + 1) / 2);
    t(0) = 1;
    t.segment(1, d) = u;
    Eigen::Index k = 1 + d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i; j < d; ++j)
            t(k++) = u(i) * u(j);
    return t;
}

/// The curvature of a form from its coefficients, with the sign of a maximum.
Matrix curvature(const Vector& coefficients, Eigen::Index d)
{
    Matrix h(d, d);
    Eigen::Index k = 1 + d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i; j < d; ++j, ++k)
            h(i, j) = h(j, i) = (i == j ? -2 : -1) * coefficients(k);
    return h;
}

Vector to_vector(const UnitPoint& p)
{
    return Eigen::Map<const Vector>(p.data(), index(p.size()));
}

/// Sum over columns, those of one group first summed up, of what they differ from their mean.
Matrix scatter(const Matrix& slopes)
{
    const double n = static_cast<double>(slopes.cols());
    if (n < 2)
        return Matrix::Zero(slopes.rows(), slopes.rows());
    const Matrix centred = slopes.colwise() - slopes.rowwise().mean();
    return centred * centred.transpose() * (n / (n - 1));
}

double halton(std::size_t i, std::size_t base)
{
    double f = 1, value = 0;
    for (; i > 0; i /= base) {
        f /= static_cast<double>(base);
        value += f * static_cast<double>(i % base);
    }
    return value;
}

constexpr std::array<std::size_t, 12> primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};

/// The scores about the middle of the points, each point weighted by how near it is to the best.
struct WeightedScores {
    Vector centre, least, most; ///< (d) of the points
    Matrix design;              ///< (points x coefficients)
    Matrix scores;              ///< (points x units)
    Vector total;               ///< (points) over the units
};

/// Far below the best the form does not hold, and need not. The level below which a point counts for little is where
/// half of the points are, so that it is known from the points themselves.
Vector weights_of(const Vector& total)
{
    std::vector<double> below;
    for (Eigen::Index i = 0; i < total.size(); ++i)
        below.push_back(total.maxCoeff() - total(i));
    const double level = std::max(upper_median(below), 2.0);
    Vector weights(total.size());
    for (Eigen::Index i = 0; i < total.size(); ++i) {
        const double far = below[static_cast<std::size_t>(i)] / (2 * level);
        weights(i) = std::sqrt(1 / (1 + far * far * far * far));
    }
    return weights;
}

WeightedScores weighted_scores(const std::vector<ScoredPoint>& points, const std::vector<std::size_t>& units)
{
    const std::size_t dimensions = points.front().at.size();
    const Eigen::Index d = index(dimensions), n = index(points.size());
    WeightedScores w{Vector::Zero(d),
                     Vector::Ones(d),
                     Vector::Zero(d),
                     Matrix(n, terms(Vector::Zero(d)).size()),
                     Matrix(n, index(units.size())),
                     Vector(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        const ScoredPoint& point = points[static_cast<std::size_t>(i)];
        w.centre += to_vector(point.at) / static_cast<double>(n);
        w.least = w.least.cwiseMin(to_vector(point.at));
        w.most = w.most.cwiseMax(to_vector(point.at));
        for (std::size_t u = 0; u < units.size(); ++u)
            w.scores(i, index(u)) = point.scores[units[u]];
        w.total(i) = w.scores.row(i).sum();
    }
    const Vector weights = weights_of(w.total);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double weight = weights(i);
        w.design.row(i) = weight * terms(to_vector(points[static_cast<std::size_t>(i)].at) - w.centre).transpose();
        w.scores.row(i) *= weight;
        w.total(i) *= weight;
    }
    return w;
}

/// (coefficients x units) by least squares, with the smallest ridge that keeps the solution finite where points lie on
/// a face of the cube. It is of columns of one length: of points that lie near each other it would else flatten the
/// form.
Matrix fitted_coefficients(const WeightedScores& w)
{
    const Vector length = w.design.colwise().norm().transpose();
    const Vector per = (length.array() > 0).select(length.cwiseInverse(), 1.0);
    const Matrix columns = w.design * per.asDiagonal();
    Matrix normal = columns.transpose() * columns;
    normal.diagonal().array() += 1e-9;
    const Eigen::LDLT<Matrix> solver(normal);
    return per.asDiagonal() * solver.solve(columns.transpose() * w.scores);
}

/// Curvature of the sum of the scores, without directions in which the form rises to all sides, and with the prior.
struct Curvature {
    explicit Curvature(const Matrix& raw)
        : precision(Matrix::Identity(raw.rows(), raw.rows()) / (prior_deviation * prior_deviation)), eigen(raw),
          h(eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose() +
            precision)
    {
    }

    /// From the scatter of the slopes. A direction in which the slopes are too uncertain for its curvature is not known
    /// better than before.
    Matrix covariance(const Matrix& scatter_of_slopes) const
    {
        Vector held = eigen.eigenvalues().cwiseMax(0).array() + 1 / (prior_deviation * prior_deviation);
        for (Eigen::Index k = 0; k < h.rows(); ++k) {
            const Vector e = eigen.eigenvectors().col(k);
            held(k) = std::max(held(k), std::sqrt(e.dot((scatter_of_slopes + precision) * e)) / prior_deviation);
        }
        const Matrix least_inverse =
            eigen.eigenvectors() * held.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
        return Matrix(least_inverse * (scatter_of_slopes + precision) * least_inverse);
    }

    Matrix precision; ///< of the prior
    Eigen::SelfAdjointEigenSolver<Matrix> eigen;
    Matrix h;
};

/// The best point from the centre, one parameter after the other; the form does not hold beyond its points.
Vector best_point(const Vector& slope, const Matrix& h, const WeightedScores& w)
{
    Vector best = Vector::Zero(slope.size());
    for (int sweep = 0; sweep < 500; ++sweep)
        for (Eigen::Index i = 0; i < slope.size(); ++i) {
            const double pull = slope(i) - h.row(i).dot(best) + h(i, i) * best(i);
            best(i) = std::clamp(pull / h(i, i), w.least(i) - w.centre(i), w.most(i) - w.centre(i));
        }
    return best;
}

/// Covariance of the best point, from the scatter of the slopes there between units, and at least that between groups
/// where there are enough of them, each parameter by its own factor.
Matrix covariance_of(const Matrix& unit_coefficients, const std::vector<std::size_t>& units,
                     const std::vector<std::size_t>& group, const Vector& best, const Curvature& curved)
{
    const Eigen::Index d = best.size();
    Matrix slopes(d, index(units.size()));
    std::map<std::size_t, Vector> grouped;
    for (std::size_t u = 0; u < units.size(); ++u) {
        const Vector c = unit_coefficients.col(index(u));
        slopes.col(index(u)) = c.segment(1, d) - curvature(c, d) * best;
        const auto [place, fresh] = grouped.try_emplace(group[units[u]], Vector::Zero(d));
        place->second += slopes.col(index(u));
    }
    Matrix by_group(d, index(grouped.size()));
    Eigen::Index g = 0;
    for (const auto& [key, sum_of] : grouped)
        by_group.col(g++) = sum_of;
    Matrix cov = curved.covariance(scatter(slopes));
    if (index(grouped.size()) > d) {
        const Matrix of_runs = curved.covariance(scatter(by_group));
        const Vector factor = (of_runs.diagonal().array() / cov.diagonal().array()).max(1).sqrt();
        cov = factor.asDiagonal() * cov * factor.asDiagonal();
    }
    return cov;
}

/// Standard deviation of the points about the form, with their weights.
double roughness_of(const WeightedScores& w, const Vector& sum)
{
    double square = 0, weights = 0;
    for (Eigen::Index i = 0; i < w.total.size(); ++i) {
        const double r = w.total(i) - w.design.row(i).dot(sum);
        square += r * r;
        weights += w.design(i, 0) * w.design(i, 0);
    }
    return std::sqrt(square / std::max(weights - static_cast<double>(w.design.cols()), 1.0));
}

} // namespace

ScoreSurface fit_surface(const std::vector<ScoredPoint>& points, const std::vector<std::size_t>& group,
                         const std::vector<bool>& use)
{
    ScoreSurface surface;
    if (points.empty())
        return surface;
    const std::size_t dimensions = points.front().at.size();
    const Eigen::Index d = index(dimensions);
    std::vector<std::size_t> units;
    for (std::size_t i = 0; i < group.size(); ++i)
        if (use.empty() || use[i])
            units.push_back(i);
    if (index(points.size()) < terms(Vector::Zero(d)).size() + 2 || units.empty())
        return surface;
    surface.fitted = true;

    const WeightedScores w = weighted_scores(points, units);
    const Matrix unit_coefficients = fitted_coefficients(w);
    const Vector sum = unit_coefficients.rowwise().sum();
    const Curvature curved(curvature(sum, d));
    const Vector best = best_point(sum.segment(1, d), curved.h, w);
    const Matrix cov = covariance_of(unit_coefficients, units, group, best, curved), inverse = curved.h.inverse();

    surface.largest = terms(best).dot(sum);
    surface.roughness = roughness_of(w, sum);
    surface.correlation.resize(dimensions * dimensions);
    surface.along.resize(dimensions * dimensions);
    for (std::size_t i = 0; i < dimensions; ++i) {
        surface.best.push_back(std::clamp(best(index(i)) + w.centre(index(i)), 0.0, 1.0));
        surface.reach.push_back((w.most(index(i)) - w.least(index(i))) / 2);
        surface.deviation.push_back(std::sqrt(cov(index(i), index(i))));
        surface.overdispersion.push_back(cov(index(i), index(i)) / inverse(index(i), index(i)));
        for (std::size_t j = 0; j < dimensions; ++j) {
            surface.correlation[i * dimensions + j] =
                cov(index(i), index(j)) / std::sqrt(cov(index(i), index(i)) * cov(index(j), index(j)));
            surface.along[i * dimensions + j] = inverse(index(j), index(i)) / inverse(index(i), index(i));
        }
    }
    return surface;
}

std::vector<UnitPoint> spread_points(std::size_t dimensions, std::size_t count, std::size_t first)
{
    assert(dimensions <= primes.size() && "the sequence has 12 dimensions");
    std::vector<UnitPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        UnitPoint point;
        for (std::size_t k = 0; k < dimensions; ++k)
            point.push_back(halton(first + i + 1, primes[k]));
        points.push_back(std::move(point));
    }
    return points;
}

std::vector<UnitPoint> points_about(const UnitPoint& centre, const std::vector<double>& deviation,
                                    const std::vector<double>& correlation, std::size_t count, std::size_t first)
{
    const std::size_t d = centre.size();
    Matrix cov(index(d), index(d));
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j)
            cov(index(i), index(j)) = correlation[i * d + j] * deviation[i] * deviation[j];
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(cov);
    const Matrix root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    Perturbation unit;
    unit.sd = 1;
    const Distribution normal(unit, 0);
    std::vector<UnitPoint> points = spread_points(d, count, first);
    for (UnitPoint& point : points) {
        Vector z(index(d));
        for (std::size_t i = 0; i < d; ++i)
            z(index(i)) = normal.value(point[i]);
        const Vector u = to_vector(centre) + root * z;
        for (std::size_t i = 0; i < d; ++i) {
            // reflected at the faces of the cube
            double v = std::fabs(u(index(i)));
            v = std::fmod(v, 2.0);
            point[i] = v > 1 ? 2 - v : v;
        }
    }
    return points;
}

} // namespace stylobate
