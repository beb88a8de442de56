#include "studies/measured/joint_tests/friction_fit.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t fewest_windows = 4, fewest_on_a_side = 4;
constexpr std::size_t at_start = 3, at_end = 6; // windows of which the friction is compared
constexpr double left_over = 0.4;               // of the first friction
constexpr double clear_of_noise = 5;            // standard deviations

double mean_friction(const std::vector<FrictionWindow>& windows, std::size_t from, std::size_t to)
{
    double sum = 0;
    for (std::size_t i = from; i < to; ++i)
        sum += windows[i].mu;
    return sum / static_cast<double>(to - from);
}

/// Leaves out what is worn away; true if that was anything.
bool cut_where_worn(std::vector<FrictionWindow>& windows)
{
    std::ranges::stable_sort(windows, {}, &FrictionWindow::path_m);
    if (windows.size() < at_start + at_end)
        return false;
    const double first = mean_friction(windows, 0, at_start);
    for (std::size_t i = at_start; i + at_end <= windows.size(); ++i)
        if (mean_friction(windows, i, i + at_end) < left_over * first) {
            windows.resize(std::max(i, fewest_windows));
            return true;
        }
    return false;
}

double side_of(const FrictionWindow& window, FrictionTerm term)
{
    return term == FrictionTerm::speed ? (window.fast ? -1.0 : 1.0) : -window.direction;
}

bool has_both_sides(const std::vector<FrictionWindow>& windows, FrictionTerm term)
{
    const auto plus = static_cast<std::size_t>(
        std::ranges::count_if(windows, [&](const FrictionWindow& w) { return side_of(w, term) > 0; }));
    return plus >= fewest_on_a_side && windows.size() - plus >= fewest_on_a_side;
}

/// mu, and how it changes with each parameter.
double expected(const FrictionWindow& window, const std::vector<FrictionTerm>& terms, const Eigen::VectorXd& at,
                double middle_s, Eigen::VectorXd& slopes)
{
    const auto column = [&](FrictionTerm term) {
        switch (term) {
        case FrictionTerm::wear:
            return -window.path_m;
        case FrictionTerm::time:
            return window.time_s - middle_s;
        default:
            return side_of(window, term) / 2;
        }
    };
    double product = at[0], sum = 0;
    for (std::size_t k = 1; k < terms.size(); ++k)
        if (terms[k] != FrictionTerm::other)
            product *= 1 + at[static_cast<Eigen::Index>(k)] * column(terms[k]);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const auto p = static_cast<Eigen::Index>(k);
        if (terms[k] == FrictionTerm::level)
            slopes[p] = product / at[0];
        else if (terms[k] == FrictionTerm::other) {
            slopes[p] = window.other;
            sum += at[p] * window.other;
        } else {
            const double factor = 1 + at[p] * column(terms[k]);
            slopes[p] = std::fabs(factor) > 1e-9 ? product / factor * column(terms[k]) : 0;
        }
    }
    return product + sum;
}

} // namespace

std::optional<FrictionFit> fit_friction(std::vector<FrictionWindow> windows, const std::vector<FrictionTerm>& wanted)
{
    std::erase_if(windows, [](const FrictionWindow& w) { return !std::isfinite(w.mu) || !(w.sd > 0); });
    const bool worn = cut_where_worn(windows);
    if (windows.size() < fewest_windows)
        return std::nullopt;
    std::vector<FrictionTerm> terms = {FrictionTerm::level, FrictionTerm::wear};
    for (const FrictionTerm term : wanted) {
        const bool sided = term == FrictionTerm::speed || term == FrictionTerm::direction;
        if (sided ? has_both_sides(windows, term) : !worn)
            terms.push_back(term);
    }
    const auto n = static_cast<Eigen::Index>(windows.size()), p = static_cast<Eigen::Index>(terms.size());
    if (n <= p)
        return std::nullopt;
    double middle_s = 0;
    for (const FrictionWindow& window : windows)
        middle_s += window.time_s / static_cast<double>(n);
    Eigen::VectorXd at = Eigen::VectorXd::Zero(p), slopes(p), error(n), scale(n);
    at[0] = mean_friction(windows, 0, windows.size());
    if (!(at[0] > 0))
        return std::nullopt;
    Eigen::MatrixXd columns(n, p);
    const auto fill = [&] {
        for (Eigen::Index i = 0; i < n; ++i) {
            const FrictionWindow& window = windows[static_cast<std::size_t>(i)];
            const double mu = expected(window, terms, at, middle_s, slopes);
            columns.row(i) = slopes.transpose() / window.sd;
            error[i] = (window.mu - mu) / window.sd;
            scale[i] = mu;
        }
    };
    for (int iteration = 0; iteration < 30; ++iteration) {
        fill();
        const Eigen::VectorXd change = columns.colPivHouseholderQr().solve(error);
        at += change;
        if (change.norm() < 1e-10 * at.norm())
            break;
    }
    fill();
    const Eigen::MatrixXd covariance = (columns.transpose() * columns).ldlt().solve(Eigen::MatrixXd::Identity(p, p));
    const double chi2 = error.squaredNorm() / static_cast<double>(n - p), more = std::sqrt(std::max(1.0, chi2));
    if (!at.allFinite() || !covariance.allFinite() || at[0] < clear_of_noise * more * std::sqrt(covariance(0, 0)))
        return std::nullopt;
    FrictionFit fit;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const auto term = static_cast<std::size_t>(terms[k]);
        const auto q = static_cast<Eigen::Index>(k);
        fit.value[term] = at[q];
        fit.sd[term] = more * std::sqrt(std::max(0.0, covariance(q, q)));
    }
    for (Eigen::Index i = 0; i < n; ++i)
        fit.residual.push_back(error[i] * windows[static_cast<std::size_t>(i)].sd / scale[i]);
    fit.windows = std::move(windows);
    return fit;
}

} // namespace stylobate
