#include "ensemble/estimators/search/paired_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

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
