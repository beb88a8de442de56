/// Which limit rigid blocks are: collapse probabilities of rigid blocks, over step and restitution, beside those of
/// ever stiffer contacts at two corners, over stiffness and damping. All on the same draws.
///
///   stylobate_rigid_limit [--draws N] [--threads N] [--cell NAME]     tables for docs/rigid_limit.md
///   stylobate_rigid_limit --steps ...                                 of rigid blocks over the step alone

#include "bench/processor.hpp"
#include "ensemble/engine/executor.hpp"
#include "io/tables/markdown.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

using namespace stylobate;

namespace {

/// A structure on a fixed block, under 10 s of a harmonic.
struct Cell {
    std::string name;
    int free_blocks = 6;
    double height_m = 0.029; ///< of a block
    double frequency_hz = 4, pga_m_s2 = 4;
};

struct Law {
    ContactForm form = ContactForm::rigid;
    double stiffness_n_m2 = 0, damping_ratio = 0; ///< of two corners
    double restitution = 0, step_s = 0;           ///< of rigid blocks
    bool fine = false;                            ///< half of the step of a study
};

const std::vector<Cell> cells{{"monolith", 1, 0.174, 3, 3.4},    {"two_blocks", 2, 0.087, 4, 5},
                              {"six_drums_a", 6, 0.029, 4, 4},   {"six_drums_b", 6, 0.029, 4, 5},
                              {"six_drums_c", 6, 0.029, 3, 3.5}, {"six_drums_d", 6, 0.029, 6, 7}};

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
    else if (law.fine)
        s.run.step_fraction /= 2;
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
    perturb(Quantity::drum_width, Per::block, 0.0002);
    perturb(Quantity::drum_height, Per::block, 0.0002);
    perturb(Quantity::drum_offset, Per::block, 0.00024);
    perturb(Quantity::tilt, Per::structure, 0.0017453);
    Perturbation phase;
    phase.quantity = Quantity::phase;
    phase.per = Per::structure;
    phase.distribution = DistributionKind::uniform;
    phase.from = 0;
    phase.to = 2 * 3.14159265358979;
    s.perturbations.push_back(phase);
    return s;
}

std::string text_of(const Law& law)
{
    if (law.form == ContactForm::rigid)
        return fmt::format("rigid, e = {:g} | 1/{:.0f}", law.restitution, 1 / law.step_s);
    return fmt::format("two_corner, damping ratio {:g}{} | K_N {:.0e}", law.damping_ratio,
                       law.fine ? ", half the step" : "", law.stiffness_n_m2);
}

/// @param steps over the step alone
std::vector<Law> laws(bool steps)
{
    std::vector<Law> all;
    if (steps) {
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
    all.push_back({ContactForm::two_corner, 1e9, 0.5, 0, 0, true});
    return all;
}

struct Answer {
    double probability = 0, error = 0; ///< and its standard error
    double seconds = 0;
};

Answer run(const Study& study, int threads)
{
    std::uint64_t fallen = 0, valid = 0;
    RunPlan plan;
    plan.total = study.realizations;
    plan.sink = [&](const Realization&, const Outcome& o) {
        fallen += o.state == State::collapsed;
        valid += o.state != State::invalid;
    };
    Observer quiet;
    const auto begin = std::chrono::steady_clock::now();
    run_ensemble(Experiment(study), {best_isa(), threads}, plan, quiet);
    const double p = static_cast<double>(fallen) / static_cast<double>(valid);
    return {p, std::sqrt(p * (1 - p) / static_cast<double>(valid)),
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Collapse probabilities of rigid blocks beside those of stiff contacts");
    std::uint64_t draws = 512;
    int threads = 1;
    std::string only;
    bool steps = false;
    app.add_flag("--steps", steps, "rigid blocks over the step alone");
    app.add_option("--draws", draws, "realizations of each")->check(CLI::Range(8, 1000000));
    app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 1024));
    app.add_option("--cell", only, "one structure and shaking alone");
    CLI11_PARSE(app, argc, argv);
    std::string head = "contacts | step [s], K_N [N/m2]";
    std::vector<Cell> chosen;
    for (const Cell& cell : cells)
        if (only.empty() || cell.name == only) {
            chosen.push_back(cell);
            head += fmt::format(" | {}, {:g} Hz, {:g} m/s2", cell.name, cell.frequency_hz, cell.pga_m_s2);
        }
    fmt::print("{} draws each, {}\n\n{}", draws, processor(), markdown_head(head + " | seconds"));
    for (const Law& law : laws(steps)) {
        std::string row = text_of(law);
        double seconds = 0;
        for (const Cell& cell : chosen) {
            const Answer a = run(study_of(cell, law, draws), threads);
            row += fmt::format(" | {:.3f} ± {:.3f}", a.probability, a.error);
            seconds += a.seconds;
        }
        fmt::print("{}", markdown_row("{} | {:.0f}", row, seconds));
        std::fflush(stdout);
    }
}
