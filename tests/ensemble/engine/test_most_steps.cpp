/// About how many steps a realization takes at most, known before it is made: against what a lane that has it knows.

#include "ensemble/experiment.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/drawn_motions.hpp"
#include "io/study/study_file.hpp"
#include "kernels/isa.hpp"
#include "tests/ensemble/engine/rigid_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {
namespace {

Study study_of(const std::string& file, const std::vector<std::string>& settings)
{
    return read_study(std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/" + file, settings);
}

const std::vector<std::string> small{"study.realizations=8",
                                     "surface.frequency_hz={ from = 0.5, to = 10.0, count = 4, spacing = \"log\" }",
                                     "surface.pga_m_s2={ from = 1.0, to = 12.0, count = 3 }"};

std::vector<std::string> small_and(const std::string& more)
{
    std::vector<std::string> settings = small;
    settings.push_back(more);
    return settings;
}

Motion chirp()
{
    std::vector<double> samples;
    for (int i = 0; i < 200; ++i)
        samples.push_back(std::cos(0.02 * std::numbers::pi * (1 + 0.01 * i) * i));
    Motion motion = motion_of(samples, 0.01);
    motion.predominant_frequency_hz = 2;
    return motion;
}

/// `Watch::last_step` of every `every`-th realization, and what the sampler says of it before.
std::vector<std::pair<double, double>> both(const Study& study, std::uint64_t every = 1, const Motions& motions = {})
{
    const Experiment experiment(study, motions);
    const Realization pattern = experiment.sampler().realization(0);
    LaneSet lane(experiment.study(), experiment.record(), kernels(Isa::scalar), pattern);
    std::vector<std::pair<double, double>> steps;
    for (std::uint64_t index = 0; index < study.total(); index += every) {
        lane.load(0, experiment.sampler().realization(index));
        steps.emplace_back(static_cast<double>(lane.place(0).watch.last_step), experiment.sampler().most_steps(index));
    }
    return steps;
}

/// Those of the lane are as many within a tenth, and in nearly the same order.
void agree(const Study& study, std::uint64_t every = 1, const Motions& motions = {})
{
    const std::vector<std::pair<double, double>> steps = both(study, every, motions);
    ASSERT_GT(steps.size(), 25U);
    std::size_t pairs = 0, same = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_NEAR(steps[i].second, steps[i].first, 0.1 * steps[i].first + chunk_steps);
        for (std::size_t j = 0; j < i; ++j) {
            if (std::abs(steps[i].first - steps[j].first) < 0.02 * steps[i].first)
                continue;
            ++pairs;
            same += (steps[i].first < steps[j].first) == (steps[i].second < steps[j].second);
        }
    }
    EXPECT_GE(static_cast<double>(same), 0.97 * static_cast<double>(pairs));
}

} // namespace

TEST(MostSteps, OfASurfaceAreThoseOfTheLane)
{
    agree(study_of("small_scale_column.toml", small));
    agree(rigid_of(study_of("small_scale_column.toml", small)));
    agree(study_of("small_scale_colonnade_drums.toml", {"study.realizations=2"}), 4);
    for (const ExcitationKind kind : {ExcitationKind::ricker, ExcitationKind::half_sine, ExcitationKind::full_sine}) {
        Study study = study_of("small_scale_column.toml", small);
        study.excitation.kind = kind;
        agree(study);
    }
}

/// Replicas have the steps of their form, and those in another step more.
TEST(MostSteps, OfReplicasAreThoseOfTheirForm)
{
    const Study study = study_of("twins_column.toml", {"study.realizations=2", "twins.followed=2"});
    ASSERT_NE(study.design().replica_set, nullptr);
    const Experiment experiment(study);
    for (std::uint64_t index = 0; index < study.total(); index += 13) {
        const Realization realization = experiment.sampler().realization(index);
        const double longest = longest_s(experiment, realization) / realization.step_s;
        EXPECT_NEAR(experiment.sampler().most_steps(index), longest, 0.1 * longest);
    }
}

TEST(MostSteps, OfNoiseAreThoseOfTheLane)
{
    agree(study_of("synthetic_earthquake.toml", {"study.realizations=8"}), 3);
}

TEST(MostSteps, OfARecordAreThoseOfTheLane)
{
    Study study = study_of("small_scale_column.toml", small);
    study.excitation.kind = ExcitationKind::record;
    agree(study, 1, {.record = chirp()});
    study = study_of("small_scale_column.toml", small_and("mechanisms.time_offset={ offset_s = 0.3 }"));
    study.excitation.kind = ExcitationKind::record;
    agree(study, 1, {.record = chirp()});
}

TEST(MostSteps, OfAFragilityStudyAreThoseOfTheLane)
{
    const Study study =
        study_of("fragility_column.toml", {"study.realizations=2", "fragility.contacts=1", "fragility.twins=2",
                                           "fragility.motions=14", "fragility.intensity.count=2"});
    MotionSet pulses = drawn_motions(study);
    pulses.measures.push_back({"pgv_m_s", 1, {}});
    for (const auto& motion : pulses.motions)
        pulses.measures.back().value.push_back(peak(motion->velocity_m_s));
    agree(study, 1, {.drawn = std::make_shared<const MotionSet>(std::move(pulses))});
}

/// The drawn stiffness counts as much as the frequency: by the frequency alone the longest ones are not found.
TEST(MostSteps, FindTheLongestOfASurface)
{
    const Study study = study_of("small_scale_column.toml", {"study.realizations=4"});
    std::vector<std::pair<double, double>> steps = both(study);
    const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.begin() + 64); // of the lowest frequency
    EXPECT_GT(longest->first, 2 * shortest->first);
    constexpr std::size_t some = 16;
    std::sort(steps.begin(), steps.end(), [](auto a, auto b) { return a.second > b.second; });
    std::vector<double> by_lane;
    for (const auto& [last_step, said] : steps)
        by_lane.push_back(last_step);
    std::sort(by_lane.begin(), by_lane.end(), std::greater<>());
    EXPECT_GE(steps.front().first, 0.95 * by_lane.front());
    for (std::size_t i = 0; i < some; ++i) // none of the longest is missing
        EXPECT_GE(steps[i].first, 0.9 * by_lane[some - 1]);
}

} // namespace stylobate
