#include "ensemble/estimators/designs/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace stylobate {

namespace {

/// What is needed of a row, as places in its list of numbers.
enum Of : std::size_t { a, b, aa, bb, ab, own_ab, square, mean_square, first_factor };
/// And of each factor, from there on.
enum OfFactor : std::size_t { c, cc, bc, ac, own_ac, bc_mean_square, per_factor };

double mean_of(std::span<const double> values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean of y_i z_i.
double own_product(std::span<const double> y, std::span<const double> z)
{
    return std::inner_product(y.begin(), y.end(), z.begin(), 0.0) / static_cast<double>(y.size());
}

/// <y z>: mean of y_i z_j over i != j.
double product(std::span<const double> y, std::span<const double> z)
{
    const auto m = static_cast<double>(y.size());
    return y.size() == 1 ? y[0] * z[0] : (m * mean_of(y) * mean_of(z) - own_product(y, z)) / (m - 1);
}

/// The square of an expected value, from the mean m of n values and the mean of their squares.
double square_of_mean(double m, double mean_of_squares, double n)
{
    return m * m - (mean_of_squares - m * m) / (n - 1);
}

class Design {
public:
    explicit Design(const DesignValues& values) : rows_(values.rows), factors_(values.factors), rest_(values.inner > 1)
    {
        const std::size_t points = factors_ + 2;
        if (values.inner == 0 || rows_ < 2 || values.value.size() != rows_ * points * values.inner)
            throw std::invalid_argument("the outcomes are not (rows x (factors + 2) x inner)");
        centre_ = mean_of(values.value);
        width_ = first_factor + per_factor * factors_;
        acts_.resize(factors_, false);
        std::vector<double> y(points * values.inner);
        for (std::size_t r = 0; r < rows_; ++r) {
            for (std::size_t i = 0; i < y.size(); ++i)
                y[i] = values.value[r * y.size() + i] - centre_;
            add(y, values.inner);
        }
    }

    std::size_t width() const { return width_; }
    std::size_t factors() const { return factors_; }
    bool rest() const { return rest_; }
    double centre() const { return centre_; }
    const std::vector<double>& numbers() const { return numbers_; }
    const std::vector<bool>& acts() const { return acts_; }

    double variance_of_mean(std::span<const double> m) const
    {
        return (m[aa] + m[bb]) / 2 - square_of_mean((m[a] + m[b]) / 2, m[mean_square], rows());
    }
    double variance_of_value(std::span<const double> m) const
    {
        return m[square] - square_of_mean((m[a] + m[b]) / 2, m[mean_square], rows());
    }
    /// Var E[y|x_k], of B and A_k.
    double first(std::span<const double> m, std::size_t k, double beta) const
    {
        return of(m, k, bc) - pair_mean_square(m, k) - beta * control(m);
    }
    /// Var p, of B and A_k.
    double variance_of_pair(std::span<const double> m, std::size_t k) const
    {
        return (m[bb] + of(m, k, cc)) / 2 - pair_mean_square(m, k);
    }
    double total(std::span<const double> m, std::size_t k) const { return (m[aa] + of(m, k, cc)) / 2 - of(m, k, ac); }
    static double of(std::span<const double> m, std::size_t k, OfFactor what)
    {
        return m[first_factor + per_factor * k + what];
    }
    double control(std::span<const double> m) const { return m[ab] - m[a] * m[b]; }

    /// The multiple of the control that makes the first index of a factor vary least.
    std::vector<double> betas() const
    {
        const std::vector<double> mean = row_means(numbers_, width_);
        std::vector<double> without(width_), changes(rows_ * (factors_ + 1));
        for (std::size_t r = 0; r < rows_; ++r) {
            for (std::size_t i = 0; i < width_; ++i)
                without[i] = mean[i] + (mean[i] - numbers_[r * width_ + i]) / (rows() - 1);
            for (std::size_t k = 0; k < factors_; ++k)
                changes[r * (factors_ + 1) + k] = first(without, k, 0) / variance_of_pair(without, k);
            changes[r * (factors_ + 1) + factors_] = control(without);
        }
        const std::vector<double> centre = row_means(changes, factors_ + 1);
        std::vector<double> betas(factors_);
        for (std::size_t k = 0; k < factors_; ++k) {
            double joint = 0, own = 0;
            for (std::size_t r = 0; r < rows_; ++r) {
                const double* row = &changes[r * (factors_ + 1)];
                joint += (row[k] - centre[k]) * (row[factors_] - centre[factors_]);
                own += (row[factors_] - centre[factors_]) * (row[factors_] - centre[factors_]);
            }
            betas[k] = own > 0 && std::isfinite(joint) ? joint / own * variance_of_pair(mean, k) : 0;
        }
        return betas;
    }

private:
    double rows() const { return static_cast<double>(rows_); }
    double pair_mean_square(std::span<const double> m, std::size_t k) const
    {
        return square_of_mean((m[b] + of(m, k, c)) / 2, of(m, k, bc_mean_square), rows());
    }

    /// @param y the outcomes of a row, (points x inner)
    void add(std::span<const double> y, std::size_t inner)
    {
        const auto point = [&](std::size_t p) { return y.subspan(p * inner, inner); };
        const auto half_sum = [](std::span<const double> u, std::span<const double> v) {
            return (mean_of(u) + mean_of(v)) / 2;
        };
        const auto at_a = point(0), at_b = point(1);
        const std::size_t begin = numbers_.size();
        numbers_.resize(begin + width_);
        double* n = &numbers_[begin];
        n[a] = mean_of(at_a);
        n[b] = mean_of(at_b);
        n[aa] = product(at_a, at_a);
        n[bb] = product(at_b, at_b);
        n[ab] = product(at_a, at_b);
        n[own_ab] = own_product(at_a, at_b);
        n[square] = (own_product(at_a, at_a) + own_product(at_b, at_b)) / 2;
        n[mean_square] = half_sum(at_a, at_b) * half_sum(at_a, at_b);
        for (std::size_t k = 0; k < factors_; ++k) {
            const auto at_c = point(k + 2);
            double* f = n + first_factor + per_factor * k;
            f[c] = mean_of(at_c);
            f[cc] = product(at_c, at_c);
            f[bc] = product(at_b, at_c);
            f[ac] = product(at_a, at_c);
            f[own_ac] = (own_product(at_a, at_a) + own_product(at_c, at_c)) / 2 - own_product(at_a, at_c);
            f[bc_mean_square] = half_sum(at_b, at_c) * half_sum(at_b, at_c);
            acts_[k] = acts_[k] || !std::equal(at_a.begin(), at_a.end(), at_c.begin());
        }
    }

    std::size_t rows_, factors_, width_ = 0;
    bool rest_;
    double centre_ = 0;           ///< taken off all outcomes, so that no digits are lost where they vary little
    std::vector<double> numbers_; ///< (rows x width)
    std::vector<bool> acts_;
};

/// A ratio that means something: of a variance that is there.
double share(double part, double variance)
{
    return variance > 0 ? part / variance : std::nan("");
}

Estimate possible_share(const Estimate& e)
{
    const bool zero = e.lower == 0 && e.upper == 0; // of what never changed an outcome
    if (std::isnan(e.value) || (!zero && e.upper <= 0) || e.lower >= 1)
        return Estimate::undetermined();
    return {std::clamp(e.value, 0.0, 1.0), std::clamp(e.lower, 0.0, 1.0), std::clamp(e.upper, 0.0, 1.0)};
}

} // namespace

SobolIndices sobol_indices(const DesignValues& values, const BootstrapOptions& options)
{
    const Design design(values);
    const std::size_t d = design.factors(), with_rest = d + design.rest();
    const std::vector<double> beta = design.betas();
    // mean, explained, then first and total of the mean of each factor, then those of the value
    const auto estimates = [&](std::span<const double> m, std::span<double> out) {
        const double of_mean = design.variance_of_mean(m), of_value = design.variance_of_value(m);
        out[0] = (m[a] + m[b]) / 2 + design.centre();
        out[1] = share(of_mean, of_value);
        std::size_t next = 2;
        for (std::size_t k = 0; k < d; ++k) {
            const double pair = design.variance_of_pair(m, k);
            // where the variance of the mean is not distinguishable from 0, neither is its share
            out[next++] = of_mean > 0 ? share(design.first(m, k, beta[k]), pair) : std::nan("");
            out[next++] = share(design.total(m, k), of_mean);
        }
        for (std::size_t k = 0; k < d; ++k) {
            out[next++] = share(design.first(m, k, beta[k]), of_value);
            out[next++] = share(Design::of(m, k, own_ac), of_value);
        }
        if (design.rest()) {
            out[next++] = share(m[own_ab] - m[ab], of_value);
            out[next++] = share(m[square] - (m[aa] + m[bb]) / 2, of_value);
        }
    };
    const std::vector<Estimate> found =
        resampled_rows(design.numbers(), design.width(), 2 + 2 * d + 2 * with_rest, estimates, options);

    SobolIndices indices;
    indices.mean = found[0];
    indices.explained = found[1];
    indices.acts = design.acts();
    for (std::size_t k = 0; k < d; ++k)
        indices.of_mean.push_back({found[2 + 2 * k], found[3 + 2 * k]});
    for (std::size_t k = 0; k < with_rest; ++k)
        indices.of_value.push_back({found[2 + 2 * d + 2 * k], found[3 + 2 * d + 2 * k]});
    return indices;
}

SobolIndices possible_shares(SobolIndices indices)
{
    indices.explained = possible_share(indices.explained);
    for (auto* of : {&indices.of_mean, &indices.of_value})
        for (FactorIndices& factor : *of)
            factor = {possible_share(factor.first), possible_share(factor.total)};
    return indices;
}

namespace {

/// The root of a square that chance may have made negative.
double root(double square)
{
    return std::sqrt(std::max(square, 0.0));
}

} // namespace

std::vector<ElementaryEffects> elementary_effects(const DesignValues& values, const std::vector<double>& direction,
                                                  const BootstrapOptions& options)
{
    const std::size_t points = values.factors + 1, d = values.factors, m = values.inner;
    if (m == 0 || values.rows < 2 || values.value.size() != values.rows * points * m ||
        direction.size() != values.rows * d)
        throw std::invalid_argument("the outcomes are not (rows x (factors + 1) x inner)");

    constexpr std::size_t width = 3; // of each factor: e, |e|, e^2 without its noise
    std::vector<double> numbers;
    std::vector<bool> acts(d, false);
    numbers.reserve(values.rows * d * width);
    for (std::size_t r = 0; r < values.rows; ++r)
        for (std::size_t k = 0; k < d; ++k) {
            double sum = 0, squares = 0;
            for (std::size_t i = 0; i < m; ++i) {
                const double effect = (values.at(r, k + 1, i, points) - values.at(r, 0, i, points)) / elementary_step;
                acts[k] = acts[k] || effect != 0;
                sum += effect;
                squares += effect * effect;
            }
            const auto n = static_cast<double>(m);
            const double mean = sum / n;
            const double noise = m > 1 ? (squares / n - mean * mean) / (n - 1) : 0;
            numbers.insert(numbers.end(), {mean * direction[r * d + k], std::abs(mean), mean * mean - noise});
        }

    const auto estimates = [&](std::span<const double> means, std::span<double> out) {
        for (std::size_t k = 0; k < d; ++k) {
            const double mu = means[width * k], square = means[width * k + 2];
            const double n = static_cast<double>(values.rows);
            out[4 * k] = mu;
            out[4 * k + 1] = means[width * k + 1];
            out[4 * k + 2] = root(square);
            out[4 * k + 3] = std::isnan(mu) ? mu : root((square - mu * mu) * n / (n - 1));
        }
    };
    const std::vector<Estimate> found = bootstrap_rows(numbers, width * d, 4 * d, estimates, options);
    std::vector<ElementaryEffects> effects;
    for (std::size_t k = 0; k < d; ++k)
        effects.push_back({found[4 * k], found[4 * k + 1], found[4 * k + 2], found[4 * k + 3], acts[k]});
    return effects;
}

} // namespace stylobate
