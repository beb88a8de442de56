/// Full-scale columns that fall, followed until what has fallen lies: flat blows of long faces break no energy bound.

#include "ensemble/planar/structure/step_bound.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stylobate {
namespace {

/// Strong slow shaking, contacts of many stiffnesses and dashpots. @param blocks that stand on the ground
Study falling(int blocks, double width_m, double height_m, int realizations)
{
    return parse_study(fmt::format(R"(
[study]
kind = "single"
seed = {}
realizations = {}
[structure]
kind = "column"
blocks = {}
fixed_blocks = 0
drum_width_m = {}
drum_height_m = {}
depth_m = 1.0
density_kg_m3 = 2700
[contact]
normal_stiffness_n_m2 = 3e9
normal_damping_ratio = 0.1
tangential_damping_ratio = 0.1
friction = 0.6
[excitation]
kind = "full_sine"
frequency_hz = 0.5
pga_m_s2 = 8
[perturbation]
friction = {{ distribution = "normal", cov = 0.10, min = 0.36, max = 0.84, per = "joint" }}
normal_stiffness = {{ distribution = "lognormal", sigma_ln = 0.7, per = "structure" }}
damping_ratio = {{ distribution = "log_uniform", from = 0.01, to = 0.5, per = "structure" }}
drum_width = {{ distribution = "normal", sd_m = 0.002, per = "block" }}
[outcome]
follow = "rest"
)",
                                   blocks + 1, realizations, blocks, width_m, height_m),
                       "falling.toml");
}

struct Ends {
    int invalid = 0, collapsed = 0;
    double most_residual = 0;
};

Ends ends_of(const Study& study)
{
    Ends ends;
    RunPlan plan;
    plan.total = study.realizations;
    plan.sink = [&](const Realization&, const Outcome& o) {
        ends.invalid += o.state == State::invalid;
        ends.collapsed += o.state == State::collapsed;
        ends.most_residual = std::max(ends.most_residual, std::fabs(o.energy_residual));
    };
    Observer observer;
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, observer);
    return ends;
}

TEST(Falling, ABlockOnTheGroundFallsFlat)
{
    int collapsed = 0;
    for (const double height_m : {2.5, 4.0, 6.0, 9.0}) {
        const Ends ends = ends_of(falling(1, 1, height_m, 24));
        EXPECT_EQ(ends.invalid, 0) << height_m;
        EXPECT_LT(ends.most_residual, 0.1) << height_m;
        collapsed += ends.collapsed;
    }
    EXPECT_GT(collapsed, 40) << "of 96";
}

TEST(Falling, ColumnsOfDrumsFallFlat)
{
    int collapsed = 0;
    for (const auto& [blocks, height_m] : {std::pair{2, 2.5}, {3, 1.4}}) {
        const Ends ends = ends_of(falling(blocks, 1, height_m, 48));
        EXPECT_EQ(ends.invalid, 0) << blocks;
        collapsed += ends.collapsed;
    }
    EXPECT_GT(collapsed, 30) << "of 96";
}

/// On its long face the block is held by K_N times that: the step follows it, and is the upright one's where nothing is
/// followed to rest.
TEST(Falling, TheStepIsThatOfTheLongFace)
{
    Study study = falling(1, 1, 4, 1);
    study.perturbations.clear();
    const Realization to_rest = Sampler(study, nullptr).realization(0);
    study.outcome.follow = Follow::collapse;
    const Realization until_fallen = Sampler(study, nullptr).realization(0);
    const Block& block = to_rest.blocks.front();
    const double K = 3e9 * 4;
    // lying flat, undamped: x, y and the rotation about the long face's middle are each stable below 2 / w
    const double arm = 0.5, k_t = to_rest.joints.front().tangential_stiffness_n_m;
    const double w2 =
        std::max({K / block.mass_kg, k_t / block.mass_kg, (K * 16 / 12 + k_t * arm * arm) / block.inertia_kg_m2});
    EXPECT_NEAR(to_rest.step_s * std::sqrt(w2), 0.15, 1e-9); // .9 of a sixth
    EXPECT_GT(until_fallen.step_s, to_rest.step_s);
}

} // namespace
} // namespace stylobate
