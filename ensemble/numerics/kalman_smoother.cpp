#include "ensemble/numerics/kalman_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace stylobate::kalman {

double dot(const Vector& x, const Vector& y)
{
    double sum = 0;
    for (std::size_t i = 0; i < states; ++i)
        sum += x[i] * y[i];
    return sum;
}

namespace {

Vector times(const Matrix& matrix, const Vector& x)
{
    Vector y{};
    for (std::size_t i = 0; i < states; ++i)
        for (std::size_t k = 0; k < states; ++k)
            y[i] += matrix[i][k] * x[k];
    return y;
}

/// matrix * other
Matrix times(const Matrix& matrix, const Matrix& other)
{
    Matrix product{};
    for (std::size_t i = 0; i < states; ++i)
        for (std::size_t k = 0; k < states; ++k)
            if (matrix[i][k] != 0)
                for (std::size_t l = 0; l < states; ++l)
                    product[i][l] += matrix[i][k] * other[k][l];
    return product;
}

Matrix transposed(const Matrix& matrix)
{
    Matrix t;
    for (std::size_t i = 0; i < states; ++i)
        for (std::size_t k = 0; k < states; ++k)
            t[i][k] = matrix[k][i];
    return t;
}

/// Intermediate results of the filter for the smoother.
struct Update {
    Vector gain; ///< P h / S
    double innovation;
    double variance; ///< S
};
struct Step {
    Vector mean;       ///< predicted
    Matrix covariance; ///< predicted
    std::vector<Update> updates;
};

Matrix transition(const Problem& problem, const Process& process)
{
    const double d = problem.dt_s;
    Matrix f{};
    f[u] = {1, d, d * d / 2, d * d * d / 6, 0, 0};
    f[v] = {0, 1, d, d * d / 2, 0, 0};
    f[a] = {0, 0, 1, d, 0, 0};
    f[j][j] = process.smooth_jerk ? 1 : 0;
    f[bias][bias] = f[zero][zero] = 1;
    return f;
}

/// @param steps  receives the input of the smoother; null: only the likelihood is computed
/// @return logarithm of the likelihood, without its constants
double filter(const Problem& problem, const Process& process, std::vector<Step>* steps)
{
    const Matrix f = transition(problem, process);
    Vector x = problem.start_mean;
    Matrix p{};
    for (std::size_t i = 0; i < states; ++i)
        p[i][i] = problem.start_variance[i];
    if (!process.smooth_jerk)
        p[j][j] = process.sd * process.sd;
    double likelihood = 0;
    for (std::size_t k = 0; k < problem.steps(); ++k) {
        if (k > 0) {
            x = times(f, x);
            p = times(f, transposed(times(f, p))); // F (F P)' = F P F', P being symmetric
            p[j][j] += process.sd * process.sd;
        }
        Step step{x, p, {}};
        for (const Measurement& m : problem.at[k]) {
            const Vector ph = times(p, m.row);
            const double s = dot(m.row, ph) + m.variance;
            const double innovation = m.value - dot(m.row, x);
            likelihood -= (std::log(s) + innovation * innovation / s) / 2;
            Update update{{}, innovation, s};
            for (std::size_t i = 0; i < states; ++i) {
                update.gain[i] = ph[i] / s;
                x[i] += update.gain[i] * innovation;
            }
            for (std::size_t i = 0; i < states; ++i)
                for (std::size_t l = 0; l < states; ++l)
                    p[i][l] -= ph[i] * ph[l] / s;
            if (steps)
                step.updates.push_back(update);
        }
        if (steps)
            steps->push_back(std::move(step));
    }
    return likelihood;
}

} // namespace

Process likeliest(const Problem& problem, bool smooth_jerk, double& likelihood)
{
    const auto value = [&](double exponent) {
        const double l = filter(problem, {smooth_jerk, std::pow(10, exponent)}, nullptr);
        return std::isfinite(l) ? l : -std::numeric_limits<double>::max();
    };
    constexpr double lowest = -4, highest = 8, tolerance = 0.02;
    double best = lowest;
    likelihood = value(lowest);
    for (double e = lowest + 1; e <= highest; ++e)
        if (const double l = value(e); l > likelihood) {
            likelihood = l;
            best = e;
        }
    const double part = (std::numbers::phi - 1);
    double from = best - 1, to = best + 1;
    double left = to - part * (to - from), right = from + part * (to - from);
    double at_left = value(left), at_right = value(right);
    while (to - from > tolerance) {
        if (at_left > at_right) {
            to = right;
            right = left;
            at_right = at_left;
            at_left = value(left = to - part * (to - from));
        } else {
            from = left;
            left = right;
            at_left = at_right;
            at_right = value(right = from + part * (to - from));
        }
    }
    likelihood = std::max(at_left, at_right);
    return {smooth_jerk, std::pow(10, (from + to) / 2)};
}

/// Backward: r and N accumulate the later values; x = x_pred + P r, V = P - P N P (de Jong 1989).
Smoothed smoothed(const Problem& problem, const Process& process)
{
    std::vector<Step> steps;
    filter(problem, process, &steps);
    const Matrix f = transition(problem, process), ft = transposed(f);
    Smoothed all;
    all.mean.resize(steps.size());
    all.variance.resize(steps.size());
    Vector r{};
    Matrix n{};
    for (std::size_t k = steps.size(); k-- > 0;) {
        if (k + 1 < steps.size()) {
            r = times(ft, r);
            n = times(ft, transposed(times(ft, n)));
        }
        const Step& step = steps[k];
        for (std::size_t i = step.updates.size(); i-- > 0;) {
            // r = h y / S + L' r, N = h h' / S + L' N L with L = I - K h'
            const Vector& h = problem.at[k][i].row;
            const Update& update = step.updates[i];
            const double rk = dot(update.gain, r);
            const Vector nk = times(n, update.gain);
            const double knk = dot(update.gain, nk);
            for (std::size_t q = 0; q < states; ++q) {
                r[q] += h[q] * (update.innovation / update.variance - rk);
                for (std::size_t l = 0; l < states; ++l)
                    n[q][l] += h[q] * h[l] * (1 / update.variance + knk) - h[q] * nk[l] - nk[q] * h[l];
            }
        }
        const Vector pr = times(step.covariance, r);
        const Matrix pnp = times(step.covariance, transposed(times(step.covariance, n)));
        for (std::size_t q = 0; q < states; ++q) {
            all.mean[k][q] = step.mean[q] + pr[q];
            all.variance[k][q] = std::max(step.covariance[q][q] - pnp[q][q], 0.0);
        }
    }
    return all;
}

} // namespace stylobate::kalman
