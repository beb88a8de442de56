#include "ensemble/estimators/designs/subset_simulation.hpp"

#include "ensemble/numerics/elementary.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace stylobate {

namespace {

/// Fills in standard normal numbers, two at a time (Box & Muller, "A note on the generation of random normal deviates",
/// Annals of Mathematical Statistics 29 (1958) 610).
void draw_normal(std::uint64_t seed, std::uint64_t index, double* numbers, std::size_t count)
{
    for (std::size_t i = 0; i < count; i += 2) {
        const double radius = std::sqrt(-2 * log_of(uniform01(seed, index, Stream::subset, i)));
        const double cycles = uniform01(seed, index, Stream::subset, i + 1);
        numbers[i] = radius * cosine_of(cycles);
        if (i + 1 < count)
            numbers[i + 1] = radius * sine_of(cycles);
    }
}

/// The samples of a level: points and responses.
struct Samples {
    std::vector<double> points; ///< (n x dimension)
    std::vector<double> response;
};

/// Which samples begin the chains of a level: an element beyond those of any point.
constexpr std::uint64_t starts_element = std::uint64_t{1} << 32;

class Subset {
public:
    /// @param plan levels whose thresholds and steps are kept; null: they are chosen
    Subset(std::size_t dimension, const Response& response, const SubsetOptions& options, std::uint64_t simulation,
           const std::vector<SubsetLevel>* plan)
        : dimension_(dimension), evaluate_(response), options_(options), simulation_(simulation), plan_(plan),
          chains_(
              static_cast<std::size_t>(std::lround(options.level_probability * static_cast<double>(options.samples)))),
          length_(chains_ > 0 ? options.samples / chains_ : 0)
    {
        if (chains_ < 2 || length_ < 2 || dimension == 0)
            throw std::invalid_argument("subset simulation needs a dimension and at least two chains of two samples");
    }

    SubsetRun run()
    {
        Samples samples;
        samples.points.resize(options_.samples * dimension_);
        for (std::size_t i = 0; i < options_.samples; ++i)
            draw_normal(options_.seed, number(i), &samples.points[i * dimension_], dimension_);
        samples.response = respond(samples.points);
        SubsetLevel level;
        level.threshold = -std::numeric_limits<double>::infinity();
        double product = 1; ///< of the shares
        while (true) {
            const double next = next_threshold(samples.response, level.threshold);
            level.probability = share(samples.response, next);
            const bool last = next == options_.limit || level.probability == 0;
            run_.levels.push_back(level);
            product *= level.probability;
            if (last) {
                run_.probability = product;
                return run_;
            }
            level.threshold = next;
            samples = walk(samples, level);
        }
    }

private:
    std::uint64_t number(std::uint64_t evaluation) const { return (simulation_ << 32) | evaluation; }

    /// Where the samples of a level are divided; the limit if it is the last level.
    double next_threshold(const std::vector<double>& response, double threshold) const
    {
        const std::size_t level = run_.levels.size();
        if (plan_)
            return level + 1 < plan_->size() ? (*plan_)[level + 1].threshold : options_.limit;
        std::vector<double> sorted = response;
        std::sort(sorted.begin(), sorted.end(), std::greater<>());
        const double next = sorted[chains_]; // the greatest response that does not continue
        const bool higher = next > threshold && sorted.front() > next;
        return higher && next < options_.limit && level < options_.most_levels ? next : options_.limit;
    }

    /// Of the responses above a threshold, or not below the limit.
    double share(const std::vector<double>& response, double value) const
    {
        const bool limit = value == options_.limit;
        const auto count = std::count_if(response.begin(), response.end(),
                                         [=](double g) { return g > value || (limit && g == value); });
        return static_cast<double>(count) / static_cast<double>(response.size());
    }

    /// NaN becomes less than anything.
    std::vector<double> respond(const std::vector<double>& points)
    {
        std::vector<double> response = evaluate_(points, run_.evaluations);
        run_.evaluations += response.size();
        for (double& g : response)
            if (std::isnan(g)) {
                ++run_.invalid;
                g = -std::numeric_limits<double>::infinity();
            }
        return response;
    }

    /// Chains from samples above the threshold of the level, all a step at a time.
    Samples walk(const Samples& from, SubsetLevel& level)
    {
        std::vector<std::size_t> above;
        for (std::size_t i = 0; i < from.response.size(); ++i)
            if (from.response[i] > level.threshold)
                above.push_back(i);
        Samples all, at; // everything, and where the chains are
        // evenly over all that go on, from a random one: each begins chains_ / above.size() chains on average
        const double begin_at = uniform01(options_.seed, number(run_.evaluations), Stream::subset, starts_element);
        for (std::size_t c = 0; c < chains_; ++c) {
            const double place = (static_cast<double>(c) + begin_at) / static_cast<double>(chains_);
            const std::size_t i =
                above[std::min(above.size() - 1, static_cast<std::size_t>(place * static_cast<double>(above.size())))];
            at.response.push_back(from.response[i]);
            const auto begin = from.points.begin() + static_cast<std::ptrdiff_t>(i * dimension_);
            at.points.insert(at.points.end(), begin, begin + static_cast<std::ptrdiff_t>(dimension_));
        }
        all = at;
        std::vector<bool> moved(chains_, false);
        std::size_t taken = 0;
        level.steps = plan_ ? (*plan_)[run_.levels.size()].steps : std::vector<double>{};
        for (std::size_t step = 1; step < length_; ++step) {
            const std::size_t before = taken;
            if (!plan_)
                level.steps.push_back(std::min(1.0, step_));
            const std::vector<double> candidates = propose(at.points, level.steps[step - 1]);
            const std::vector<double> response = respond(candidates);
            for (std::size_t c = 0; c < chains_; ++c)
                if (response[c] > level.threshold) {
                    std::copy_n(&candidates[c * dimension_], dimension_, &at.points[c * dimension_]);
                    at.response[c] = response[c];
                    moved[c] = true;
                    ++taken;
                }
            all.points.insert(all.points.end(), at.points.begin(), at.points.end());
            all.response.insert(all.response.end(), at.response.begin(), at.response.end());
            const double accepted = static_cast<double>(taken - before) / static_cast<double>(chains_);
            step_ *= std::exp((accepted - wanted_acceptance) / std::sqrt(static_cast<double>(step)));
        }
        const auto candidates = static_cast<double>(chains_ * (length_ - 1));
        level.acceptance = static_cast<double>(taken) / candidates;
        level.stuck = static_cast<double>(std::count(moved.begin(), moved.end(), false)) / static_cast<double>(chains_);
        return all;
    }

    std::vector<double> propose(const std::vector<double>& points, double s) const
    {
        const double r = std::sqrt(1 - s * s);
        std::vector<double> candidates(points.size());
        for (std::size_t c = 0; c < chains_; ++c) {
            double* v = &candidates[c * dimension_];
            const double* u = &points[c * dimension_];
            draw_normal(options_.seed, number(run_.evaluations + c), v, dimension_);
            for (std::size_t i = 0; i < dimension_; ++i)
                v[i] = r * u[i] + s * v[i];
        }
        return candidates;
    }

    static constexpr double wanted_acceptance = 0.44;

    std::size_t dimension_;
    const Response& evaluate_;
    SubsetOptions options_;
    std::uint64_t simulation_;
    const std::vector<SubsetLevel>* plan_;
    std::size_t chains_, length_;
    double step_ = 0.6; ///< of a pilot; what one level has learnt the next one begins with
    SubsetRun run_;
};

double mean_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// With n - 1.
double variance_of(const std::vector<double>& values)
{
    const double mean = mean_of(values);
    double squares = 0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return squares / static_cast<double>(values.size() - 1);
}

} // namespace

SubsetRun subset_pilot(std::size_t dimension, const Response& response, const SubsetOptions& options,
                       std::uint64_t simulation)
{
    return Subset(dimension, response, options, simulation, nullptr).run();
}

SubsetRun subset_simulation(std::size_t dimension, const Response& response, const SubsetOptions& options,
                            const std::vector<SubsetLevel>& plan, std::uint64_t simulation)
{
    return Subset(dimension, response, options, simulation, &plan).run();
}

Estimate mean_of_repeats(const std::vector<double>& repeats, double level)
{
    Estimate estimate = Estimate::undetermined();
    if (repeats.size() < least_repeats || !(mean_of(repeats) > 0))
        return estimate;
    estimate.value = mean_of(repeats);
    if (std::find(repeats.begin(), repeats.end(), 0.0) != repeats.end())
        return estimate;
    std::vector<double> logs;
    for (const double p : repeats)
        logs.push_back(std::log(p));
    const auto n = static_cast<double>(repeats.size());
    const double variance = variance_of(logs);
    const double centre = mean_of(logs) + variance / 2;
    const double reach =
        student_quantile((1 + level) / 2, n - 1) * std::sqrt(variance / n + variance * variance / (2 * (n - 1)));
    estimate.lower = std::exp(centre - reach);
    estimate.upper = std::min(1.0, std::exp(centre + reach));
    return estimate;
}

double plain_sampling_cost(const std::vector<double>& repeats)
{
    const double mean = mean_of(repeats);
    return mean * (1 - mean) * static_cast<double>(repeats.size()) / variance_of(repeats);
}

} // namespace stylobate
