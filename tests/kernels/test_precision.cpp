/// Single precision in the ensemble: the same bits everywhere, outcomes that agree with double precision as well as
/// double precision agrees with itself at another step, and refusals. `docs/precision.md` has the figures.

#include "ensemble/planar/planar_model.hpp"
#include "studies/workflow/bench/scenes.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

std::vector<Outcome> run(Study study, Precision precision, double step_fraction, Isa isa = best_isa(), int threads = 2)
{
    study.run.precision = precision;
    study.run.step_fraction = step_fraction;
    return outcomes_of(study, {isa, threads});
}

bool collapsed(const Outcome& o)
{
    return o.state == State::collapsed;
}

/// How two runs of the same realizations differ.
struct Difference {
    double n = 0;          ///< realizations
    double discordant = 0; ///< of them collapse in one run alone
    double more = 0;       ///< collapse in the second run, less those in the first
};
Difference difference(const std::vector<Outcome>& a, const std::vector<Outcome>& b)
{
    Difference d;
    d.n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        d.discordant += collapsed(a[i]) != collapsed(b[i]);
        d.more += collapsed(b[i]) - collapsed(a[i]);
    }
    return d;
}

std::vector<double> collapse_times(const std::vector<Outcome>& outcomes)
{
    std::vector<double> times;
    for (const Outcome& o : outcomes)
        if (collapsed(o))
            times.push_back(o.collapse_time_s);
    std::sort(times.begin(), times.end());
    return times;
}

/// Two-sample Kolmogorov-Smirnov: the probability of a distance at least as large between samples of one distribution.
double same_distribution(const std::vector<double>& a, const std::vector<double>& b)
{
    double distance = 0;
    const auto share = [](const std::vector<double>& sorted, double x) {
        return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), x) - sorted.begin()) /
               static_cast<double>(sorted.size());
    };
    for (const auto* sample : {&a, &b})
        for (const double x : *sample)
            distance = std::max(distance, std::fabs(share(a, x) - share(b, x)));
    const double n =
        static_cast<double>(a.size()) * static_cast<double>(b.size()) / static_cast<double>(a.size() + b.size());
    const double t = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
    double p = 0;
    for (int k = 1; k <= 100; ++k)
        p += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * t * t);
    return t < 0.2 ? 1 : std::clamp(p, 0.0, 1.0);
}

/// @param level false-alarm rate of each of the three comparisons, one-sided normal quantile `quantile`
void agrees(const Study& study, const char* name, double quantile, double level)
{
    const auto here = run(study, Precision::double_, 0.9), finer = run(study, Precision::double_, 0.72),
               single = run(study, Precision::single, 0.9);
    const Difference steps = difference(here, finer), digits = difference(here, single);
    const auto share = [](const Difference& d) { return d.discordant / d.n; };
    // not more discordant than two steps are, to within chance: both shares are binomial
    const double sd =
        std::sqrt((share(steps) * (1 - share(steps)) + share(digits) * (1 - share(digits)) + 1 / steps.n) / steps.n);
    EXPECT_LE(share(digits), share(steps) + quantile * sd) << name;
    // nor to one side: McNemar
    EXPECT_LE(std::fabs(digits.more), quantile * std::sqrt(digits.discordant) + 1) << name;
    const double p = same_distribution(collapse_times(here), collapse_times(single));
    EXPECT_GT(p, level) << name << ": times of collapse";
    double worst = 0;
    for (const Outcome& o : single) {
        EXPECT_NE(o.state, State::invalid) << name;
        worst = std::max(worst, std::fabs(o.energy_residual));
    }
    EXPECT_LT(worst, 0.1) << name << ": energy balance";
    fmt::print("{}: {} realizations, {} collapse; alone in one run: {} with single precision ({:+}), {} with 0.8 of "
               "the step ({:+}); times of collapse p = {:.2f}; largest energy residual {:.3f}\n",
               name, here.size(), collapse_times(here).size(), digits.discordant, digits.more, steps.discordant,
               steps.more, p, worst);
}

/// Drums that are put down a little askew. (With the friction alone, realizations that hardly slip are copies of each
/// other, and a cell at the edge decides all of its own at once: nothing that a binomial test could judge.)
Study laid_by_hand(Study study)
{
    Perturbation offset;
    offset.quantity = Quantity::drum_offset;
    offset.per = Per::block;
    offset.sd = 0.00024;
    study.perturbations.push_back(offset);
    return study;
}

/// One cell of the surface, where about half of the realizations fall.
Study cell(int realizations, double frequency_hz, double pga_m_s2)
{
    Study study = rocking_column(7);
    study.realizations = static_cast<std::uint64_t>(realizations);
    study.excitation.cycles = 10;
    study.excitation.frequency_hz = frequency_hz;
    study.excitation.pga_m_s2 = pga_m_s2;
    return laid_by_hand(study);
}

Study falling_colonnade(int realizations)
{
    Study study = shaken_colonnade(2, 2, 12);
    study.realizations = static_cast<std::uint64_t>(realizations);
    study.excitation.cycles = 6;
    return study;
}

void same_everywhere(const Study& study)
{
    const auto want = run(study, Precision::single, 0.9, Isa::scalar, 1);
    for (const Isa isa : usable_isas())
        for (const int threads : {1, 3}) {
            const auto got = run(study, Precision::single, 0.9, isa, threads);
            for (std::size_t i = 0; i < want.size(); ++i)
                ASSERT_EQ(outcome_bits(got[i]), outcome_bits(want[i]))
                    << to_string(isa) << ", " << threads << " threads, realization " << i;
        }
}

} // namespace

TEST(Precision, SingleHasTheSameBitsForEveryWidthAndThreadCount)
{
    same_everywhere(small_surface(3));
    same_everywhere(falling_colonnade(9));
}

TEST(Precision, SinglePrecisionIsTaken)
{
    const Study study = small_surface(1);
    const auto a = run(study, Precision::double_, 0.9), b = run(study, Precision::single, 0.9);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NE(outcome_bits(a[i]), outcome_bits(b[i])) << "realization " << i;
}

TEST(Precision, APartedChunkHasTheSameOutcome)
{
    Study study = cell(4, 2, 3);
    study.run.precision = Precision::single;
    const Sampler sampler(study, nullptr);
    const auto want = run(study, Precision::single, 0.9);
    LaneSet lanes(study, nullptr, kernels(best_isa()), sampler.realization(0));
    for (int i = 0; i < 4 && i < lanes.lanes(); ++i) {
        lanes.load(i, sampler.realization(static_cast<std::uint64_t>(i)));
        while (!lanes.outcome(i)) {
            lanes.advance(0, 17);
            lanes.snapshot(i);
            lanes.advance(17, 18);
            lanes.advance(18, chunk_steps);
        }
        EXPECT_EQ(outcome_bits(*lanes.outcome(i)), outcome_bits(want[static_cast<std::size_t>(i)]));
    }
}

TEST(Precision, AStackAtRestStaysAtRest)
{
    Study study = cell(16, 1, 1);
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = 5;
    for (const Outcome& o : run(study, Precision::single, 0.9)) {
        EXPECT_EQ(o.state, State::stood);
        EXPECT_LT(o.total_sliding_m, 1e-7);
        EXPECT_LT(std::fabs(o.residual_top_displacement_m), 1e-7);
        EXPECT_LT(o.max_relative_rotation_rad, 1e-5);
    }
}

TEST(Precision, MechanismsAreRefused)
{
    Study study = cell(1, 1, 1);
    study.run.precision = Precision::single;
    study.contact.form = ContactForm::two_corner;
    const Sampler sampler(study, nullptr);
    EXPECT_THROW(LaneSet(study, nullptr, kernels(best_isa()), sampler.realization(0)), std::invalid_argument);
}

TEST(Precision, OutcomesAgreeOnASmallSurface)
{
    // three comparisons at 1e-3 each
    agrees(laid_by_hand(small_surface(24)), "surface 4 x 4", 3.1, 1e-3);
}

/// One cell of rigid blocks. Their step is fixed, so that another one can be compared.
Study rigid_cell(int realizations, double step_s)
{
    Study study = cell(realizations, 4, 5);
    ContactSpec rigid;
    rigid.form = ContactForm::rigid;
    rigid.normal_damping_ratio = rigid.tangential_damping_ratio = 0;
    rigid.friction = study.contact.friction;
    study.contact = rigid;
    study.run.step_s = step_s;
    return study;
}

TEST(Precision, RigidBlocksHaveTheSameBitsForEveryWidthAndThreadCount)
{
    Study study = rigid_cell(12, 1e-3);
    same_everywhere(study);
    study.outcome.follow = Follow::rest;
    same_everywhere(study);
}

TEST(Precision, RigidBlocksAgree)
{
    const Study study = rigid_cell(512, 1e-3);
    const auto here = run(study, Precision::double_, 1), single = run(study, Precision::single, 1),
               finer = run(rigid_cell(512, 0.8e-3), Precision::double_, 1);
    const Difference digits = difference(here, single), steps = difference(here, finer);
    fmt::print("rigid: {} of {} collapse; alone in one run: {} with single precision ({:+}), {} with 0.8 of the step "
               "({:+})\n",
               collapse_times(here).size(), here.size(), digits.discordant, digits.more, steps.discordant, steps.more);
    EXPECT_LE(std::fabs(digits.more), 3.1 * std::sqrt(digits.discordant) + 1);
    EXPECT_GT(same_distribution(collapse_times(here), collapse_times(single)), 1e-3);
    for (const Outcome& o : single) {
        EXPECT_NE(o.state, State::invalid);
        EXPECT_LT(std::fabs(o.energy_residual), 0.1);
    }
}

TEST(PrecisionLong, OutcomesAgreeOnASurface)
{
    Study study = laid_by_hand(small_surface(64));
    study.surface->frequency_hz.count = 8;
    study.surface->pga_m_s2.count = 8;
    agrees(study, "surface 8 x 8", 3.1, 1e-3);
}

TEST(PrecisionLong, OutcomesAgreeWhereHalfFall)
{
    agrees(cell(1000, 4, 5), "4 Hz, 5 m/s2", 3.1, 1e-3);
    agrees(cell(1000, 6, 9), "6 Hz, 9 m/s2", 3.1, 1e-3);
}

TEST(PrecisionLong, OutcomesAgreeOfAColonnade)
{
    agrees(falling_colonnade(500), "colonnade 2 x 2", 3.1, 1e-3);
}
