/// How often the intervals of rare events and of Sobol's indices hold the truth, as Markdown tables on standard output.
///
///   stylobate_sampling_coverage [--repeats N]
///
/// Limit states and functions known in closed form (`tests/rare_truth.hpp`, `tests/sensitivity_functions.hpp`); no
/// mechanics. `scripts/sampling_coverage.sh` writes the tables into docs/sensitivity.md.

#include "tests/rare_truth.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <span>

namespace stylobate {
namespace {

/// Where intervals lay: holding the truth, above it, below it.
struct Held {
    std::size_t held = 0, above = 0, below = 0;

    void add(const Estimate& e, double truth) { ++(e.contains(truth) ? held : e.lower > truth ? above : below); }
    double percent(std::size_t count) const
    {
        return 100 * static_cast<double>(count) / static_cast<double>(held + above + below);
    }
};

void rare_coverage(std::size_t repeats)
{
    constexpr std::array<std::size_t, 4> sizes = {5, 10, 20, 40};
    fmt::print(
        "### Rare events\n\nPercent of {} estimates whose interval at 95 % holds the probability (one standard "
        "error: {:.1f}), with 5, 10, 20 and 40 repeats of 500 samples; in brackets in how many the whole interval "
        "lies above it, and below it. Mean: of the estimates, over the probability.\n\n| in ten dimensions | "
        "probability | 5 repeats | 10 | 20 | 40 | mean |\n|---|---|---|---|---|---|---|\n",
        repeats, 100 * std::sqrt(0.0475 / static_cast<double>(repeats)));
    for (const RareTruth& truth : {rare_plane(1e-3), rare_plane(1e-4), rare_plane(1e-5), rare_plane(1e-6),
                                   rare_pair(1e-4), rare_corner(1e-5), rare_shell(1e-4)}) {
        std::vector<double> pool;
        const Response response = truth.response();
        for (std::size_t r = 0; r < repeats * sizes.back(); ++r)
            pool.push_back(
                subset_simulation(truth.dimension, response, {.limit = truth.limit, .seed = 71}, r).probability);
        fmt::print("| {} | {:.0e} |", truth.name, truth.probability);
        for (const std::size_t n : sizes) {
            Held held;
            for (std::size_t i = 0; i < repeats; ++i)
                held.add(mean_of_repeats(std::vector<double>(&pool[i * n], &pool[i * n] + n), 0.95), truth.probability);
            fmt::print(" {:.1f} ({:.1f}, {:.1f}) |", held.percent(held.held), held.percent(held.above),
                       held.percent(held.below));
        }
        double mean = 0;
        for (const double p : pool)
            mean += p / truth.probability / static_cast<double>(pool.size());
        fmt::print(" {:.3f} |\n", mean);
        std::fflush(stdout);
    }
}

} // namespace
} // namespace stylobate

int main(int argc, char** argv)
{
    CLI::App app("How often intervals of rare events and of indices hold the truth, as Markdown tables");
    std::size_t repeats = 2000;
    app.add_option("--repeats", repeats, "estimates of each kind")->check(CLI::Range(10, 1000000));
    CLI11_PARSE(app, argc, argv);
    stylobate::rare_coverage(repeats);
    return 0;
}
