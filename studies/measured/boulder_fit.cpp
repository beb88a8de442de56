#include "studies/measured/boulder_fit.hpp"

#include "studies/measured/score.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

namespace stylobate::measured {

namespace {

constexpr double least_slenderness = 0.1;
constexpr double grid_step = 0.065; // of the logarithm
constexpr int grid_points = 24;
constexpr std::array<double, 6> slips{0.01, 0.02, 0.04, 0.07, 0.1, 0.15};

} // namespace

std::vector<double> slenderness_grid()
{
    std::vector<double> grid;
    for (int i = 0; i < grid_points; ++i)
        grid.push_back(least_slenderness * std::exp(grid_step * i));
    return grid;
}

double FallTable::share(std::size_t test, std::size_t median, double spread) const
{
    const std::vector<char>& fell = falls[test];
    if (spread <= 0)
        return fell[median];
    double weights = 0, sum = 0;
    for (std::size_t i = 0; i < slenderness.size(); ++i) {
        const double z = std::log(slenderness[i] / slenderness[median]) / spread;
        const double weight = std::exp(-0.5 * z * z);
        weights += weight;
        sum += weight * fell[i];
    }
    return sum / weights;
}

FallTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run)
{
    FallTable table{variant, slenderness_grid(), std::vector<std::vector<char>>(tests.size())};
    std::vector<BoulderModel> models;
    for (const double slenderness : table.slenderness) {
        models.push_back(variant);
        models.back().slenderness = slenderness;
    }
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(run.threads));
    tbb::parallel_for(std::size_t(0), tests.size(),
                      [&](std::size_t i) { table.falls[i] = falls_in(tests[i].motion, models, run.isa); });
    return table;
}

BoulderFit fit(const FallTable& table, const std::vector<BoulderTest>& tests, const std::vector<bool>& use,
               const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const double spread : spreads)
        for (const double slip : slips) {
            BoulderFit now;
            now.slip = slip;
            for (std::size_t s = 0; s < boulders; ++s) {
                double most = -std::numeric_limits<double>::infinity();
                for (std::size_t median = 0; median < table.slenderness.size(); ++median) {
                    double sum = 0;
                    for (std::size_t i = 0; i < tests.size(); ++i)
                        if (use[i])
                            sum -= log_loss({now.probability(table.share(i, median, spread)), tests[i].fell[s], {}});
                    if (sum > most) {
                        most = sum;
                        now.model[s] = table.variant;
                        now.model[s].slenderness = table.slenderness[median];
                        now.model[s].slenderness_spread = spread;
                    }
                }
                now.log_likelihood += most;
            }
            if (now.log_likelihood > best.log_likelihood)
                best = now;
        }
    return best;
}

BoulderFit best_fit(const std::vector<FallTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const FallTable& table : tables) {
        const BoulderFit now = fit(table, tests, use, spreads);
        if (now.log_likelihood > best.log_likelihood)
            best = now;
    }
    return best;
}

} // namespace stylobate::measured
