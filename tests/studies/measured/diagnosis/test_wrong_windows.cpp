/// Errors of the baseline, and the motion that is drawn there.

#include "ensemble/tracking/specimen.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/window_evidence.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace stylobate;

namespace {

/// What the specimen really is.
Study right_study(const SyntheticCampaign& c, const Campaign& campaign)
{
    Study study = default_study(campaign);
    study.contact = truth_of(c).contact;
    return study;
}

SyntheticCampaign two_runs()
{
    SyntheticCampaign c;
    c.runs = 2;
    return c;
}

} // namespace

TEST(WindowCurves, AreTheMotionThatTheResidualsAreOf)
{
    const SyntheticCampaign c = two_runs();
    const Campaign campaign = measure(c);
    ModelVariant variant;
    variant.study = right_study(c, campaign);
    variant.study.contact.friction = 0.25;
    WindowComparison comparison(campaign, {});
    Observer observer;
    const RunOptions options{best_isa(), 1};
    const std::vector<WindowResiduals> z = comparison.residuals({variant}, options, observer);
    ASSERT_EQ(z.size(), 1U);
    // windows of the second run
    std::vector<std::size_t> windows;
    for (std::size_t w = 0; w < comparison.windows().size() && windows.size() < 3; ++w)
        if (comparison.windows()[w].run == 1 && w % 2 == 1)
            windows.push_back(w);
    ASSERT_EQ(windows.size(), 3U);
    const auto block = static_cast<std::size_t>(build_specimen(campaign.specimen).block[1]);
    const std::vector<WindowCurve> curves = comparison.curves(variant, windows, {block}, options, observer);
    ASSERT_EQ(curves.size(), 3U);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const WindowCurve& curve = curves[i];
        const WindowPlace& place = comparison.windows()[windows[i]];
        ASSERT_GT(curve.time_s.size(), 20U);
        EXPECT_GT(curve.time_s.front(), place.start_s);
        EXPECT_NEAR(curve.time_s.back(), place.end_s, 1e-9);
        // a window ends with a sample that is scored: what is drawn there lies off by the residual
        const auto& seen = comparison.seen(windows[i]);
        const std::size_t last = std::max_element(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
                                     return a.time < b.time;
                                 })->time;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            if (seen[k].block != block || seen[k].time != last)
                continue;
            const auto of = static_cast<std::size_t>(seen[k].coordinate);
            EXPECT_EQ(curve.seen[of].back(), seen[k].value);
            EXPECT_NEAR(curve.model[of].back() - curve.seen[of].back(), z[0][windows[i]][k] * seen[k].scale, 1e-12);
            ++compared;
        }
    }
    EXPECT_EQ(compared, 9U); // x, y and rotation of three windows
}

TEST(WindowCurves, OfABlockOnTheGroundAreItsOwnToo)
{
    // the same campaign, said to stand on the table itself instead of on a block fixed to it: the ground is then a
    // block of the realization too, and to the right model the motion is the same
    const SyntheticCampaign c = two_runs();
    Campaign campaign = measure(c);
    Specimen& s = campaign.specimen;
    for (double& y : s.rest_y_m)
        y -= s.base_block_top_m;
    for (MeasuredRun& run : campaign.runs)
        for (double& y : run.blocks.y_m.values)
            y -= s.base_block_top_m;
    s.base_block_half_width_m.reset();
    s.base_block_top_m = 0;
    ModelVariant variant;
    variant.study = right_study(c, campaign);
    WindowComparison comparison(campaign, {});
    Observer observer;
    const std::vector<WindowResiduals> z = comparison.residuals({variant}, {best_isa(), 1}, observer);
    ASSERT_EQ(z.size(), 1U);
    // where it moves most, from sample to sample it does not jump to another block
    std::size_t strongest = 0;
    double most = 0;
    for (std::size_t w = 0; w < z[0].size(); ++w)
        for (const SeenValue& seen : comparison.seen(w))
            if (comparison.windows()[w].run == 0 && seen.coordinate == BlockCoordinate::x &&
                std::fabs(seen.value) > most) {
                most = std::fabs(seen.value);
                strongest = w;
            }
    ASSERT_GT(most, 2e-3);
    const auto block = static_cast<std::size_t>(build_specimen(s).block.back());
    const std::vector<WindowCurve> curves = comparison.curves(variant, {strongest}, {block}, {best_isa(), 1}, observer);
    ASSERT_EQ(curves.size(), 1U);
    for (std::size_t k = 1; k < curves[0].time_s.size(); ++k)
        EXPECT_LT(std::fabs(curves[0].model[0][k] - curves[0].model[0][k - 1]), 0.5 * most) << k;
    // and the residuals at its end are of the same block
    std::size_t compared = 0;
    for (std::size_t k = 0; k < z[0][strongest].size(); ++k) {
        const SeenValue& seen = comparison.seen(strongest)[k];
        if (seen.block != block || seen.time != 1)
            continue;
        const auto of = static_cast<std::size_t>(seen.coordinate);
        EXPECT_NEAR(curves[0].model[of].back() - curves[0].seen[of].back(), z[0][strongest][k] * seen.scale, 1e-12);
        ++compared;
    }
    EXPECT_EQ(compared, 3U);
}

TEST(WrongWindows, DrawsMeasuredAndSimulatedWhereTheModelIsWrong)
{
    const SyntheticCampaign c = two_runs();
    const Campaign campaign = measure(c);
    Study wrong = right_study(c, campaign);
    wrong.contact.friction = 0.2; // of 0.5
    Observer observer;
    SimulationCount count;
    const WrongWindows found = wrong_windows(campaign, wrong, 20, {best_isa(), 1}, count, observer);
    ASSERT_FALSE(found.stretches.empty());
    ASSERT_GE(found.figures.size(), 2U); // x and rotation of one block, or of two
    EXPECT_EQ(found.figures.size() % 2, 0U);
    const WrongStretch& worst = found.stretches.front();
    for (std::size_t i = 0; i < 2; ++i) {
        const DiagnosisFigure& figure = found.figures[i];
        EXPECT_EQ(figure.place, FigurePlace::wrong);
        EXPECT_NE(figure.title.find("Run " + worst.run + ", block " + std::to_string(worst.block)), std::string::npos)
            << figure.title;
        ASSERT_GE(figure.series.size(), 2U);
        const FigureSeries &seen = figure.series[0], &model = figure.series[1];
        EXPECT_NE(seen.name.find("measured"), std::string::npos);
        EXPECT_EQ(seen.kind, SeriesKind::line);
        ASSERT_EQ(seen.low.size(), seen.x.size()); // the band of noise: two standard deviations on each side
        const bool thousandths = figure.y_label.ends_with("[mm]") || figure.y_label.ends_with("[mrad]");
        const double sd = (thousandths ? 1000 : 1) * (i == 0 ? c.camera_noise_m : c.camera_noise_rad);
        EXPECT_NEAR(seen.high[5] - seen.low[5], 4 * sd, 1e-9 * sd);
        EXPECT_GT(model.x.size(), 100U);
    }
    // the window that is worst is marked in the figure of its coordinate
    const DiagnosisFigure& of = found.figures[worst.coordinate == "theta" ? 1 : 0];
    if (worst.coordinate != "y") {
        ASSERT_EQ(of.series.size(), 3U);
        const FigureSeries& spans = of.series[2];
        EXPECT_EQ(spans.kind, SeriesKind::spans);
        ASSERT_EQ(spans.x.size(), spans.y.size());
        bool inside = false;
        for (std::size_t k = 0; k < spans.x.size(); ++k)
            inside = inside || (spans.x[k] < worst.to_s && spans.y[k] > worst.from_s);
        EXPECT_TRUE(inside);
    }
    // the first of the windows that are shown in motion is the worst one of that stretch
    ASSERT_FALSE(found.shown.empty());
    EXPECT_EQ(found.shown.front().rank, 1U);
    EXPECT_EQ(campaign.runs[found.shown.front().place.run].name, worst.run);
    EXPECT_GE(found.shown.front().place.start_s, worst.from_s);
    EXPECT_LE(found.shown.front().place.end_s, worst.to_s);
    // measured and simulated differ where it is marked, and the model knows no measured sample beyond the start
    EXPECT_GT(count.window_simulations, 10U);

    // of the right model nothing is off by as much
    const WrongWindows right = wrong_windows(campaign, right_study(c, campaign), 20, {best_isa(), 1}, count, observer);
    const double excess = right.stretches.empty() ? 0 : right.stretches.front().excess;
    EXPECT_LT(excess, worst.excess / 2);
}
