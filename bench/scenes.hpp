#pragma once
/// The structures that are timed: the paper's specimen, and columns of its drums with other numbers of them.

#include "ensemble/realization.hpp"
#include "ensemble/sampler.hpp"
#include "ensemble/study.hpp"

namespace stylobate {

/// Drums of the specimen under a harmonic that makes them rock without an end; the lowest of `blocks` is fixed.
inline Study rocking_column(int blocks)
{
    Study study;
    study.kind = StudyKind::single;
    study.realizations = 1'000'000;
    study.structure = equal_column(blocks, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.normal_stiffness_n_m2 = 1e8;
    study.contact.tangential_stiffness_n_m = 4.8e6;
    study.contact.friction = 0.68;
    study.excitation.kind = ExcitationKind::harmonic;
    study.excitation.frequency_hz = 5;
    study.excitation.pga_m_s2 = 2.15;
    study.excitation.cycles = 1e6;
    Perturbation friction;
    friction.per = Per::joint;
    friction.cov = 0.1;
    study.perturbations = {friction};
    return study;
}

/// The main job in small: frequencies and PGAs from standing to falling, perturbed.
inline Study small_surface(int realizations)
{
    Study study = rocking_column(7);
    study.kind = StudyKind::surface;
    study.realizations = static_cast<std::uint64_t>(realizations);
    study.excitation.frequency_hz = 0;
    study.excitation.pga_m_s2 = 0;
    study.excitation.cycles = 10;
    study.surface = SurfaceSpec{{.from = 1, .to = 10, .count = 4, .spacing = Spacing::log},
                                {.from = 1, .to = 12, .count = 4, .spacing = Spacing::linear}};
    return study;
}

} // namespace stylobate
