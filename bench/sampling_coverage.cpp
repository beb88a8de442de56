/// How often the intervals of rare events and of Sobol's indices hold the truth, as Markdown tables on standard output.
///
///   stylobate_sampling_coverage [--repeats N]
///
/// Limit states and functions known in closed form (`tests/ensemble/estimators/rare_truth.hpp`,
/// `tests/ensemble/estimators/sensitivity_functions.hpp`); no mechanics. `scripts/tables.sh sampling_coverage` writes
/// the tables into docs/sensitivity.md.

#include "bench/mean.hpp"
#include "io/tables/table.hpp"
#include "tests/ensemble/estimators/rare_truth.hpp"
#include "tests/ensemble/estimators/sensitivity_functions.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace stylobate {
namespace {

/// Where intervals lay: holding the truth, above it, below it; or there was none.
struct Held {
    std::size_t held = 0, above = 0, below = 0, none = 0;

    void add(const Estimate& e, double truth)
    {
        ++(std::isnan(e.lower) ? none : e.contains(truth) ? held : e.lower > truth ? above : below);
    }
    double percent(std::size_t count) const
    {
        return 100 * static_cast<double>(count) / static_cast<double>(held + above + below + none);
    }
};

std::string text_of(const Mean& parts_of_truth)
{
    return fmt::format("{:.4f} ± {:.4f}", parts_of_truth.value(), parts_of_truth.error());
}

/// Studies of rare events, each with its pilot.
struct RareStudies {
    double truth;
    std::vector<std::vector<double>> studies; ///< repeats of each
    Mean pilots, counted;

    RareStudies(const RareTruth& of, std::size_t samples, std::size_t count, std::size_t repeats)
        : truth(of.probability), studies(count)
    {
        const Response response = of.response();
        for (std::size_t i = 0; i < count; ++i) {
            const SubsetOptions options{.samples = samples, .limit = of.limit, .seed = 71 + i};
            const SubsetRun pilot = subset_pilot(of.dimension, response, options);
            pilots.add(pilot.probability / truth);
            for (std::size_t r = 1; r <= repeats; ++r) {
                studies[i].push_back(subset_simulation(of.dimension, response, options, pilot.levels, r).probability);
                counted.add(studies[i].back() / truth);
            }
        }
    }

    /// Of their intervals by the first `repeats` repeats.
    Held held(std::size_t repeats) const
    {
        Held held;
        for (const auto& study : studies)
            held.add(mean_of_repeats({study.begin(), study.begin() + static_cast<std::ptrdiff_t>(repeats)}, 0.95),
                     truth);
        return held;
    }

    double percent_of_none() const
    {
        double none = 0;
        for (const auto& study : studies)
            none += static_cast<double>(std::count(study.begin(), study.end(), 0.0));
        return 100 * none / counted.count;
    }
};

void rare_coverage(std::size_t repeats)
{
    constexpr std::array<std::size_t, 4> sizes = {5, 10, 20, 40};
    fmt::print("### Rare events\n\nPercent of {} estimates whose 95 % interval contains the probability (one standard "
               "error: {:.1f}), with 5, 10, 20 and 40 repeats of 500 samples; in brackets the percentage of intervals "
               "entirely above it, and below it. Mean: of the estimates, divided by the probability.\n\n",
               repeats, 100 * std::sqrt(0.0475 / static_cast<double>(repeats)));
    fmt::print("{}", markdown_head("in ten dimensions | probability | 5 repeats | 10 | 20 | 40 | mean"));
    for (const RareTruth& truth : {rare_plane(1e-3), rare_plane(1e-4), rare_plane(1e-5), rare_plane(1e-6),
                                   rare_pair(1e-4), rare_corner(1e-5), rare_shell(1e-4)}) {
        const RareStudies studies(truth, 500, repeats, sizes.back());
        fmt::print("| {} | {:.0e} |", truth.name, truth.probability);
        for (const std::size_t n : sizes) {
            const Held held = studies.held(n);
            fmt::print(" {:.1f} ({:.1f}, {:.1f}) |", held.percent(held.held), held.percent(held.above),
                       held.percent(held.below));
        }
        fmt::print(" {} |\n", text_of(studies.counted));
        std::fflush(stdout);
    }
}

/// What the pilot is for: the means of simulations that choose their own levels and steps, and of those that keep them.
void rare_bias(std::size_t repeats)
{
    fmt::print(
        "\nMeans divided by the probability, with one standard error, for a plane at 1e-05 in ten dimensions, by "
        "the samples of each level ({} studies of 5 repeats at 500, and as many realizations at the others): of the "
        "pilots, which choose levels and steps, and "
        "of the repeats, which keep them; percentage of the repeats that are 0; percentage of the 95 % "
        "intervals that contain the probability, among all studies, and percentage of the studies without an "
        "interval.\n\n",
        10 * repeats);
    fmt::print("{}", markdown_head("samples | pilots | repeats | repeats that are 0 | intervals that hold | none"));
    for (const std::size_t samples : {100U, 200U, 500U, 1000U}) {
        const RareStudies studies(rare_plane(1e-5), samples, 10 * repeats * 500 / samples, 5);
        const Held held = studies.held(5);
        fmt::print("| {} | {} | {} | {:.2f} | {:.1f} | {:.1f} |\n", samples, text_of(studies.pilots),
                   text_of(studies.counted), studies.percent_of_none(), held.percent(held.held),
                   held.percent(held.none));
        std::fflush(stdout);
    }
}

/// A function with known indices and designs of it.
struct IndexTruth {
    std::string name;
    std::vector<double> first, total;
    std::function<DesignValues(std::size_t rows, std::mt19937_64&)> design;
};

std::vector<IndexTruth> functions()
{
    using namespace testing;
    const IshigamiIndices of_ishigami;
    const GFunction g{{0, 1, 4.5, 9, 99, 99}};
    std::vector<double> first, total;
    for (std::size_t k = 0; k < g.a.size(); ++k) {
        first.push_back(g.first(k));
        total.push_back(g.total(k));
    }
    const auto falls = [](bool chaos) {
        return [chaos](std::size_t rows, std::mt19937_64& random) {
            return sobol_design(rows, 3, 4, random, Falls{chaos});
        };
    };
    return {{"Ishigami's function", of_ishigami.first, of_ishigami.total,
             [](std::size_t rows, std::mt19937_64& random) { return sobol_design(rows, 3, 1, random, ishigami); }},
            {"a g-function of six factors", first, total,
             [g](std::size_t rows, std::mt19937_64& random) { return sobol_design(rows, 6, 1, random, g); }},
            {"falls, 4 trials per point", Falls::first(), Falls::total(), falls(false)},
            {"chaotic falls, 4 trials per point", Falls::first(), Falls::total(), falls(true)}};
}

void index_coverage(std::size_t repeats)
{
    constexpr std::size_t resamples = 400;
    fmt::print("\n### Sobol's indices\n\nPercent of {} designs in which the 95 % interval ({} resamples) contains the "
               "index: mean over the factors and the lowest of them; percentage of first indices with an interval "
               "entirely below 0, and without one, because the variance is not distinguishable from 0.\n\n",
               repeats, resamples);
    fmt::print("{}", markdown_head("function | rows | first: mean, lowest | total: mean, lowest | below 0 | none"));
    for (const IndexTruth& truth : functions())
        for (const std::size_t rows : {100, 200, 500, 1000}) {
            const std::size_t n = truth.first.size();
            std::vector<Held> first(n), total(n);
            std::size_t below = 0, none = 0;
            std::mt19937_64 random(7);
            for (std::size_t r = 0; r < repeats; ++r) {
                const SobolIndices found =
                    sobol_indices(truth.design(rows, random), {.resamples = resamples, .seed = 1000 + r});
                for (std::size_t k = 0; k < n; ++k) {
                    const FactorIndices& of = found.of_mean[k];
                    if (std::isnan(of.first.value) || std::isnan(of.total.value)) {
                        ++none;
                        continue;
                    }
                    first[k].add(of.first, truth.first[k]);
                    total[k].add(of.total, truth.total[k]);
                    below += of.first.upper < 0 ? 1 : 0;
                }
            }
            const auto text = [n](const std::vector<Held>& of) {
                double mean = 0, least = 100;
                for (const Held& held : of) {
                    mean += held.percent(held.held) / static_cast<double>(n);
                    least = std::min(least, held.percent(held.held));
                }
                return fmt::format("{:.1f}, {:.1f}", mean, least);
            };
            const double all = static_cast<double>(repeats * n) / 100;
            fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} |\n", rows == 100 ? truth.name : "", rows, text(first),
                       text(total), static_cast<double>(below) / all, static_cast<double>(none) / all);
            std::fflush(stdout);
        }
}

} // namespace
} // namespace stylobate

int main(int argc, char** argv)
{
    CLI::App app("Coverage of the intervals of rare events and of Sobol indices, as Markdown tables");
    std::size_t repeats = 2000;
    app.add_option("--repeats", repeats, "estimates of each kind")->check(CLI::Range(10, 1000000));
    CLI11_PARSE(app, argc, argv);
    stylobate::rare_coverage(repeats);
    stylobate::rare_bias(repeats);
    stylobate::index_coverage(repeats / 2);
    return 0;
}
