#include "ensemble/estimators/subset_simulation.hpp"

#include "ensemble/elementary.hpp"
#include "ensemble/random.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace stylobate {

namespace {

/// Fills in standard normal numbers, two at a time (Box and Muller 1958).
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

class Subset {
public:
    Subset(std::size_t dimension, const Response& response, const SubsetOptions& options, std::uint64_t repeat)
        : dimension_(dimension), evaluate_(response), options_(options), repeat_(repeat),
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
        double product = 1;
        while (true) {
            std::vector<double> sorted = samples.response;
            std::sort(sorted.begin(), sorted.end(), std::greater<>());
            const double next = sorted[chains_ - 1];
            const bool last = next >= options_.limit;
            level.probability = share_above(samples.response, last ? options_.limit : next);
            run_.levels.push_back(level);
            product *= level.probability;
            if (last || run_.levels.size() > options_.most_levels || !(next > level.threshold)) {
                // not there yet, and no level that is higher than this: what fails among these is all that is known
                run_.probability =
                    last ? product : product / level.probability * share_above(samples.response, options_.limit);
                return run_;
            }
            level.threshold = next;
            samples = walk(samples, level);
        }
    }

private:
    std::uint64_t number(std::uint64_t evaluation) const { return (repeat_ << 32) | evaluation; }

    static double share_above(const std::vector<double>& response, double threshold)
    {
        const auto above =
            std::count_if(response.begin(), response.end(), [threshold](double g) { return g >= threshold; });
        return static_cast<double>(above) / static_cast<double>(response.size());
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
        Samples all, at; // everything, and where the chains are
        for (std::size_t i = 0; i < from.response.size() && at.response.size() < chains_; ++i)
            if (from.response[i] >= level.threshold) {
                at.response.push_back(from.response[i]);
                const auto begin = from.points.begin() + static_cast<std::ptrdiff_t>(i * dimension_);
                at.points.insert(at.points.end(), begin, begin + static_cast<std::ptrdiff_t>(dimension_));
            }
        all = at;
        const std::vector<double> spread = spreads(at.points);
        std::vector<bool> moved(chains_, false);
        std::size_t taken = 0;
        for (std::size_t step = 1; step < length_; ++step) {
            const std::size_t before = taken;
            const std::vector<double> candidates = propose(at.points, spread);
            const std::vector<double> response = respond(candidates);
            for (std::size_t c = 0; c < chains_; ++c)
                if (response[c] >= level.threshold) {
                    std::copy_n(&candidates[c * dimension_], dimension_, &at.points[c * dimension_]);
                    at.response[c] = response[c];
                    moved[c] = true;
                    ++taken;
                }
            all.points.insert(all.points.end(), at.points.begin(), at.points.end());
            all.response.insert(all.response.end(), at.response.begin(), at.response.end());
            const double share = static_cast<double>(taken - before) / static_cast<double>(chains_);
            step_ *= std::exp((share - wanted_acceptance) / std::sqrt(static_cast<double>(step)));
        }
        const auto candidates = static_cast<double>(chains_ * (length_ - 1));
        level.acceptance = static_cast<double>(taken) / candidates;
        level.stuck = static_cast<double>(std::count(moved.begin(), moved.end(), false)) / static_cast<double>(chains_);
        level.step = step_;
        return all;
    }

    /// Deviation of each number over the chains.
    std::vector<double> spreads(const std::vector<double>& points) const
    {
        std::vector<double> sum(dimension_, 0), squares(dimension_, 0);
        for (std::size_t i = 0; i < points.size(); ++i) {
            sum[i % dimension_] += points[i];
            squares[i % dimension_] += points[i] * points[i];
        }
        const auto n = static_cast<double>(chains_);
        for (std::size_t d = 0; d < dimension_; ++d)
            squares[d] = std::sqrt(std::max(0.0, (squares[d] - sum[d] * sum[d] / n) / (n - 1)));
        return squares;
    }

    std::vector<double> propose(const std::vector<double>& points, const std::vector<double>& spread) const
    {
        std::vector<double> candidates(points.size());
        for (std::size_t c = 0; c < chains_; ++c) {
            double* v = &candidates[c * dimension_];
            const double* u = &points[c * dimension_];
            draw_normal(options_.seed, number(run_.evaluations + c), v, dimension_);
            for (std::size_t i = 0; i < dimension_; ++i) {
                const double s = std::min(1.0, step_ * spread[i]);
                v[i] = std::sqrt(1 - s * s) * u[i] + s * v[i];
            }
        }
        return candidates;
    }

    static constexpr double wanted_acceptance = 0.44;

    std::size_t dimension_;
    const Response& evaluate_;
    SubsetOptions options_;
    std::uint64_t repeat_;
    std::size_t chains_, length_;
    double step_ = 0.6; ///< f; what one level has learnt the next one begins with
    SubsetRun run_;
};

/// Mean, and the deviation of the mean over it.
struct Spread {
    double mean = 0;
    double relative = 0;
};

Spread spread_of(const std::vector<double>& repeats)
{
    const auto n = static_cast<double>(repeats.size());
    const double mean = std::accumulate(repeats.begin(), repeats.end(), 0.0) / n;
    double squares = 0;
    for (const double p : repeats)
        squares += (p - mean) * (p - mean);
    return {mean, std::sqrt(squares / (n - 1) / n) / mean};
}

} // namespace

SubsetRun subset_simulation(std::size_t dimension, const Response& response, const SubsetOptions& options,
                            std::uint64_t repeat)
{
    return Subset(dimension, response, options, repeat).run();
}

Estimate mean_of_repeats(const std::vector<double>& repeats, double level)
{
    if (repeats.size() < 2)
        return Estimate::undetermined();
    const Spread spread = spread_of(repeats);
    if (!(spread.mean > 0))
        return Estimate::undetermined();
    const boost::math::students_t student(static_cast<double>(repeats.size() - 1));
    const double factor = std::exp(boost::math::quantile(student, (1 + level) / 2) * spread.relative);
    return {spread.mean, spread.mean / factor, std::min(1.0, spread.mean * factor)};
}

double plain_sampling_cost(const std::vector<double>& repeats)
{
    const Spread spread = spread_of(repeats);
    return (1 - spread.mean) / (spread.mean * spread.relative * spread.relative);
}

} // namespace stylobate
