#include "ensemble/estimators/past/exclusion.hpp"

#include "ensemble/estimators/past/past_posterior.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace stylobate {

Exclusion exclusion(const PastLikelihood& likelihood, std::size_t events, const PriorDensity& prior, double level,
                    const RatioThresholds& thresholds, std::optional<std::size_t> frequency)
{
    const PastAxes& axes = likelihood.axes;
    assert(events >= 1 && events <= axes.events && "a past that was computed");
    const std::size_t ni = axes.intensity.size(), nf = axes.frequency_hz.size(),
                      first = (events - 1) * axes.cells_of_one();
    const std::vector<double> weights = frequency_weights(axes.frequency_hz);
    const auto of_events = [&](std::span<const double> cells) { return cells.subspan(first, axes.cells_of_one()); };
    const auto curve = [&](std::span<const double> cells) {
        if (!frequency)
            return over_frequencies(of_events(cells), weights);
        const std::span<const double> row = of_events(cells).subspan(*frequency * ni, ni);
        return std::vector<double>(row.begin(), row.end());
    };
    const IntensityIntegral integral(axes.intensity, prior);

    Exclusion result;
    result.rule = frequency ? thresholds.by_frequency.at(*frequency) : thresholds.mean;
    for (std::size_t i = 0; i < ni; ++i)
        result.likelihood.push_back(past_estimate(likelihood, [&](auto cells) { return curve(cells)[i]; }));
    const auto top = [](const std::vector<double>& values) {
        const double most = *std::max_element(values.begin(), values.end());
        return most > 0 ? values.back() / most : 1.0;
    };
    result.top_ratio = past_estimate(likelihood, [&](auto cells) { return top(curve(cells)); });
    const auto limit = [&](std::span<const double> cells) {
        const std::vector<double> values = curve(cells);
        return likelihood_limit(axes.intensity, values, result.rule.thresholds(values));
    };
    result.by_likelihood = past_estimate(likelihood, limit);
    std::vector<double> inverse; // from strong to weak, ascending
    for (auto a = axes.intensity.rbegin(); a != axes.intensity.rend(); ++a)
        inverse.push_back(1 / *a);
    result.weaker = past_estimate(likelihood, [&](auto cells) {
        std::vector<double> values = curve(cells), threshold = result.rule.thresholds(values);
        std::reverse(values.begin(), values.end());
        std::reverse(threshold.begin(), threshold.end());
        return 1 / likelihood_limit(inverse, values, threshold);
    });
    for (const std::vector<double>& draw : likelihood.drawn)
        result.drawn_with_limit += std::isfinite(limit(draw));
    result.drawn = likelihood.drawn.size();
    result.by_posterior = past_estimate(likelihood, [&](auto cells) { return integral.quantile(curve(cells), level); });
    result.by_prior = integral.quantile(std::vector<double>(ni, 1.0), level);
    if (frequency || nf == 1)
        return result;

    result.by_profile = past_estimate(likelihood, [&](auto cells) {
        const std::vector<double> values = largest_over_frequencies(of_events(cells), ni);
        return likelihood_limit(axes.intensity, values, thresholds.profile.thresholds(values));
    });
    const auto of_end = [&](std::size_t f) {
        return past_estimate(likelihood, [&](auto cells) {
            const auto all = of_events(cells), row = all.subspan(f * ni, ni);
            return *std::max_element(row.begin(), row.end()) / *std::max_element(all.begin(), all.end());
        });
    };
    result.lowest_frequency = of_end(0);
    result.highest_frequency = of_end(nf - 1);
    result.open_from = asymptotic_rule(1, level).part.front();
    return result;
}

namespace {

double wilks(double level)
{
    // the quantile of chi-square with one degree of freedom is the square of a normal one
    const double normal = normal_quantile(0.5 + level / 2);
    return std::exp(-normal * normal / 2);
}

/// The ratio below which a new monument has a probability of 1 - level at most, of exchangeable ones; none: too few.
std::optional<double> part_of(std::vector<double> ratios, double level)
{
    const auto place = static_cast<std::size_t>((1 - level) * static_cast<double>(ratios.size() + 1) * (1 + 1e-12));
    if (place == 0)
        return {};
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(place - 1), ratios.end());
    return ratios[place - 1];
}

/// A rule from the parts of those intensities that could be calibrated.
ExclusionRule rule_of(const std::vector<std::optional<double>>& parts, double level)
{
    ExclusionRule rule = asymptotic_rule(parts.size(), level);
    double least = std::numeric_limits<double>::infinity();
    for (const std::optional<double>& part : parts)
        least = std::min(least, part.value_or(least));
    rule.calibrated = std::isfinite(least);
    for (std::size_t i = 0; i < parts.size() && rule.calibrated; ++i)
        rule.part[i] = std::min(rule.part[i], parts[i].value_or(least));
    return rule;
}

double ratio_at(const std::vector<double>& curve, std::size_t i)
{
    return curve[i] / *std::max_element(curve.begin(), curve.end());
}

/// The ratios of one monument.
struct Ratios {
    std::size_t frequency = 0; ///< of its shaking
    double mean = 1, profile = 1, of_frequency = 1;
    bool judged = false; ///< else nothing is excluded
};

/// Monuments of one number of events.
class Monuments {
public:
    Monuments(const PastAxes& axes, const std::vector<double>& trials, const StandingStates& standing,
              const AgreeingStates& agreeing, const MeasuredState& measured, std::size_t events, std::uint64_t seed)
        : axes_(axes), trials_(trials), standing_(standing), agreeing_(agreeing), measured_(measured), seed_(seed),
          first_((events - 1) * axes.cells_of_one()), weights_(frequency_weights(axes.frequency_hz)),
          rows_(axes.intensity.size()), sums_(axes.intensity.size())
    {
        for (std::size_t r = 0; r < standing.cell.size(); ++r) {
            if (!in_events(r))
                continue;
            const std::size_t c = standing.cell[r] - first_, i = c % ni();
            rows_[i].push_back(r);
            sums_[i].push_back((sums_[i].empty() ? 0 : sums_[i].back()) + weights_[c / ni()] / trials[first_ + c]);
        }
    }

    std::size_t standing_at(std::size_t i) const { return rows_[i].size(); }

    /// @pre some stand there
    Ratios monument(std::size_t i, std::uint64_t number) const
    {
        const auto draw = [&](std::uint64_t element) { return uniform01(seed_, number, Stream::monument, element); };
        const auto at = std::upper_bound(sums_[i].begin(), sums_[i].end(), draw(0) * sums_[i].back());
        const auto place = std::min(static_cast<std::size_t>(at - sums_[i].begin()), sums_[i].size() - 1);
        const std::size_t itself = rows_[i][place], truth = standing_.cell[itself] - first_;
        std::vector<double> seen(standing_.state(itself).begin(),
                                 standing_.state(itself).begin() +
                                     static_cast<std::ptrdiff_t>(measured_.tolerance.size()));
        for (std::size_t k = 0; k < seen.size(); ++k)
            seen[k] += measured_.tolerance[k] * (2 * draw(1 + k) - 1);
        Ratios found{truth / ni()};
        std::vector<double> counts(axes_.cells_of_one(), 0);
        agreeing_.each(seen, [&](std::size_t r) {
            if (r == itself || !in_events(r))
                return;
            counts[standing_.cell[r] - first_] += 1;
            found.judged = true;
        });
        if (!found.judged)
            return found;
        const auto likelihood = [&](PastUse use) {
            const double c = prior_count(axes_, use);
            std::vector<double> cells;
            for (std::size_t k = 0; k < counts.size(); ++k)
                cells.push_back((counts[k] + c) / (trials_[first_ + k] - (k == truth ? 1 : 0) + 2 * c));
            return cells;
        };
        const std::vector<double> cells = likelihood(PastUse::means), single = likelihood(PastUse::cells);
        found.mean = ratio_at(over_frequencies(cells, weights_), i);
        found.profile = ratio_at(largest_over_frequencies(cells, ni()), i);
        const auto row = single.begin() + static_cast<std::ptrdiff_t>(found.frequency * ni());
        found.of_frequency = ratio_at({row, row + static_cast<std::ptrdiff_t>(ni())}, i);
        return found;
    }

private:
    std::size_t ni() const { return axes_.intensity.size(); }
    bool in_events(std::size_t r) const
    {
        return standing_.cell[r] >= first_ && standing_.cell[r] < first_ + axes_.cells_of_one();
    }

    const PastAxes& axes_;
    const std::vector<double>& trials_;
    const StandingStates& standing_;
    const AgreeingStates& agreeing_;
    const MeasuredState& measured_;
    std::uint64_t seed_;
    std::size_t first_;
    std::vector<double> weights_;
    std::vector<std::vector<std::size_t>> rows_; ///< (ni) those that stand
    std::vector<std::vector<double>> sums_;      ///< (ni) of their weights
};

} // namespace

std::vector<double> ExclusionRule::thresholds(std::span<const double> likelihood) const
{
    std::vector<double> all = part;
    const double most = absolute ? 1 : *std::max_element(likelihood.begin(), likelihood.end());
    for (double& each : all)
        each *= most;
    return all;
}

ExclusionRule asymptotic_rule(std::size_t intensities, double level)
{
    return {std::vector<double>(intensities, wilks(level))};
}

RatioThresholds asymptotic_thresholds(const PastAxes& axes, double level)
{
    const ExclusionRule rule = asymptotic_rule(axes.intensity.size(), level);
    return {rule, rule, std::vector<ExclusionRule>(axes.frequency_hz.size(), rule), {}};
}

RatioThresholds standing_thresholds(const PastAxes& axes, double level)
{
    const ExclusionRule rule{std::vector<double>(axes.intensity.size(), 1 - level), true};
    return {rule, rule, std::vector<ExclusionRule>(axes.frequency_hz.size(), rule), {}};
}

RatioThresholds ratio_thresholds(const PastAxes& axes, const std::vector<double>& trials,
                                 const StandingStates& standing, const AgreeingStates& agreeing,
                                 const MeasuredState& measured, std::size_t events, std::size_t monuments, double level,
                                 std::uint64_t seed)
{
    const std::size_t ni = axes.intensity.size(), nf = axes.frequency_hz.size();
    const Monuments of(axes, trials, standing, agreeing, measured, events, seed);
    const double asymptotic = wilks(level);
    std::vector<std::optional<double>> mean(ni), profile(ni);
    std::vector<std::vector<std::optional<double>>> by_frequency(nf, std::vector<std::optional<double>>(ni));
    std::vector<std::vector<Ratios>> tested(ni);
    for (std::size_t i = 0; i < ni; ++i) {
        if (of.standing_at(i) < fewest_standing)
            continue;
        std::vector<double> means, profiles;
        std::vector<std::vector<double>> one(nf);
        for (std::size_t m = 0; m < 2 * monuments; ++m) {
            const std::uint64_t number = (std::uint64_t{1} << 32) + ((events - 1) * ni + i) * 2 * monuments + m;
            const Ratios ratios = of.monument(i, number);
            if (m >= monuments) {
                tested[i].push_back(ratios);
                continue;
            }
            means.push_back(ratios.mean);
            profiles.push_back(ratios.profile);
            one[ratios.frequency].push_back(ratios.of_frequency);
        }
        mean[i] = part_of(means, level);
        profile[i] = part_of(profiles, level);
        for (std::size_t f = 0; f < nf; ++f)
            by_frequency[f][i] = part_of(one[f], level);
    }
    RatioThresholds found{rule_of(mean, level), rule_of(profile, level), {}, std::vector<ExclusionCoverage>(ni)};
    for (const auto& parts : by_frequency)
        found.by_frequency.push_back(rule_of(parts, level));
    for (std::size_t i = 0; i < ni; ++i)
        for (const Ratios& ratios : tested[i]) {
            ++found.coverage[i].monuments;
            found.coverage[i].excluded += ratios.judged && ratios.mean < found.mean.part[i];
            found.coverage[i].asymptotic += ratios.judged && ratios.mean < asymptotic;
        }
    return found;
}

} // namespace stylobate
