#include "studies/measured/loop/known_tests.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t specimens_of_a_law = 40; // healthy ones that count
constexpr std::size_t specimens_in_prospect = 4;

} // namespace

void KnownTests::add(Eigen::Index column, const Estimate& estimate)
{
    seen_.push_back({column, estimate.value});
    double& sd = own_sd_.try_emplace(column, 0).first->second;
    sd = std::max(sd, estimate.sd);
}

bool KnownTests::was_done(RunKind test) const
{
    return std::ranges::find(done_, test, &std::pair<RunKind, int>::first) != done_.end();
}

std::vector<SequenceModel> KnownTests::models_after(RunKind test) const
{
    std::vector<Eigen::Index> of_law;
    for (std::size_t k = 0; k < samples_.columns.size(); ++k)
        if (samples_.columns[k].of_the_law && samples_.columns[k].test == test)
            of_law.push_back(static_cast<Eigen::Index>(k));
    if (of_law.empty())
        return {};
    const TestSamples like = like_measured(samples_, values(), specimens_of_a_law);
    std::vector<std::pair<double, Eigen::Index>> order;
    for (Eigen::Index i = 0; i < like.healthy.rows(); ++i)
        if (const double value = like.healthy(i, of_law.front()); std::isfinite(value))
            order.emplace_back(value, i);
    std::ranges::sort(order);
    std::vector<SequenceModel> models;
    for (std::size_t part = 0; part < specimens_in_prospect && !order.empty(); ++part) {
        const Eigen::Index i = order[(2 * part + 1) * order.size() / (2 * specimens_in_prospect)].second;
        Values with = values();
        for (const Eigen::Index k : of_law)
            if (std::isfinite(like.healthy(i, k)))
                with.emplace_back(k, like.healthy(i, k));
        models.push_back(model_with(with));
    }
    return models;
}

KnownTests::Values KnownTests::values() const
{
    Values out;
    for (const SeenEstimate& e : seen_)
        out.emplace_back(e.column, e.value);
    return out;
}

SequenceModel KnownTests::model_with(const Values& values) const
{
    Signatures s = signatures_of(like_measured(samples_, values, specimens_of_a_law));
    for (std::size_t k = 0; k < s.columns.size(); ++k)
        if (std::ranges::find(done_, std::pair(s.columns[k].test, s.columns[k].joint)) != done_.end() &&
            !own_sd_.contains(static_cast<Eigen::Index>(k)))
            s.used[k] = false;
    add_own_scatter(s);
    return {std::move(s), prior_};
}

/// A test that scatters more than simulated ones knows less (bounces of a body that lands otherwise), and does so in
/// all its estimates together.
void KnownTests::add_own_scatter(Signatures& signatures) const
{
    std::map<std::pair<RunKind, int>, std::pair<std::vector<Eigen::Index>, std::vector<double>>> tests;
    for (const auto& [column, sd] : own_sd_) {
        const TestColumn& of = signatures.columns[static_cast<std::size_t>(column)];
        auto& [columns, more] = tests[{of.test, of.joint}];
        columns.push_back(column);
        more.push_back(std::sqrt(std::max(0.0, sd * sd - of.own_sd * of.own_sd)));
    }
    for (const auto& [test, estimates] : tests) {
        const auto& [columns, more] = estimates;
        const Eigen::Map<const Eigen::VectorXd> scatter(more.data(), static_cast<Eigen::Index>(more.size()));
        signatures.covariance(columns, columns) += scatter * scatter.transpose();
    }
}

} // namespace stylobate
