#include "ensemble/estimators/past/simulated_monuments.hpp"

#include "ensemble/numerics/random.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// The place in ascending sums at which a part u of the last one is reached.
std::size_t chosen(const std::vector<double>& sums, double u)
{
    const auto at = std::upper_bound(sums.begin(), sums.end(), u * sums.back());
    return std::min(static_cast<std::size_t>(at - sums.begin()), sums.size() - 1);
}

/// u of a coordinate of the true cell.
template <class Coordinate>
double place_of(const std::vector<double>& posterior, const Coordinate& coordinate, std::size_t truth, double within)
{
    double below = 0, here = 0, all = 0;
    for (std::size_t c = 0; c < posterior.size(); ++c) {
        all += posterior[c];
        below += coordinate(c) < coordinate(truth) ? posterior[c] : 0;
        here += coordinate(c) == coordinate(truth) ? posterior[c] : 0;
    }
    return (below + within * here) / all;
}

} // namespace

std::size_t MonumentTest::inside(const std::vector<double>& u, double level)
{
    return static_cast<std::size_t>(
        std::count_if(u.begin(), u.end(), [&](double each) { return std::fabs(each - 0.5) <= level / 2; }));
}

MonumentTest test_monuments(const PastAxes& axes, const std::vector<double>& trials, const StandingStates& standing,
                            const AgreeingStates& agreeing, const MeasuredState& measured,
                            std::span<const double> prior, std::size_t monuments, std::uint64_t seed)
{
    MonumentTest test;
    const std::size_t ni = axes.intensity.size(), of_one = axes.cells_of_one();
    if (standing.cell.empty())
        return test;
    const double count = prior_count(axes, PastUse::means);
    // a realization that stands has the prior of its cell over the trials of its cell
    std::vector<double> sums;
    for (const std::size_t cell : standing.cell)
        sums.push_back((sums.empty() ? 0 : sums.back()) + prior[cell] / trials[cell]);
    for (std::size_t m = 0; m < monuments; ++m) {
        const auto draw = [&](std::uint64_t element) { return uniform01(seed, m, Stream::monument, element); };
        const std::size_t itself = chosen(sums, draw(0));
        const std::size_t truth = standing.cell[itself];
        std::vector<double> seen;
        for (std::size_t k = 0; k < measured.tolerance.size(); ++k)
            seen.push_back(standing.state(itself)[k] + measured.tolerance[k] * (2 * draw(4 + k) - 1));
        std::vector<double> posterior(axes.cells(), 0);
        bool judged = false;
        agreeing.each(seen, [&](std::size_t r) {
            posterior[standing.cell[r]] += r == itself ? 0 : 1;
            judged = judged || r != itself;
        });
        for (std::size_t c = 0; c < posterior.size(); ++c)
            posterior[c] = prior[c] * (posterior[c] + count) / (trials[c] - (c == truth ? 1 : 0) + 2 * count);
        if (!judged) {
            ++test.not_judged;
            continue;
        }
        test.intensity.push_back(place_of(
            posterior, [&](std::size_t c) { return c % ni; }, truth, draw(1)));
        test.frequency.push_back(place_of(
            posterior, [&](std::size_t c) { return c % of_one / ni; }, truth, draw(2)));
        test.events.push_back(place_of(
            posterior, [&](std::size_t c) { return c / of_one; }, truth, draw(3)));
    }
    return test;
}

} // namespace stylobate
