/// What adaptive surfaces gain, and how often their intervals hold the truth, as Markdown tables on standard output.
///
///   stylobate_adaptive --reference REF.h5 [--run ADAPTIVE.h5 ...] [--sobol SURFACE.h5 ...] [--repeats N]
///
/// The reference is a uniform surface with many realizations. Its shares are taken as the truth of one of the known
/// surfaces. Of intervals by own trials the coverage is computed exactly; of pooled ones runs are simulated by drawing
/// collapses (no mechanics: seconds for a run).
/// Adaptive runs of the study itself, with seeds of their own, are then held against it. `scripts/adaptive.sh` makes
/// all files.

#include "ensemble/estimators/surface/adaptive.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
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
    double deviation = 0;    ///< of one run; NaN: not computed
    double held = 0, held_between = 0;
    double held_tenth = 0;                    ///< of the tenth of the cells with the lowest coverage
    double worst = std::nan(""), worst_p = 0; ///< of the worst cell; NaN: not measured
    std::vector<Kind> kinds = {{"0 to 0.002", -1, 0.002},  {"0.002 to 0.02", 0.002, 0.02}, {"0.02 to 0.05", 0.02, 0.05},
                               {"0.05 to 0.1", 0.05, 0.1}, {"0.1 to 0.25", 0.1, 0.25},     {"0.25 to 0.5", 0.25, 0.51}};
};

/// Whether a cell is neither on a plateau nor a cliff.
bool between(double p)
{
    return p > 0.05 && p < 0.95;
}

/// Cells in the order of their coverage.
std::vector<std::size_t> by_coverage(const std::vector<double>& coverage)
{
    std::vector<std::size_t> cells(coverage.size());
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    std::sort(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) { return coverage[a] < coverage[b]; });
    return cells;
}

/// Mean coverage of the first tenth of some cells.
double tenth(const std::vector<std::size_t>& cells, const std::vector<double>& coverage)
{
    const std::size_t n = (cells.size() + 9) / 10;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        sum += coverage[cells[i]];
    return sum / static_cast<double>(n);
}

/// Means over the cells.
void add_means(Measured& m, const Known& truth, const std::vector<double>& coverage)
{
    double n = 0;
    for (std::size_t cell = 0; cell < coverage.size(); ++cell) {
        m.held += coverage[cell] / static_cast<double>(coverage.size());
        if (between(truth.p[cell])) {
            m.held_between += coverage[cell];
            ++n;
        }
    }
    m.held_between = n > 0 ? m.held_between / n : std::nan("");
}

/// Of own trials, by the sum over all paths of each cell (`InterimAnalyses::expected`): the cells do not depend on each
/// other while the budget lasts.
Measured exactly(const Known& truth, std::uint64_t minimum)
{
    const InterimAnalyses analyses(minimum, most, half_width, adaptive_level);
    Measured m;
    m.deviation = std::nan("");
    std::vector<double> coverage;
    for (const double p : truth.p) {
        // with p = 0 or 1 there is one path, of which the interval holds the end
        const double inside = std::clamp(p, 1e-12, 1 - 1e-12);
        const InterimAnalyses::Expected e = analyses.expected(inside, analyses.trials().size());
        coverage.push_back(e.coverage);
        m.realizations += e.trials;
    }
    add_means(m, truth, coverage);
    const std::vector<std::size_t> cells = by_coverage(coverage);
    m.held_tenth = tenth(cells, coverage);
    m.worst = coverage[cells.front()];
    m.worst_p = truth.p[cells.front()];
    return m;
}

/// Of pooled intervals, whose cells depend on each other, by simulated runs. The cells of the lowest tenth are chosen
/// by half of the runs, and their coverage is that of the other half: the lowest of many estimates is too low.
Measured measure(const Known& truth, std::uint64_t minimum, int repeats)
{
    const std::size_t cells = truth.p.size();
    Measured m;
    std::vector<double> held(cells, 0), choosing(cells, 0), counts;
    for (int i = 0; i < repeats; ++i) {
        std::mt19937_64 engine(static_cast<std::uint64_t>(i) + 1);
        AdaptiveAllocation allocation({most * cells, minimum, half_width, true}, truth.rows, truth.columns, most);
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
            held[cell] += in / static_cast<double>(repeats);
            choosing[cell] += i < repeats / 2 && in ? 1.0 / (repeats / 2) : 0;
            for (Kind& kind : m.kinds)
                if (const double q = std::min(p, 1 - p); q > kind.from && q <= kind.to) {
                    ++kind.cells;
                    kind.held += in;
                    kind.trials += static_cast<double>(data.trials[cell]);
                }
        }
    }
    add_means(m, truth, held);
    std::vector<double> counted;
    const double chosen_by = repeats / 2, counted_in = repeats - repeats / 2;
    for (std::size_t cell = 0; cell < cells; ++cell)
        counted.push_back((held[cell] * repeats - choosing[cell] * chosen_by) / counted_in);
    m.held_tenth = tenth(by_coverage(choosing), counted);
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
    fmt::print("| {} | {} | {:.0f}{} | {:.1f} | {} | {} | {} | {} |\n", truth.name, how, m.realizations,
               std::isnan(m.deviation) ? "" : fmt::format(" ± {:.0f}", m.deviation),
               uniform_realizations(truth.p.size()) / m.realizations, share(m.held), share(m.held_between),
               share(m.held_tenth), std::isnan(m.worst) ? "" : fmt::format("{:.3f} (p = {:.3f})", m.worst, m.worst_p));
}

/// The coverage of one cell's own trials as a function of p, exactly.
void print_one_cell()
{
    fmt::print("\nOne cell by its own trials, exactly: coverage and mean number of realizations; the mean over p, and "
               "the lowest on a grid of 0.0005.\n\n");
    constexpr std::array<double, 6> shown = {0.001, 0.01, 0.05, 0.1, 0.2, 0.5};
    std::string head = "half width, minimum | mean | lowest";
    for (const double p : shown)
        head += fmt::format(" | p = {}", p);
    fmt::print("{}", markdown_head(head));
    for (const auto& [half, minimum] : {std::pair{0.05, 8}, {0.05, 16}, {0.05, 28}, {0.02, 8}, {0.1, 8}}) {
        const InterimAnalyses analyses(static_cast<std::uint64_t>(minimum), 100000, half, adaptive_level);
        const auto at = [&](double p) { return analyses.expected(p, analyses.trials().size()); };
        double mean = 0, lowest = 1, lowest_p = 0;
        constexpr int parts = 1000;
        for (int i = 0; i < parts; ++i) {
            const double p = 0.5 * (i + 0.5) / parts, coverage = at(p).coverage;
            mean += coverage / parts;
            if (coverage < lowest) {
                lowest = coverage;
                lowest_p = p;
            }
        }
        fmt::print("| ±{}, {} | {:.3f} | {:.3f} (p = {:.4f}) |", half, minimum, mean, lowest, lowest_p);
        for (const double p : shown)
            fmt::print(" {:.3f}, {:.0f} |", at(p).coverage, at(p).trials);
        fmt::print("\n");
    }
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

    fmt::print("{}",
               markdown_head(
                   "surface | intervals | realizations | times fewer | hold, all cells | hold, 0.05 < p < 0.95 | hold, "
                   "lowest tenth | worst cell"));
    print_known(main, "own trials", exactly(main, 8));
    const Measured borrowed = measure(main, 8, repeats);
    print_known(main, "pooled", borrowed);
    print_known(main, "pooled, minimum 16", measure(main, 16, repeats));
    for (const Known& truth : known_surfaces()) {
        print_known(truth, "own trials", exactly(truth, 8));
        print_known(truth, "pooled", measure(truth, 8, repeats));
        std::fflush(stdout);
    }
    print_one_cell();
    fmt::print("\nSmall-scale column, reference, pooled intervals, by min(p, 1 - p):\n\n");
    fmt::print("{}", markdown_head("min(p, 1 - p) | cells | hold | realizations of a cell"));
    for (const Kind& kind : borrowed.kinds)
        if (kind.cells > 0)
            fmt::print("| {} | {:.0f} | {:.3f} | {:.0f} |\n", kind.name, kind.cells / repeats, kind.held / kind.cells,
                       kind.trials / kind.cells);
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
    int repeats = 40;
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
