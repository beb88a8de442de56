#include "ensemble/estimators/surface/adaptive.hpp"

#include "ensemble/numerics/eigen_blocks.hpp"
#include "ensemble/numerics/elementary.hpp"
#include "ensemble/numerics/in_parallel.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace stylobate {

AdaptiveAllocation::AdaptiveAllocation(const AdaptiveSpec& spec, std::size_t rows, std::size_t columns,
                                       std::uint64_t most)
    : spec_(spec), analyses_(spec.minimum, most, spec.half_width, adaptive_level), model_(adaptive_level),
      rounds_(spec.budget, rows * columns)
{
    assert(spec.minimum * asked().size() <= spec.budget && "checked where the study is read");
}

std::vector<CellEstimate> AdaptiveAllocation::estimate(const SurfaceTrials& data)
{
    if (!estimates_.empty() && known_.trials == data.trials && known_.collapses == data.collapses)
        return estimates_;
    std::vector<SurfaceEstimate> surface;
    if (spec_.borrow)
        surface = model_.estimate(data);
    std::vector<CellEstimate> estimates;
    for (std::size_t cell = 0; cell < data.cells(); ++cell) {
        const std::uint64_t n = data.trials[cell];
        const BinomialInterval own = analyses_.interval(n, data.collapses[cell]);
        // a rough surface can make it wider: then it does not keep a cell going that its own trials have finished
        if (spec_.borrow && surface[cell].agrees_with_neighbours &&
            (analyses_.narrow(surface[cell].interval) || !analyses_.narrow(own)))
            estimates.push_back({surface[cell].probability, surface[cell].interval, IntervalMethod::surface});
        else
            estimates.push_back({n > 0 ? static_cast<double>(data.collapses[cell]) / static_cast<double>(n)
                                       : std::numeric_limits<double>::quiet_NaN(),
                                 own, IntervalMethod::own});
    }
    known_ = data;
    estimates_ = estimates;
    return estimates;
}

const std::vector<std::uint64_t>& AdaptiveAllocation::next(const SurfaceTrials& data)
{
    if (rounds() > 0)
        estimate(data);
    return rounds_.next(analyses_.trials(), [this](std::size_t cell) -> std::optional<double> {
        const BinomialInterval& interval = estimates_[cell].interval;
        return analyses_.narrow(interval) ? std::nullopt : std::optional(interval.upper - interval.lower);
    });
}

namespace {

constexpr int radius = 2; ///< of a window: cells to either side
constexpr int most_neighbours = (2 * radius + 1) * (2 * radius + 1) - 1;
constexpr int lags = 4 * radius + 1; ///< differences between two cells of a window, from -2 radius on
constexpr double level_sd = 4;       ///< of the level about which a window's surface varies, in logit

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_neighbours, most_neighbours>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_neighbours, 1>;

/// A Gaussian process: its covariances by difference of row and column.
struct Setting {
    std::array<double, lags * lags> covariance;
    double misfit2; ///< variance of each cell's own departure

    double between(int rows, int columns) const
    {
        return covariance[static_cast<std::size_t>((rows + 2 * radius) * lags + columns + 2 * radius)];
    }
};

Setting make_setting(double row_length, double column_length, double sd, double misfit)
{
    Setting setting{{}, misfit * misfit};
    std::size_t at = 0;
    for (int r = -2 * radius; r <= 2 * radius; ++r)
        for (int c = -2 * radius; c <= 2 * radius; ++c) {
            const double x = r / row_length;
            const double y = c / column_length;
            const double d = std::sqrt(5 * (x * x + y * y));
            setting.covariance[at++] = level_sd * level_sd + sd * sd * (1 + d + d * d / 3) * exp_of(-d);
        }
    return setting;
}

const std::vector<Setting>& settings()
{
    static const std::vector<Setting> all = [] {
        std::vector<Setting> made;
        for (const double row_length : {1.2, 3.0, 8.0})
            for (const double column_length : {1.2, 3.0, 8.0})
                for (const auto& [sd, misfit] : {std::pair(2.0, 0.1), {2.0, 0.4}, {6.0, 0.3}, {6.0, 1.0}})
                    made.push_back(make_setting(row_length, column_length, sd, misfit));
        return made;
    }();
    return all;
}

/// e: the probability that the neighbours carry no information.
constexpr std::array<double, 2> wrong = {0.02, 0.2};

/// Logits at which densities are held.
constexpr int points = 401;
constexpr double first_logit = -10;
constexpr double logit_step = 0.05;

struct LogitGrid {
    std::array<double, points> logit, log_p, log_q, p, alone; ///< alone: B
};

const LogitGrid& grid()
{
    static const LogitGrid made = [] {
        LogitGrid g{};
        for (std::size_t i = 0; i < points; ++i) {
            const double u = first_logit + logit_step * static_cast<double>(i);
            g.logit[i] = u;
            g.log_q[i] = -log_of(1 + exp_of(u));
            g.log_p[i] = u + g.log_q[i];
            g.p[i] = exp_of(g.log_p[i]);
            g.alone[i] = exp_of(0.5 * (g.log_p[i] + g.log_q[i])) / std::numbers::pi;
        }
        return g;
    }();
    return made;
}

using Density = std::array<double, points>;

/// Likelihood of a cell's trials, its largest value 1.
Density likelihood(std::uint64_t trials, std::uint64_t collapses)
{
    const LogitGrid& g = grid();
    const auto s = static_cast<double>(collapses);
    const auto rest = static_cast<double>(trials - collapses);
    Density density;
    for (std::size_t i = 0; i < points; ++i)
        density[i] = s * g.log_p[i] + rest * g.log_q[i];
    const double top = *std::max_element(density.begin(), density.end());
    for (double& d : density)
        d = d - top < -700 ? 0 : exp_of(d - top);
    return density;
}

/// Calls f(point, density of the normal distribution) where it is not negligible. A mean beyond the grid is moved to
/// its end: there p is 0 or 1 to 5e-5.
template <class F>
void visit_normal(double mean, double variance, F&& f)
{
    const double sd = std::sqrt(variance);
    const double m = std::clamp(mean, first_logit, -first_logit);
    const double scale = 1 / (sd * std::sqrt(2 * std::numbers::pi));
    const int from = std::max(0, static_cast<int>(std::ceil((m - 6 * sd - first_logit) / logit_step)));
    const int to = std::min(points - 1, static_cast<int>(std::floor((m + 6 * sd - first_logit) / logit_step)));
    // exp(-(x + k h)^2 / 2) by products of ratios that grow by one ratio themselves
    const double x = (first_logit + from * logit_step - m) / sd;
    const double h = logit_step / sd;
    double value = scale * exp_of(-0.5 * x * x);
    double ratio = exp_of(-x * h - 0.5 * h * h);
    const double ratio_of_ratios = exp_of(-h * h);
    for (int i = from; i <= to; ++i) {
        f(static_cast<std::size_t>(i), value);
        value *= ratio;
        ratio *= ratio_of_ratios;
    }
}

/// The cells of a window but its middle.
struct Window {
    int size = 0;
    std::array<std::size_t, most_neighbours> cell;
    std::array<int, most_neighbours> row, column; ///< from the middle
};

Window window_of(const SurfaceTrials& data, std::size_t cell)
{
    Window window;
    const auto rows = static_cast<int>(data.rows);
    const auto columns = static_cast<int>(data.columns);
    const int row = static_cast<int>(cell / data.columns);
    const int column = static_cast<int>(cell % data.columns);
    for (int r = std::max(0, row - radius); r <= std::min(rows - 1, row + radius); ++r)
        for (int c = std::max(0, column - radius); c <= std::min(columns - 1, column + radius); ++c)
            if (r != row || c != column) {
                const auto k = static_cast<std::size_t>(window.size++);
                window.cell[k] = static_cast<std::size_t>(r) * data.columns + static_cast<std::size_t>(c);
                window.row[k] = r - row;
                window.column[k] = c - column;
            }
    return window;
}

struct Prediction {
    double mean;
    double variance;
};

/// The latent process at the middle of a window, given the trials around it.
///
/// Newton's steps for the mode f = K a of the posterior, halved where they overshoot; with W the curvature of the
/// likelihood, B = 1 + W^1/2 K W^1/2, and k the covariances with the middle (Rasmussen & Williams 2006, algorithms 3.1
/// and 3.2):
///   mean = k a,   variance = k(0) + misfit2 - k W^1/2 B^-1 W^1/2 k
///
/// @param a initial value of the search, where it is better than zeros, and the mode afterwards: the modes of
///          successive settings are close to each other
Prediction predict(const Setting& setting, const Window& window, const SurfaceTrials& data, Vector& a)
{
    const Eigen::Index size = window.size;
    Matrix K(size, size);
    Vector n(size), s(size), k(size);
    for (Eigen::Index i = 0; i < size; ++i) {
        const auto at = static_cast<std::size_t>(i);
        n[i] = static_cast<double>(data.trials[window.cell[at]]);
        s[i] = static_cast<double>(data.collapses[window.cell[at]]);
        k[i] = setting.between(window.row[at], window.column[at]);
        for (Eigen::Index j = 0; j <= i; ++j) {
            const auto to = static_cast<std::size_t>(j);
            K(i, j) = K(j, i) = setting.between(window.row[at] - window.row[to], window.column[at] - window.column[to]);
        }
        K(i, i) += setting.misfit2;
    }

    Vector f = K * a, W(size), root(size), p(size);
    const auto objective = [&](const Vector& with_a, const Vector& with_f) {
        double sum = -0.5 * with_a.dot(with_f);
        for (Eigen::Index i = 0; i < size; ++i) {
            // log(1 + e^f) without overflow
            const double u = with_f[i];
            sum += s[i] * u - n[i] * (std::max(u, 0.0) + log_of(1 + exp_of(-std::min(std::abs(u), 700.0))));
        }
        return sum;
    };
    Eigen::LLT<Matrix> B;
    double reached = objective(a, f);
    if (const double at_zero = -std::numbers::ln2 * n.sum(); !(reached > at_zero)) {
        a.setZero();
        f.setZero();
        reached = at_zero;
    }
    const auto curve = [&] {
        for (Eigen::Index i = 0; i < size; ++i) {
            const double e = exp_of(-std::min(std::abs(f[i]), 700.0));
            p[i] = f[i] >= 0 ? 1 / (1 + e) : e / (1 + e);
            W[i] = n[i] * e / ((1 + e) * (1 + e));
            root[i] = std::sqrt(W[i]);
        }
        Matrix inner = root.asDiagonal() * K * root.asDiagonal();
        inner.diagonal().array() += 1;
        B.compute(inner);
    };
    for (int iteration = 0; iteration < 30; ++iteration) {
        curve();
        const Vector b = W.cwiseProduct(f) + s - n.cwiseProduct(p);
        const Vector step = b - root.cwiseProduct(B.solve(root.cwiseProduct(K * b))) - a;
        const Vector change = K * step;
        double part = 1;
        double now = objective(a + step, f + change);
        while (now < reached && part > 1e-3) {
            part /= 2;
            now = objective(a + part * step, f + part * change);
        }
        if (!(now >= reached))
            break;
        a += part * step;
        f += part * change;
        const bool settled = now - reached < 1e-5;
        reached = now;
        if (settled)
            break;
    }
    curve();
    const Vector half = B.matrixL().solve(root.cwiseProduct(k));
    const double own = setting.between(0, 0) + setting.misfit2;
    return {k.dot(s - n.cwiseProduct(p)), std::max(own - half.squaredNorm(), setting.misfit2)};
}

/// The point below which a part of a density lies. @param density at the points, not normalized; @param sum its sum
double quantile_of(const Density& density, double sum, double part)
{
    double below = 0;
    for (std::size_t i = 0; i < points; ++i) {
        if (below + density[i] >= part * sum) {
            const double inside = density[i] > 0 ? (part * sum - below) / density[i] : 0.5;
            return grid().logit[i] + (inside - 0.5) * logit_step;
        }
        below += density[i];
    }
    return grid().logit.back();
}

double probability_of(double logit)
{
    return 1 / (1 + exp_of(-logit));
}

} // namespace

void SurfaceModel::update(std::size_t cell, const SurfaceTrials& data, bool same_grid)
{
    const auto changed = [&](std::size_t c) {
        return !same_grid || last_.trials[c] != data.trials[c] || last_.collapses[c] != data.collapses[c];
    };
    const Window window = window_of(data, cell);
    Neighbours& said = neighbours_[cell];
    const bool around =
        std::any_of(window.cell.begin(), window.cell.begin() + window.size, [&](auto c) { return changed(c); });
    if (around || said.mean.empty()) {
        said.mean.clear();
        said.variance.clear();
        Vector a = Vector::Zero(window.size);
        for (const Setting& setting : settings()) {
            const Prediction prediction = predict(setting, window, data, a);
            said.mean.push_back(prediction.mean);
            said.variance.push_back(prediction.variance);
        }
    }
    if (around || changed(cell)) {
        const Density own = likelihood(data.trials[cell], data.collapses[cell]);
        said.evidence.clear();
        for (std::size_t t = 0; t < settings().size(); ++t) {
            double sum = 0;
            visit_normal(said.mean[t], said.variance[t], [&](std::size_t i, double d) { sum += d * own[i]; });
            said.evidence.push_back(sum * logit_step);
        }
        said.evidence_alone = 0;
        for (std::size_t i = 0; i < points; ++i)
            said.evidence_alone += grid().alone[i] * own[i] * logit_step;
    }
}

SurfaceEstimate SurfaceModel::combined(std::size_t cell, const SurfaceTrials& data) const
{
    const Window window = window_of(data, cell);
    const std::size_t count = settings().size();
    std::vector<double> score(count * wrong.size(), 0);
    for (std::size_t k = 0; k < static_cast<std::size_t>(window.size); ++k) {
        const Neighbours& said = neighbours_[window.cell[k]];
        for (std::size_t t = 0; t < count; ++t)
            for (std::size_t e = 0; e < wrong.size(); ++e)
                score[t * wrong.size() + e] +=
                    log_of((1 - wrong[e]) * said.evidence[t] + wrong[e] * said.evidence_alone);
    }
    const double best = *std::max_element(score.begin(), score.end());
    const Density own = likelihood(data.trials[cell], data.collapses[cell]);
    Density density{};
    double alone = 0;
    const Neighbours& said = neighbours_[cell];
    for (std::size_t t = 0; t < count; ++t) {
        double weight = 0;
        for (std::size_t e = 0; e < wrong.size(); ++e) {
            const double w = exp_of(std::max(score[t * wrong.size() + e] - best, -700.0));
            weight += w * (1 - wrong[e]);
            alone += w * wrong[e];
        }
        if (weight > 1e-9)
            visit_normal(said.mean[t], said.variance[t],
                         [&](std::size_t i, double d) { density[i] += weight * d * own[i]; });
    }
    double together = 0;
    for (std::size_t i = 0; i < points; ++i)
        together += density[i];
    double apart = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const double d = alone * grid().alone[i] * own[i];
        apart += d;
        density[i] += d;
    }
    const double sum = together + apart, tail = (1 - level_) / 2;
    SurfaceEstimate estimate;
    double mean = 0;
    for (std::size_t i = 0; i < points; ++i)
        mean += grid().p[i] * density[i];
    estimate.probability = mean / sum;
    estimate.agrees_with_neighbours = together > apart;
    estimate.interval.lower = data.collapses[cell] == 0 ? 0 : probability_of(quantile_of(density, sum, tail));
    estimate.interval.upper =
        data.collapses[cell] == data.trials[cell] ? 1 : probability_of(quantile_of(density, sum, 1 - tail));
    return estimate;
}

std::vector<SurfaceEstimate> SurfaceModel::estimate(const SurfaceTrials& data)
{
    assert(data.trials.size() == data.cells() && data.collapses.size() == data.cells());
    const std::size_t cells = data.cells();
    const bool same_grid = last_.rows == data.rows && last_.columns == data.columns;
    neighbours_.resize(cells);
    in_parallel(std::size_t{0}, cells, [&](std::size_t cell) { update(cell, data, same_grid); });
    last_ = data;
    std::vector<SurfaceEstimate> estimates(cells);
    in_parallel(std::size_t{0}, cells, [&](std::size_t cell) { estimates[cell] = combined(cell, data); });
    return estimates;
}

} // namespace stylobate
