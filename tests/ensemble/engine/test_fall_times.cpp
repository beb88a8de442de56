/// When blocks fall, to a step: against a realization that is stepped one by one and looked at from outside; and that
/// no number of a block decides which fell first.

#include "ensemble/planar/planar_model.hpp"
#include "io/study/study_file.hpp"
#include "tests/ensemble/engine/ensemble_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace stylobate {
namespace {

const std::string inputs = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/";

/// Of every block the steps from which on it was outside its limits until the next check, by the criterion itself:
/// centre below a part of its height at rest above the base, or turned beyond atan(b / h).
std::vector<std::set<std::uint64_t>> starts_of(const Study& study, std::uint64_t index)
{
    const Sampler sampler(study, nullptr);
    const Realization r = sampler.realization(index);
    LaneSet lanes(study, nullptr, kernels(Isa::scalar), r);
    lanes.load(0, r);
    const Block& base = r.blocks[static_cast<std::size_t>(r.joints.front().lower)];
    const double base_top = base.y_m + base.half_height_m;
    std::vector<std::set<std::uint64_t>> starts(r.blocks.size());
    std::vector<std::uint64_t> since(r.blocks.size(), 0);
    std::vector<bool> was_outside(r.blocks.size(), false);
    for (std::uint64_t steps = 1; !lanes.outcome(0); ++steps) {
        const int k = static_cast<int>((steps - 1) % chunk_steps);
        lanes.advance(k, k + 1);
        const Snapshot s = lanes.snapshot(0);
        for (std::size_t i = 0; i < r.blocks.size(); ++i) {
            const Block& block = r.blocks[i];
            if (block.fixed)
                continue;
            const bool outside =
                s.y_m[i] - base_top < study.outcome.collapse_height_fraction * (block.y_m - base_top) ||
                std::fabs(s.theta_rad[i]) > std::atan(block.half_width_m / block.half_height_m);
            if (outside && !was_outside[i])
                since[i] = steps;
            was_outside[i] = outside;
            if (outside && steps % chunk_steps == 0)
                starts[i].insert(since[i]);
        }
    }
    return starts;
}

/// @return how many falls were not at a check
int expect_exact(const Study& study)
{
    const std::vector<Outcome> outcomes = outcomes_of(study, {best_isa(), 2});
    int collapsed = 0, between = 0;
    for (std::size_t index = 0; index < outcomes.size() && collapsed < 6; ++index) {
        const Outcome& o = outcomes[index];
        if (o.state != State::collapsed)
            continue;
        ++collapsed;
        const auto starts = starts_of(study, index);
        double first = -1;
        for (std::size_t i = 0; i < o.fall_time_s.size(); ++i) {
            if (o.fall_time_s[i] < 0)
                continue;
            const auto step = static_cast<std::uint64_t>(std::llround(o.fall_time_s[i] / o.step_s));
            EXPECT_TRUE(starts[i].contains(step)) << "realization " << index << ", block " << i << ", step " << step;
            if (study.outcome.follow == Follow::collapse) {
                EXPECT_EQ(*starts[i].rbegin(), step) << "realization " << index << ", block " << i;
            }
            between += step % chunk_steps != 0;
            first = first < 0 ? o.fall_time_s[i] : std::min(first, o.fall_time_s[i]);
        }
        EXPECT_EQ(o.collapse_time_s, first);
    }
    EXPECT_GE(collapsed, 3);
    return between;
}

Study column(const std::vector<std::string>& more)
{
    std::vector<std::string> settings{"study.realizations=12",
                                      "surface.frequency_hz={ from = 2.0, to = 2.0, count = 1 }",
                                      "surface.pga_m_s2={ from = 6.0, to = 6.0, count = 1 }"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(inputs + "small_scale_column.toml", settings);
}

TEST(FallTimes, OfAColumnAreThoseOfItsSteps)
{
    EXPECT_GE(expect_exact(column({})), 3);
}

TEST(FallTimes, InSinglePrecision)
{
    EXPECT_GE(expect_exact(column({"run.precision=single"})), 3);
}

TEST(FallTimes, OfOtherContactForms)
{
    EXPECT_GE(expect_exact(column({"contact.form=two_corner"})), 3);
    EXPECT_GE(expect_exact(column({"contact.form=points"})), 3);
}

TEST(FallTimes, OfTheExtendedModel)
{
    EXPECT_GE(expect_exact(column({"mechanisms.eccentricity={ offset_m = 0.002 }"})), 3);
}

TEST(FallTimes, OfAColonnadeThatIsFollowedToRest)
{
    EXPECT_GE(expect_exact(read_study(inputs + "small_scale_colonnade_drums.toml",
                                      {"study.realizations=12", "excitation.cycles=5",
                                       "surface.frequency_hz={ from = 2.0, to = 2.0, count = 1 }",
                                       "surface.pga_m_s2={ from = 15.0, to = 15.0, count = 1 }"})),
              10);
}

/// Mirror images shaken from both sides alike: neither column may fall first more often than by chance.
TEST(FallTimes, NeitherColumnOfASymmetricColonnadeIsFirst)
{
    const Study study =
        read_study(inputs + "full_scale_colonnade_one.toml",
                   {"study.realizations=96", "study.seed=5", "surface.frequency_hz={ from = 0.5, to = 0.5, count = 1 }",
                    "surface.pga_m_s2={ from = 4.0, to = 4.0, count = 1 }"});
    int first[2] = {}, together = 0, others = 0;
    for (const Outcome& o : outcomes_of(study, {best_isa(), 2}))
        if (o.state == State::collapsed) {
            if (o.first_collapse_block == 0 || o.first_collapse_block == 1)
                ++first[o.first_collapse_block];
            else if (o.first_collapse_block == several_blocks)
                ++together;
            else
                ++others;
        }
    const int alone = first[0] + first[1];
    EXPECT_EQ(others, 0);
    EXPECT_GT(alone, 24) << together << " together";
    // 3.3 standard deviations: by chance in one of a thousand seeds
    EXPECT_LT(std::abs(first[0] - first[1]), 3.3 * std::sqrt(alone)) << first[0] << ", " << first[1];
    RecordProperty("first", std::to_string(first[0]) + " " + std::to_string(first[1]) + " " + std::to_string(together));
}

/// A check finds two blocks outside: the steps tell which was first, and the order of their numbers does not.
TEST(FallTimes, OfTwoBlocksFoundAtOneLook)
{
    const Realization r = Experiment(column({})).sampler().realization(0);
    std::vector<BlockMotion> moved(r.blocks.size());
    moved[3].theta_rad = moved[5].theta_rad = 3;
    const auto ended = [&](int inside_3, int inside_5) {
        LimitStates limits(r, {}, 0, 1 << 20);
        std::vector<int> inside(r.blocks.size(), chunk_steps - 1);
        limits.check(r, chunk_steps, std::vector<BlockMotion>(r.blocks.size()), inside, chunk_steps);
        inside[3] = inside_3;
        inside[5] = inside_5;
        limits.check(r, 2 * chunk_steps, moved, inside, chunk_steps);
        limits.conclude();
        Outcome o;
        limits.write(r.step_s, r.drums, o);
        return o;
    };
    const Outcome later = ended(20, 10), same = ended(10, 10), whole = ended(-1, 63);
    EXPECT_EQ(later.first_collapse_block, 5);
    EXPECT_EQ(later.fall_time_s[5], (64 + 12) * r.step_s);
    EXPECT_EQ(later.fall_time_s[3], (64 + 22) * r.step_s);
    EXPECT_EQ(later.collapse_time_s, later.fall_time_s[5]);
    EXPECT_EQ(same.first_collapse_block, several_blocks);
    EXPECT_EQ(same.collapse_time_s, (64 + 12) * r.step_s);
    EXPECT_EQ(whole.first_collapse_block, 3);
    EXPECT_EQ(whole.fall_time_s[3], 65 * r.step_s);
    EXPECT_EQ(whole.fall_time_s[5], 128 * r.step_s); // inside by a rounding: outside from the last step on
}

} // namespace
} // namespace stylobate
