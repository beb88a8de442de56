#include "studies/evidence/measured/boulders/boulder_fit.hpp"

#include "ensemble/numerics/in_parallel.hpp"

#include <tbb/global_control.h>

#include <limits>

namespace stylobate::measured {

namespace {

std::vector<bool> fell(const std::vector<BoulderTest>& tests, std::size_t boulder)
{
    std::vector<bool> falls;
    for (const BoulderTest& test : tests)
        falls.push_back(test.fell[boulder]);
    return falls;
}

} // namespace

BoulderTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run)
{
    BoulderTable table{
        variant,
        {equal_ratios(0.1, 0.45, 24), std::vector<std::vector<char>>(tests.size()), std::vector<Ends>(tests.size())}};
    std::vector<Study> studies;
    for (const double slenderness : table.falls.slenderness) {
        BoulderModel model = variant;
        model.slenderness = slenderness;
        studies.push_back(boulder_study(model));
    }
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(run.threads));
    in_parallel(std::size_t(0), tests.size(), [&](std::size_t i) {
        table.falls.falls[i] = falls_in(tests[i].motion, studies, run.isa, &table.falls.ends[i]);
    });
    return table;
}

BoulderFit fit(const BoulderTable& table, const std::vector<BoulderTest>& tests, const std::vector<bool>& use,
               const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const double spread : spreads)
        for (const double slip : slips) {
            BoulderFit now;
            now.slip = slip;
            for (std::size_t s = 0; s < boulders; ++s) {
                const LikelySlenderness likely = likely_slenderness(table.falls, fell(tests, s), use, spread, slip);
                now.model[s] = table.variant;
                now.model[s].slenderness = table.falls.slenderness[likely.median];
                now.model[s].slenderness_spread = spread;
                now.log_likelihood += likely.log_likelihood;
            }
            if (now.log_likelihood > best.log_likelihood)
                best = now;
        }
    return best;
}

BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const BoulderTable& table : tables) {
        const BoulderFit now = fit(table, tests, use, spreads);
        if (now.log_likelihood > best.log_likelihood)
            best = now;
    }
    return best;
}

} // namespace stylobate::measured
