/// Windows to be shown in motion: the choice by their errors, and the blocks in them, which are those of the measured
/// file and of windows that are simulated anew here.

#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/tracking/tracking_targets.hpp"
#include "io/measured/measured_motion.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/windows/window_motions.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

const RunOptions one_thread{best_isa(), 1};

/// Windows of 1 s, so many in each run, with the errors of one coordinate of one block (NaN: nothing was seen).
/// @return of the chosen ones the run, the start, why, the rank and among how many
std::vector<std::string> chosen_by(const std::vector<std::vector<double>>& errors)
{
    std::vector<WindowPlace> windows;
    std::vector<WindowExcess> excess;
    for (std::size_t run = 0; run < errors.size(); ++run)
        for (std::size_t w = 0; w < errors[run].size(); ++w) {
            const auto start = static_cast<double>(w);
            windows.push_back({run, start, start + 1, start});
            excess.emplace_back();
            if (std::isfinite(errors[run][w])) {
                excess.back()[{0, BlockCoordinate::theta}] = errors[run][w] / 2;
                excess.back()[{1, BlockCoordinate::x}] = errors[run][w];
            }
        }
    std::vector<std::string> words;
    for (const ChosenWindow& window : choose_windows(windows, excess))
        words.push_back(std::to_string(window.place.run) + " " +
                        std::to_string(static_cast<int>(window.place.start_s)) +
                        (window.choice == WindowChoice::worst ? " worst " : " typical ") + std::to_string(window.rank) +
                        "/" + std::to_string(window.ranked));
    return words;
}

using Texts = std::vector<std::string>;

TEST(ChosenWindows, AreTheWorstTheMedianAndTheWorstOfOtherRuns)
{
    // in order: 9 8 7 6 5 4 3 2 1; the median is the fifth
    EXPECT_EQ(chosen_by({{1, 9, 8}, {7, 2, 3}, {5, 4, 6}}),
              (Texts{"0 1 worst 1/9", "2 0 typical 5/9", "1 0 worst 3/9", "2 2 worst 4/9"}));
    // of an even number the smaller one of the two in the middle
    EXPECT_EQ(chosen_by({{4, 3, 2, 1}}), (Texts{"0 0 worst 1/4", "0 2 typical 3/4"}));
}

TEST(ChosenWindows, AreNoWindowTwice)
{
    EXPECT_EQ(chosen_by({{3}, {2}, {1}}), (Texts{"0 0 worst 1/3", "1 0 typical 2/3", "2 0 worst 3/3"}));
    EXPECT_EQ(chosen_by({{3}}), (Texts{"0 0 worst 1/1"}));
    EXPECT_EQ(chosen_by({{}}), Texts{});
}

TEST(ChosenWindows, AreNoneInWhichNothingWasSeen)
{
    const double unseen = std::nan("");
    EXPECT_EQ(chosen_by({{unseen, 2, unseen, 3, 1}, {unseen}}), (Texts{"0 3 worst 1/3", "0 1 typical 2/3"}));
}

TEST(ChosenWindows, OfEqualErrorsAreTheEarlierOnesAndAFewInAll)
{
    EXPECT_EQ(chosen_by({{2, 2, 2}, {2, 2, 2}, {2}, {2}, {2}, {2}, {2}}),
              (Texts{"0 0 worst 1/11", "1 2 typical 6/11", "1 0 worst 4/11", "2 0 worst 7/11", "3 0 worst 8/11"}));
}

SyntheticCampaign three_runs()
{
    SyntheticCampaign c;
    c.runs = 3;
    c.placement_m = 4e-4;
    return c;
}

ModelVariant with_friction(const SyntheticCampaign& c, const Campaign& campaign, double friction)
{
    ModelVariant variant;
    variant.study = default_study(campaign);
    variant.study.contact = truth_of(c).contact;
    variant.study.contact.friction = friction;
    return variant;
}

std::vector<ChosenWindow> chosen_of(const Campaign& campaign, const ModelVariant& variant,
                                    std::vector<WindowExcess>& excess, std::vector<WindowPlace>& places)
{
    WindowComparison comparison(campaign, {});
    Observer observer;
    const std::vector<WindowResiduals> z = comparison.residuals({variant}, one_thread, observer);
    excess = excess_of(comparison, z.front(), build_specimen(campaign.specimen));
    places = comparison.windows();
    return choose_windows(places, excess);
}

const MeasuredRun& run_of(const Campaign& campaign, const std::string& name)
{
    return *std::ranges::find(campaign.runs, name, &MeasuredRun::name);
}

/// The row of a run's clock.
std::size_t row_at(const MeasuredRun& run, double time_s)
{
    return static_cast<std::size_t>(std::ranges::find(run.time_s, time_s) - run.time_s.begin());
}

/// A window simulated anew, from the campaign and the model alone: an observer that follows the smoothed measurement,
/// and the window that leaves it. @return (times x blocks of the realization), and the heights of rest
struct Anew {
    Readings readings;
    std::vector<double> rest_y_m;
    SeenRun seen;
    std::size_t blocks = 0;
};

Anew simulated_anew(const Campaign& campaign, const MeasuredRun& run, const ModelVariant& variant,
                    const WindowMotion& window)
{
    const SpecimenStructure built = build_specimen(campaign.specimen);
    const TrackingScales scales = tracking_scales(0.048, campaign.specimen.gravity_m_s2);
    const auto base = std::make_shared<Motion>(base_motion_of(run));
    const std::vector<double> plan_x_m(4, 0);
    Anew anew;
    anew.seen = seen_run(run, *base, built.block, plan_x_m, scales.smoothing_s);
    TrackingJob job;
    job.realization = nominal_realization(variant.study, built.structure);
    for (std::size_t i = 1; i < 4; ++i) // 0 is fixed
        job.realization.blocks[i].x_m += anew.seen.standing_x_m[i];
    job.realization.motion = base;
    job.targets = std::make_shared<Targets>(targets_of(anew.seen));
    job.nudge_rad_s = scales.nudge_rad_s;
    FreeWindow free{window.from_s - run.time_s.front(), {}};
    for (const MotionSample& sample : window.samples)
        free.times_s.push_back(sample.time_s - run.time_s.front());
    job.windows = std::make_shared<std::vector<FreeWindow>>(1, free);
    anew.rest_y_m = static_state(job.realization).y_m;
    anew.blocks = job.realization.blocks.size();
    Observer observer;
    anew.readings = track({job}, one_thread, observer).results.front().windows.front();
    return anew;
}

class ShownWindows : public testing::Test {
protected:
    void SetUp() override
    {
        wrong_ = with_friction(c_, campaign_, 0.2); // of 0.5
        right_ = with_friction(c_, campaign_, 0.5);
        chosen_ = chosen_of(campaign_, wrong_, excess_, places_);
        ASSERT_EQ(chosen_.size(), 4U); // worst, median, worst of two other runs
    }

    const SyntheticCampaign c_ = three_runs();
    const Campaign campaign_ = measure(c_);
    ModelVariant wrong_, right_;
    std::vector<WindowExcess> excess_;
    std::vector<WindowPlace> places_;
    std::vector<ChosenWindow> chosen_;
    SimulationCount cost_;
    Observer observer_;
};

TEST_F(ShownWindows, HaveTheMeasuredValuesAgainstTheBase)
{
    const auto motion = window_motions(chosen_, {{"wrong", campaign_, wrong_}}, {}, one_thread, cost_, observer_);
    ASSERT_TRUE(motion);
    EXPECT_EQ(motion->fault(), std::nullopt);
    ASSERT_EQ(motion->blocks.size(), 4U);
    EXPECT_EQ(motion->blocks[3].kind, ShownBlockKind::fixed);
    ASSERT_EQ(motion->windows.size(), chosen_.size());
    for (std::size_t w = 0; w < chosen_.size(); ++w) {
        const WindowMotion& window = motion->windows[w];
        EXPECT_EQ(window.run, campaign_.runs[chosen_[w].place.run].name);
        EXPECT_EQ(window.rank, chosen_[w].rank);
        EXPECT_EQ(window.from_s, chosen_[w].place.start_s);
        EXPECT_EQ(window.samples.back().time_s, window.to_s);
        EXPECT_GT(window.samples.front().time_s, window.from_s);
        EXPECT_LE(window.samples.front().time_s, window.from_s + 0.0021); // the cameras' next sample
        const MeasuredRun& run = run_of(campaign_, window.run);
        const Motion base = base_motion_of(run);
        ASSERT_EQ(base.dt_s, run.time_s[1] - run.time_s[0]);
        for (std::size_t k = 0; k < window.samples.size(); ++k) {
            const std::size_t row = row_at(run, window.samples[k].time_s);
            ASSERT_LT(row, run.time_s.size());
            ASSERT_NEAR(window.samples[k].base_x_m, base.displacement_m[row], 1e-12);
            for (std::size_t b = 0; b < 3; ++b) {
                const BlockPlace& place = window.tracks[0].places[3 * k + b];
                ASSERT_NEAR(place.x_m + window.samples[k].base_x_m, run.blocks.x_m.values[3 * row + b], 1e-12);
                ASSERT_EQ(place.theta_rad, run.blocks.theta_rad.values[3 * row + b]);
                // heights count from where a block stood at first, which is its place in the plan
                ASSERT_NEAR(place.y_m, run.blocks.y_m.values[3 * row + b], 3 * c_.camera_noise_m);
            }
        }
    }
    // and the rise itself is the measured one
    const WindowMotion& window = motion->windows[0];
    const MeasuredRun& run = run_of(campaign_, window.run);
    const std::size_t first = row_at(run, window.samples.front().time_s), last = row_at(run, window.to_s);
    for (std::size_t b = 0; b < 3; ++b)
        EXPECT_NEAR(window.tracks[0].places[3 * (window.samples.size() - 1) + b].y_m - window.tracks[0].places[b].y_m,
                    run.blocks.y_m.values[3 * last + b] - run.blocks.y_m.values[3 * first + b], 1e-12);
}

TEST_F(ShownWindows, HaveTheModelAsItIsSimulatedAnew)
{
    const auto motion = window_motions(chosen_, {{"wrong", campaign_, wrong_}, {"right", campaign_, right_}}, {},
                                       one_thread, cost_, observer_);
    ASSERT_TRUE(motion);
    double apart = 0;
    for (const WindowMotion& window : motion->windows)
        for (std::size_t model = 1; model < 3; ++model) {
            const ModelVariant& variant = model == 1 ? wrong_ : right_;
            EXPECT_EQ(window.tracks[model].model, model == 1 ? "wrong" : "right");
            const MeasuredRun& run = run_of(campaign_, window.run);
            const Anew anew = simulated_anew(campaign_, run, variant, window);
            for (std::size_t k = 0; k < window.samples.size(); ++k)
                for (std::size_t b = 0; b < 3; ++b) {
                    const BlockPlace& place = window.tracks[model].places[3 * k + b];
                    const std::size_t at = k * anew.blocks + b + 1;
                    ASSERT_EQ(place.x_m, anew.seen.standing_x_m[b + 1] + anew.readings.x_m[at]);
                    ASSERT_EQ(place.theta_rad, anew.readings.theta_rad[at]);
                    ASSERT_NEAR(place.y_m,
                                campaign_.specimen.rest_y_m[b] + (anew.readings.y_m[at] - anew.rest_y_m[b + 1]), 1e-15);
                    apart = std::max(apart, std::abs(place.x_m - window.tracks[0].places[3 * k + b].x_m));
                }
        }
    EXPECT_GT(apart, 1e-3); // the wrong one slides where the specimen rocks
    EXPECT_GT(cost_.window_simulations, 8U);
}

TEST_F(ShownWindows, HaveTheErrorsByWhichTheyWereChosen)
{
    const auto motion = window_motions(chosen_, {{"wrong", campaign_, wrong_}, {"right", campaign_, right_}}, {},
                                       one_thread, cost_, observer_);
    ASSERT_TRUE(motion);
    std::vector<double> all;
    for (const WindowExcess& window : excess_) {
        double largest = 0;
        for (const auto& [what, value] : window)
            largest = std::max(largest, value);
        all.push_back(largest);
    }
    std::ranges::sort(all, std::greater<>());
    for (const WindowMotion& window : motion->windows) {
        const MotionTrack &wrong = window.tracks[1], &right = window.tracks[2];
        EXPECT_FALSE(window.tracks[0].excess);
        EXPECT_EQ(window.ranked, all.size());
        ASSERT_TRUE(wrong.excess && right.excess);
        EXPECT_EQ(*wrong.excess, all[window.rank - 1]);
        EXPECT_GE(wrong.block, 0);
        EXPECT_TRUE(wrong.coordinate == "x" || wrong.coordinate == "y" || wrong.coordinate == "theta");
    }
    EXPECT_LT(*motion->windows[0].tracks[2].excess, *motion->windows[0].tracks[1].excess / 2);
}

TEST_F(ShownWindows, OfAModelWithItsOwnBaseStandInTheSameFrame)
{
    // the table moved a tenth farther than the file says, and a model that knows it
    Campaign corrected = campaign_;
    for (MeasuredRun& run : corrected.runs) {
        for (double& a : run.base_acceleration_m_s2.values)
            a *= 1.1;
        for (double& u : run.base_displacement_m.values)
            u *= 1.1;
    }
    const auto motion = window_motions(chosen_, {{"wrong", campaign_, wrong_}, {"right", corrected, right_}}, {},
                                       one_thread, cost_, observer_);
    ASSERT_TRUE(motion);
    const WindowMotion& window = motion->windows[0];
    const MeasuredRun &run = run_of(campaign_, window.run), &moved = run_of(corrected, window.run);
    const Anew anew = simulated_anew(corrected, moved, right_, window);
    for (std::size_t k = 0; k < window.samples.size(); ++k) {
        const std::size_t row = row_at(run, window.samples[k].time_s);
        EXPECT_NEAR(window.samples[k].base_x_m, run.base_displacement_m.values[row], 1e-6);
        for (std::size_t b = 0; b < 3; ++b) {
            const double laboratory = anew.seen.standing_x_m[b + 1] + anew.readings.x_m[k * anew.blocks + b + 1] +
                                      moved.base_displacement_m.values[row];
            EXPECT_NEAR(window.tracks[2].places[3 * k + b].x_m + window.samples[k].base_x_m, laboratory, 2e-6);
            EXPECT_NEAR(window.tracks[0].places[3 * k + b].x_m + window.samples[k].base_x_m,
                        run.blocks.x_m.values[3 * row + b], 1e-12);
        }
    }
}

TEST_F(ShownWindows, OfFastCamerasAreThinnedAndEndWithTheWindow)
{
    Campaign fast = campaign_;
    for (MeasuredRun& run :
         fast.runs) { // as if the cameras had 3000 Hz: every sample six times, with a clock of its own
        const MeasuredRun slow = run;
        run.time_s.clear();
        for (Series* series : {&run.base_acceleration_m_s2, &run.base_displacement_m, &run.blocks.x_m, &run.blocks.y_m,
                               &run.blocks.theta_rad})
            series->values.clear();
        for (std::size_t k = 0; k + 1 < slow.time_s.size(); ++k)
            for (int part = 0; part < 6; ++part) {
                const double share = part / 6.0;
                const auto between = [&](const Series& from, Series& to, std::size_t n) {
                    for (std::size_t b = 0; b < n; ++b)
                        to.values.push_back((1 - share) * from.values[k * n + b] +
                                            share * from.values[(k + 1) * n + b]);
                };
                run.time_s.push_back((1 - share) * slow.time_s[k] + share * slow.time_s[k + 1]);
                between(slow.base_acceleration_m_s2, run.base_acceleration_m_s2, 1);
                between(slow.base_displacement_m, run.base_displacement_m, 1);
                between(slow.blocks.x_m, run.blocks.x_m, 3);
                between(slow.blocks.y_m, run.blocks.y_m, 3);
                between(slow.blocks.theta_rad, run.blocks.theta_rad, 3);
            }
        run.rate_hz *= 6;
    }
    const std::vector<ChosenWindow> chosen = chosen_of(fast, wrong_, excess_, places_);
    const auto motion = window_motions(chosen, {{"wrong", fast, wrong_}}, {}, one_thread, cost_, observer_);
    ASSERT_TRUE(motion);
    for (const WindowMotion& window : motion->windows) {
        EXPECT_LE(window.samples.size(), most_shown_samples);
        EXPECT_GT(window.samples.size(), most_shown_samples / 2);
        EXPECT_EQ(window.samples.back().time_s, window.to_s);
        const double spacing = window.samples[1].time_s - window.samples[0].time_s;
        EXPECT_NEAR(spacing, 3 / 3000.0, 1e-9); // 600 samples in a window of 0.2 s
        EXPECT_LT(window.samples.front().time_s - window.from_s, spacing + 1e-9);
    }
}

TEST_F(ShownWindows, AreAsManyAsTheBudgetHolds)
{
    // 100 samples of 3 blocks in a window: 24 bytes a sample, and 32 for each place in two tracks
    for (const auto& [budget_mb, windows, samples] :
         {std::tuple{0.09, 4U, 100U}, {0.08, 3U, 100U}, {0.05, 2U, 100U}, {0.02, 2U, 34U}}) {
        const auto motion =
            window_motions(chosen_, {{"wrong", campaign_, wrong_}}, {}, one_thread, cost_, observer_, budget_mb);
        ASSERT_TRUE(motion);
        EXPECT_EQ(motion->windows.size(), windows) << budget_mb;
        double bytes = 0;
        for (const WindowMotion& window : motion->windows) {
            EXPECT_NEAR(static_cast<double>(window.samples.size()), samples, 1) << budget_mb;
            EXPECT_EQ(window.samples.back().time_s, window.to_s);
            bytes += 24.0 * static_cast<double>(window.samples.size());
            for (const MotionTrack& track : window.tracks)
                bytes += 32.0 * static_cast<double>(track.places.size());
        }
        EXPECT_LE(bytes, 1e6 * budget_mb);
        EXPECT_EQ(motion->windows[0].rank, 1U);
        EXPECT_EQ(motion->windows[1].choice, WindowChoice::typical);
    }
}

TEST_F(ShownWindows, AreNoneWhereNoneWasChosenOrTheObserverStopped)
{
    EXPECT_FALSE(window_motions({}, {{"wrong", campaign_, wrong_}}, {}, one_thread, cost_, observer_));
    class Stopping : public Observer {
    public:
        bool stop_requested() override { return true; }
    } stopping;
    EXPECT_FALSE(window_motions(chosen_, {{"wrong", campaign_, wrong_}}, {}, one_thread, cost_, stopping));
}

} // namespace
} // namespace stylobate
