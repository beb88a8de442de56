#include "studies/measured/loop/joint_density.hpp"

#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {

namespace {

constexpr double unlisted_deviations = 6; // scatter of what is not listed, over that of healthy specimens

/// The two simulated sizes around a size and how far it is between them; below the weakest one the first is 0.
struct Between {
    std::size_t above;
    double part;
};

Between between(const std::vector<double>& sizes, double size)
{
    std::size_t k = 0;
    while (k + 1 < sizes.size() && std::fabs(size) > std::fabs(sizes[k]))
        ++k;
    const double below = k == 0 ? 0 : sizes[k - 1];
    return {k, (size - below) / (sizes[k] - below)};
}

template <class Member>
Eigen::VectorXd linear_in_size(const ShiftOfSize& of, double size, Member member)
{
    const std::size_t last = of.sizes.size() - 1;
    if (std::fabs(size) > std::fabs(of.sizes[last]))
        return size / of.sizes[last] * (of.at[last]->*member);
    const Between b = between(of.sizes, size);
    if (b.above == 0)
        return b.part * (of.at[0]->*member);
    return (1 - b.part) * (of.at[b.above - 1]->*member) + b.part * (of.at[b.above]->*member);
}

/// The additional variances, and the spread of the sizes of a cell along the shift.
Eigen::MatrixXd spread_of(const ShiftOfSize& of, const Hypothesis& h)
{
    const Eigen::MatrixXd scatter = of.spread(h.size);
    Eigen::MatrixXd out(scatter.rows(), scatter.cols() + 1);
    out << (of.shift(h.to) - of.shift(h.from)) / std::sqrt(12.0), scatter;
    return out;
}

/// The cells of the sizes of one sign.
void add_cells(const ShiftOfSize& of, int cause, std::vector<Hypothesis>& out)
{
    std::vector<double> nodes;
    for (std::size_t k = 0; k < of.sizes.size(); ++k) {
        if (k > 0)
            nodes.push_back((of.sizes[k - 1] + of.sizes[k]) / 2);
        nodes.push_back(of.sizes[k]);
    }
    double from = nodes.front() / 2;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        Hypothesis h;
        h.cause = cause;
        h.size = nodes[k];
        h.from = from;
        h.to = k + 1 < nodes.size() ? (nodes[k] + nodes[k + 1]) / 2 : 2 * nodes[k] - from;
        h.shift = of.shift(h.size);
        h.spread = spread_of(of, h);
        from = h.to;
        out.push_back(std::move(h));
    }
}

void add_unlisted(const Signatures& s, std::vector<Hypothesis>& out)
{
    const auto add = [&](const std::vector<Eigen::Index>& columns, double sd, double share) {
        Hypothesis h;
        h.share = share;
        h.unlisted = columns;
        h.shift = Eigen::VectorXd::Zero(s.mean.size());
        h.spread = Eigen::MatrixXd::Zero(s.mean.size(), 1);
        h.spread(columns, 0).setConstant(unlisted_deviations * sd);
        out.push_back(std::move(h));
    };
    const double share = 1 / static_cast<double>(s.alike.size());
    for (const std::vector<Eigen::Index>& group : s.alike) {
        const auto n = static_cast<double>(group.size());
        const Eigen::VectorXd sd = s.sd_given_others(group);
        for (std::size_t k = 0; k < group.size(); ++k)
            add({group[k]}, sd(static_cast<Eigen::Index>(k)), group.size() > 1 ? share / 2 / n : share);
        if (group.size() > 1)
            add(group, std::sqrt(s.covariance_of(group).sum()) / n, share / 2);
    }
}

/// A chi-squared number from a uniform one (Wilson & Hilferty, "The distribution of chi-square", Proceedings of the
/// National Academy of Sciences 17 (1931) 684): for 8 and more degrees of freedom within 1 %.
double chi_squared(double u, double freedom)
{
    const double a = 2 / (9 * freedom), root = 1 - a + to_normal(u) * std::sqrt(a);
    return freedom * std::pow(std::max(root, 0.01), 3);
}

} // namespace

Eigen::VectorXd ShiftOfSize::shift(double size) const
{
    return linear_in_size(*this, size, &CauseSignature::shift);
}

Eigen::VectorXd ShiftOfSize::variance(double size) const
{
    return linear_in_size(*this, size, &CauseSignature::variance);
}

Eigen::MatrixXd ShiftOfSize::spread(double size) const
{
    const Eigen::VectorXd own = variance(size);
    std::vector<Eigen::Index> scattered;
    for (Eigen::Index j = 0; j < own.size(); ++j)
        if (own(j) > 0)
            scattered.push_back(j);
    // the simulated sizes around it, and their weights
    std::vector<std::pair<const Eigen::MatrixXd*, double>> parts;
    if (const std::size_t last = sizes.size() - 1; std::fabs(size) > std::fabs(sizes[last]))
        parts.emplace_back(&at[last]->common, size / sizes[last]);
    else {
        const Between b = between(sizes, size);
        if (b.above > 0)
            parts.emplace_back(&at[b.above - 1]->common, 1 - b.part);
        parts.emplace_back(&at[b.above]->common, b.part);
    }
    auto columns = static_cast<Eigen::Index>(scattered.size());
    for (const auto& [common, weight] : parts)
        columns += common->cols();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(own.size(), columns);
    Eigen::Index k = 0;
    for (const Eigen::Index j : scattered)
        out(j, k++) = std::sqrt(own(j));
    for (const auto& [common, weight] : parts) {
        if (common->cols() > 0)
            out.middleCols(k, common->cols()) = std::sqrt(weight) * *common;
        k += common->cols();
    }
    return out;
}

std::vector<ShiftOfSize> shifts_of(const Signatures& signatures, const CausePlace& cause)
{
    std::vector<ShiftOfSize> out;
    for (const double sign : {1.0, -1.0}) {
        std::vector<const CauseSignature*> found;
        for (const CauseSignature& c : signatures.causes)
            if (c.cause.at() == cause && sign * c.cause.size > 0)
                found.push_back(&c);
        if (found.empty())
            continue;
        std::sort(found.begin(), found.end(),
                  [&](const auto* a, const auto* b) { return sign * a->cause.size < sign * b->cause.size; });
        ShiftOfSize of;
        for (const CauseSignature* c : found)
            of.sizes.push_back(c->cause.size);
        of.at = std::move(found);
        out.push_back(std::move(of));
    }
    return out;
}

Hypotheses::Hypotheses(const Signatures& signatures)
{
    for (const CauseSignature& c : signatures.causes)
        if (const CausePlace place = c.cause.at(); std::find(causes.begin(), causes.end(), place) == causes.end())
            causes.push_back(place);
    for (std::size_t i = 0; i < causes.size(); ++i) {
        const std::size_t first = each.size();
        for (const ShiftOfSize& of : shifts_of(signatures, causes[i]))
            add_cells(of, static_cast<int>(i), each);
        for (std::size_t k = first; k < each.size(); ++k)
            each[k].share = 1 / static_cast<double>(each.size() - first);
    }
    add_unlisted(signatures, each);
}

JointDensity::JointDensity(const Signatures& signatures, const Hypotheses& hypotheses,
                           const std::vector<Eigen::Index>& columns)
    : columns_(columns), mean_(signatures.mean(columns)), root_(signatures.covariance_of(columns)),
      distances_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(hypotheses.each.size())))
{
    for (std::size_t i = 0; i < hypotheses.each.size(); ++i) {
        const Hypothesis& h = hypotheses.each[i];
        Seen seen;
        const Eigen::MatrixXd spread = h.spread(columns, Eigen::all);
        seen.shows = h.shift(columns).squaredNorm() + spread.squaredNorm() > 0;
        if (seen.shows) {
            std::vector<Eigen::Index> acting;
            for (Eigen::Index k = 0; k < spread.cols(); ++k)
                if (spread.col(k).squaredNorm() > 0)
                    acting.push_back(k);
            seen.shift = whitened_shift(h.shift);
            seen.spread = root_.matrixL().solve(Eigen::MatrixXd(spread(Eigen::all, acting)));
            const Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(seen.spread.cols(), seen.spread.cols()) +
                                          seen.spread.transpose() * seen.spread;
            const Eigen::LLT<Eigen::MatrixXd> inner_root(inner);
            seen.narrowed = inner_root.matrixL().solve(Eigen::MatrixXd(seen.spread.transpose()));
            seen.half_log_determinant = inner_root.matrixLLT().diagonal().array().log().sum();
            distances_(static_cast<Eigen::Index>(i)) = h.cause < 0 ? seen.spread.norm() : seen.shift.norm();
        }
        seen_.push_back(std::move(seen));
    }
}

Eigen::VectorXd JointDensity::whitened(const Eigen::VectorXd& values) const
{
    return root_.matrixL().solve(values - mean_);
}

Eigen::VectorXd JointDensity::whitened_shift(const Eigen::VectorXd& shift) const
{
    return root_.matrixL().solve(Eigen::VectorXd(shift(columns_)));
}

double surprise(double squares, Eigen::Index estimates)
{
    const auto n = static_cast<double>(estimates);
    const double power = (estimate_freedom + n) / 2, tangent = std::max(0.0, n - estimate_freedom);
    return power * (std::log1p(std::max(squares, tangent) / estimate_freedom) +
                    std::min(0.0, squares - tangent) / (estimate_freedom + tangent));
}

Eigen::VectorXd JointDensity::log_ratios(const Eigen::VectorXd& white) const
{
    const double healthy = surprise(white.squaredNorm(), white.size());
    Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(seen_.size()));
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const Seen& seen = seen_[i];
        if (!seen.shows)
            continue;
        const Eigen::VectorXd off = white - seen.shift;
        const double distance = std::max(0.0, off.squaredNorm() - (seen.narrowed * off).squaredNorm());
        out(static_cast<Eigen::Index>(i)) = healthy - surprise(distance, white.size()) - seen.half_log_determinant;
    }
    return out;
}

Eigen::VectorXd JointDensity::continued(std::optional<std::size_t> hypothesis, const Eigen::VectorXd& first,
                                        const Eigen::VectorXd& normals, double u) const
{
    // of a normal vector of covariance 1 + W W' with a part W1 that is known: the mean of the rest is
    // W2 (1 + W1' W1)^-1 W1' (z1 - v1), its covariance 1 + W2 (1 + W1' W1)^-1 W2'
    const Eigen::Index d = first.size(), rest = static_cast<Eigen::Index>(columns_.size()) - d;
    Eigen::VectorXd out(d + rest);
    out.head(d) = first;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(rest), noise = normals.head(rest);
    double distance = first.squaredNorm();
    if (hypothesis && seen_[*hypothesis].shows) {
        const Seen& seen = seen_[*hypothesis];
        const Eigen::MatrixXd known = seen.spread.topRows(d), open = seen.spread.bottomRows(rest);
        const Eigen::LLT<Eigen::MatrixXd> inner(Eigen::MatrixXd::Identity(known.cols(), known.cols()) +
                                                known.transpose() * known);
        const Eigen::VectorXd off = first - seen.shift.head(d), along = known.transpose() * off;
        const Eigen::VectorXd solved = inner.solve(along);
        mean = seen.shift.tail(rest) + open * solved;
        noise += open * inner.matrixU().solve(Eigen::VectorXd(normals.segment(rest, known.cols())));
        distance = off.squaredNorm() - along.dot(solved);
    }
    const double radius = (estimate_freedom + distance) / chi_squared(u, estimate_freedom + static_cast<double>(d));
    out.tail(rest) = mean + std::sqrt(radius) * noise;
    return out;
}

} // namespace stylobate
