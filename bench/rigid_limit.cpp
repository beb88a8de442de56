/// Which limit rigid blocks are: collapse probabilities of rigid blocks, over step and restitution, beside those of
/// ever stiffer contacts at two corners, over stiffness and damping. All on the same draws.
///
///   stylobate_rigid_limit [--draws N] [--threads N] [--cell NAME]     tables for docs/rigid_limit.md
///   stylobate_rigid_limit --steps ...                                 of rigid blocks over the step alone
///   stylobate_rigid_limit --cost ...                                  realizations per second of processor time

#include "bench/processor.hpp"
#include "bench/rocking_cells.hpp"
#include "ensemble/engine/executor.hpp"
#include "io/tables/markdown.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <ctime>

using namespace stylobate;

namespace {

std::string text_of(const Law& law)
{
    if (law.form == ContactForm::rigid)
        return fmt::format("rigid, e = {:g} | 1/{:.0f}", law.restitution, 1 / law.step_s);
    return fmt::format("two_corner, damping ratio {:g} | K_N {:.0e}", law.damping_ratio, law.stiffness_n_m2);
}

enum class Table { limit, steps, cost };

std::vector<Law> laws(Table table)
{
    std::vector<Law> all;
    if (table == Table::cost) {
        for (const double rate : {240.0, 480.0, 960.0})
            all.push_back({.step_s = 1 / rate});
        all.push_back({ContactForm::two_corner, 1e8, 0.1});
        all.push_back({ContactForm::two_corner, 1e9, 0.5});
        return all;
    }
    if (table == Table::steps) {
        for (const double rate : {120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0})
            all.push_back({.step_s = 1 / rate});
        return all;
    }
    for (const double e : {0.0, 0.1, 0.3})
        for (const double rate : {480.0, 960.0, 1920.0, 3840.0})
            all.push_back({.restitution = e, .step_s = 1 / rate});
    for (const double K_n : {1e8, 1e9})
        for (const double xi : {0.05, 0.1, 0.3, 0.5, 1.0})
            all.push_back({ContactForm::two_corner, K_n, xi});
    for (const double xi : {2.0, 4.0})
        all.push_back({ContactForm::two_corner, 1e8, xi});
    all.push_back({ContactForm::two_corner, 1e10, 0.5});
    return all;
}

struct Answer {
    double probability = 0, error = 0; ///< and its standard error
    double rate = 0; ///< realizations of 10 s per second of processor time; one that falls counts by its time
};

Answer run(const Study& study, int threads)
{
    std::uint64_t fallen = 0, valid = 0;
    double simulated_s = 0;
    RunPlan plan;
    plan.total = study.realizations;
    plan.sink = [&](const Realization&, const Outcome& o) {
        fallen += o.state == State::collapsed;
        valid += o.state != State::invalid;
        simulated_s += o.end_time_s;
    };
    Observer quiet;
    const std::clock_t begin = std::clock();
    run_ensemble(Experiment(study), {best_isa(), threads}, plan, quiet);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const double p = static_cast<double>(fallen) / static_cast<double>(valid);
    return {p, std::sqrt(p * (1 - p) / static_cast<double>(valid)), simulated_s / 10 / seconds};
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Collapse probabilities of rigid blocks beside those of stiff contacts");
    std::uint64_t draws = 512;
    int threads = 1;
    std::string only;
    bool steps = false, cost = false;
    app.add_flag("--steps", steps, "rigid blocks over the step alone");
    app.add_flag("--cost", cost, "realizations per second of processor time")->excludes("--steps");
    app.add_option("--draws", draws, "realizations of each")->check(CLI::Range(8, 1000000));
    app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--cell", only, "one structure and shaking alone");
    CLI11_PARSE(app, argc, argv);
    const Table table = cost ? Table::cost : steps ? Table::steps : Table::limit;
    std::vector<Cell> all = rocking_cells();
    if (steps)
        all.push_back(alike_drums);
    if (cost)
        all = {standing_drums, alike_drums};
    std::string head = "contacts | step [s], K_N [N/m2]";
    std::vector<Cell> chosen;
    for (const Cell& cell : all)
        if (only.empty() || cell.name == only) {
            chosen.push_back(cell);
            head += fmt::format(" | {}, {:g} Hz, {:g} m/s2", cell.name, cell.frequency_hz, cell.pga_m_s2);
        }
    fmt::print("{} draws each, {}\n\n{}", draws, processor(), markdown_head(head));
    for (const Law& law : laws(table)) {
        std::string row = text_of(law);
        for (const Cell& cell : chosen) {
            const Answer a = run(cell_study(cell, law, draws), threads);
            row += cost ? fmt::format(" | {:.0f}", a.rate) : fmt::format(" | {:.3f} ± {:.3f}", a.probability, a.error);
        }
        fmt::print("{}", markdown_row("{}", row));
        std::fflush(stdout);
    }
}
