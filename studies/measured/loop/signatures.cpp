#include "studies/measured/loop/signatures.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace stylobate {

namespace {

constexpr double least_finite = 0.75;  // part of the healthy specimens in which a used column has a value
constexpr double least_deviations = 2; // of a shift that counts, in standard deviations
constexpr double least_errors = 3;     // and in its standard errors
constexpr double least_floor = 0.05;   // of the scatter: no test repeats itself better
constexpr double common_floor = 2;     // of what all joints have in common, over the floor of one
constexpr double fewest_of_cause = 3;  // specimens with an estimate
constexpr double guessed_part = 0.5;   // standard deviation of a shift that a weaker size lets expect, over the shift
constexpr Eigen::Index parts_left_out = 6; // one after the other
// Of the scatter of a cause. What is not seen of it decides: a velocity of Stribeck's law moves all joints together,
// and some specimens alone do not tell in which proportions.
constexpr double common_part = 0.5;

/// Mean, variance and number of the finite values.
struct FiniteMoments {
    double mean = 0, variance = 0;
    double count = 0;
};

FiniteMoments finite_moments(const Eigen::VectorXd& values)
{
    FiniteMoments m;
    for (const double v : values)
        if (std::isfinite(v)) {
            m.mean += v;
            ++m.count;
        }
    if (m.count == 0)
        return m;
    m.mean /= m.count;
    for (const double v : values)
        if (std::isfinite(v))
            m.variance += (v - m.mean) * (v - m.mean);
    m.variance = m.count > 1 ? m.variance / (m.count - 1) : 0;
    return m;
}

/// An orthonormal basis (p x p, a row each): of each group of like columns the mean and Helmert's contrasts.
Eigen::MatrixXd joint_contrasts(Eigen::Index p, const std::vector<std::vector<Eigen::Index>>& alike)
{
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(p, p);
    for (const std::vector<Eigen::Index>& group : alike)
        for (std::size_t k = 0; k < group.size(); ++k) {
            const auto n = static_cast<double>(k == 0 ? group.size() : k);
            for (std::size_t i = 0; i < (k == 0 ? group.size() : k); ++i)
                basis(group[k], group[i]) = k == 0 ? 1 / std::sqrt(n) : 1 / std::sqrt(n * (n + 1));
            if (k > 0)
                basis(group[k], group[k]) = -n / std::sqrt(n * (n + 1));
        }
    return basis;
}

/// Mean squared distance of the estimates of specimens that were left out, for each estimate.
double distance_left_out(const TestSamples& tests, const Signatures& s)
{
    double sum = 0, count = 0;
    const Eigen::Index n = tests.healthy.rows();
    for (Eigen::Index part = 0; part < parts_left_out; ++part) {
        std::vector<Eigen::Index> kept;
        for (Eigen::Index i = 0; i < n; ++i)
            if (i % parts_left_out != part)
                kept.push_back(i);
        Signatures others = s;
        std::tie(others.mean, others.covariance) = healthy_scatter(tests.healthy(kept, Eigen::all), s.alike);
        for (Eigen::Index i = part; i < n; i += parts_left_out) {
            std::vector<Eigen::Index> finite;
            for (Eigen::Index j = 0; j < s.mean.size(); ++j)
                if (s.used[static_cast<std::size_t>(j)] && std::isfinite(tests.healthy(i, j)))
                    finite.push_back(j);
            if (finite.empty())
                continue;
            const Eigen::VectorXd off = tests.healthy(i, finite).transpose() - others.mean(finite);
            sum += off.dot(others.covariance_of(finite).llt().solve(off));
            count += static_cast<double>(finite.size());
        }
    }
    return count > 0 ? sum / count : 1;
}

bool has_pairs(const CauseSamples& samples)
{
    return samples.differences || !samples.pairs.empty();
}

/// One column: differences from the healthy specimens of the same law, where there are such; else as it is.
Eigen::VectorXd against_twins(const TestSamples& tests, const CauseSamples& samples, Eigen::Index j)
{
    Eigen::VectorXd values = samples.rows.col(j);
    for (std::size_t i = 0; i < samples.pairs.size() && !samples.differences; ++i)
        values(static_cast<Eigen::Index>(i)) -= tests.healthy(samples.pairs[i], j);
    return values;
}

/// Shift and additional variance of one column, before small ones are left out.
struct ColumnShift {
    double shift = 0, variance = 0, error = 0;
    bool known = false;
};

ColumnShift column_shift(const TestSamples& tests, const CauseSamples& samples, Eigen::Index j)
{
    ColumnShift out;
    const bool paired = has_pairs(samples);
    const FiniteMoments with = finite_moments(against_twins(tests, samples, j));
    if (with.count < fewest_of_cause)
        return out;
    out.known = true;
    if (paired) {
        out.shift = with.mean;
        out.error = std::sqrt(with.variance / with.count);
        out.variance = with.variance;
    } else {
        const FiniteMoments without = finite_moments(tests.healthy.col(j));
        out.shift = with.mean - without.mean;
        out.error = std::sqrt(with.variance / with.count + without.variance / without.count);
        out.variance = std::max(0.0, with.variance - without.variance);
    }
    out.variance += out.error * out.error;
    return out;
}

/// Takes half of the scatter as what the estimates have together in the same specimens.
void take_common_part(const TestSamples& tests, const CauseSamples& samples, CauseSignature& out)
{
    if (!has_pairs(samples) || samples.rows.rows() < 2)
        return;
    const Eigen::Index m = samples.rows.rows();
    out.common = Eigen::MatrixXd::Zero(out.shift.size(), m);
    for (Eigen::Index j = 0; j < out.shift.size(); ++j) {
        if (out.shift(j) == 0 || !column_shift(tests, samples, j).known)
            continue;
        const Eigen::VectorXd values = against_twins(tests, samples, j);
        const FiniteMoments with = finite_moments(values);
        for (Eigen::Index i = 0; i < m; ++i)
            if (std::isfinite(values(i)))
                out.common(j, i) = std::sqrt(common_part / (with.count - 1)) * (values(i) - with.mean);
        out.variance(j) -= common_part * with.variance;
    }
}

/// Where a cause leaves hardly an estimate, because what is tested falls: in proportion to a weaker size.
void guess_shift(const CauseSignature* weaker, Eigen::Index j, CauseSignature& out)
{
    if (weaker && weaker->shift(j) != 0) {
        out.shift(j) = out.cause.size / weaker->cause.size * weaker->shift(j);
        out.variance(j) = guessed_part * guessed_part * out.shift(j) * out.shift(j);
    }
}

/// The next weaker size of the same cause.
const CauseSignature* next_weaker(const std::vector<CauseSignature>& known, const TestedCause& cause)
{
    const CauseSignature* found = nullptr;
    for (const CauseSignature& c : known)
        if (c.cause.at() == cause.at() && c.cause.size * cause.size > 0 &&
            std::fabs(c.cause.size) < std::fabs(cause.size) &&
            (!found || std::fabs(c.cause.size) > std::fabs(found->cause.size)))
            found = &c;
    return found;
}

/// @param weaker the next weaker size of the same cause; null: there is none
CauseSignature cause_signature(const TestSamples& tests, const CauseSamples& samples, const Signatures& s,
                               const Eigen::VectorXd& sd, const CauseSignature* weaker)
{
    const Eigen::Index p = s.mean.size();
    CauseSignature out{samples.cause, Eigen::VectorXd::Zero(p), Eigen::VectorXd::Zero(p)};
    for (Eigen::Index j = 0; j < p; ++j) {
        if (!s.used[static_cast<std::size_t>(j)])
            continue;
        const ColumnShift c = column_shift(tests, samples, j);
        if (!c.known) {
            guess_shift(weaker, j, out);
            continue;
        }
        if (std::fabs(c.shift) < least_deviations * sd(j) || std::fabs(c.shift) < least_errors * c.error)
            continue;
        out.shift(j) = c.shift;
        out.variance(j) = c.variance;
    }
    take_common_part(tests, samples, out);
    return out;
}

/// The sample correlation of n rows of scatter 1, in which what is within the noise of so many rows, sqrt(2 ln p / n),
/// is 0 (Bickel and Levina, "Covariance regularization by thresholding", Annals of Statistics 36 (2008) 2577). Few
/// estimators are correlated, and those strongly: the friction of a joint in several tests. A shrinkage of all towards
/// 0 would make many quantities of that one.
Eigen::MatrixXd sparse_correlation(const Eigen::MatrixXd& rows)
{
    const auto n = static_cast<double>(rows.rows() - 1), p = static_cast<double>(rows.cols());
    Eigen::MatrixXd out = rows.transpose() * rows / n;
    const Eigen::VectorXd scale = out.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    out = scale.asDiagonal() * out * scale.asDiagonal();
    const double noise = std::sqrt(2 * std::log(std::max(p, 2.0)) / n);
    for (Eigen::Index i = 0; i < out.rows(); ++i)
        for (Eigen::Index j = 0; j < out.cols(); ++j)
            out(i, j) = i == j ? 1 : std::fabs(out(i, j)) < noise ? 0 : out(i, j);
    constexpr double least = 0.005; // of the eigenvalues: what is left need not be positive definite
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(out);
    if (parts.eigenvalues().minCoeff() >= least)
        return out;
    out = parts.eigenvectors() * parts.eigenvalues().cwiseMax(least).asDiagonal() * parts.eigenvectors().transpose();
    const Eigen::VectorXd one = out.diagonal().cwiseSqrt().cwiseInverse();
    return one.asDiagonal() * out * one.asDiagonal();
}

/// Of the means over the joints; and one for all contrasts, which the specimens have joints - 1 times.
/// @param contrasts (n x p) of scatter 1
Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& contrasts, const std::vector<std::vector<Eigen::Index>>& alike)
{
    const Eigen::Index n = contrasts.rows(), p = contrasts.cols(), estimators = static_cast<Eigen::Index>(alike.size());
    std::size_t joints = 1;
    for (const std::vector<Eigen::Index>& group : alike)
        joints = std::max(joints, group.size());
    const auto columns_of = [&](std::size_t k) { // of the mean (0) or the k-th contrast, of the estimators that have it
        std::pair<std::vector<Eigen::Index>, std::vector<Eigen::Index>> out;
        for (std::size_t e = 0; e < alike.size(); ++e)
            if (alike[e].size() > k) {
                out.first.push_back(static_cast<Eigen::Index>(e));
                out.second.push_back(alike[e][k]);
            }
        return out;
    };
    const auto contrasts_each = static_cast<Eigen::Index>(joints) - 1;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n * contrasts_each, estimators);
    for (Eigen::Index k = 0; k < contrasts_each; ++k) {
        const auto [at, columns] = columns_of(static_cast<std::size_t>(k) + 1);
        all.middleRows(n * k, n)(Eigen::all, at) = contrasts(Eigen::all, columns);
    }
    const auto [means, mean_columns] = columns_of(0);
    Eigen::MatrixXd out = Eigen::MatrixXd::Identity(p, p);
    out(mean_columns, mean_columns) = sparse_correlation(contrasts(Eigen::all, mean_columns));
    if (contrasts_each == 0)
        return out;
    const Eigen::MatrixXd of_contrasts = sparse_correlation(all);
    for (std::size_t k = 1; k < joints; ++k) {
        const auto [at, columns] = columns_of(k);
        out(columns, columns) = of_contrasts(at, at);
    }
    return out;
}

/// What is missing at one joint stands where the specimen's other joints are: their common part may be far from the
/// mean, and is no contrast.
void stand_in_for_missing(const std::vector<std::vector<Eigen::Index>>& alike, Eigen::MatrixXd& off)
{
    for (const std::vector<Eigen::Index>& group : alike)
        for (Eigen::Index i = 0; i < off.rows(); ++i) {
            const FiniteMoments others = finite_moments(off(i, group).transpose());
            for (const Eigen::Index j : group)
                if (!std::isfinite(off(i, j)))
                    off(i, j) = others.mean; // 0 of none
        }
    off = off.array().isFinite().select(off, 0).eval(); // columns that are not used
}

} // namespace

std::pair<Eigen::VectorXd, Eigen::MatrixXd> healthy_scatter(const Eigen::MatrixXd& rows,
                                                            const std::vector<std::vector<Eigen::Index>>& alike)
{
    const Eigen::Index n = rows.rows(), p = rows.cols();
    Eigen::VectorXd mean(p), seen(p);
    Eigen::MatrixXd off(n, p);
    for (Eigen::Index j = 0; j < p; ++j) {
        const FiniteMoments m = finite_moments(rows.col(j));
        mean(j) = m.mean;
        seen(j) = m.count;
        off.col(j) = rows.col(j).array() - m.mean;
    }
    stand_in_for_missing(alike, off);
    const Eigen::MatrixXd basis = joint_contrasts(p, alike);
    Eigen::MatrixXd contrasts = off * basis.transpose();
    Eigen::VectorXd sd(p);
    for (Eigen::Index j = 0; j < p; ++j) {
        sd(j) = contrasts.col(j).norm() / std::sqrt(std::max(seen(j) - 1, 1.0)); // by those that were seen
        contrasts.col(j) /= std::max(sd(j), 1e-300);
    }
    const Eigen::MatrixXd correlation = correlation_of(contrasts, alike);
    const Eigen::MatrixXd back = basis.transpose() * sd.asDiagonal();
    return {mean, back * correlation * back.transpose()};
}

Eigen::MatrixXd Signatures::covariance_of(const std::vector<Eigen::Index>& of) const
{
    Eigen::MatrixXd out = covariance(of, of);
    out.diagonal() += floor_variance(of);
    return out;
}

Eigen::VectorXd Signatures::sd_given_others(const std::vector<Eigen::Index>& of) const
{
    return covariance_of(of).inverse().diagonal().cwiseInverse().cwiseSqrt();
}

namespace {

constexpr double farthest_law = 3; // beyond it a law is as unlike as it can be, by one estimator

double median_of(std::vector<double> values)
{
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.empty() ? std::nan("") : upper_median(std::move(values));
}

} // namespace

TestSamples like_measured(const TestSamples& tests, std::span<const std::pair<Eigen::Index, double>> seen,
                          std::size_t count)
{
    std::map<std::string, std::pair<std::vector<Eigen::Index>, std::vector<double>>> groups;
    for (const auto& [column, value] : seen)
        if (const TestColumn& of = tests.columns[static_cast<std::size_t>(column)]; of.of_the_law) {
            groups[of.name].first.push_back(column);
            groups[of.name].second.push_back(value);
        }
    const Eigen::Index n = tests.healthy.rows();
    if (groups.empty() || static_cast<std::size_t>(n) <= count)
        return tests;
    std::vector<double> distance(static_cast<std::size_t>(n), 0);
    for (const auto& [name, group] : groups) {
        std::vector<double> common;
        for (Eigen::Index i = 0; i < n; ++i) {
            const Eigen::RowVectorXd row = tests.healthy(i, group.first);
            common.push_back(median_of({row.data(), row.data() + row.size()}));
        }
        // by ranks: how many laws lie between
        std::vector<double> sorted = common;
        std::erase_if(sorted, [](double value) { return !std::isfinite(value); });
        std::sort(sorted.begin(), sorted.end());
        const auto rank = [&](double value) {
            const auto at = std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
            return static_cast<double>(at) / static_cast<double>(std::max<std::size_t>(sorted.size(), 1));
        };
        const double here = rank(median_of(group.second)), width = 0.1;
        for (std::size_t i = 0; i < distance.size(); ++i) {
            const double apart = std::isfinite(common[i]) ? (rank(common[i]) - here) / width : farthest_law;
            distance[i] += std::min(apart * apart, farthest_law * farthest_law);
        }
    }
    std::vector<Eigen::Index> order(distance.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return distance[static_cast<std::size_t>(a)] < distance[static_cast<std::size_t>(b)];
    });
    order.resize(count);
    TestSamples out = tests;
    out.healthy = tests.healthy(order, Eigen::all);
    for (CauseSamples& samples : out.causes) {
        // the nearer half of those that have a twin
        std::vector<Eigen::Index> rows;
        for (std::size_t i = 0; i < samples.pairs.size(); ++i)
            rows.push_back(static_cast<Eigen::Index>(i));
        std::stable_sort(rows.begin(), rows.end(), [&](Eigen::Index a, Eigen::Index b) {
            const auto far = [&](Eigen::Index i) {
                return distance[static_cast<std::size_t>(samples.pairs[static_cast<std::size_t>(i)])];
            };
            return far(a) < far(b);
        });
        rows.resize((rows.size() + 1) / 2);
        Eigen::MatrixXd shifted(static_cast<Eigen::Index>(rows.size()), samples.rows.cols());
        for (std::size_t i = 0; i < rows.size(); ++i)
            shifted.row(static_cast<Eigen::Index>(i)) =
                samples.rows.row(rows[i]) - tests.healthy.row(samples.pairs[static_cast<std::size_t>(rows[i])]);
        samples.rows = std::move(shifted);
        samples.pairs.clear();
        samples.differences = true;
    }
    return out;
}

Signatures signatures_of(const TestSamples& tests)
{
    Signatures s;
    s.columns = tests.columns;
    const auto p = static_cast<Eigen::Index>(s.columns.size());
    std::map<std::pair<RunKind, std::string>, std::vector<Eigen::Index>> alike;
    for (Eigen::Index j = 0; j < p; ++j) {
        const TestColumn& column = s.columns[static_cast<std::size_t>(j)];
        const FiniteMoments m = finite_moments(tests.healthy.col(j));
        s.used.push_back(m.count >= least_finite * static_cast<double>(tests.healthy.rows()) &&
                         m.variance + column.floor_sd > 0);
        if (s.used.back())
            alike[{column.test, column.name}].push_back(j);
    }
    if (std::find(s.used.begin(), s.used.end(), true) == s.used.end())
        throw InputError("tests of single joints: no test gives an estimate in three of four simulated healthy "
                         "specimens.\n  Check the procedures for this specimen: in most of them everything falls.");
    for (auto& [name, group] : alike)
        s.alike.push_back(std::move(group));
    std::tie(s.mean, s.covariance) = healthy_scatter(tests.healthy, s.alike);
    s.floor_variance.resize(p);
    for (Eigen::Index j = 0; j < p; ++j)
        s.floor_variance(j) = std::max({std::pow(s.columns[static_cast<std::size_t>(j)].floor_sd, 2),
                                        least_floor * least_floor * s.covariance(j, j)});
    for (const std::vector<Eigen::Index>& group : s.alike) {
        // what a laboratory does alike at every joint: a gauge's gain and zero, a table out of level
        double common = 0;
        for (const Eigen::Index j : group)
            common = std::max(common, common_floor * common_floor * s.floor_variance(j));
        for (const Eigen::Index a : group)
            for (const Eigen::Index b : group)
                s.covariance(a, b) += common;
    }
    s.scale = std::max(1.0, distance_left_out(tests, s));
    s.covariance *= s.scale;

    Eigen::VectorXd sd = Eigen::VectorXd::Zero(p);
    for (const std::vector<Eigen::Index>& group : s.alike)
        sd(group) = s.sd_given_others(group);
    for (const CauseSamples& samples : tests.causes)
        s.causes.push_back(cause_signature(tests, samples, s, sd, next_weaker(s.causes, samples.cause)));
    return s;
}

} // namespace stylobate
