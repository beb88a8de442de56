/// Free rocking of one block against Housner's rigid one.

#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/reference_runs.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/rocking_block.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* subject = "Rocking";

const model::Stone block_a{1, 4, 10000}; // 1 x 4 m, 2500 kg/m3

Finding quarter_periods(const model::Stone& stone, const char* name, const std::vector<double>& stiffness)
{
    const RigidBlock rigid = rigid_block(stone.width, stone.height);
    Finding f;
    for (const double part : {0.3, 0.5, 0.8}) {
        const double exact = static_cast<double>(quarter_period(rigid, part * rigid.alpha));
        std::vector<double> values;
        for (double K : stiffness)
            values.push_back(upright_time(leaned_block(stone, K, part, 0.2)));
        f.equals(fmt::format("{} from {} alpha, K_N to infinity [s]", name, part), exact, aitken(values), 5e-4 * exact);
        f.convergences.push_back(convergence(
            "K_N [N/m2]", fmt::format("quarter period of {} from {} alpha [s]", name, part), stiffness, values, exact));
    }
    return f;
}

Finding monolith()
{
    Finding f = quarter_periods(model::mono_stone, "MONO", {1e8, 1e9, 1e10, 1e11, 1e12});
    const RigidBlock rigid = rigid_block(0.048L, 0.174L);
    for (const auto& [part, digits] : {std::pair{0.1, 0.20800736}, {0.5, 0.58467309}, {0.9, 1.32676631}})
        f.equals(fmt::format("the oracle against the reference value, from {} alpha: whole period [s]", part), digits,
                 static_cast<double>(4 * quarter_period(rigid, part * rigid.alpha)), 1e-8);
    for (const std::size_t i : {0U, 2U})
        f.equals(
            fmt::format("MONO from 0.5 alpha at K_N = {:g} N/m2, by the second solver [s]", f.convergences[1].at[i]),
            reference_upright_time(leaned_block(model::mono_stone, f.convergences[1].at[i], 0.5, 0.2)),
            f.convergences[1].value[i], 1e-9);
    return f;
}

Finding tall_block()
{
    Finding f = quarter_periods(block_a, "A", {1e9, 1e10, 1e11, 1e12, 1e13});
    const RigidBlock rigid = rigid_block(1, 4);
    for (const auto& [part, digits] : {std::pair{0.1, 0.99328373}, {0.5, 2.79337282}, {0.9, 6.34056642}})
        f.equals(fmt::format("the oracle against the reference value, from {} alpha: whole period [s]", part), digits,
                 static_cast<double>(4 * quarter_period(rigid, part * rigid.alpha)), 1e-8);
    return f;
}

Finding loss_at_impact()
{
    // Not an agreement with Housner: the impulse of a flat face on a bed acts inside the edge, and the dashpot at the
    // centroid of the overlap does not damp rotation about it.
    Finding f;
    const double housner = static_cast<double>(housner_restitution(rigid_block(0.048L, 0.174L).alpha));
    f.equals("Housner's e of MONO against its reference value", 0.893922652, housner, 1e-9);
    for (const double K : {1e7, 1e8, 1e10}) {
        const Realization leaned = leaned_block(model::mono_stone, K, 0.5, 0.1, 0.4);
        f.equals(fmt::format("e of MONO from 0.5 alpha at K_N = {:g} N/m2, xi = 0.4, by the second solver", K),
                 reference_restitution(leaned), impact_restitution(leaned), 1e-8);
    }
    f.at_least("e of MONO at K_N = 1e12 N/m2, xi = 0.4: above Housner's by at least 0.05", housner + 0.05,
               impact_restitution(leaned_block(model::mono_stone, 1e12, 0.5, 0.1, 0.4)));
    f.remarks.push_back(fmt::format("Housner's {:.6f} is **not** reached, as expected: his impulse acts only at the "
                                    "new corner, while here it is distributed over the face. Tests of real blocks "
                                    "also lie above his value.",
                                    housner));
    return f;
}

constexpr double grid_m_s2 = 0.02;

Study onset_shaking()
{
    return model::harmonic(12, 2);
}

/// SPEC with drums that taper by 1e-5: of flush sides rounding decides which block's side lies inside the other.
Realization shaken_specimen(double frequency_hz, double pga_m_s2)
{
    const model::Bed bed{1e8, 0.1, 0.68};
    Realization r = model::spec(bed, 0.4 / model::bed_rate(bed, model::spec_drum), 1e-5);
    r.frequency_hz = frequency_hz;
    r.pga_m_s2 = pga_m_s2;
    return r;
}

/// Least amplitude on the grid for which `happens` [m/s2]; -1 for none.
template <class Test>
double least_amplitude(double frequency_hz, double from, double to, Test happens)
{
    const auto lanes = static_cast<double>(kernels(best_isa()).lanes);
    for (double low = from; low <= to; low += grid_m_s2 * lanes) {
        std::vector<Realization> tries;
        for (int i = 0; i < static_cast<int>(lanes); ++i)
            tries.push_back(shaken_specimen(frequency_hz, low + grid_m_s2 * i));
        const auto outcomes = model::run_all(onset_shaking(), tries);
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            if (happens(outcomes[i]))
                return tries[i].pga_m_s2;
    }
    return -1;
}

/// The same by the second solver, looked for on the grid near the engine's; -1 where it is not there.
template <class Test>
double reference_amplitude(double frequency_hz, double engine, Test happens)
{
    for (const int step : {-2, -1, 0, 1, 2})
        if (const double a = engine + grid_m_s2 * step;
            happens(reference_shaken(onset_shaking(), shaken_specimen(frequency_hz, a))))
            return a;
    return -1;
}

Finding specimen_onset()
{
    const auto rocks = [](const Outcome& o) { return o.max_relative_rotation_rad > 0.01; };
    const auto falls = [](const Outcome& o) { return o.state == State::collapsed; };
    const auto reference_rocks = [](const ReferenceShaken& found) { return found.rocks; };
    const auto reference_falls = [](const ReferenceShaken& found) { return found.falls; };
    Finding f;
    for (const auto& [frequency_hz, from, to] : {std::tuple{1, 1.5, 4.0}, {5, 1.2, 4.0}, {15, 2.0, 6.0}}) {
        const double least = least_amplitude(frequency_hz, from, to, rocks);
        f.equals(fmt::format("rocking by 0.01 rad at {} Hz, from [m/s2]", frequency_hz),
                 reference_amplitude(frequency_hz, least, reference_rocks), least, grid_m_s2);
    }
    const double least = least_amplitude(1, 1.5, 4, falls);
    f.equals("overturning at 1 Hz, from [m/s2]", reference_amplitude(1, least, reference_falls), least, grid_m_s2);
    return f;
}

} // namespace

Cases rocking_cases()
{
    return {
        {"QuarterPeriod", subject,
         "MONO tilted by 0.3, 0.5 and 0.8 alpha and released: time to the upright position, at growing contact "
         "stiffness.",
         "the rigid block's integral, in extended precision; at two stiffnesses the second solver of the same "
         "equations "
         "(`reference_solver.hpp`), with the same step; reference values (`reference_values.py`).",
         "Aitken's limit of the three stiffest; against the second solver the rounding of its steps.", monolith},
        {"QuarterPeriodTall", subject, "The same for A, a block of 1 x 4 m and 2500 kg/m3.",
         "the same integral; reference values (`reference_values.py`).", "Aitken's limit of the three stiffest.",
         tall_block},
        {"RockingRestitution", subject,
         "Ratio of the angular velocities after and before the first impact, from the energies of the rigid block at "
         "the peaks on both sides.",
         "the second solver of the same equations (`reference_solver.hpp`). **Not Housner's e**: this contact law does "
         "not reproduce it.",
         "the rounding of the steps of the second solver.", loss_at_impact},
        {"SpecimenOnset", subject,
         "SPEC under a harmonic with a smooth start, 12 cycles, K_N = 1e8 N/m2: smallest amplitude, on a grid of 0.02 "
         "m/s2, that causes rocking or overturning.",
         "two other programs of the same contact law.",
         "the response is chaotic, and the start, the number of cycles and the form of the dashpot change the ranges "
         "of the other programs (at 15 Hz 3.4 to 4.2). This is a plausibility check.",
         specimen_onset, Duration::slow},
    };
}

} // namespace stylobate::verification
