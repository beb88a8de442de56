#include "ensemble/estimators/risk/frequency_estimate.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/record_share.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/quantiles.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace stylobate {

namespace {

constexpr double smallest_share = 1e-10; // of a record that is not taken as 0

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
/// @param between (from, to) -> RiskNumber   @param value (from, to) -> its value alone
template <class Between, class Value>
void fill(FrequencyEstimate& estimate, const std::vector<double>& edges, const HazardModel& hazard, Between&& between,
          Value&& value)
{
    estimate.frequency = between(-no_end, no_end);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        estimate.parts.push_back({std::exp(edges[i]), std::exp(edges[i + 1]), between(edges[i], edges[i + 1])});
    const double all = estimate.frequency.value;
    if (!(all > 0))
        return;
    estimate.below = estimate.parts.front().frequency.value / all;
    estimate.above = estimate.parts.back().frequency.value / all;
    estimate.beyond_hazard = outside_of(hazard, value) / all;
}

class LognormalFrequency {
public:
    LognormalFrequency(const FragilityData& data, const HazardModel& hazard, const FrequencyOptions& options)
        : hazard_(hazard), options_(options), curves_(hazard, options.level),
          curve_(fitted_curve(data, log_predictors(data), Link::probit))
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
            [&](double from, double to) { return frequency(b, curves_.best, from, to); });
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
        return combined(value, limits(value, from, to), curves_.spread([&](const HazardCurve& hazard) {
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
        if (!(square > 0)) // nothing at all comes from there
            return {value, value};
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
};

class ShareFrequency {
public:
    ShareFrequency(const FragilityData& data, const StripeShares& shares, const HazardModel& hazard,
                   const FrequencyOptions& options)
        : data_(data), hazard_(hazard), options_(options), curves_(hazard, options.level),
          own_(data.records, std::vector<double>(data.points()))
    {
        assert(data.measures == 1 && data.points() >= 2 && shares.stripes.size() == data.points());
        for (std::size_t j = 0; j < data.points(); ++j) {
            nodes_.push_back(std::log(data.intensity[j]));
            monotone_.push_back(shares.stripes[j].monotone);
            for (std::size_t g = 0; g < data.records; ++g)
                own_[g][j] = shares.stripes[j].share;
        }
        for (std::size_t g = 0; g < data.records; ++g)
            for (const FragilityRow& row : data.of_record(g))
                own_[g][row.point] = row.reached / row.trials;
    }

    FrequencyEstimate estimate() const
    {
        FrequencyEstimate found;
        found.form = FragilityForm::shares;
        fill(
            found, edges_of(data_, options_.parts), hazard_, [&](double from, double to) { return number(from, to); },
            [&](double from, double to) { return frequency(curves_.best, from, to); });
        found.bounds = bounds();
        std::size_t none = 0;
        while (none < nodes_.size() && monotone_[none] == 0)
            ++none;
        if (none > 0)
            found.unseen = number(-no_end, nodes_[none - 1]).fragility.upper;
        return found;
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

    RiskNumber number(double from, double to) const
    {
        const std::vector<double> weights = curves_.best.node_weights(nodes_, from, to);
        double most = 0;
        for (const double w : weights)
            most += w;
        if (!(most > 0)) // there are no events
            return combined(0, {0, 0}, std::nullopt);
        std::vector<double> own; // frequency of each record
        double value = 0;
        for (const auto& shares : own_) {
            own.push_back(std::inner_product(weights.begin(), weights.end(), shares.begin(), 0.0));
            value += own.back() / static_cast<double>(own_.size());
        }
        return combined(value, limits(own, value, most), curves_.spread([&](const HazardCurve& hazard) {
            if (value > 0)
                return frequency(hazard, from, to);
            double events = 0;
            for (const double w : hazard.node_weights(nodes_, from, to))
                events += w;
            return events;
        }));
    }

    /// Of the mean of the records' own frequencies, each of which is at most `most`.
    Limits limits(const std::vector<double>& own, double value, double most) const
    {
        const auto n = static_cast<double>(own.size());
        if (own.size() < least_records)
            return {0, no_end};
        double square = 0, deviation = 0;
        for (const double y : own) {
            square += y * y;
            deviation += (y - value) * (y - value);
        }
        const double effective = square > 0 ? n * value * n * value / square : 0;
        if (effective >= static_cast<double>(least_records)) {
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

    Limits bounds() const
    {
        const std::size_t n = nodes_.size();
        std::vector<double> events;
        for (const double x : nodes_)
            events.push_back(curves_.best.frequency(x));
        Limits found{monotone_[n - 1] * events[n - 1], events[n - 1]};
        for (std::size_t j = 0; j + 1 < n; ++j) {
            found.lower += monotone_[j] * (events[j] - events[j + 1]);
            found.upper += monotone_[j + 1] * (events[j] - events[j + 1]);
        }
        if (monotone_[0] > 0) {
            // at least from where the line of the estimate reaches 0
            const double from = std::min(std::log(hazard_.intensity.front()), 2 * nodes_[0] - nodes_[1]);
            found.upper += hazard_.unbounded ? no_end : monotone_[0] * (curves_.best.frequency(from) - events[0]);
        }
        return found;
    }

    const FragilityData& data_;
    const HazardModel& hazard_;
    const FrequencyOptions options_;
    HazardCurves curves_;
    std::vector<double> nodes_, monotone_; ///< (stripes)
    std::vector<std::vector<double>> own_; ///< (records x stripes) shares
};

} // namespace

const char* to_string(FragilityForm form)
{
    return form == FragilityForm::lognormal ? "lognormal" : "shares";
}

FrequencyEstimate lognormal_frequency(const FragilityData& data, const HazardModel& hazard,
                                      const FrequencyOptions& options)
{
    return LognormalFrequency(data, hazard, options).estimate();
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

} // namespace stylobate
