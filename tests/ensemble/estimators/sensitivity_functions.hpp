#pragma once
/// Functions with known indices, on designs made here, with a generator that the estimators do not have.

#include "ensemble/estimators/designs/sobol_indices.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace stylobate::testing {

using Point = std::vector<double>;

/// Outcomes of f(x, w) over a design: A, B, A_1 ... (or A, A_1 ... without B), w the same at all points of a row.
template <class F>
DesignValues sobol_design(std::size_t rows, std::size_t factors, std::size_t inner, std::mt19937_64& random, F&& f)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    DesignValues values{rows, factors, inner, {}};
    for (std::size_t r = 0; r < rows; ++r) {
        Point a(factors), b(factors), w(inner);
        for (Point* point : {&a, &b, &w})
            for (double& x : *point)
                x = uniform(random);
        const auto run = [&](const Point& x) {
            for (const double rest : w)
                values.value.push_back(f(x, rest));
        };
        run(a);
        run(b);
        for (std::size_t k = 0; k < factors; ++k) {
            Point c = a;
            c[k] = b[k];
            run(c);
        }
    }
    return values;
}

/// Ishigami and Homma (1990) with a = 7, b = 0.1.
inline double ishigami(const Point& u, double = 0)
{
    const auto x = [&](std::size_t i) { return std::numbers::pi * (2 * u[i] - 1); };
    return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

/// V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, V13 = 8 b^2 pi^8 / 225.
struct IshigamiIndices {
    std::vector<double> first, total;
    IshigamiIndices()
    {
        const double pi4 = std::pow(std::numbers::pi, 4);
        const double v1 = std::pow(1 + 0.1 * pi4 / 5, 2) / 2, v2 = 49.0 / 8, v13 = 8 * 0.01 * pi4 * pi4 / 225;
        const double v = v1 + v2 + v13;
        first = {v1 / v, v2 / v, 0};
        total = {(v1 + v13) / v, v2 / v, v13 / v};
    }
};

/// Sobol's g-function: the product of (|4 u_k - 2| + a_k) / (1 + a_k), V_k = 1 / (3 (1 + a_k)^2).
struct GFunction {
    std::vector<double> a;
    double operator()(const Point& u, double = 0) const
    {
        double g = 1;
        for (std::size_t k = 0; k < a.size(); ++k)
            g *= (std::abs(4 * u[k] - 2) + a[k]) / (1 + a[k]);
        return g;
    }
    double part(std::size_t k) const { return 1 / (3 * (1 + a[k]) * (1 + a[k])); }
    double variance() const
    {
        double product = 1;
        for (std::size_t k = 0; k < a.size(); ++k)
            product *= 1 + part(k);
        return product - 1;
    }
    double first(std::size_t k) const { return part(k) / variance(); }
    double total(std::size_t k) const { return part(k) * (variance() + 1) / (1 + part(k)) / variance(); }
};

/// A fall with the probability p(u) = 0.1 + 0.8 u_1 (0.3 + 0.7 u_2); u_3 has no effect on it. Which of the realizations
/// fall is decided by the rest alone (w < p), or by w and u_3 together, as chaos does it: (w + 1000 u_3) mod 1 < p.
struct Falls {
    bool chaos = false;
    static double probability(const Point& u) { return 0.1 + 0.8 * u[0] * (0.3 + 0.7 * u[1]); }
    double operator()(const Point& u, double w) const
    {
        const double s = chaos ? std::fmod(w + 1000 * u[2], 1.0) : w;
        return s < probability(u) ? 1 : 0;
    }
    // with q = u_1 r, r = 0.3 + 0.7 u_2: E u = 1/2, Var u = 1/12, E r = 0.65, Var r = 0.49 / 12
    static constexpr double variance_u = 1.0 / 12, variance_r = 0.49 / 12, mean_r = 0.65;
    static double variance()
    {
        return 0.64 * (variance_u * mean_r * mean_r + variance_r * 0.25 + variance_u * variance_r);
    }
    static double mean() { return 0.1 + 0.8 * 0.5 * mean_r; }
    static double variance_of_value() { return mean() * (1 - mean()); }
    static std::vector<double> first()
    {
        return {0.64 * variance_u * mean_r * mean_r / variance(), 0.64 * variance_r * 0.25 / variance(), 0};
    }
    static std::vector<double> total() { return {1 - first()[1], 1 - first()[0], 0}; }
};

} // namespace stylobate::testing
