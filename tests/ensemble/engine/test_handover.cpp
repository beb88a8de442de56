/// How realizations go from rigid contacts to contacts that yield: what goes on, and that nothing has met before.

#include "ensemble/experiment.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace stylobate {
namespace {

constexpr int lane = 0;

/// A column, or two columns of two drums, that fall.
Study falling(const char* input, Follow follow)
{
    Study study = rigid_of(read_study(std::string(STYLOBATE_SOURCE_DIR "/studies/inputs/").append(input),
                                      {"study.realizations=4", "excitation.cycles=6",
                                       "surface.frequency_hz={ from = 1.5, to = 3.0, count = 2 }",
                                       "surface.pga_m_s2={ from = 10.0, to = 16.0, count = 2 }"}));
    study.outcome.follow = follow;
    return study;
}
constexpr const char *column = "small_scale_column.toml", *colonnade = "small_scale_colonnade_drums.toml";

/// What the rigid contacts hand over of every realization that they do.
std::vector<HandOver> handed(const Study& study)
{
    const Experiment experiment(study);
    std::vector<HandOver> all;
    for (std::uint64_t i = 0; i < study.total(); ++i) {
        const Realization r = experiment.sampler().realization(i);
        LaneSet lanes(study, nullptr, kernels(Isa::scalar), r);
        lanes.load(lane, r);
        while (!lanes.done(lane))
            lanes.advance();
        if (lanes.handed(lane))
            all.push_back(*lanes.handed(lane));
    }
    return all;
}

/// How deep two rectangles lie in each other: the least overlap of their shadows on the normals of their sides
/// (separating axes). Below 0 they are apart by so much at least.
double overlap_m(const Block& a, const BlockMotion& am, const Block& b, const BlockMotion& bm)
{
    const double x = b.x_m + bm.x_m - a.x_m - am.x_m, y = b.y_m + bm.y_m - a.y_m - am.y_m;
    double least = 1e300;
    for (const double turn :
         {am.theta_rad, am.theta_rad + std::numbers::pi / 2, bm.theta_rad, bm.theta_rad + std::numbers::pi / 2}) {
        const auto reach = [turn](const Block& of, double theta) {
            return of.half_width_m * std::fabs(std::cos(theta - turn)) +
                   of.half_height_m * std::fabs(std::sin(theta - turn));
        };
        const double apart = std::fabs(x * std::cos(turn) + y * std::sin(turn));
        least = std::min(least, reach(a, am.theta_rad) + reach(b, bm.theta_rad) - apart);
    }
    return least;
}

TEST(Handover, ComesBeforeBlocksMeetOtherwiseThanAtBeds)
{
    for (const auto& [input, follow] : {std::pair(column, Follow::rest), std::pair(colonnade, Follow::collapse)}) {
        const std::vector<HandOver> all = handed(falling(input, follow));
        ASSERT_GT(all.size(), 6U) << input;
        for (const HandOver& h : all) {
            const Realization& r = h.realization;
            for (int j = 0; j < static_cast<int>(r.joints.size()); ++j) {
                const auto l = static_cast<std::size_t>(r.joints[static_cast<std::size_t>(j)].lower),
                           u = static_cast<std::size_t>(r.joints[static_cast<std::size_t>(j)].upper);
                const double least =
                    std::min({r.blocks[l].half_width_m, r.blocks[l].half_height_m, r.blocks[u].half_width_m});
                // beds have what their corners may have entered in an impact
                EXPECT_LT(overlap_m(r.blocks[l], h.measured.moved[l], r.blocks[u], h.measured.moved[u]),
                          j < r.beds() ? 0.02 * least : 0)
                    << input << ' ' << r.index << ": " << l << " and " << u;
            }
        }
    }
}

TEST(Handover, TimePlaceAndVelocityGoOn)
{
    const Study study = falling(column, Follow::rest);
    const std::vector<HandOver> all = handed(study);
    ASSERT_FALSE(all.empty());
    for (const HandOver& h : all) {
        LaneSet set(study, nullptr, kernels(Isa::scalar), compliant_form(h.realization));
        take_over(set, lane, h);
        const double step_s = set.realization(lane).step_s, rigid_s = h.realization.step_s;
        // the middle of the last rigid step, where its increment is the velocity
        const double begin_s = (static_cast<double>(h.watch.steps) - 0.5) * rigid_s;
        EXPECT_NEAR(static_cast<double>(set.steps(lane)) * step_s, begin_s, 1e-9);
        const Snapshot before = set.snapshot(lane);
        set.advance(0, 1);
        const Snapshot after = set.snapshot(lane);
        for (std::size_t i = 0; i < h.measured.moved.size(); ++i) {
            const Block& block = h.realization.blocks[i];
            if (block.fixed)
                continue;
            EXPECT_NEAR(before.x_m[i], block.x_m + h.measured.moved[i].x_m - h.increment[i].x_m / 2, 1e-12);
            EXPECT_NEAR(before.theta_rad[i], h.measured.moved[i].theta_rad - h.increment[i].theta_rad / 2, 1e-12);
            // contacts carry nothing yet: only gravity and the base change the velocity
            EXPECT_NEAR((after.x_m[i] - before.x_m[i]) / step_s, h.increment[i].x_m / rigid_s, 50 * step_s + 1e-3);
            EXPECT_NEAR((after.y_m[i] - before.y_m[i]) / step_s, h.increment[i].y_m / rigid_s, 50 * step_s + 1e-3);
        }
    }
}

TEST(Handover, EnergyBalancesFromTheStartToTheEnd)
{
    for (const char* input : {column, colonnade}) {
        const Study study = falling(input, Follow::rest);
        int fallen = 0;
        for (const Outcome& o : outcomes_of(study, {best_isa(), 2})) {
            EXPECT_NE(o.state, State::invalid) << input;
            EXPECT_LT(std::fabs(o.energy_residual), 0.05) << input;
            fallen += o.fallen_blocks > 1;
            if (o.state == State::collapsed) {
                EXPECT_GE(o.end_time_s, o.collapse_time_s);
                EXPECT_LT(o.energy_potential_j, 0);
            }
        }
        EXPECT_GT(fallen, 6) << input;
    }
}

} // namespace
} // namespace stylobate
