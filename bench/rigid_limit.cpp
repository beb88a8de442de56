/// Which limit rigid blocks are: collapse probabilities of rigid blocks, over step and restitution, beside those of
/// ever stiffer contacts at two corners, over stiffness and damping. All on the same draws.
///
///   stylobate_rigid_limit [--draws N] [--threads N] [--cell NAME]     tables for docs/rigid_limit.md
///   stylobate_rigid_limit --steps ...                                 of rigid blocks over the step alone, and the
///                                                                     paired differences from the finest step
///   stylobate_rigid_limit --stiff ...                                 of much stiffer contacts, far slower
///   stylobate_rigid_limit --cost ...                                  realizations per second of processor time
///   stylobate_rigid_limit --agreement PAGE                            what the first table of the page shows, for
///                                                                     scripts/tables.sh rigid_limit

#include "bench/mean.hpp"
#include "bench/rigid_agreement.hpp"
#include "bench/rocking_cells.hpp"
#include "ensemble/run/executor.hpp"
#include "io/tables/table.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

std::string text_of(const Law& law)
{
    if (law.form == ContactForm::rigid)
        return fmt::format("rigid, e = {:g}{} | 1/{:.0f}", law.restitution,
                           law.restitution_law == RestitutionLaw::poisson ? ", Poisson" : "", 1 / law.step_s);
    return fmt::format("two_corner, damping ratio {:g} | K_N {:.0e}", law.damping_ratio, law.stiffness_n_m2);
}

enum class Shown { limit, steps, stiff, cost };

std::vector<Law> laws(Shown shown)
{
    std::vector<Law> all;
    if (shown == Shown::cost) {
        for (const double rate : {240.0, 480.0, 960.0})
            all.push_back({.step_s = 1 / rate});
        all.push_back({ContactForm::two_corner, 1e8, 0.1});
        all.push_back({ContactForm::two_corner, 1e9, 0.5});
        return all;
    }
    if (shown == Shown::steps) {
        for (const double rate : {120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0, 7680.0, 15360.0})
            all.push_back({.step_s = 1 / rate});
        return all;
    }
    if (shown == Shown::stiff) {
        for (const double K_n : {1e10, 1e11})
            for (const double xi : {1.0, 4.0})
                all.push_back({ContactForm::two_corner, K_n, xi});
        return all;
    }
    for (const double e : {0.0, 0.1, 0.3})
        for (const double rate : {480.0, 960.0, 1920.0, 3840.0})
            all.push_back({.restitution = e, .step_s = 1 / rate});
    for (const double e : {0.1, 0.3})
        for (const double rate : {960.0, 1920.0, 3840.0})
            all.push_back({.restitution = e, .step_s = 1 / rate, .restitution_law = RestitutionLaw::poisson});
    for (const double K_n : {1e8, 1e9})
        for (const double xi : {0.05, 0.1, 0.3, 0.5, 1.0})
            all.push_back({ContactForm::two_corner, K_n, xi});
    for (const double xi : {2.0, 4.0, 8.0, 16.0})
        all.push_back({ContactForm::two_corner, 1e8, xi});
    all.push_back({ContactForm::two_corner, 1e10, 0.5});
    return all;
}

struct Answer {
    Fallen fallen;   ///< (draws)
    double rate = 0; ///< realizations of 10 s per second of processor time; one that falls counts by its time
};

Answer run(const Study& study, int threads)
{
    Answer out;
    out.fallen.resize(study.realizations);
    double simulated_s = 0;
    RunPlan plan;
    plan.total = study.realizations;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        out.fallen[r.index] = o.state == State::invalid ? -1 : o.state == State::collapsed;
        simulated_s += o.end_time_s;
    };
    Observer quiet;
    const std::clock_t begin = std::clock();
    run_ensemble(Experiment(study), {best_isa(), threads}, plan, quiet);
    out.rate = simulated_s / 10 / (static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    return out;
}

/// The share of the valid ones that fell, and its standard error.
std::string probability(const Answer& answer)
{
    const Mean share = share_of(answer.fallen);
    const double invalid = static_cast<double>(answer.fallen.size()) - share.count;
    return fmt::format("{:.4f} ± {:.4f}{}", share.value(), share.error(),
                       invalid > 0 ? fmt::format(" ({:.0f} invalid)", invalid) : "");
}

/// How much larger the share of `a` is than that of `b`, of the same draws, and its standard error by the pairs.
std::string difference(const Answer& a, const Answer& b)
{
    const Mean d = paired_difference(a.fallen, b.fallen);
    return fmt::format("{:+.4f} ± {:.4f}", d.value(), d.error());
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Collapse probabilities of rigid blocks beside those of stiff contacts");
    std::uint64_t draws = 512;
    int threads = 1;
    std::string only;
    std::optional<double> rate, stiffness, damping;
    std::string page;
    bool steps = false, stiff = false, cost = false;
    app.add_flag("--steps", steps, "rigid blocks over the step alone");
    app.add_flag("--stiff", stiff, "two corners of much higher stiffness alone")->excludes("--steps");
    app.add_flag("--cost", cost, "realizations per second of processor time")->excludes("--steps")->excludes("--stiff");
    app.add_option("--agreement", page, "what the first table of this page shows, nothing is run")
        ->check(CLI::ExistingFile);
    app.add_option("--draws", draws, "realizations of each")->check(CLI::Range(8, 1000000));
    app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--cell", only, "one structure and shaking alone");
    app.add_option("--rate", rate, "rows of one step of rigid blocks alone [1/s]");
    app.add_option("--stiffness", stiffness, "rows of one K_N alone [N/m2]");
    app.add_option("--damping-ratio", damping, "rows of one damping ratio alone");
    CLI11_PARSE(app, argc, argv);
    if (!page.empty()) {
        std::ifstream file(page);
        fmt::print("{}", agreement_text({std::istreambuf_iterator<char>(file), {}}));
        return 0;
    }
    const Shown shown = cost ? Shown::cost : steps ? Shown::steps : stiff ? Shown::stiff : Shown::limit;
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
    std::vector<std::vector<Answer>> answers; // (laws) of the cells
    for (const Law& law : laws(shown)) {
        if (law.stiffness_n_m2 != stiffness.value_or(law.stiffness_n_m2) ||
            law.damping_ratio != damping.value_or(law.damping_ratio) ||
            (rate && std::fabs(law.step_s * *rate - 1) > 1e-9))
            continue;
        std::string row = text_of(law);
        answers.emplace_back();
        for (const Cell& cell : chosen) {
            answers.back().push_back(run(cell_study(cell, law, draws), threads));
            const Answer& a = answers.back().back();
            row += " | " + (cost ? fmt::format("{:.0f}", a.rate) : probability(a));
        }
        fmt::print("{}", markdown_row("{}", row));
        std::fflush(stdout);
    }
    if (!steps)
        return 0;
    fmt::print("\nLess the finest step\n\n{}", markdown_head(head));
    for (std::size_t i = 0; i + 1 < answers.size(); ++i) {
        std::string row = text_of(laws(shown)[i]);
        for (std::size_t k = 0; k < chosen.size(); ++k)
            row += " | " + difference(answers[i][k], answers.back()[k]);
        fmt::print("{}", markdown_row("{}", row));
    }
}
