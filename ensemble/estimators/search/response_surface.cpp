#include "ensemble/estimators/search/response_surface.hpp"

#include "ensemble/numerics/eigen_blocks.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>

namespace stylobate {

namespace {

constexpr double least_weight = 1e-3; ///< of a model that is kept
constexpr double jitter = 1e-8;       ///< of a variance, on the diagonal
constexpr int smoothing_passes = 2;

double matern(double r)
{
    const double a = std::sqrt(5.0) * r;
    return (1 + a + a * a / 3) * std::exp(-a);
}

double correlation(const SearchPlace& a, const SearchPlace& b, const std::vector<double>& length)
{
    double r2 = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        r2 += (a[k] - b[k]) * (a[k] - b[k]) / (length[k] * length[k]);
    return matern(std::sqrt(r2));
}

Eigen::Index index(std::size_t i)
{
    return static_cast<Eigen::Index>(i);
}

/// (a x b)
Eigen::MatrixXd correlations(const std::vector<SearchPlace>& a, const std::vector<SearchPlace>& b,
                             const std::vector<double>& length)
{
    Eigen::MatrixXd all(index(a.size()), index(b.size()));
    for (std::size_t j = 0; j < b.size(); ++j)
        for (std::size_t i = 0; i < a.size(); ++i)
            all(index(i), index(j)) = correlation(a[i], b[j], length);
    return all;
}

/// All choices of the lengths.
std::vector<std::vector<double>> lengths_of(std::size_t dimensions)
{
    const std::vector<double> each = dimensions == 1   ? std::vector<double>{0.1, 0.15, 0.25, 0.4, 0.7, 1.2, 2}
                                     : dimensions == 2 ? std::vector<double>{0.15, 0.3, 0.6, 1.2, 2.4}
                                                       : std::vector<double>{0.2, 0.5, 1.2, 2.5};
    std::vector<std::vector<double>> all = {{}};
    for (std::size_t k = 0; k < dimensions; ++k) {
        std::vector<std::vector<double>> longer;
        for (const std::vector<double>& start : all)
            for (const double length : each) {
                longer.push_back(start);
                longer.back().push_back(length);
            }
        all = std::move(longer);
    }
    return all;
}

} // namespace

/// One choice of the deviation and the lengths.
struct ResponseSurface::Model {
    double weight = 0;
    double variance = 1;
    std::vector<double> length;
    Eigen::LLT<Eigen::MatrixXd> factor; ///< L L' = K
    Eigen::VectorXd rest;               ///< L^-1 (y - mean)
    Eigen::VectorXd ones;               ///< L^-1 1
    double mean = 0, precision = 1;     ///< of the flat mean: 1' K^-1 1

    /// L^-1 k of places, from their correlations with the points (points x places).
    Eigen::MatrixXd whitened(const Eigen::MatrixXd& correlation) const
    {
        return factor.matrixL().solve(variance * correlation);
    }
};

ResponseSurface::ResponseSurface(std::vector<SearchPlace> points, PairedNoise noise)
    : points_(std::move(points)), noise_(std::move(noise))
{
    assert(points_.size() >= 2);
    fit(noise_);
    for (int pass = 0; pass < smoothing_passes; ++pass) {
        std::vector<double> mean;
        for (const Value& value : values(points_))
            mean.push_back(value.mean);
        fit(smoothed_noise(noise_, mean));
    }
}

void ResponseSurface::fit(const PairedNoise& noise)
{
    const std::size_t m = points_.size();
    const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(noise.share.data(), index(m));
    const Eigen::MatrixXd errors = Eigen::Map<const Eigen::MatrixXd>(noise.covariance.data(), index(m), index(m));
    const double spread = std::sqrt((y.array() - y.mean()).square().sum() / static_cast<double>(m - 1));
    const double scale = std::max(spread, std::sqrt(errors.trace() / static_cast<double>(m))); // 0: all shares equal
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(index(m));
    std::vector<Model> models;
    std::vector<double> log_weight;
    for (const std::vector<double>& length : lengths_of(points_.front().size())) {
        const Eigen::MatrixXd correlation = correlations(points_, points_, length);
        for (const double times : {0.35, 0.7, 1.4, 2.8}) {
            Model model;
            model.variance = times * times * scale * scale;
            model.length = length;
            Eigen::MatrixXd K = errors + model.variance * correlation;
            K.diagonal().array() += jitter * model.variance;
            model.factor.compute(K);
            if (model.factor.info() != Eigen::Success)
                continue;
            model.ones = model.factor.matrixL().solve(one);
            model.rest = model.factor.matrixL().solve(y);
            model.precision = model.ones.squaredNorm();
            model.mean = model.rest.dot(model.ones) / model.precision;
            model.rest -= model.mean * model.ones;
            const double determinant = 2 * model.factor.matrixLLT().diagonal().array().log().sum();
            log_weight.push_back(-0.5 * (model.rest.squaredNorm() + determinant + std::log(model.precision)));
            models.push_back(std::move(model));
        }
    }
    const double most = *std::max_element(log_weight.begin(), log_weight.end());
    double sum = 0;
    for (std::size_t i = 0; i < models.size(); ++i)
        sum += models[i].weight = std::exp(log_weight[i] - most);
    std::erase_if(models, [&](const Model& model) { return model.weight < least_weight * sum; });
    sum = 0;
    for (const Model& model : models)
        sum += model.weight;
    for (Model& model : models)
        model.weight /= sum;
    models_ = std::make_shared<const std::vector<Model>>(std::move(models));
}

std::vector<ResponseSurface::Value> ResponseSurface::mixture(const std::vector<SearchPlace>& places,
                                                             const SearchPlace* from) const
{
    const Eigen::Index n = index(places.size());
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n), square = sum;
    Eigen::MatrixXd correlation;
    Eigen::ArrayXd own;
    const std::vector<double>* length = nullptr;
    for (const Model& model : *models_) {
        if (!length || *length != model.length) {
            length = &model.length;
            correlation = correlations(points_, places, model.length);
            own = Eigen::ArrayXd::Ones(n);
            if (from) {
                const Eigen::VectorXd reference = correlations(points_, {*from}, model.length).col(0);
                correlation.colwise() -= reference;
                for (Eigen::Index j = 0; j < n; ++j)
                    own[j] = 2 * (1 - stylobate::correlation(places[static_cast<std::size_t>(j)], *from, *length));
            }
        }
        const Eigen::MatrixXd V = model.whitened(correlation);
        const Eigen::ArrayXd value = (V.transpose() * model.rest).array() + (from ? 0 : model.mean);
        const Eigen::ArrayXd rest = (from ? 0.0 : 1.0) - (V.transpose() * model.ones).array();
        const Eigen::ArrayXd variance =
            (model.variance * own - V.colwise().squaredNorm().transpose().array() + rest.square() / model.precision)
                .max(0.0);
        sum += model.weight * value;
        square += model.weight * (value.square() + variance);
    }
    std::vector<Value> all(places.size());
    for (Eigen::Index j = 0; j < n; ++j)
        all[static_cast<std::size_t>(j)] = {sum[j], std::sqrt(std::max(0.0, square[j] - sum[j] * sum[j]))};
    return all;
}

std::vector<ResponseSurface::Value> ResponseSurface::values(const std::vector<SearchPlace>& places) const
{
    return mixture(places, nullptr);
}

ResponseSurface::Value ResponseSurface::at(const SearchPlace& place) const
{
    return mixture({place}, nullptr).front();
}

std::vector<ResponseSurface::Value> ResponseSurface::differences(const std::vector<SearchPlace>& places,
                                                                 const SearchPlace& from) const
{
    return mixture(places, &from);
}

ResponseSurface::Value ResponseSurface::difference(const SearchPlace& a, const SearchPlace& b) const
{
    return mixture({a}, &b).front();
}

std::vector<std::vector<double>> ResponseSurface::draws(const std::vector<SearchPlace>& places, std::size_t number,
                                                        std::uint64_t seed) const
{
    const Eigen::Index n = index(places.size());
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> all;
    double until = 0;
    for (const Model& model : *models_) {
        until += model.weight * static_cast<double>(number);
        if (all.size() >= number || std::floor(until + 0.5) <= static_cast<double>(all.size()))
            continue;
        const Eigen::MatrixXd V = model.whitened(correlations(points_, places, model.length));
        const Eigen::VectorXd mean = (V.transpose() * model.rest).array() + model.mean;
        const Eigen::VectorXd rest = 1 - (V.transpose() * model.ones).array();
        Eigen::MatrixXd C = model.variance * correlations(places, places, model.length);
        C.noalias() -= V.transpose() * V;
        C.noalias() += rest * rest.transpose() / model.precision;
        C.diagonal().array() += jitter * model.variance;
        const Eigen::LLT<Eigen::MatrixXd> factor(C);
        while (all.size() < number && static_cast<double>(all.size()) + 0.5 <= until) {
            Eigen::VectorXd z(n);
            for (Eigen::Index j = 0; j < n; ++j)
                z[j] = normal(random);
            const Eigen::VectorXd drawn = mean + factor.matrixL() * z;
            all.emplace_back(drawn.data(), drawn.data() + n);
        }
    }
    return all;
}

std::vector<SearchPlace> first_places(std::size_t dimensions)
{
    if (dimensions == 1)
        return {{0.5}, {0}, {1}, {0.25}, {0.75}};
    double ratio = 1.5; // x^(d + 1) = x + 1
    for (int i = 0; i < 60; ++i)
        ratio = std::pow(1 + ratio, 1.0 / (static_cast<double>(dimensions) + 1));
    std::vector<SearchPlace> places;
    for (std::size_t i = 0; i < 4 * dimensions; ++i) {
        SearchPlace place;
        for (std::size_t k = 0; k < dimensions; ++k)
            place.push_back(
                std::fmod(0.5 + static_cast<double>(i) * std::pow(1 / ratio, static_cast<double>(k) + 1), 1.0));
        places.push_back(std::move(place));
    }
    return places;
}

std::vector<SearchPlace> candidate_places(std::size_t dimensions)
{
    const std::size_t side = dimensions == 1 ? 201 : dimensions == 2 ? 41 : 17;
    std::size_t all = 1;
    for (std::size_t k = 0; k < dimensions; ++k)
        all *= side;
    std::vector<SearchPlace> places;
    for (std::size_t i = 0; i < all; ++i) {
        SearchPlace place;
        for (std::size_t k = 0, rest = i; k < dimensions; ++k, rest /= side)
            place.push_back(static_cast<double>(rest % side) / static_cast<double>(side - 1));
        places.push_back(std::move(place));
    }
    return places;
}

namespace {

constexpr double prior_groups = 3; ///< for each point
constexpr double most_correlation = 0.99;

/// (sum y)^2 / sum y^2 - 1 of a column.
double freedom_of(const std::vector<double>& reached, std::size_t groups, std::size_t points, std::size_t column)
{
    double sum = 0, square = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        const double y = reached[g * points + column];
        sum += y;
        square += y * y;
    }
    return square > 0 ? sum * sum / square - 1 : 0;
}

} // namespace

PairedNoise paired_noise(const std::vector<double>& reached, const std::vector<double>& size,
                         const std::vector<std::size_t>& stratum, std::size_t points, double most)
{
    const std::size_t groups = size.size(), strata = 1 + *std::max_element(stratum.begin(), stratum.end());
    double all = 0, squares = 0;
    std::vector<double> in_stratum(strata), number(strata), mean(strata * points);
    PairedNoise noise;
    noise.share.resize(points);
    noise.covariance.resize(points * points);
    noise.most = most;
    for (std::size_t g = 0; g < groups; ++g) {
        all += size[g];
        squares += size[g] * size[g];
        in_stratum[stratum[g]] += size[g];
        number[stratum[g]] += 1;
        for (std::size_t i = 0; i < points; ++i) {
            mean[stratum[g] * points + i] += reached[g * points + i];
            noise.share[i] += reached[g * points + i];
        }
    }
    for (std::size_t s = 0; s < strata; ++s)
        for (std::size_t i = 0; i < points; ++i)
            mean[s * points + i] /= std::max(in_stratum[s], 1.0);
    for (double& share : noise.share)
        share /= all;
    std::vector<double> error(points);
    for (std::size_t g = 0; g < groups; ++g) {
        const double n = number[stratum[g]];
        for (std::size_t i = 0; i < points; ++i)
            error[i] = reached[g * points + i] - size[g] * mean[stratum[g] * points + i];
        for (std::size_t i = 0; i < points; ++i)
            for (std::size_t j = 0; j < points; ++j)
                noise.covariance[i * points + j] += (n > 1 ? n / (n - 1) : 1) * error[i] * error[j] / (all * all);
    }
    noise.half = 0.5 * most * most / (all * all);
    noise.groups = all * all / squares;
    const bool single = squares <= all;
    for (std::size_t i = 0; i < points; ++i) {
        // a share of 0 or 1 has an error too: that of half a count, for each point by itself
        noise.covariance[i * points + i] += noise.half;
        noise.freedom.push_back(single ? std::numeric_limits<double>::infinity()
                                       : freedom_of(reached, groups, points, i));
    }
    return noise;
}

PairedNoise smoothed_noise(const PairedNoise& noise, const std::vector<double>& mean)
{
    const std::size_t m = noise.share.size();
    // half a realization, as a variance over those of one: y (most - y) is 0 at both ends
    const double least = std::sqrt(0.5 * noise.half) * noise.most;
    const auto binomial = [&](double y) {
        const double inside = std::clamp(y, 0.0, noise.most);
        return inside * (noise.most - inside) + least;
    };
    const auto sd = [&](std::size_t i) { return std::sqrt(noise.covariance[i * m + i]); };
    double variances = 0, binomials = 0, correlation = 0;
    for (std::size_t i = 0; i < m; ++i) {
        variances += noise.covariance[i * m + i];
        binomials += binomial(noise.share[i]);
        for (std::size_t j = 0; j < i; ++j)
            correlation += noise.covariance[i * m + j] / (sd(i) * sd(j));
    }
    if (m > 1)
        correlation = std::clamp(2 * correlation / static_cast<double>(m * (m - 1)), 0.0, most_correlation);
    const double own = std::max(noise.groups - 1, 0.0), prior = prior_groups * static_cast<double>(m);
    const double weight = own / (own + prior);
    PairedNoise smooth = noise;
    std::vector<double> deviation;
    for (std::size_t i = 0; i < m; ++i) {
        const double ratio =
            weight * noise.covariance[i * m + i] / binomial(noise.share[i]) + (1 - weight) * variances / binomials;
        deviation.push_back(std::sqrt(ratio * binomial(mean[i])));
    }
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j) {
            const double found = noise.covariance[i * m + j] / (sd(i) * sd(j));
            smooth.covariance[i * m + j] =
                deviation[i] * deviation[j] * (i == j ? 1 : weight * found + (1 - weight) * correlation);
        }
    return smooth;
}

} // namespace stylobate
