/// Which limit rigid blocks are: collapse probabilities of rigid blocks, over step and restitution, beside those of
/// ever stiffer contacts at two corners, over stiffness and damping. All on the same draws.
///
///   stylobate_rigid_limit [--draws N] [--threads N] [--cell NAME]     tables for docs/rigid_limit.md
///   stylobate_rigid_limit --steps ...                                 of rigid blocks over the step alone, and the
///                                                                     paired differences from the finest step
///   stylobate_rigid_limit --stiff ...                                 of much stiffer contacts, far slower
///   stylobate_rigid_limit --cost ...                                  realizations per second of processor time

#include "bench/processor.hpp"
#include "ensemble/engine/executor.hpp"
#include "io/tables/markdown.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

/// A structure on a fixed block, under 10 s of a harmonic.
struct Cell {
    std::string name;
    int free_blocks = 6;
    double height_m = 0.029; ///< of a block
    double frequency_hz = 4, pga_m_s2 = 4;
    bool alike = false; ///< the realizations differ by their friction and by drums offset by 1e-6 m alone
};

struct Law {
    ContactForm form = ContactForm::rigid;
    double stiffness_n_m2 = 0, damping_ratio = 0; ///< of two corners
    double restitution = 0, step_s = 0;           ///< of rigid blocks
};

const std::vector<Cell> cells{{"monolith", 1, 0.174, 3, 3.4},    {"two_blocks", 2, 0.087, 4, 5},
                              {"six_drums_a", 6, 0.029, 4, 4},   {"six_drums_b", 6, 0.029, 4, 5},
                              {"six_drums_c", 6, 0.029, 3, 3.5}, {"six_drums_d", 6, 0.029, 6, 7}};
const Cell alike{"six_drums_alike", 6, 0.029, 4, 5, true};
const Cell standing{"six_drums_standing", 6, 0.029, 5, 2.15, true};

/// Blocks 48 mm wide, of the specimen's stone; sizes, places, friction, level and phase as they vary in its studies.
Study study_of(const Cell& cell, const Law& law, std::uint64_t draws)
{
    constexpr double width_m = 0.048, density = 0.1355 / (0.048 * 0.048 * 0.029);
    Study s;
    s.kind = StudyKind::single;
    s.realizations = draws;
    s.structure = equal_column(cell.free_blocks + 1, 1, width_m, cell.height_m, width_m,
                               density * width_m * width_m * cell.height_m);
    s.contact.form = law.form;
    s.contact.friction = 0.68;
    s.contact.restitution = law.restitution;
    s.contact.normal_stiffness_n_m2 = law.stiffness_n_m2;
    s.contact.tangential_stiffness_n_m = law.stiffness_n_m2 * width_m / 3;
    s.contact.normal_damping_ratio = s.contact.tangential_damping_ratio = law.damping_ratio;
    if (law.form == ContactForm::rigid)
        s.run.step_s = law.step_s;
    s.excitation.kind = ExcitationKind::harmonic;
    s.excitation.frequency_hz = cell.frequency_hz;
    s.excitation.pga_m_s2 = cell.pga_m_s2;
    s.excitation.cycles = 10 * cell.frequency_hz;
    s.excitation.tail_s = 1;
    const auto perturb = [&s](Quantity quantity, Per per, double sd) {
        Perturbation p;
        p.quantity = quantity;
        p.per = per;
        p.sd = sd;
        s.perturbations.push_back(p);
    };
    perturb(Quantity::friction, Per::joint, 0.068);
    if (cell.alike) {
        perturb(Quantity::drum_offset, Per::block, 1e-6);
        return s;
    }

    perturb(Quantity::drum_width, Per::block, 0.0002);
    perturb(Quantity::drum_height, Per::block, 0.0002);
    perturb(Quantity::drum_offset, Per::block, 0.00024);
    perturb(Quantity::tilt, Per::structure, 0.0017453);
    Perturbation phase;
    phase.quantity = Quantity::phase;
    phase.per = Per::structure;
    phase.distribution = DistributionKind::uniform;
    phase.from = 0;
    phase.to = 2 * std::numbers::pi;
    s.perturbations.push_back(phase);
    return s;
}

std::string text_of(const Law& law)
{
    if (law.form == ContactForm::rigid)
        return fmt::format("rigid, e = {:g} | 1/{:.0f}", law.restitution, 1 / law.step_s);
    return fmt::format("two_corner, damping ratio {:g} | K_N {:.0e}", law.damping_ratio, law.stiffness_n_m2);
}

enum class Table { limit, steps, stiff, cost };

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
        for (const double rate : {120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0, 7680.0, 15360.0})
            all.push_back({.step_s = 1 / rate});
        return all;
    }
    if (table == Table::stiff) {
        for (const double K_n : {1e10, 1e11})
            for (const double xi : {1.0, 4.0})
                all.push_back({ContactForm::two_corner, K_n, xi});
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
    std::vector<signed char> fallen; ///< (draws) 1, 0, or -1: invalid
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
    double fallen = 0, valid = 0;
    for (const signed char one : answer.fallen) {
        fallen += one > 0;
        valid += one >= 0;
    }
    const double p = fallen / valid;
    const auto invalid = static_cast<double>(answer.fallen.size()) - valid;
    return fmt::format("{:.4f} ± {:.4f}{}", p, std::sqrt(p * (1 - p) / valid),
                       invalid > 0 ? fmt::format(" ({:.0f} invalid)", invalid) : "");
}

/// How much larger the share of `a` is than that of `b`, of the same draws, and its standard error by the pairs.
std::string difference(const Answer& a, const Answer& b)
{
    double sum = 0, apart = 0, valid = 0;
    for (std::size_t i = 0; i < a.fallen.size(); ++i)
        if (a.fallen[i] >= 0 && b.fallen[i] >= 0) {
            sum += a.fallen[i] - b.fallen[i];
            apart += a.fallen[i] != b.fallen[i];
            ++valid;
        }
    return fmt::format("{:+.4f} ± {:.4f}", sum / valid, std::sqrt(apart - sum * sum / valid) / valid);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Collapse probabilities of rigid blocks beside those of stiff contacts");
    std::uint64_t draws = 512;
    int threads = 1;
    std::string only;
    std::optional<double> stiffness, damping;
    bool steps = false, stiff = false, cost = false;
    app.add_flag("--steps", steps, "rigid blocks over the step alone");
    app.add_flag("--stiff", stiff, "two corners of much higher stiffness alone")->excludes("--steps");
    app.add_flag("--cost", cost, "realizations per second of processor time")->excludes("--steps")->excludes("--stiff");
    app.add_option("--draws", draws, "realizations of each")->check(CLI::Range(8, 1000000));
    app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--cell", only, "one structure and shaking alone");
    app.add_option("--stiffness", stiffness, "rows of one K_N alone [N/m2]");
    app.add_option("--damping-ratio", damping, "rows of one damping ratio alone");
    CLI11_PARSE(app, argc, argv);
    const Table table = cost ? Table::cost : steps ? Table::steps : stiff ? Table::stiff : Table::limit;
    std::vector<Cell> all = cells;
    if (steps)
        all.push_back(alike);
    if (cost)
        all = {standing, alike};
    std::string head = "contacts | step [s], K_N [N/m2]";
    std::vector<Cell> chosen;
    for (const Cell& cell : all)
        if (only.empty() || cell.name == only) {
            chosen.push_back(cell);
            head += fmt::format(" | {}, {:g} Hz, {:g} m/s2", cell.name, cell.frequency_hz, cell.pga_m_s2);
        }
    fmt::print("{} draws each, {}\n\n{}", draws, processor(), markdown_head(head));
    std::vector<std::vector<Answer>> answers; // (laws) of the cells
    for (const Law& law : laws(table)) {
        if (law.stiffness_n_m2 != stiffness.value_or(law.stiffness_n_m2) ||
            law.damping_ratio != damping.value_or(law.damping_ratio))
            continue;
        std::string row = text_of(law);
        answers.emplace_back();
        for (const Cell& cell : chosen) {
            answers.back().push_back(run(study_of(cell, law, draws), threads));
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
        std::string row = text_of(laws(table)[i]);
        for (std::size_t k = 0; k < chosen.size(); ++k)
            row += " | " + difference(answers[i][k], answers.back()[k]);
        fmt::print("{}", markdown_row("{}", row));
    }
}
