#pragma once
/// Structures and shakings at which some of the realizations collapse, for programs that compare collapse
/// probabilities: the cells of docs/rigid_limit.md, and the contact laws with which they are run.

#include "ensemble/model/study.hpp"

#include <numbers>
#include <string>
#include <vector>

namespace stylobate {

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
    RestitutionLaw restitution_law = RestitutionLaw::newton;
};

inline std::vector<Cell> rocking_cells()
{
    return {{"monolith", 1, 0.174, 3, 3.4},  {"two_blocks", 2, 0.087, 4, 5},    {"six_drums_a", 6, 0.029, 4, 4},
            {"six_drums_b", 6, 0.029, 4, 5}, {"six_drums_c", 6, 0.029, 3, 3.5}, {"six_drums_d", 6, 0.029, 6, 7}};
}
inline const Cell alike_drums{"six_drums_alike", 6, 0.029, 4, 5, true};
inline const Cell standing_drums{"six_drums_standing", 6, 0.029, 5, 2.15, true};

/// Blocks 48 mm wide, of the specimen's stone; sizes, places, friction, level and phase as they vary in its studies.
inline Study cell_study(const Cell& cell, const Law& law, std::uint64_t draws)
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
    s.contact.restitution_law = law.restitution_law;
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

} // namespace stylobate
