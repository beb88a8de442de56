#pragma once
/// The structures that are timed: the paper's specimen, columns of its drums with other numbers of them, and
/// colonnades that stand or lie in a heap.

#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <vector>

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

/// A scene with faces that carry in another way.
inline Study formed_column(ContactForm form)
{
    Study study = rocking_column(7);
    study.contact.form = form;
    return study;
}

/// A scene in which every pair is watched that may meet when it falls.
inline Study watched_column(int blocks)
{
    Study study = rocking_column(blocks);
    study.outcome.follow = Follow::rest;
    return study;
}

/// Columns of the paper's colonnade under epistyles that meet over them, shaken without an end: at 4 m/s2 it stands,
/// at 12 m/s2 it soon lies in a heap, which is shaken on.
inline Study shaken_colonnade(int columns, int drums, double pga_m_s2)
{
    Study study = watched_column(2);
    study.structure = {};
    study.structure.kind = StructureKind::colonnade;
    study.structure.depth_m = 0.06;
    for (int i = 0; i < columns; ++i) {
        ColumnSpec column;
        column.x_m = 0.09 * i;
        column.drums.assign(static_cast<std::size_t>(drums), {0.06, 0.1 / drums, 0.75 / drums});
        study.structure.columns.push_back(column);
        if (i == 0)
            continue;
        const double left = 0.09 * (i - 1) - (i == 1 ? 0.03 : 0);
        const double right = 0.09 * i + (i + 1 == columns ? 0.03 : 0);
        study.structure.epistyles.push_back({i - 1, i, (left + right) / 2, right - left, 0.06, 7.6 * (right - left)});
    }
    study.contact.tangential_stiffness_n_m = 6e6;
    study.excitation.frequency_hz = pga_m_s2 > 8 ? 2 : 5;
    study.excitation.pga_m_s2 = pga_m_s2;
    return study;
}

/// Floating-point operations of a block-step of the specimen, a multiply-add being two: as bench/counted_step.cpp
/// counts them (test `CountedStep.HasTheOperationsOfTheSpecimen`).
inline constexpr double specimen_operations = 241;

/// A surface of ten cycles from standing to falling in 4 x 4 cells. @param realizations in each of them
inline Study as_small_surface(Study study, int realizations)
{
    study.kind = StudyKind::surface;
    study.realizations = static_cast<std::uint64_t>(realizations);
    study.excitation.frequency_hz = 0;
    study.excitation.pga_m_s2 = 0;
    study.excitation.cycles = 10;
    study.surface = SurfaceSpec{{.from = 1, .to = 10, .count = 4, .spacing = Spacing::log},
                                {.from = 1, .to = 12, .count = 4, .spacing = Spacing::linear}};
    return study;
}

/// The main job in small: frequencies and PGAs from standing to falling, perturbed.
inline Study small_surface(int realizations)
{
    return as_small_surface(rocking_column(7), realizations);
}

/// What a user does to a study file: no stiffness, no dashpot, an accuracy.
inline void make_rigid(Study& s, double accuracy)
{
    s.contact.form = ContactForm::rigid;
    s.contact.normal_stiffness_n_m2 = s.contact.tangential_stiffness_n_m = 0;
    s.contact.normal_damping_ratio = s.contact.tangential_damping_ratio = 0;
    std::erase_if(s.perturbations, [](const Perturbation& p) {
        return p.quantity == Quantity::normal_stiffness || p.quantity == Quantity::damping_ratio;
    });
    s.run.accuracy = accuracy;
}

} // namespace stylobate
