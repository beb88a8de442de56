#include "ensemble/estimators/risk/frequency_change.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

/// A number for each of the two structures.
struct Two {
    double base = 0, variant = 0;
};

/// Draws of a quantity: those for its lower limit, and those for its upper one.
using Draws = std::array<std::vector<double>, 2>;

/// The value itself is never outside.
Limits limits_of(Draws& draws, double level, double value)
{
    for (std::vector<double>& each : draws)
        std::sort(each.begin(), each.end());
    const double tail = (1 - level) / 2;
    return {std::min(value, sorted_quantile(draws[0], tail, QuantileDefinition::linear)),
            std::max(value, sorted_quantile(draws[1], 1 - tail, QuantileDefinition::linear))};
}

class Change {
public:
    Change(const PairedStripes& pairs, const HazardModel& hazard, const ChangeOptions& options)
        : hazard_(hazard), options_(options)
    {
        const FragilityData base = grouped(pairs.intensity, pairs.trials, pairs.base),
                            variant = grouped(pairs.intensity, pairs.trials, pairs.variant);
        motions_ = base.records;
        stripes_ = base.points();
        assert(stripes_ >= 2);
        for (const double im : base.intensity)
            nodes_.push_back(std::log(im));
        best_ = weights_of(best_curve(hazard));
        const auto of_base = record_shares(base), of_variant = record_shares(variant);
        for (std::size_t g = 0; g < motions_; ++g)
            for (std::size_t j = 0; j < stripes_; ++j)
                shares_.push_back({of_base[g][j], of_variant[g][j]});
        centre_ = resampled(std::vector<double>(motions_, 1), 0, {});
        while (first_ + 1 < stripes_ && centre_[first_].base == 0 && centre_[first_].variant == 0)
            ++first_;
        FrequencyOptions alone;
        alone.level = options.level;
        found_.base = share_frequency(base, stripe_shares(base), hazard, alone);
        found_.variant = share_frequency(variant, stripe_shares(variant), hazard, alone);
    }

    FrequencyChange run()
    {
        const Two value = frequencies(centre_, best_);
        std::vector<ChangeNumber> numbers(2 + options_.years.size());
        for (std::size_t q = 0; q < numbers.size(); ++q)
            numbers[q].value = change(q, value);
        judge();
        if (motions_ >= least_records) {
            limit(numbers);
            widen(numbers);
        }
        found_.frequency = numbers[0];
        found_.ratio = numbers[1];
        found_.ratio.value = value.base > 0 ? value.variant / value.base : std::nan("");
        for (Limits* l : {&found_.ratio.fragility, &found_.ratio.total})
            *l = {std::exp(l->lower), std::exp(l->upper)};
        found_.probability.assign(numbers.begin() + 2, numbers.end());
        for (ChangeNumber& p : found_.probability)
            for (Limits* l : {&p.fragility, &p.total})
                *l = {std::max(l->lower, -1.0), std::min(l->upper, 1.0)};
        return std::move(found_);
    }

private:
    std::vector<double> weights_of(const HazardCurve& hazard) const
    {
        return hazard.node_weights(nodes_, -no_end, no_end);
    }

    // The quantities are differences on scales of the frequency: itself, its logarithm (of the ratio), and the
    // probability over each of the years.

    double scale(std::size_t quantity, double frequency) const
    {
        return quantity == 0   ? frequency
               : quantity == 1 ? std::log(frequency)
                               : -std::expm1(-frequency * options_.years[quantity - 2]);
    }

    double change(std::size_t quantity, const Two& frequency) const
    {
        return scale(quantity, frequency.variant) - scale(quantity, frequency.base);
    }

    /// Whether the scatter of the motions' own changes can be relied on, and by how much draws are spread.
    void judge()
    {
        const auto n = static_cast<double>(motions_);
        double sum = 0, square = 0;
        for (std::size_t g = 0; g < motions_; ++g) {
            double d = 0;
            for (std::size_t j = 0; j < stripes_; ++j)
                d += best_[j] * (shares_[g * stripes_ + j].variant - shares_[g * stripes_ + j].base);
            sum += std::abs(d);
            square += d * d;
        }
        const double effective = square > 0 ? sum * sum / square : 0;
        found_.few = effective < static_cast<double>(least_records);
        if (!found_.few)
            spread_ = student_quantile((1 + options_.level) / 2, effective - 1) /
                      normal_quantile((1 + options_.level) / 2) * std::sqrt((n + 1) / (n - 1));
    }

    /// (stripes) shares with weights of the motions. @param more weight of a further motion that reaches what `as` says
    /// from the first stripe with damage on
    std::vector<Two> resampled(const std::vector<double>& weights, double more, const Two& as) const
    {
        std::vector<Two> shares(stripes_);
        const double all = std::accumulate(weights.begin(), weights.end(), more);
        for (std::size_t g = 0; g < weights.size(); ++g)
            for (std::size_t j = 0; j < stripes_; ++j) {
                shares[j].base += weights[g] / all * shares_[g * stripes_ + j].base;
                shares[j].variant += weights[g] / all * shares_[g * stripes_ + j].variant;
            }
        for (std::size_t j = first_; j < stripes_; ++j) {
            shares[j].base += more / all * as.base;
            shares[j].variant += more / all * as.variant;
        }
        return shares;
    }

    Two frequencies(const std::vector<Two>& shares, const std::vector<double>& weights) const
    {
        Two found;
        for (std::size_t j = 0; j < stripes_; ++j) {
            found.base += weights[j] * shares[j].base;
            found.variant += weights[j] * shares[j].variant;
        }
        return found;
    }

    void limit(std::vector<ChangeNumber>& numbers) const
    {
        std::vector<Draws> fragility(numbers.size()), total(numbers.size());
        const auto take = [&](const std::vector<Two>& shares, const std::vector<double>& hazard, bool upper,
                              std::vector<Draws>& to) {
            const Two drawn = frequencies(shares, hazard), middle = frequencies(centre_, hazard);
            for (std::size_t q = 0; q < to.size(); ++q) {
                const double at = change(q, middle);
                to[q][upper].push_back(at + spread_ * (change(q, drawn) - at));
            }
        };
        std::vector<double> weights(motions_);
        for (std::size_t draw = 0; draw < options_.draws; ++draw) {
            const auto uniform = [&](std::uint64_t i) { return uniform01(options_.seed, draw, Stream::bootstrap, i); };
            for (std::size_t g = 0; g < motions_; ++g)
                weights[g] = -std::log1p(-uniform(g));
            const double more = found_.few ? -std::log1p(-uniform(motions_)) : 0;
            const double quantile = std::clamp(uniform(motions_ + 1), 1e-6, 1 - 1e-6);
            const std::vector<double> hazard =
                hazard_.fractiles.empty() ? best_ : weights_of(quantile_curve(hazard_, quantile));
            for (const bool upper : {false, true}) {
                const std::vector<Two> shares = resampled(weights, more, upper ? Two{0, 1} : Two{1, 0});
                take(shares, best_, upper, fragility);
                take(shares, hazard, upper, total);
            }
        }
        for (std::size_t q = 0; q < numbers.size(); ++q)
            if (std::isfinite(numbers[q].value)) { // else the logarithm of 0
                numbers[q].fragility = limits_of(fragility[q], options_.level, numbers[q].value);
                numbers[q].total = limits_of(total[q], options_.level, numbers[q].value);
            }
    }

    /// By what is not known of the form of the curve where the stripes of a structure separate: the distances of its
    /// limits from its value are joined with those of the draws, at the root of the sum of their squares (as in
    /// `frequency_estimate.hpp`).
    void widen(std::vector<ChangeNumber>& numbers) const
    {
        for (std::size_t q = 0; q < numbers.size(); ++q) {
            const auto distances = [&](const FrequencyEstimate& of) {
                const RiskNumber& f = of.frequency;
                return of.separated ? Limits{scale(q, f.value) - scale(q, f.fragility.lower),
                                             scale(q, f.fragility.upper) - scale(q, f.value)}
                                    : Limits{0, 0};
            };
            const Limits base = distances(found_.base), variant = distances(found_.variant);
            ChangeNumber& n = numbers[q];
            if (std::isfinite(n.value))
                for (Limits* l : {&n.fragility, &n.total})
                    *l = {n.value - std::hypot(n.value - l->lower, variant.lower, base.upper),
                          n.value + std::hypot(l->upper - n.value, variant.upper, base.lower)};
        }
    }

    const HazardModel& hazard_;
    const ChangeOptions& options_;
    std::size_t motions_ = 0, stripes_ = 0;
    std::vector<double> nodes_, best_; ///< (stripes) ln im; weights with the hazard's best estimate
    std::vector<Two> shares_;          ///< (motions x stripes)
    std::vector<Two> centre_;          ///< (stripes) means of the motions
    std::size_t first_ = 0;            ///< stripe with damage
    double spread_ = 1;
    FrequencyChange found_;
};

} // namespace

FrequencyChange frequency_change(const PairedStripes& pairs, const HazardModel& hazard, const ChangeOptions& options)
{
    return Change(pairs, hazard, options).run();
}

} // namespace stylobate
