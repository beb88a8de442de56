#include "studies/evidence/measured/planar_impact/planar_impact_cause.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace stylobate::measured::impact {

namespace {

/// Zero mean, unit spread.
Eigen::VectorXd standardized(const Eigen::VectorXd& v)
{
    const Eigen::VectorXd centred = v.array() - v.mean();
    const double spread = std::sqrt(centred.squaredNorm() / static_cast<double>(v.size()));
    return spread > 0 ? Eigen::VectorXd(centred / spread) : centred;
}

Eigen::MatrixXd cubic(const Eigen::VectorXd& v)
{
    const Eigen::ArrayXd z = standardized(v).array();
    Eigen::MatrixXd columns(v.size(), 3);
    columns << z.matrix(), z.square().matrix(), z.cube().matrix();
    return columns;
}

/// Orthonormal basis of the columns (those that depend on others left out).
Eigen::MatrixXd basis(const Eigen::MatrixXd& columns)
{
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

/// A number below n; the same on every platform, which the standard's distributions are not.
std::size_t below(std::mt19937_64& random, std::size_t n)
{
    return static_cast<std::size_t>(random() % n);
}

} // namespace

Residuals residuals(const Body& body, const std::vector<Impact>& impacts, const std::vector<Velocity>& predicted,
                    double turn)
{
    Residuals r;
    for (std::size_t k = 0; k < impacts.size(); ++k) {
        const Impact& one = impacts[k];
        const Arms arms = lowest_point(body, one.theta + turn);
        const Velocity measured = one.after - one.before;
        const Impulse seen = nearest_impulse(body, measured, arms);
        const Impulse said = nearest_impulse(body, predicted[k] - one.before, arms);
        r.restitution.push_back(at_contact(one.after - predicted[k], arms).n / -at_contact(one.before, arms).n);
        r.friction.push_back(seen.t / seen.n - said.t / said.n);
        r.lever.push_back(lever_residual(body, measured, arms));
    }
    return r;
}

std::vector<Candidate> candidates(const Body& body, const std::vector<Impact>& impacts)
{
    const auto of = [&](auto value) {
        Eigen::VectorXd v(static_cast<Eigen::Index>(impacts.size()));
        for (std::size_t k = 0; k < impacts.size(); ++k)
            v[static_cast<Eigen::Index>(k)] = value(impacts[k]);
        return v;
    };
    const auto arms = [&](const Impact& i) { return lowest_point(body, i.theta); };
    const auto contact = [&](const Impact& i) { return at_contact(i.before, arms(i)); };
    const auto harmonic = [&](double n) {
        Eigen::MatrixXd columns(static_cast<Eigen::Index>(impacts.size()), 2);
        columns << of([&](const Impact& i) { return std::cos(n * i.theta); }),
            of([&](const Impact& i) { return std::sin(n * i.theta); });
        return columns;
    };
    return {{"place along the surface", cubic(of([](const Impact& i) { return i.x; }))},
            {"horizontal speed", cubic(of([](const Impact& i) { return i.before.x; }))},
            {"normal speed", cubic(of([&](const Impact& i) { return contact(i).n; }))},
            {"tangential speed", cubic(of([&](const Impact& i) { return contact(i).t; }))},
            {"spin", cubic(of([](const Impact& i) { return i.before.spin; }))},
            {"lever arm, signed", cubic(of([&](const Impact& i) { return arms(i).n; }))},
            {"spin x lever arm", cubic(of([&](const Impact& i) { return i.before.spin * arms(i).n; }))},
            {"tangential speed x lever arm", cubic(of([&](const Impact& i) { return contact(i).t * arms(i).n; }))},
            {"which end is down (first harmonic of the orientation)", harmonic(1)},
            {"fourth harmonic of the orientation", harmonic(4)},
            {"order in time", cubic(of([](const Impact& i) { return static_cast<double>(i.index); }))}};
}

Dependence dependence(const std::vector<double>& residual, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& given,
                      int shufflings, std::uint64_t seed)
{
    const auto n = static_cast<Eigen::Index>(residual.size());
    Eigen::MatrixXd first(n, given.cols() + 1);
    first.col(0).setOnes();
    first.rightCols(given.cols()) = given;
    const Eigen::MatrixXd base = basis(first);
    const auto free_of_given = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(m - base * (base.transpose() * m));
    };
    const Eigen::MatrixXd added = basis(free_of_given(columns));
    Eigen::VectorXd left = free_of_given(Eigen::Map<const Eigen::VectorXd>(residual.data(), n));
    const auto share = [&](const Eigen::VectorXd& v) {
        const Eigen::VectorXd clean = free_of_given(v);
        return (added.transpose() * clean).squaredNorm() / clean.squaredNorm();
    };
    Dependence d;
    d.share = share(left);
    std::mt19937_64 random(seed);
    std::vector<double> null;
    int as_much = 0;
    for (int k = 0; k < shufflings; ++k) {
        for (std::size_t i = residual.size(); i > 1; --i)
            std::swap(left[static_cast<Eigen::Index>(i - 1)], left[static_cast<Eigen::Index>(below(random, i))]);
        null.push_back(share(left));
        as_much += null.back() >= d.share;
    }
    d.null_99 = quantile(null, 0.99);
    d.p = (1.0 + as_much) / (1.0 + shufflings);
    return d;
}

double neighbour_correlation(const std::vector<double>& values)
{
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double product = 0, square = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        square += (values[k] - mean) * (values[k] - mean);
        if (k > 0)
            product += (values[k] - mean) * (values[k - 1] - mean);
    }
    return product / square;
}

Eigen::MatrixXd smooth_prediction(const Eigen::MatrixXd& from, const Eigen::MatrixXd& values,
                                  const Eigen::VectorXd& weight, const Eigen::MatrixXd& to, double length, double ridge)
{
    const Eigen::RowVectorXd mean = from.colwise().mean();
    const Eigen::RowVectorXd spread = (from.rowwise() - mean).colwise().norm() / std::sqrt(double(from.rows()));
    const auto scaled = [&](const Eigen::MatrixXd& m) {
        return Eigen::MatrixXd(((m.rowwise() - mean).array().rowwise() / (spread.array() * length)).matrix());
    };
    const Eigen::MatrixXd a = scaled(from), b = scaled(to);
    const auto kernel = [](const Eigen::MatrixXd& p, const Eigen::MatrixXd& q) {
        Eigen::MatrixXd k = -2 * p * q.transpose();
        k.colwise() += p.rowwise().squaredNorm();
        k.rowwise() += q.rowwise().squaredNorm().transpose();
        return Eigen::MatrixXd((-0.5 * k.array()).exp().matrix());
    };
    Eigen::MatrixXd k = kernel(a, a);
    k.diagonal() += ridge * weight.cwiseInverse();
    return kernel(b, a) * k.ldlt().solve(values);
}

double quantile(std::vector<double> values, double part)
{
    std::sort(values.begin(), values.end());
    return sorted_quantile(values, part, QuantileDefinition::linear);
}

Gain gain(const std::vector<double>& before, const std::vector<double>& after, std::uint64_t seed)
{
    const auto of = [](const std::vector<double>& a, const std::vector<double>& b) {
        return 1 - quantile(b, 0.5) / quantile(a, 0.5);
    };
    constexpr int resamplings = 2000;
    std::mt19937_64 random(seed);
    std::vector<double> values, a(before.size()), b(before.size());
    for (int k = 0; k < resamplings; ++k) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t at = below(random, a.size());
            a[i] = before[at];
            b[i] = after[at];
        }
        values.push_back(of(a, b));
    }
    return {of(before, after), quantile(values, 0.025), quantile(values, 0.975)};
}

} // namespace stylobate::measured::impact
