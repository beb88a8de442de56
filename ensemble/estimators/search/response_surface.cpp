#include "ensemble/estimators/search/response_surface.hpp"

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

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

} // namespace

PairedNoise paired_noise(const std::vector<double>& reached, const std::vector<double>& size,
                         const std::vector<std::size_t>& stratum, std::size_t points)
{
    const std::size_t groups = size.size(), strata = 1 + *std::max_element(stratum.begin(), stratum.end());
    double all = 0;
    std::vector<double> in_stratum(strata), number(strata), mean(strata * points);
    PairedNoise noise{std::vector<double>(points), std::vector<double>(points * points)};
    for (std::size_t g = 0; g < groups; ++g) {
        all += size[g];
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
    // a share of 0 or 1 has an error too: that of half a count, for each point by itself
    for (std::size_t i = 0; i < points; ++i)
        noise.covariance[i * points + i] += 0.5 / (all * all);
    return noise;
}

/// One choice of the deviation and the lengths.
struct ResponseSurface::Model {
    double weight = 0;
    double variance = 1;
    std::vector<double> length;
    Eigen::VectorXd alpha; ///< K^-1 (y - mean)
    Eigen::VectorXd ones;  ///< K^-1 1
    Eigen::LLT<Eigen::MatrixXd> factor;
    double mean = 0, precision = 1; ///< of the flat mean: 1' K^-1 1
};

ResponseSurface::ResponseSurface(std::vector<SearchPlace> points, const PairedNoise& noise) : points_(std::move(points))
{
    const std::size_t m = points_.size(), d = points_.front().size();
    assert(m >= 2);
    Eigen::VectorXd y(index(m));
    Eigen::MatrixXd errors(index(m), index(m));
    for (std::size_t i = 0; i < m; ++i) {
        y[index(i)] = noise.share[i];
        for (std::size_t j = 0; j < m; ++j)
            errors(index(i), index(j)) = noise.covariance[i * m + j];
    }
    const double scale = std::max(0.02, std::sqrt((y.array() - y.mean()).square().sum() / static_cast<double>(m - 1)));
    const std::vector<double> lengths = d == 1   ? std::vector<double>{0.1, 0.15, 0.25, 0.4, 0.7, 1.2, 2}
                                        : d == 2 ? std::vector<double>{0.15, 0.3, 0.6, 1.2, 2.4}
                                                 : std::vector<double>{0.2, 0.5, 1.2, 2.5};
    std::size_t choices = 1;
    for (std::size_t k = 0; k < d; ++k)
        choices *= lengths.size();
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(index(m));
    std::vector<Model> models;
    double most = -std::numeric_limits<double>::infinity();
    std::vector<double> log_weight;
    for (const double times : {0.35, 0.7, 1.4, 2.8})
        for (std::size_t choice = 0; choice < choices; ++choice) {
            Model model;
            model.variance = times * times * scale * scale;
            for (std::size_t k = 0, rest = choice; k < d; ++k, rest /= lengths.size())
                model.length.push_back(lengths[rest % lengths.size()]);
            Eigen::MatrixXd K = errors;
            for (std::size_t i = 0; i < m; ++i)
                for (std::size_t j = 0; j < m; ++j)
                    K(index(i), index(j)) += model.variance * correlation(points_[i], points_[j], model.length);
            K.diagonal().array() += 1e-10;
            model.factor.compute(K);
            if (model.factor.info() != Eigen::Success)
                continue;
            model.ones = model.factor.solve(one);
            model.precision = one.dot(model.ones);
            model.mean = y.dot(model.ones) / model.precision;
            model.alpha = model.factor.solve(y - model.mean * one);
            const double determinant = 2 * model.factor.matrixLLT().diagonal().array().log().sum();
            log_weight.push_back(-0.5 *
                                 ((y - model.mean * one).dot(model.alpha) + determinant + std::log(model.precision)));
            most = std::max(most, log_weight.back());
            models.push_back(std::move(model));
        }
    double sum = 0;
    for (std::size_t i = 0; i < models.size(); ++i)
        sum += models[i].weight = std::exp(log_weight[i] - most);
    for (Model& model : models)
        model.weight /= sum;
    std::erase_if(models, [](const Model& model) { return model.weight < 1e-4; });
    models_ = std::make_shared<const std::vector<Model>>(std::move(models));
}

ResponseSurface::Value ResponseSurface::at(const SearchPlace& place) const
{
    double mean = 0, square = 0, weights = 0;
    for (const Model& model : *models_) {
        Eigen::VectorXd k(index(points_.size()));
        for (std::size_t i = 0; i < points_.size(); ++i)
            k[index(i)] = model.variance * correlation(place, points_[i], model.length);
        const double rest = 1 - k.dot(model.ones), value = model.mean + k.dot(model.alpha);
        const double variance =
            std::max(0.0, model.variance - k.dot(model.factor.solve(k)) + rest * rest / model.precision);
        mean += model.weight * value;
        square += model.weight * (value * value + variance);
        weights += model.weight;
    }
    mean /= weights;
    return {mean, std::sqrt(std::max(0.0, square / weights - mean * mean))};
}

ResponseSurface::Value ResponseSurface::difference(const SearchPlace& a, const SearchPlace& b) const
{
    double mean = 0, square = 0, weights = 0;
    for (const Model& model : *models_) {
        Eigen::VectorXd k(index(points_.size()));
        for (std::size_t i = 0; i < points_.size(); ++i)
            k[index(i)] =
                model.variance * (correlation(a, points_[i], model.length) - correlation(b, points_[i], model.length));
        const double rest = k.dot(model.ones), value = k.dot(model.alpha);
        const double variance = std::max(0.0, 2 * model.variance * (1 - correlation(a, b, model.length)) -
                                                  k.dot(model.factor.solve(k)) + rest * rest / model.precision);
        mean += model.weight * value;
        square += model.weight * (value * value + variance);
        weights += model.weight;
    }
    mean /= weights;
    return {mean, std::sqrt(std::max(0.0, square / weights - mean * mean))};
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

SearchAnswer search_answer(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates, double level)
{
    SearchAnswer answer;
    double least = std::numeric_limits<double>::infinity();
    for (const SearchPlace& place : candidates)
        if (const double mean = surface.at(place).mean; mean < least) {
            least = mean;
            answer.best = place;
        }
    answer.value = surface.at(answer.best);
    const double z = quantile(boost::math::normal_distribution<double>(), (1 + level) / 2);
    for (const SearchPlace& place : candidates) {
        const ResponseSurface::Value excess = surface.difference(place, answer.best);
        if (excess.mean <= z * excess.sd)
            answer.flat.push_back(place);
    }
    return answer;
}

NextPlace next_place(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates,
                     const std::vector<SearchPlace>& points)
{
    SearchPlace best = points.front();
    double least = surface.at(best).mean;
    for (const SearchPlace& point : points)
        if (const double mean = surface.at(point).mean; mean < least) {
            least = mean;
            best = point;
        }
    const boost::math::normal_distribution<double> normal;
    NextPlace next{{}, -1};
    for (const SearchPlace& place : candidates) {
        if (std::find(points.begin(), points.end(), place) != points.end())
            continue;
        const ResponseSurface::Value change = surface.difference(place, best);
        const double u = change.sd > 0 ? -change.mean / change.sd : 0;
        const double improvement = change.sd > 0 ? change.sd * (u * cdf(normal, u) + pdf(normal, u)) : 0;
        if (improvement > next.improvement)
            next = {place, improvement};
    }
    return next;
}

} // namespace stylobate
