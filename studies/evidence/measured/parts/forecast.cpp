#include "studies/evidence/measured/parts/forecast.hpp"

#include "ensemble/estimators/fragility/binomial_regression.hpp"
#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <set>

namespace stylobate::measured {

namespace {

bool foretold(const Forecast& f)
{
    return f.probability >= 0.5;
}

} // namespace

double share_right(const Forecast& f)
{
    return foretold(f) == f.fell ? 1 : 0;
}

double brier(const Forecast& f)
{
    const double off = f.probability - (f.fell ? 1 : 0);
    return off * off;
}

double log_loss(const Forecast& f)
{
    const double p = std::clamp(f.probability, surest, 1 - surest);
    return -std::log(f.fell ? p : 1 - p);
}

Scores score(const std::vector<Forecast>& forecasts)
{
    Scores s;
    s.count = forecasts.size();
    for (const Forecast& f : forecasts) {
        s.right += share_right(f);
        s.brier += brier(f);
        s.log += log_loss(f);
        s.false_falls += foretold(f) && !f.fell;
        s.false_stands += !foretold(f) && f.fell;
    }
    const auto n = static_cast<double>(std::max<std::size_t>(s.count, 1));
    s.right /= n;
    s.brier /= n;
    s.log /= n;
    return s;
}

std::string signed_interval(const Estimate& e)
{
    return fmt::format("{:+.3f} ({:+.3f} to {:+.3f})", e.mean, e.low, e.high);
}

Estimate grouped_mean(const std::vector<double>& values, const std::vector<std::string>& groups, int draws,
                      std::uint64_t seed)
{
    assert(values.size() == groups.size() && !values.empty() && "each value has its group");
    struct Sum {
        double total = 0, count = 0;
    };
    std::map<std::string, Sum> by_group;
    for (std::size_t i = 0; i < values.size(); ++i) {
        Sum& sum = by_group[groups[i]];
        sum.total += values[i];
        sum.count += 1;
    }
    std::vector<Sum> sums;
    Sum all;
    for (const auto& [name, sum] : by_group) {
        sums.push_back(sum);
        all.total += sum.total;
        all.count += sum.count;
    }
    std::mt19937_64 random(seed);
    std::vector<double> means;
    for (int draw = 0; draw < draws; ++draw) {
        Sum drawn;
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const Sum& sum = sums[random() % sums.size()];
            drawn.total += sum.total;
            drawn.count += sum.count;
        }
        means.push_back(drawn.total / drawn.count);
    }
    std::sort(means.begin(), means.end());
    const auto at = [&](double part) {
        return means[static_cast<std::size_t>(std::lround(part * static_cast<double>(means.size() - 1)))];
    };
    return {all.total / all.count, at(0.025), at(0.975)};
}

Estimate difference(const std::vector<Forecast>& first, const std::vector<Forecast>& second, const Measure& measure)
{
    assert(first.size() == second.size() && "the same tests");
    std::vector<double> values;
    std::vector<std::string> groups;
    for (std::size_t i = 0; i < first.size(); ++i) {
        values.push_back(measure(first[i]) - measure(second[i]));
        groups.push_back(first[i].group);
    }
    return grouped_mean(values, groups);
}

Answers answers_worth(const std::vector<bool>& predicted, const std::vector<bool>& fell)
{
    double tests[2] = {0, 0}, falls[2] = {0, 0};
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        tests[predicted[i]] += 1;
        falls[predicted[i]] += fell[i];
    }
    return {(falls[0] + 0.5) / (tests[0] + 1), (falls[1] + 0.5) / (tests[1] + 1)};
}

std::vector<bool> fitting_half(const std::vector<std::string>& group)
{
    const std::set<std::string> names(group.begin(), group.end());
    std::vector<bool> fits;
    for (const std::string& name : group)
        fits.push_back(std::distance(names.begin(), names.find(name)) % 2 == 0);
    return fits;
}

double Logistic::probability(const std::vector<double>& x) const
{
    double sum = coefficients.front();
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += coefficients[i + 1] * x[i];
    return 1 / (1 + std::exp(-sum));
}

Logistic fit_logistic(const std::vector<std::vector<double>>& x, const std::vector<bool>& event)
{
    assert(!x.empty() && x.size() == event.size() && "an event to each observation");
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd predictors(n, static_cast<Eigen::Index>(x.front().size()) + 1);
    BinomialCounts counts{Eigen::VectorXd::Ones(n), Eigen::VectorXd(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        predictors(i, 0) = 1;
        for (Eigen::Index j = 1; j < predictors.cols(); ++j)
            predictors(i, j) = x[static_cast<std::size_t>(i)][static_cast<std::size_t>(j - 1)];
        counts.reached(i) = event[static_cast<std::size_t>(i)] ? 1 : 0;
    }
    const BinomialFit fit = fit_binomial(Link::logit, predictors, counts);
    if (fit.maximum != Maximum::inside)
        throw InputError("a logistic rule separates the events: no coefficients are the most likely ones");
    return {std::vector<double>(fit.coefficients.data(), fit.coefficients.data() + fit.coefficients.size())};
}

} // namespace stylobate::measured
