#include "ensemble/estimators/risk/frequency_estimate.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/stripe_shares.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/interval.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

constexpr double smallest_share = 1e-10; // of a record that is not taken as 0

Limits hull(const Limits& a, const Limits& b)
{
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

/// Edges of the parts, in ln im.
std::vector<double> edges_of(const FragilityData& data, std::size_t parts)
{
    const double low = std::log(data.intensity.front()), high = std::log(data.intensity.back());
    std::vector<double> edges = {-no_end};
    for (std::size_t i = 0; i <= parts; ++i)
        edges.push_back(i == parts ? high : low + (high - low) * static_cast<double>(i) / static_cast<double>(parts));
    edges.push_back(no_end);
    return edges;
}

/// The curves of the hazard that an interval needs.
struct HazardCurves {
    HazardCurve best;
    std::vector<HazardCurve> quantiles; ///< lower limit, median, upper limit; none where they are not known

    HazardCurves(const HazardModel& hazard, double level) : best(best_curve(hazard))
    {
        if (!hazard.fractiles.empty())
            for (const double probability : {(1 - level) / 2, 0.5, (1 + level) / 2})
                quantiles.push_back(quantile_curve(hazard, probability));
    }

    /// @param frequency of a curve of the hazard
    template <class F>
    std::optional<HazardSpread> spread(F&& frequency) const
    {
        if (quantiles.empty())
            return std::nullopt;
        const double value = frequency(best);
        if (!(value > 0))
            return HazardSpread{};
        return HazardSpread{frequency(quantiles[0]) / value, frequency(quantiles[1]) / value,
                            frequency(quantiles[2]) / value};
    }
};

/// What of a frequency lies outside of the hazard's points; 0 of a power law without a range.
template <class F>
double outside_of(const HazardModel& hazard, F&& between)
{
    if (hazard.unbounded)
        return 0;
    return between(-no_end, std::log(hazard.intensity.front())) + between(std::log(hazard.intensity.back()), no_end);
}

/// Shares of the frequency and its parts, from the frequency between two intensities.
/// @param between (from, to) -> RiskNumber   @param value (curve of the hazard, from, to) -> a frequency alone
template <class Between, class Value>
void fill(FrequencyEstimate& estimate, const std::vector<double>& edges, const HazardModel& hazard, Between&& between,
          Value&& value)
{
    estimate.frequency = between(-no_end, no_end);
    if (!hazard.fractiles.empty())
        estimate.by_mean_hazard = value(mean_curve(hazard), -no_end, no_end);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        estimate.parts.push_back({std::exp(edges[i]), std::exp(edges[i + 1]), between(edges[i], edges[i + 1])});
    const double all = estimate.frequency.value;
    if (!(all > 0))
        return;
    estimate.below = estimate.parts.front().frequency.value / all;
    estimate.above = estimate.parts.back().frequency.value / all;
    const HazardCurve best = best_curve(hazard);
    estimate.beyond_hazard = outside_of(hazard, [&](double from, double to) { return value(best, from, to); }) / all;
}

class LognormalFrequency {
public:
    /// The frequency of another form of the fragility, whose intervals are to be in those of this one.
    using Other = std::function<RiskNumber(double from, double to)>;

    LognormalFrequency(const FragilityData& data, const HazardModel& hazard, const FrequencyOptions& options,
                       Other other)
        : hazard_(hazard), options_(options), curves_(hazard, options.level),
          curve_(fitted_curve(data, log_predictors(data), Link::probit)), other_(std::move(other))
    {
        assert(curve_.fit.maximum == Maximum::inside && curve_.fit.coefficients[1] > 0);
        if (data.records >= least_records)
            without_ = jackknife(curve_);
    }

    FrequencyEstimate estimate() const
    {
        FrequencyEstimate found;
        found.form = FragilityForm::lognormal;
        const std::vector<double> edges = edges_of(curve_.data, options_.parts);
        const ParameterVector& b = curve_.fit.coefficients;
        fill(
            found, edges, hazard_, [&](double from, double to) { return number(from, to); },
            [&](const HazardCurve& hazard, double from, double to) { return frequency(b, hazard, from, to); });
        const double last = edges[edges.size() - 2], events = curves_.best.frequency(last);
        const double within = frequency(b, curves_.best, edges[1], last);
        found.bounds = {within + events * link_at(Link::probit, b[0] + b[1] * last).below,
                        within + frequency(b, curves_.best, -no_end, edges[1]) + events};
        return found;
    }

private:
    static double frequency(const ParameterVector& b, const HazardCurve& hazard, double from, double to)
    {
        return hazard.lognormal_integral(b[0], b[1], from, to);
    }

    RiskNumber number(double from, double to) const
    {
        const double value = frequency(curve_.fit.coefficients, curves_.best, from, to);
        Limits both = limits(value, from, to);
        if (other_)
            if (const RiskNumber other = other_(from, to); other.value > 0)
                both = hull(both, other.fragility);
        return combined(value, both, curves_.spread([&](const HazardCurve& hazard) {
            return frequency(curve_.fit.coefficients, hazard, from, to);
        }));
    }

    Limits limits(double value, double from, double to) const
    {
        const auto& without = without_.coefficients;
        if (without.size() < 2 ||
            std::any_of(without.begin(), without.end(), [](const ParameterVector& b) { return !(b[1] > 0); }))
            return {0, no_end};
        const auto log_frequency = [&](const ParameterVector& b) {
            return std::log(std::max(frequency(b, curves_.best, from, to), std::numeric_limits<double>::min()));
        };
        const double n = static_cast<double>(without.size());
        std::vector<double> values;
        double mean = 0, square = 0;
        for (const ParameterVector& b : without) {
            values.push_back(log_frequency(b));
            mean += values.back() / n;
        }
        for (const double v : values)
            square += (v - mean) * (v - mean);
        if (!(square > 1e-20 * mean * mean)) // nothing at all comes from there, or records without any scatter
            return {value > std::numeric_limits<double>::min() ? 0 : value,
                    value > std::numeric_limits<double>::min() ? no_end : value};
        ParameterVector gradient(2);
        for (Eigen::Index j = 0; j < 2; ++j) {
            constexpr double step = 1e-5;
            ParameterVector up = curve_.fit.coefficients, down = up;
            up[j] += step;
            down[j] -= step;
            gradient[j] = (log_frequency(up) - log_frequency(down)) / (2 * step);
        }
        const double freedom = gradient.norm() > 0 ? record_spread(curve_, CurveTarget::sum(gradient)).freedom : n - 1;
        const double unbiased = n * std::log(value) - (n - 1) * mean;
        const double reach = student_quantile((1 + options_.level) / 2, freedom) * std::sqrt((n - 1) / n * square);
        // an estimate is never outside its own interval
        return {std::min(value, std::exp(unbiased - reach)), std::max(value, std::exp(unbiased + reach))};
    }

    const HazardModel& hazard_;
    const FrequencyOptions options_;
    HazardCurves curves_;
    FittedCurve curve_;
    Jackknife without_;
    Other other_;
};

class ShareFrequency {
public:
    ShareFrequency(const FragilityData& data, const StripeShares& shares, const HazardModel& hazard,
                   const FrequencyOptions& options)
        : data_(data), hazard_(hazard), options_(options), curves_(hazard, options.level), own_(record_shares(data))
    {
        assert(data.measures == 1 && data.points() >= 2 && shares.stripes.size() == data.points());
        for (std::size_t j = 0; j < data.points(); ++j) {
            nodes_.push_back(std::log(data.intensity[j]));
            monotone_.push_back(shares.stripes[j].monotone);
            trials_.push_back(shares.stripes[j].trials);
        }
        while (first_ + 1 < monotone_.size() && monotone_[first_] == 0)
            ++first_;
        separated_ = separated();
        for (std::size_t j = 0; j < nodes_.size(); ++j) {
            std::vector<double> at;
            for (const auto& record : own_)
                at.push_back(record[j]);
            const Limits share = mean_limits(at, mean_share(j), 1);
            low_.push_back(share.lower);
            high_.push_back(std::min(share.upper, 1.0));
        }
        for (std::size_t j = first_; j-- > 0;) // weaker shaking has no greater probability than stronger shaking
            high_[j] = std::min(high_[j], high_[j + 1]);
    }

    FrequencyEstimate estimate() const
    {
        FrequencyEstimate found;
        found.form = FragilityForm::shares;
        fill(
            found, edges_of(data_, options_.parts), hazard_, [&](double from, double to) { return number(from, to); },
            [&](const HazardCurve& hazard, double from, double to) { return frequency(hazard, from, to); });
        found.bounds = steps(-no_end, no_end, monotone_, monotone_);
        found.unseen = not_excluded(curves_.best, nodes_.front(), no_end); // weaker shaking was not run
        found.separated = separated_;
        return found;
    }

    /// Of events in [from, to].
    RiskNumber number(double from, double to) const
    {
        const std::vector<double> weights = curves_.best.node_weights(nodes_, from, to);
        const double most = most_of(curves_.best, from, to);
        std::vector<double> own; // frequency of each record
        double value = 0;
        for (const auto& shares : own_) {
            own.push_back(std::inner_product(weights.begin(), weights.end(), shares.begin(), 0.0));
            value += own.back() / static_cast<double>(own_.size());
        }
        Limits limits{0, not_excluded(curves_.best, from, to)};
        if (most > 0)
            limits = mean_limits(own, value, most);
        if (most > 0 && separated_)
            limits = hull(limits, steps(from, to, low_, high_));
        else if (value > 0) {
            const double ratio = curved_over_straight(from, to);
            limits = hull(limits, {ratio * limits.lower, ratio * limits.upper});
        }
        return combined(value, limits, curves_.spread([&](const HazardCurve& hazard) {
            return value > 0  ? frequency(hazard, from, to)
                   : most > 0 ? most_of(hazard, from, to)
                              : not_excluded(hazard, from, to);
        }));
    }

private:
    double mean_share(std::size_t stripe) const
    {
        double sum = 0;
        for (const auto& record : own_)
            sum += record[stripe];
        return sum / static_cast<double>(own_.size());
    }

    double frequency(const HazardCurve& hazard, double from, double to) const
    {
        const std::vector<double> weights = hazard.node_weights(nodes_, from, to);
        double sum = 0;
        for (std::size_t j = 0; j < weights.size(); ++j)
            sum += weights[j] * mean_share(j);
        return sum;
    }

    /// The frequency at P = 1 from the first stripe of the interval on.
    double most_of(const HazardCurve& hazard, double from, double to) const
    {
        const std::vector<double> weights = hazard.node_weights(nodes_, from, to);
        return std::accumulate(weights.begin() + static_cast<std::ptrdiff_t>(first_), weights.end(), 0.0);
    }

    /// What is not excluded of the stripes before it.
    double not_excluded(const HazardCurve& hazard, double from, double to) const
    {
        const std::vector<double> weights = hazard.node_weights(nodes_, from, to);
        return std::inner_product(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(first_), high_.begin(),
                                  0.0);
    }

    /// The frequency of events in [from, to] with a lognormal curve through the shares of every two stripes, over that
    /// with the straight line: a fragility is convex where it begins to rise and concave where it ends, which a line
    /// cuts off. Of the monotone shares; one of none (or all) of n trials counts as half a trial more than none (or
    /// less than all).
    double curved_over_straight(double from, double to) const
    {
        const std::vector<double> weights = curves_.best.node_weights(nodes_, from, to);
        const double straight = std::inner_product(weights.begin(), weights.end(), monotone_.begin(), 0.0);
        double curved = straight;
        for (std::size_t j = 0; j + 1 < nodes_.size(); ++j) {
            const double a = std::max(from, nodes_[j]), b = std::min(to, nodes_[j + 1]);
            if (!(a < b) || !(monotone_[j] < monotone_[j + 1]))
                continue;
            const std::vector<double> within = curves_.best.node_weights(nodes_, a, b);
            const double low = probit_of(j), slope = (probit_of(j + 1) - low) / (nodes_[j + 1] - nodes_[j]);
            if (slope > 0)
                curved += curves_.best.lognormal_integral(low - slope * nodes_[j], slope, a, b) -
                          std::inner_product(within.begin(), within.end(), monotone_.begin(), 0.0);
        }
        return straight > 0 && curved > 0 ? curved / straight : 1;
    }

    double probit_of(std::size_t stripe) const
    {
        const double least = 0.5 / (trials_[stripe] + 1);
        return link_quantile(Link::probit, std::clamp(monotone_[stripe], least, 1 - least));
    }

    /// Of the mean of numbers of the records, each of which is between 0 and `most`.
    Limits mean_limits(const std::vector<double>& own, double value, double most) const
    {
        const auto n = static_cast<double>(own.size());
        if (own.size() < least_records)
            return {0, no_end};
        double square = 0, deviation = 0, fourth = 0;
        for (const double y : own) {
            const double away = (y - value) * (y - value);
            square += y * y;
            deviation += away;
            fourth += away * away;
        }
        const double effective = square > 0 ? n * value * n * value / square : 0;
        // a scatter that one record alone has, or none, is not that of the others
        const bool scatter = deviation > 1e-20 * square && deviation * deviation >= 2 * fourth;
        if (effective >= static_cast<double>(least_records) && scatter) {
            const double error = std::sqrt(deviation / (n * (n - 1))) / value;
            const double reach = student_quantile((1 + options_.level) / 2, effective - 1) * error;
            return {value * std::exp(-reach), value * std::exp(reach)};
        }
        std::vector<RecordCount> records;
        for (const double y : own)
            records.push_back({1, y / most < smallest_share ? 0 : std::min(y / most, 1.0)});
        const Limits share = record_share_limits(records, options_.level);
        return {std::min(value, most * share.lower), std::max(value, most * share.upper)};
    }

    bool separated() const
    {
        std::size_t reached = 0, missed = nodes_.size();
        while (reached < nodes_.size() && mean_share(reached) == 0)
            ++reached;
        while (missed > 0 && mean_share(missed - 1) == 1)
            --missed;
        return reached < nodes_.size() && missed > 0 && missed - 1 <= reached;
    }

    /// The frequency of events in [from, to] of steps through values at the stripes: the value of the stripe below, or
    /// of the stripe above, and 1 above the last one.
    Limits steps(double from, double to, const std::vector<double>& low, const std::vector<double>& high) const
    {
        const auto events = [&](double a, double b) {
            a = std::max(a, from);
            b = std::min(b, to);
            return a < b ? curves_.best.frequency(a) - (std::isinf(b) ? 0 : curves_.best.frequency(b)) : 0;
        };
        const std::size_t n = nodes_.size();
        const double above = events(nodes_[n - 1], no_end);
        Limits found{low[n - 1] * above, above};
        for (std::size_t j = 0; j + 1 < n; ++j) {
            const double within = events(nodes_[j], nodes_[j + 1]);
            found.lower += low[j] * within;
            found.upper += j + 1 >= first_ ? high[j + 1] * within : 0;
        }
        if (monotone_[0] > 0 && from < nodes_[0]) {
            // at least from where the line of the estimate reaches 0
            const double begin =
                hazard_.unbounded ? -no_end : std::min(std::log(hazard_.intensity.front()), 2 * nodes_[0] - nodes_[1]);
            found.upper += std::isinf(std::max(begin, from)) ? no_end : high[0] * events(begin, nodes_[0]);
        }
        return found;
    }

    const FragilityData& data_;
    const HazardModel& hazard_;
    const FrequencyOptions options_;
    HazardCurves curves_;
    std::vector<double> nodes_, monotone_, trials_; ///< (stripes)
    std::vector<double> low_, high_;                ///< (stripes) limits of their shares
    std::vector<std::vector<double>> own_;          ///< (records x stripes) shares
    std::size_t first_ = 0; ///< stripe of the interval: the first one with damage, else the last one
    bool separated_ = false;
};

} // namespace

const char* to_string(FragilityForm form)
{
    return form == FragilityForm::lognormal ? "lognormal" : "shares";
}

FrequencyEstimate lognormal_frequency(const FragilityData& data, const HazardModel& hazard,
                                      const FrequencyOptions& options, const StripeShares* shares)
{
    if (!shares)
        return LognormalFrequency(data, hazard, options, {}).estimate();
    const ShareFrequency by_shares(data, *shares, hazard, options);
    return LognormalFrequency(data, hazard, options, [&](double from, double to) { return by_shares.number(from, to); })
        .estimate();
}

std::vector<double> stripe_weights(const std::vector<double>& intensity, const HazardModel& hazard)
{
    std::vector<double> nodes;
    for (const double im : intensity)
        nodes.push_back(std::log(im));
    return best_curve(hazard).node_weights(nodes, -no_end, no_end);
}

FrequencyEstimate share_frequency(const FragilityData& data, const StripeShares& shares, const HazardModel& hazard,
                                  const FrequencyOptions& options)
{
    return ShareFrequency(data, shares, hazard, options).estimate();
}

RiskNumber combined(double value, const Limits& fragility, const std::optional<HazardSpread>& hazard)
{
    RiskNumber number{value, fragility, fragility, {value, value}, 1};
    if (!hazard)
        return number;
    number.hazard = {value * hazard->low, value * hazard->high};
    const double down = std::log(hazard->middle / hazard->low), up = std::log(hazard->high / hazard->middle);
    if (!(value > 0)) {
        number.total = {0, fragility.upper * hazard->high};
        number.fragility_part = std::nan("");
        return number;
    }
    const double fragility_down = std::log(value / fragility.lower), fragility_up = std::log(fragility.upper / value);
    const double middle = value * hazard->middle;
    number.total = {middle * std::exp(-std::hypot(fragility_down, down)),
                    middle * std::exp(std::hypot(fragility_up, up))};
    const bool whole = std::isfinite(fragility_down);
    const double of_fragility = std::pow(fragility_up + (whole ? fragility_down : 0), 2);
    const double of_hazard = std::pow(up + (whole ? down : 0), 2);
    number.fragility_part = std::isfinite(of_fragility) ? of_fragility / (of_fragility + of_hazard) : std::nan("");
    return number;
}

double probability_over(double frequency, double years)
{
    return -std::expm1(-frequency * years);
}

RiskNumber probability_over(const RiskNumber& frequency, double years)
{
    const auto at = [years](double f) { return probability_over(f, years); };
    const auto limits = [&](const Limits& l) { return Limits{at(std::max(l.lower, 0.0)), at(l.upper)}; };
    return {at(frequency.value), limits(frequency.total), limits(frequency.fragility), limits(frequency.hazard),
            frequency.fragility_part};
}

} // namespace stylobate
