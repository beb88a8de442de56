/// What adaptive surfaces gain, and how often their intervals hold the truth, as Markdown tables on standard output.
///
///   stylobate_adaptive --reference REF.h5 [--run ADAPTIVE.h5 ...] [--sobol SURFACE.h5 ...] [--repeats N]
///
/// The reference is a uniform surface with many realizations. Its shares are taken as the truth of one of the known
/// surfaces, over which runs are simulated by drawing collapses (no mechanics: thousands of cells in a second).
/// Adaptive runs of the study itself, with seeds of their own, are then held against it. `scripts/adaptive.sh` makes
/// all files.

#include "ensemble/estimators/surface/adaptive.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/markdown.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace stylobate {
namespace {

constexpr double half_width = 0.05;
constexpr std::uint64_t most = 512;

/// A surface whose probabilities are known.
struct Known {
    std::string name;
    std::size_t rows, columns;
    std::vector<double> p;
};

Known known(const std::string& name, const std::function<double(double, double)>& logit)
{
    Known surface{name, 16, 16, {}};
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column)
            surface.p.push_back(1 / (1 + std::exp(-logit(row, column))));
    return surface;
}

std::vector<Known> known_surfaces()
{
    const auto fragility = [](double r, double c) { return 1.2 * (c - 5) - 0.5 * (r - 8); };
    std::vector<Known> all;
    all.push_back(known("smooth, as a fragility surface", fragility));
    all.push_back(known("smooth, intermediate everywhere",
                        [](double r, double c) { return 0.5 * (c - 7.5) - 0.35 * (r - 7.5); }));
    all.push_back(known("cliff: 0.001 and 0.999", [](double r, double c) {
        return c - 7.5 > 0.6 * (r - 7.5) + 1.5 * std::sin(r / 2) ? 6.9 : -6.9;
    }));
    all.push_back(known("island of 9 cells, p = 0.5", [&](double r, double c) {
        const bool inside = r >= 3 && r <= 5 && c >= 11 && c <= 13;
        return inside ? std::min(0.0, fragility(r, c)) : fragility(r, c);
    }));
    std::mt19937_64 engine(1);
    std::normal_distribution<double> departure(0, 0.7);
    all.push_back(known("rough: each cell off by 0.7 (logit)",
                        [&](double r, double c) { return 0.8 * (c - 7.5) - 0.5 * (r - 7.5) + departure(engine); }));
    // single cells that differ from all their neighbours: the worst kind
    Known odd = known("isolated cells", [](double, double c) { return c < 5 ? -6.9 : 6.9; });
    for (const auto& [cell, p] : {std::pair(2 * 16 + 11, 0.95), {7 * 16 + 11, 0.9}, {12 * 16 + 11, 0.7}})
        odd.p[static_cast<std::size_t>(cell)] = p;
    all.push_back(odd);
    return all;
}

struct Kind {
    const char* name;
    double from, to; ///< of min(p, 1 - p)
    double cells = 0, held = 0, trials = 0;
};

struct Measured {
    double realizations = 0; ///< mean
    double deviation = 0;    ///< of one run
    double held = 0, held_between = 0;
    double worst = 1, worst_p = 0;
    std::vector<Kind> kinds = {{"0 to 0.002", -1, 0.002},  {"0.002 to 0.02", 0.002, 0.02}, {"0.02 to 0.05", 0.02, 0.05},
                               {"0.05 to 0.1", 0.05, 0.1}, {"0.1 to 0.25", 0.1, 0.25},     {"0.25 to 0.5", 0.25, 0.51}};
};

Measured measure(const Known& truth, bool borrow, std::uint64_t minimum, int repeats)
{
    const std::size_t cells = truth.p.size();
    Measured m;
    std::vector<double> held(cells, 0), counts;
    for (int i = 0; i < repeats; ++i) {
        std::mt19937_64 engine(static_cast<std::uint64_t>(i) + 1);
        AdaptiveAllocation allocation({most * cells, minimum, half_width, borrow}, truth.rows, truth.columns, most);
        SurfaceTrials data{truth.rows, truth.columns, std::vector<std::uint64_t>(cells, 0),
                           std::vector<std::uint64_t>(cells, 0)};
        while (true) {
            const std::vector<std::uint64_t> before = allocation.asked();
            const std::vector<std::uint64_t>& asked = allocation.next(data);
            if (asked == before)
                break;
            for (std::size_t cell = 0; cell < cells; ++cell) {
                std::binomial_distribution<std::uint64_t> collapses(asked[cell] - before[cell], truth.p[cell]);
                data.collapses[cell] += asked[cell] > before[cell] ? collapses(engine) : 0;
                data.trials[cell] = asked[cell];
            }
        }
        const std::vector<CellEstimate> estimates = allocation.estimate(data);
        counts.push_back(
            static_cast<double>(std::accumulate(data.trials.begin(), data.trials.end(), std::uint64_t{0})));
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const double p = truth.p[cell];
            const bool in = estimates[cell].interval.lower <= p && p <= estimates[cell].interval.upper;
            held[cell] += in;
            for (Kind& kind : m.kinds)
                if (const double q = std::min(p, 1 - p); q > kind.from && q <= kind.to) {
                    ++kind.cells;
                    kind.held += in;
                    kind.trials += static_cast<double>(data.trials[cell]);
                }
        }
    }
    double between = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double share = held[cell] / repeats;
        m.held += share / static_cast<double>(cells);
        if (truth.p[cell] > 0.05 && truth.p[cell] < 0.95) {
            m.held_between += share;
            ++between;
        }
        if (share < m.worst) {
            m.worst = share;
            m.worst_p = truth.p[cell];
        }
    }
    m.held_between = between > 0 ? m.held_between / between : std::nan("");
    for (const double count : counts)
        m.realizations += count / repeats;
    for (const double count : counts)
        m.deviation += (count - m.realizations) * (count - m.realizations) / std::max(1, repeats - 1);
    m.deviation = std::sqrt(m.deviation);
    return m;
}

/// Of all cells, each with what a probability of 1/2 needs.
double uniform_realizations(std::size_t cells)
{
    return static_cast<double>(cells * uniform_trials(half_width, adaptive_level));
}

std::string share(double value)
{
    return std::isnan(value) ? "none" : fmt::format("{:.3f}", value);
}

void print_known(const Known& truth, const std::string& how, const Measured& m)
{
    fmt::print("| {} | {} | {:.0f} ± {:.0f} | {:.1f} | {} | {} | {:.2f} (p = {:.3f}) |\n", truth.name, how,
               m.realizations, m.deviation, uniform_realizations(truth.p.size()) / m.realizations, share(m.held),
               share(m.held_between), m.worst, m.worst_p);
}

SurfaceTable table_of(const std::string& file, const SurfaceTable* like)
{
    const ResultReader reader(file);
    SurfaceTable table = reader.surface();
    if (table.trials.empty())
        throw InputError(file + ": contains no finished surface");
    if (like && (table.frequency_hz != like->frequency_hz || table.pga_m_s2 != like->pga_m_s2))
        throw InputError(file + ": its surface has other axes than the reference");
    return table;
}

double count(const std::vector<std::uint64_t>& values)
{
    return static_cast<double>(std::accumulate(values.begin(), values.end(), std::uint64_t{0}));
}

/// An adaptive run of the study against the reference.
void print_run(const std::string& file, const SurfaceTable& reference)
{
    const SurfaceTable run = table_of(file, &reference);
    double held = 0, expected = 0, widest = 0;
    for (std::size_t cell = 0; cell < run.trials.size(); ++cell) {
        const double p = reference.probability[cell];
        held += run.lower[cell] <= p && p <= run.upper[cell];
        // the reference has an error of its own: by the normal distribution, if the run's interval is right
        const double half = (run.upper[cell] - run.lower[cell]) / 2;
        const double n = static_cast<double>(reference.trials[cell]);
        const double sd = half / 1.96;
        const double both = std::sqrt(sd * sd + p * (1 - p) / n);
        expected += std::erf(half / both / std::sqrt(2.0));
        widest = std::max(widest, half);
    }
    const double all = count(run.trials);
    fmt::print("| {} | {:.0f} | {:.1f} | {} | {:.4f} | {:.0f} | {:.1f} |\n", ResultReader(file).header().seed, all,
               uniform_realizations(run.trials.size()) / all, run.rounds, widest, held, expected);
}

/// How much the shares of the cells vary about the reference, in parts of the binomial variance.
void print_variance(const std::vector<std::string>& files, const SurfaceTable& reference)
{
    double sum = 0, squares = 0, terms = 0, trials = 0;
    for (const std::string& file : files) {
        const SurfaceTable surface = table_of(file, &reference);
        for (std::size_t cell = 0; cell < surface.trials.size(); ++cell) {
            const double p = reference.probability[cell];
            if (p < 0.05 || p > 0.95)
                continue;
            const double n = static_cast<double>(surface.trials[cell]);
            const double m = static_cast<double>(reference.trials[cell]);
            const double apart = static_cast<double>(surface.collapses[cell]) / n - p;
            // in expectation n / m of the binomial variance is the reference's
            const double ratio = (apart * apart - p * (1 - p) / m) / (p * (1 - p) / n);
            sum += ratio;
            squares += ratio * ratio;
            trials += n;
            ++terms;
        }
    }
    const double mean = sum / terms;
    const double error = std::sqrt((squares / terms - mean * mean) / terms);
    fmt::print(
        "{} surfaces of {:.0f} scrambled Sobol points in each cell: the shares of the {:.0f} cells with 0.05 < p < "
        "0.95 vary by {:.2f} ± {:.2f} of the binomial variance.\n\n",
        files.size(), trials / terms, terms, mean, error);
}

int report(const std::string& file, const std::vector<std::string>& runs, const std::vector<std::string>& sobol,
           int repeats)
{
    const SurfaceTable reference = table_of(file, nullptr);
    Known main{"small-scale column, reference", reference.frequency_hz.size(), reference.pga_m_s2.size(),
               reference.probability};

    fmt::print("Reference: {:.0f} realizations in {} × {} cells, {:.3f} of which collapse. A uniform grid needs {:.0f} "
               "realizations for ±{} in every cell.\n\n",
               count(reference.trials), main.rows, main.columns, count(reference.collapses) / count(reference.trials),
               uniform_realizations(main.p.size()), half_width);

    fmt::print(
        "{}",
        markdown_head(
            "surface | intervals | realizations | times fewer | hold, all cells | hold, 0.05 < p < 0.95 | worst cell"));
    print_known(main, "own trials", measure(main, false, 8, 4 * repeats));
    const Measured borrowed = measure(main, true, 8, 2 * repeats);
    print_known(main, "pooled", borrowed);
    print_known(main, "pooled, minimum 16", measure(main, true, 16, repeats));
    for (const Known& truth : known_surfaces()) {
        print_known(truth, "own trials", measure(truth, false, 8, repeats));
        print_known(truth, "pooled", measure(truth, true, 8, repeats));
    }
    fmt::print("\nSmall-scale column, reference, pooled intervals, by min(p, 1 - p):\n\n");
    fmt::print("{}", markdown_head("min(p, 1 - p) | cells | hold | realizations of a cell"));
    for (const Kind& kind : borrowed.kinds)
        if (kind.cells > 0)
            fmt::print("| {} | {:.0f} | {:.3f} | {:.0f} |\n", kind.name, kind.cells / (2 * repeats),
                       kind.held / kind.cells, kind.trials / kind.cells);
    if (!runs.empty()) {
        fmt::print("\nAdaptive runs of the study:\n\n");
        fmt::print("{}", markdown_head("seed | realizations | times fewer | rounds | widest ± | cells whose interval "
                                       "contains the reference's share | exact 95 % intervals would, given its error"));
        for (const std::string& run : runs)
            print_run(run, reference);
    }
    fmt::print("\n");
    if (!sobol.empty())
        print_variance(sobol, reference);
    return 0;
}

} // namespace
} // namespace stylobate

int main(int argc, char** argv)
{
    std::string reference;
    std::vector<std::string> runs, sobol;
    int repeats = 20;
    CLI::App app("Gain of adaptive surfaces, and coverage of their intervals");
    app.add_option("--reference", reference, "a uniform surface with many realizations")->required();
    app.add_option("--run", runs, "adaptive runs of the same study");
    app.add_option("--sobol", sobol, "uniform surfaces of scrambled Sobol points");
    app.add_option("--repeats", repeats, "simulated runs of each known surface")->check(CLI::Range(2, 10000));
    CLI11_PARSE(app, argc, argv);
    try {
        return stylobate::report(reference, runs, sobol, repeats);
    } catch (const stylobate::InputError& error) {
        fmt::print(stderr, "stylobate_adaptive: {}\n", error.what());
        return 2;
    }
}
