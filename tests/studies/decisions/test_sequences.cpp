/// Histories of earthquakes: the rest between two of them, and the shares of a run, by hand.

#include "io/files/atomic_file.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/decisions/risk/sequences.hpp"
#include "studies/results/study_run.hpp"
#include "tests/studies/decisions/interval_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace stylobate {
namespace {

/// Half the diagonal R of the block of 0.2 m by 0.4 m is sqrt(0.05) m, its frequency p = sqrt(3 g / (4 R)).
constexpr double gravity = 9.81;
const double frequency_rad_s = std::sqrt(3 * gravity / (4 * std::sqrt(0.05)));

/// A slender block under nine equal pulses.
class Sequences : public testing::Test {
protected:
    Sequences()
    {
        std::ofstream(folder_ / "block.toml")
            << "[study]\nkind = \"fragility\"\nrealizations = 1\n[structure]\nblocks = 1\ndrum_width_m = 0.2\n"
               "drum_height_m = 0.4\ndepth_m = 0.2\ndensity_kg_m3 = 2700\ngravity_m_s2 = 9.81\n[contact]\n"
               "normal_stiffness_n_m2 = 1e6\nfriction = 0.7\n[excitation]\nkind = \"pulse\"\nfrequency_hz = 2\n"
               "[fragility]\nmotions = 9\nintensity = { measure = \"pgv\", from = 0.3, to = 1.2, count = 2 }\n"
               "[perturbation]\npulse_frequency = { distribution = \"lognormal\", sigma_ln = 0.3 }\n"
               "drum_offset = { distribution = \"normal\", sd_m = 0.002, per = \"block\" }\n";
        risk_.hazard.measure = "pgv_m_s";
        risk_.hazard.intensity = {0.1, 10};
        risk_.hazard.frequency = {0.9, 0.9e-6}; // 0.0009 a^-3: 0.0576 a year above 0.25 m/s
        StateRisk collapse;
        collapse.state = "collapse";
        collapse.estimate.frequency.value = 0.02;
        collapse.estimate.frequency.fragility = {0.01, 0.03};
        risk_.states.push_back(collapse);
        options_.threshold = 0.25;
        options_.years = 50;
        options_.histories = 40;
    }

    /// @param settings of the study
    SequenceRisk simulated(const SequenceOptions& options, const std::vector<std::string>& settings = {})
    {
        const std::string study = folder_ / "block.toml", file = folder_ / "block.h5";
        std::filesystem::remove(file);
        Observer observer;
        const RunOptions run{best_isa(), 1};
        StudyRun whole(LoadedStudy::from_file(study, settings), study, file);
        EXPECT_TRUE(whole.run(run, observer).complete);
        const Results results(file);
        const auto found = simulate_sequences(results, risk_, options, run, observer);
        EXPECT_TRUE(found);
        return found.value_or(SequenceRisk{});
    }

    TemporaryFolder folder_;
    Risk risk_;
    SequenceOptions options_;
};

/// Ten times the tail of 12 / p, or the study's pause where that is longer: the run has the steps of that pause. The
/// earthquakes are weak, so that no fall ends a history early.
TEST_F(Sequences, TheRestBetweenEarthquakesIs120OverP)
{
    risk_.hazard.frequency = {1, 1e-60}; // a^-30: 0.05 a year above 0.1105 m/s
    options_.threshold = 0.1 * std::pow(20, 1.0 / 30);
    const auto steps = [&](std::optional<double> pause_s, const std::vector<std::string>& settings = {}) {
        SequenceOptions options = options_;
        options.histories = 4;
        options.checked = 0;
        options.pause_s = pause_s;
        const SequenceRisk s = simulated(options, settings);
        EXPECT_GT(s.with_two, 0U);
        EXPECT_EQ(s.carried + s.fresh, 0U);
        return s.steps;
    };
    const double rest_s = 120 / frequency_rad_s;
    EXPECT_NEAR(rest_s, 20.92, 0.01);
    const std::uint64_t by_default = steps({});
    EXPECT_EQ(by_default, steps(rest_s));
    EXPECT_LT(steps(0.98 * rest_s), by_default);
    EXPECT_GT(steps(1.02 * rest_s), by_default);
    // the study's own pause is the least one
    EXPECT_EQ(steps({}, {"fragility.pause_s=15"}), by_default);
    EXPECT_EQ(steps({}, {"fragility.pause_s=25"}), steps(25));
}

void expect_share(const SequenceNumber& found, std::uint64_t k, std::uint64_t n, double level)
{
    const auto reached = static_cast<double>(k), all = static_cast<double>(n);
    const auto [lower, upper] = jeffreys_limits(reached, all, level);
    EXPECT_DOUBLE_EQ(found.value, reached / all);
    EXPECT_NEAR(found.limits.lower, lower, 1e-9);
    EXPECT_NEAR(found.limits.upper, upper, 1e-9);
}

void expect_difference(const SequenceNumber& found, double more, double less, double pairs, double z)
{
    EXPECT_NEAR(found.value, (more - less) / pairs, 1e-15);
    EXPECT_NEAR(tango_score(more, less, pairs, found.limits.lower), z, 1e-6);
    EXPECT_NEAR(tango_score(more, less, pairs, found.limits.upper), -z, 1e-6);
}

TEST_F(Sequences, SharesDifferenceAndRatioAreThoseOfTheCounts)
{
    options_.pause_s = 1; // the next one finds the block in motion: histories differ
    options_.checked = 20;
    const SequenceRisk s = simulated(options_);
    ASSERT_EQ(s.invalid, 0U);
    ASSERT_GT(s.both, 0U);
    ASSERT_NE(s.carried, s.fresh) << "else the sign of the difference is not seen";
    EXPECT_EQ(s.histories, 40U);
    EXPECT_NEAR(s.events_a_year, 0.0576, 1e-12);
    expect_share(s.carried_share, s.carried, 40, 0.9);
    expect_share(s.fresh_share, s.fresh, 40, 0.9);
    constexpr double z = 1.6448536;
    const auto carried = static_cast<double>(s.carried), fresh = static_cast<double>(s.fresh);
    const double more = carried - static_cast<double>(s.both), less = fresh - static_cast<double>(s.both);
    expect_difference(s.difference, more, less, 40, z);
    // of the logarithm of the ratio: variance (b + c + 1) / (n n') (paired_difference.hpp)
    const double reach = std::exp(z * std::sqrt((more + less + 1) / (carried * fresh)));
    EXPECT_NEAR(s.ratio.value, carried / fresh, 1e-12);
    EXPECT_NEAR(s.ratio.limits.lower, carried / fresh / reach, 1e-6);
    EXPECT_NEAR(s.ratio.limits.upper, carried / fresh * reach, 1e-6);
    // 1 - exp(-0.02 x 50), and of the limits of the fragility
    EXPECT_NEAR(s.closed_form.value, 1 - std::exp(-1.0), 1e-12);
    EXPECT_NEAR(s.closed_form.limits.lower, 1 - std::exp(-0.5), 1e-12);
    EXPECT_NEAR(s.closed_form.limits.upper, 1 - std::exp(-1.5), 1e-12);
    // the check of the threshold
    EXPECT_EQ(s.checked, 20U);
    EXPECT_EQ(s.checked_threshold, 0.125);
    ASSERT_NE(s.then_fell, s.then_stood);
    expect_difference(s.check_difference, static_cast<double>(s.then_fell), static_cast<double>(s.then_stood), 20, z);
}

} // namespace
} // namespace stylobate
