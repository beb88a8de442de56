#include "studies/evidence/measured/parts/fall_table.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "studies/evidence/measured/parts/forecast.hpp"

#include <tbb/global_control.h>

#include <cmath>
#include <limits>

namespace stylobate::measured {

const std::vector<double> slips{0.01, 0.02, 0.04, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4};

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

std::vector<double> equal_ratios(double from, double to, int count)
{
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(from * std::pow(to / from, i / static_cast<double>(count - 1)));
    return values;
}

bool has_fallen(const Outcome& outcome)
{
    constexpr double on_its_side = 1; // rad; no block here balances beyond half of it
    return outcome.state == State::collapsed ||
           (outcome.state == State::invalid && outcome.max_relative_rotation_rad > on_its_side);
}

void Ends::add(const Outcome& outcome)
{
    const bool invalid = outcome.state == State::invalid;
    ++total;
    fallen += has_fallen(outcome);
    on_its_side += invalid && has_fallen(outcome);
    set_aside += invalid && !has_fallen(outcome);
}

void Ends::add(const Ends& more)
{
    total += more.total;
    fallen += more.fallen;
    on_its_side += more.on_its_side;
    set_aside += more.set_aside;
}

std::vector<char> falls_in(const Motion& motion, const std::vector<Study>& studies, Isa isa, Ends* ends)
{
    std::vector<char> falls(studies.size());
    if (motion.empty())
        return falls;
    const auto realization = [&](std::size_t i) { return Sampler(studies[i], &motion).realization(0); };
    LaneSet set(studies.front(), &motion, kernels(isa), realization(0), studies.size());
    std::vector<std::size_t> in_lane(static_cast<std::size_t>(set.lanes()));
    std::size_t next = 0;
    const auto source = [&](int lane) {
        if (next == studies.size())
            return false;
        in_lane[static_cast<std::size_t>(lane)] = next;
        set.load(lane, realization(next++));
        return true;
    };
    const auto sink = [&](int lane) {
        falls[in_lane[static_cast<std::size_t>(lane)]] = has_fallen(*set.outcome(lane));
        if (ends)
            ends->add(*set.outcome(lane));
        set.clear(lane);
    };
    drive(set, source, sink, [](int, bool) { return true; });
    return falls;
}

FallTable simulated_falls(const std::vector<double>& slenderness, std::size_t tests,
                          const std::function<Motion(std::size_t)>& motion, const std::function<Study(double)>& study,
                          const RunOptions& run)
{
    FallTable table{slenderness, std::vector<std::vector<char>>(tests), std::vector<Ends>(tests)};
    std::vector<Study> studies;
    for (const double one : slenderness)
        studies.push_back(study(one));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(run.threads));
    in_parallel(std::size_t(0), tests,
                [&](std::size_t i) { table.falls[i] = falls_in(motion(i), studies, run.isa, &table.ends[i]); });
    return table;
}

double log_likelihood(const FallTable& table, std::size_t median, const std::vector<bool>& fell,
                      const std::vector<bool>& use, double spread, double slip)
{
    double sum = 0;
    for (std::size_t i = 0; i < fell.size(); ++i)
        if (use[i])
            sum -= log_loss({with_slip(table.share(i, median, spread), slip), fell[i], {}});
    return sum;
}

LikelySlenderness likely_slenderness(const FallTable& table, const std::vector<bool>& fell,
                                     const std::vector<bool>& use, double spread, double slip)
{
    LikelySlenderness best{0, -std::numeric_limits<double>::infinity()};
    for (std::size_t median = 0; median < table.slenderness.size(); ++median) {
        const double likely = log_likelihood(table, median, fell, use, spread, slip);
        if (likely > best.log_likelihood)
            best = {median, likely};
    }
    return best;
}

} // namespace stylobate::measured
