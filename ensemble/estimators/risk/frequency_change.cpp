#include "ensemble/estimators/risk/frequency_change.hpp"

#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/estimators/fragility/fragility_data.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/quantiles.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
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

class Change {
public:
    Change(const PairedStripes& pairs, const HazardModel& hazard, const ChangeOptions& options)
        : hazard_(hazard), options_(options), stripes_(pairs.intensity.size())
    {
        assert(stripes_ >= 2 && pairs.trials.size() == pairs.motions * stripes_);
        for (const double im : pairs.intensity)
            nodes_.push_back(std::log(im));
        for (std::size_t g = 0; g < pairs.motions; ++g)
            if (std::any_of(at(pairs.trials, g), at(pairs.trials, g + 1), [](double n) { return n > 0; }))
                motions_.push_back(g);
        std::vector<Two> all(stripes_);
        std::vector<double> trials(stripes_);
        for (std::size_t g = 0; g < pairs.motions; ++g)
            for (std::size_t j = 0; j < stripes_; ++j) {
                trials[j] += pairs.trials[g * stripes_ + j];
                all[j].base += pairs.base[g * stripes_ + j];
                all[j].variant += pairs.variant[g * stripes_ + j];
            }
        // a motion without pairs at a stripe takes the share of the others there
        for (const std::size_t g : motions_)
            for (std::size_t j = 0; j < stripes_; ++j) {
                const std::size_t i = g * stripes_ + j;
                const double n = pairs.trials[i];
                shares_.push_back(n > 0 ? Two{pairs.base[i] / n, pairs.variant[i] / n}
                                        : Two{all[j].base / trials[j], all[j].variant / trials[j]});
            }
        while (first_ + 1 < stripes_ && all[first_].base == 0 && all[first_].variant == 0)
            ++first_;
        best_ = best_curve(hazard).node_weights(nodes_, -no_end, no_end);
        judge();
        found_.base = estimate(pairs, pairs.base);
        found_.variant = estimate(pairs, pairs.variant);
    }

    FrequencyChange run()
    {
        const std::vector<double> each(motions_.size(), 1);
        const Two value = frequencies(resampled(each, 0, {}), best_);
        found_.frequency.value = value.variant - value.base;
        found_.ratio.value = value.base > 0 ? value.variant / value.base : std::nan("");
        for (const double years : options_.years)
            found_.probability.push_back({over(value, years), {}, {}});
        if (motions_.size() >= least_records)
            limits();
        else
            nothing_is_known();
        widen(separated(&Two::base), separated(&Two::variant));
        return std::move(found_);
    }

private:
    std::vector<double>::const_iterator at(const std::vector<double>& of, std::size_t motion) const
    {
        return of.begin() + static_cast<std::ptrdiff_t>(motion * stripes_);
    }

    static double over(const Two& frequency, double years)
    {
        return std::exp(-frequency.base * years) - std::exp(-frequency.variant * years);
    }

    FrequencyEstimate estimate(const PairedStripes& pairs, const std::vector<double>& reached) const
    {
        std::vector<FragilityRun> runs;
        for (const std::size_t g : motions_)
            for (std::size_t j = 0; j < stripes_; ++j)
                if (const std::size_t i = g * stripes_ + j; pairs.trials[i] > 0)
                    runs.push_back({static_cast<std::uint32_t>(g), {pairs.intensity[j]}, reached[i], pairs.trials[i]});
        const FragilityData data = grouped(runs);
        FrequencyOptions options;
        options.level = options_.level;
        return share_frequency(data, stripe_shares(data), hazard_, options);
    }

    /// Whether the scatter of the motions' own changes can be relied on, and by how much draws are spread.
    void judge()
    {
        const auto n = static_cast<double>(motions_.size());
        double sum = 0, square = 0;
        for (std::size_t g = 0; g < motions_.size(); ++g) {
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

    /// A quantity of every draw, of those for lower limits and those for upper ones.
    struct Drawn {
        std::vector<double> low, high;

        Limits limits(double level, double value)
        {
            std::sort(low.begin(), low.end());
            std::sort(high.begin(), high.end());
            const double tail = (1 - level) / 2;
            return {std::min(value, sorted_quantile(low, tail, QuantileDefinition::linear)),
                    std::max(value, sorted_quantile(high, 1 - tail, QuantileDefinition::linear))};
        }
    };

    /// The quantities of one draw: the change of the frequency, the logarithm of the ratio, then each of the years.
    std::vector<double> quantities(const Two& f) const
    {
        constexpr double least = 1e-300;
        std::vector<double> all{f.variant - f.base, std::log(std::max(f.variant, least) / std::max(f.base, least))};
        for (const double years : options_.years)
            all.push_back(over(f, years));
        return all;
    }

    void limits()
    {
        const std::size_t m = motions_.size(), n = 2 + options_.years.size();
        const std::vector<Two> centre = resampled(std::vector<double>(m, 1), 0, {});
        std::vector<Drawn> fragility(n), total(n);
        std::vector<double> weights(m);
        const auto take = [&](const std::vector<Two>& shares, const std::vector<double>& hazard, std::vector<Drawn>& to,
                              bool low, bool high) {
            const std::vector<double> drawn = quantities(frequencies(shares, hazard)),
                                      middle = quantities(frequencies(centre, hazard));
            for (std::size_t q = 0; q < n; ++q) {
                const double value = middle[q] + spread_ * (drawn[q] - middle[q]);
                if (low)
                    to[q].low.push_back(value);
                if (high)
                    to[q].high.push_back(value);
            }
        };
        for (std::size_t draw = 0; draw < options_.draws; ++draw) {
            const auto uniform = [&](std::uint64_t i) { return uniform01(options_.seed, draw, Stream::bootstrap, i); };
            for (std::size_t g = 0; g < m; ++g)
                weights[g] = -std::log1p(-uniform(g));
            std::vector<double> hazard = best_;
            if (!hazard_.fractiles.empty())
                hazard = quantile_curve(hazard_, std::clamp(uniform(m + 1), 1e-6, 1 - 1e-6))
                             .node_weights(nodes_, -no_end, no_end);
            const double more = found_.few ? -std::log1p(-uniform(m)) : 0;
            for (const bool upper : {false, true}) {
                if (upper && !found_.few)
                    break; // the same draws serve both limits
                const std::vector<Two> shares = resampled(weights, more, upper ? Two{0, 1} : Two{1, 0});
                take(shares, best_, fragility, !upper, upper || !found_.few);
                take(shares, hazard, total, !upper, upper || !found_.few);
            }
        }
        const auto set = [&](ChangeNumber& number, std::size_t q, double value) {
            number.fragility = fragility[q].limits(options_.level, value);
            number.total = total[q].limits(options_.level, value);
        };
        set(found_.frequency, 0, found_.frequency.value);
        if (found_.ratio.value > 0 && std::isfinite(found_.ratio.value)) {
            set(found_.ratio, 1, std::log(found_.ratio.value));
            for (Limits* l : {&found_.ratio.fragility, &found_.ratio.total})
                *l = {std::exp(l->lower), std::exp(l->upper)};
        } else
            found_.ratio.fragility = found_.ratio.total = {0, no_end};
        for (std::size_t i = 0; i < options_.years.size(); ++i) {
            ChangeNumber& p = found_.probability[i];
            set(p, 2 + i, p.value);
            for (Limits* l : {&p.fragility, &p.total})
                *l = {std::max(l->lower, -1.0), std::min(l->upper, 1.0)};
        }
    }

    /// As of `share_frequency`: then any curve between two stripes is possible, in one structure or in both.
    bool separated(double Two::*side) const
    {
        const std::vector<Two> share = resampled(std::vector<double>(motions_.size(), 1), 0, {});
        std::size_t reached = 0, missed = stripes_;
        while (reached < stripes_ && share[reached].*side == 0)
            ++reached;
        while (missed > 0 && share[missed - 1].*side > 1 - 1e-12)
            --missed;
        return reached < stripes_ && missed > 0 && missed - 1 <= reached;
    }

    /// By what is not known of the form of one structure's curve, or of both: the distances of its limits from its
    /// value are joined with those of the draws, at the root of the sum of their squares (as in `risk_number.hpp`).
    void widen(bool base, bool variant)
    {
        if (!base && !variant)
            return;
        const RiskNumber &b = found_.base.frequency, &v = found_.variant.frequency;
        for (const auto& [of, in] : {std::pair{&RiskNumber::fragility, &ChangeNumber::fragility},
                                     {&RiskNumber::total, &ChangeNumber::total}}) {
            const Limits &of_base = b.*of, &of_variant = v.*of;
            // distances are taken on a scale of the frequencies
            const auto join = [&](ChangeNumber& number, auto&& scale) {
                const auto distance = [&](bool counts, double from, double to) {
                    return counts ? scale(to) - scale(from) : 0;
                };
                Limits& l = number.*in;
                l.upper =
                    number.value + std::hypot(l.upper - number.value, distance(variant, v.value, of_variant.upper),
                                              distance(base, of_base.lower, b.value));
                l.lower =
                    number.value - std::hypot(number.value - l.lower, distance(variant, of_variant.lower, v.value),
                                              distance(base, b.value, of_base.upper));
            };
            join(found_.frequency, [](double f) { return f; });
            for (std::size_t i = 0; i < options_.years.size(); ++i) {
                ChangeNumber& p = found_.probability[i];
                join(p, [years = options_.years[i]](double f) { return -std::expm1(-f * years); });
                p.*in = {std::max((p.*in).lower, -1.0), std::min((p.*in).upper, 1.0)};
            }
            if (!(found_.ratio.value > 0 && of_base.lower > 0 && of_variant.lower > 0)) {
                found_.ratio.*in = {0, no_end};
                continue;
            }
            Limits& ratio = found_.ratio.*in;
            ChangeNumber log{std::log(found_.ratio.value), {}, {}};
            log.*in = {std::log(ratio.lower), std::log(ratio.upper)};
            join(log, [](double f) { return std::log(f); });
            ratio = {std::exp((log.*in).lower), std::exp((log.*in).upper)};
        }
    }

    void nothing_is_known()
    {
        found_.ratio.fragility = found_.ratio.total = {0, no_end};
        for (ChangeNumber& p : found_.probability)
            p.fragility = p.total = {-1, 1};
    }

    const HazardModel& hazard_;
    const ChangeOptions& options_;
    const std::size_t stripes_;
    std::vector<double> nodes_, best_; ///< (stripes) ln im; weights with the hazard's best estimate
    std::vector<std::size_t> motions_; ///< with a pair
    std::vector<Two> shares_;          ///< (motions x stripes)
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
