#pragma once
/// Limit states of standard normal numbers whose probability is known in closed form.

#include "ensemble/estimators/designs/subset_simulation.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace stylobate {

struct RareTruth {
    std::string name;
    double probability = 0;
    double limit = 0;
    double (*size)(const double*, std::size_t) = nullptr; ///< response at a point
    bool falls = false; ///< as a collapse is seen: the response can be measured up to the fall, and is beyond all then
    std::size_t dimension = 10;

    Response response() const
    {
        return [*this](const std::vector<double>& points, std::uint64_t) {
            std::vector<double> found;
            for (std::size_t i = 0; i < points.size(); i += dimension) {
                const double g = size(&points[i], dimension);
                found.push_back(falls && g >= limit ? std::numeric_limits<double>::infinity() : g);
            }
            return found;
        };
    }
};

/// b with P(N > b) = p.
inline double normal_limit(double p)
{
    return quantile(complement(boost::math::normal_distribution<double>(), p));
}

/// A plane across the diagonal: P(N > b).
inline RareTruth rare_plane(double p, std::size_t dimension = 10)
{
    const auto along = [](const double* u, std::size_t n) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
            sum += u[i];
        return sum / std::sqrt(static_cast<double>(n));
    };
    return {"a plane", p, normal_limit(p), along, true, dimension};
}
/// Two ways to fail, far apart in a space where most numbers do not matter: 2 P(N > b).
inline RareTruth rare_pair(double p)
{
    return {"two planes, opposite", p, normal_limit(p / 2),
            [](const double* u, std::size_t) { return std::abs(u[0]); }};
}
/// Two things have to come together: P(N > b)^2.
inline RareTruth rare_corner(double p)
{
    return {"a corner", p, normal_limit(std::sqrt(p)),
            [](const double* u, std::size_t) { return std::min(u[0], u[1]); }};
}
/// Far out in any direction: chi-square of ten degrees.
inline RareTruth rare_shell(double p)
{
    const double limit = quantile(complement(boost::math::chi_squared_distribution<double>(10), p));
    return {"outside a sphere", p, limit, [](const double* u, std::size_t n) {
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i)
                    sum += u[i] * u[i];
                return sum;
            }};
}

} // namespace stylobate
