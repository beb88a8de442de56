/// Oracles that take longer: stiffer contacts, and the specimen shaken over a range of amplitudes.

#include "studies/verification/model.hpp"

#include <gtest/gtest.h>

namespace stylobate {

namespace {

using model::Bed;
using model::pi;

/// The monolith under a pulse of w = 4 p with the amplitude eta g tan alpha.
Realization pulsed_monolith(double K_n, double eta, double step_rate)
{
    const Bed bed{K_n, 0.1, 5, true};
    Realization r = model::single(model::mono_stone, bed, step_rate / model::bed_rate(bed, model::mono_stone), 0.1);
    r.frequency_hz = 4 * model::rocking_rate(model::mono_stone) / (2 * pi);
    r.pga_m_s2 = eta * model::gravity * model::mono_stone.width / model::mono_stone.height;
    return r;
}

double overturning_eta(ExcitationKind kind, double K_n, double step_rate, double low, double high)
{
    return model::least_overturning(
        model::pulse(kind), [&](double eta) { return pulsed_monolith(K_n, eta, step_rate); }, low, high, 1e-4);
}

TEST(OverturningSlow, HalfSineDoesNotDependOnTheStep)
{
    for (double K_n : {1e8, 1e10}) {
        const double eta = overturning_eta(ExcitationKind::half_sine, K_n, 0.3, 2.3, 3);
        for (double rate : {0.6, 0.15})
            EXPECT_NEAR(overturning_eta(ExcitationKind::half_sine, K_n, rate, 2.3, 3), eta, 1e-3) << K_n;
    }
}

TEST(OverturningSlow, HalfSineComesCloseToTheRigidBlock)
{
    // what is missing falls by 2.4 to 2.5 per decade of stiffness up to 1e11; two more decades of it leave .0024
    const double at_1e12 = overturning_eta(ExcitationKind::half_sine, 1e12, 0.3, 2.3, 3);
    const double at_1e13 = overturning_eta(ExcitationKind::half_sine, 1e13, 0.3, 2.3, 3);
    EXPECT_GT(at_1e13, at_1e12);
    EXPECT_NEAR(at_1e13, 2.798592, 4e-3);
}

TEST(OverturningSlow, LowerEdgeOfTheFullSine)
{
    // after one impact, so the loss in the impact counts; four digits were given for dashpots of their own form
    EXPECT_NEAR(overturning_eta(ExcitationKind::full_sine, 1e8, 0.3, 1.2, 1.7), 1.580, 0.02);
    EXPECT_NEAR(overturning_eta(ExcitationKind::full_sine, 1e10, 0.3, 1.2, 1.8), 1.686, 0.02);
}

/// Least amplitude on a grid of 0.02 m/s2 for which `happens` [m/s2]; -1 for none.
template <class Test>
double least_amplitude(double frequency_hz, double from, double to, Test happens)
{
    const Bed bed{1e8, 0.1, 0.68};
    const double dt = 0.4 / model::bed_rate(bed, model::spec_drum);
    const auto lanes = static_cast<double>(kernels(best_isa()).lanes);
    for (double low = from; low <= to; low += 0.02 * lanes) {
        std::vector<Realization> tries;
        for (int i = 0; i < static_cast<int>(lanes); ++i) {
            Realization r = model::spec(bed, dt);
            r.frequency_hz = frequency_hz;
            r.pga_m_s2 = low + 0.02 * i;
            tries.push_back(r);
        }
        const auto outcomes = model::run_all(model::harmonic(12, 2), tries);
        for (std::size_t i = 0; i < outcomes.size(); ++i)
            if (happens(outcomes[i]))
                return tries[i].pga_m_s2;
    }
    return -1;
}

// The bands are those of two other programs with starts of 2 to 4 cycles and 8 to 12 in all: the response is chaotic,
// with pockets, and the start, the number of cycles and the form of the dashpot move it: at 1 Hz rocking by 2.25 to
// 2.39 and overturning by 2.26 to 2.48. So this is a check of sanity, to 0.1 m/s2.
TEST(SpecimenOnset, Rocking)
{
    const auto rocks = [](const Outcome& o) { return o.max_relative_rotation_rad > 0.01; };
    EXPECT_NEAR(least_amplitude(1, 1.5, 4, rocks), 2.3, 0.1);
    EXPECT_NEAR(least_amplitude(5, 1.2, 4, rocks), 2.0, 0.1);
    EXPECT_NEAR(least_amplitude(15, 2, 6, rocks), 3.8, 0.5); // 3.4 to 4.2
}

TEST(SpecimenOnset, OverturningAtOneHertz)
{
    const auto falls = [](const Outcome& o) { return o.state == State::collapsed; };
    EXPECT_NEAR(least_amplitude(1, 1.5, 4, falls), 2.29, 0.1);
}

} // namespace

} // namespace stylobate
