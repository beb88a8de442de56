#include "io/plots/strip_parts.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {
namespace {

constexpr std::size_t least_snapshots = 2;
constexpr std::size_t most_snapshots = 16;

} // namespace

Unit unit_for(double largest)
{
    return largest < 1 ? Unit{"mm", 1000} : Unit{"m", 1};
}

double round_step(double length)
{
    const double decade = std::pow(10.0, std::floor(std::log10(length)));
    return decade * (length >= 5 * decade ? 5 : length >= 2 * decade ? 2 : 1);
}

bool has_fallen(const std::vector<double>& fall_time_s, std::size_t block, double time_s)
{
    return !fall_time_s.empty() && fall_time_s[block] >= 0 && fall_time_s[block] <= time_s;
}

void check_trajectory(const Trajectory& t, const std::vector<double>& fall_time_s)
{
    if (!lists_fit(t))
        throw InputError(fmt::format("the trajectory of realization {} has tables of different sizes: it is damaged.\n"
                                     "  Replay the realization into a new file.",
                                     t.index));
    if (!fall_time_s.empty() && fall_time_s.size() != t.blocks())
        throw InputError(
            fmt::format("realization {} has fall times of {} blocks and a trajectory of {}: it is damaged.\n"
                        "  Replay the realization into a new file.",
                        t.index, fall_time_s.size(), t.blocks()));
}

void check_some_sample(const Trajectory& t, std::size_t good)
{
    if (good == 0 || t.blocks() == 0)
        throw InputError(fmt::format("the trajectory of realization {} has no sample to draw.\n  Replay the "
                                     "realization with a sufficiently high output.trajectory_rate_hz.",
                                     t.index));
}

std::vector<std::size_t> choose_samples(std::size_t samples, std::size_t snapshots,
                                        const std::function<double(std::size_t sample, std::size_t from)>& departure)
{
    if (snapshots < least_snapshots || snapshots > most_snapshots)
        throw InputError(fmt::format("{} snapshots are outside [{}, {}].\n  Ask for 8, for example.", snapshots,
                                     least_snapshots, most_snapshots));
    if (samples <= snapshots) {
        std::vector<std::size_t> all(samples);
        for (std::size_t s = 0; s < samples; ++s)
            all[s] = s;
        return all;
    }
    // The clock of the stretches runs a quarter with the time, the rest with the way that the blocks have gone.
    std::vector<double> way(samples, 0.0);
    for (std::size_t s = 1; s < samples; ++s)
        way[s] = way[s - 1] + departure(s, s - 1);
    const auto clock = [&](std::size_t s) {
        const double share = static_cast<double>(s) / static_cast<double>(samples - 1);
        return way.back() > 0 ? 0.25 * share + 0.75 * way[s] / way.back() : share;
    };
    std::vector<std::size_t> chosen{0};
    std::size_t s = 1;
    const auto stretches = static_cast<double>(snapshots - 1);
    for (std::size_t k = 1; k + 1 < snapshots; ++k) {
        const std::size_t latest = samples - snapshots + k; // leaves a sample for each stretch to come
        std::size_t best = s;
        double farthest = -1;
        do {
            const double d = departure(s, 0);
            // In a column at rest the end of the stretch, so that the times are even.
            if (d >= farthest) {
                farthest = d;
                best = s;
            }
            ++s;
        } while (s <= latest && clock(s) <= static_cast<double>(k) / stretches);
        chosen.push_back(best);
    }
    chosen.push_back(samples - 1);
    return chosen;
}

} // namespace stylobate
