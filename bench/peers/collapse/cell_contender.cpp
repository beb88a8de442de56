#include "bench/peers/collapse/cell_contender.hpp"

#include "bench/peers/column.hpp"
#include "bench/peers/engine.hpp"
#include "ensemble/planar/limit_states.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate::peers {

namespace {

constexpr int check_steps_of_engines = 16;
constexpr int engine_levels = 6, rigid_levels = 7,
              compliant_levels = 3; ///< to 1/3840 s; to 1/7680 s; to a quarter of a study's step

/// The setting of each engine with which impacts converge at the least cost; of one that is not here the first.
constexpr std::pair<const char*, const char*> chosen_settings[]{{"Box2D", "8 + 3 iterations, unit 5 mm"},
                                                                {"Chipmunk", "10 iterations"},
                                                                {"Bullet", "10 iterations"},
                                                                {"MuJoCo", "stiff contacts"},
                                                                {"ODE", "QuickStep, 20 iterations"}};

bool is_chosen(const Engine& engine, std::size_t setting)
{
    for (const auto& [name, text] : chosen_settings)
        if (engine.name == name)
            return engine.settings[setting] == text;
    return setting == 0;
}

/// The draws as rigid blocks have them: faces just touch.
Study rigid_study(const Cell& cell, double step_s)
{
    Law law;
    law.step_s = step_s;
    return cell_study(cell, law, 1'000'000);
}

Draws run_engine(const Engine& engine, std::size_t setting, const Cell& cell, int level, std::uint64_t begin,
                 std::uint64_t end)
{
    const Study study = rigid_study(cell, halved_step(level));
    const Sampler sampler(study, nullptr);
    Draws draws;
    const double start = processor_seconds();
    for (std::uint64_t i = begin; i < end; ++i) {
        const DrawEnd one = run_draw(engine, setting, halved_step(level), study, sampler.realization(i));
        draws.collapsed.push_back(one.collapsed);
        draws.simulated_s += one.time_s;
    }
    draws.processor_s = processor_seconds() - start;
    return draws;
}

Draws run_own(const Study& study, std::uint64_t begin, std::uint64_t end)
{
    std::vector<std::uint64_t> indices(end - begin);
    std::iota(indices.begin(), indices.end(), begin);
    Draws draws;
    draws.collapsed.resize(indices.size());
    RunPlan plan;
    plan.total = indices.size();
    plan.indices = indices;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        draws.collapsed[r.index - begin] = o.state == State::collapsed || o.state == State::invalid;
        draws.simulated_s += o.end_time_s;
    };
    Observer quiet;
    const double start = processor_seconds();
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, quiet);
    draws.processor_s = processor_seconds() - start;
    return draws;
}

} // namespace

double halved_step(int level)
{
    return std::ldexp(1.0 / 120, -level);
}

DrawEnd run_draw(const Engine& engine, std::size_t setting, double step_s, const Study& study, const Realization& draw)
{
    const Scene scene = scene_of(study, draw);
    const auto world = engine.make(scene, setting, step_s);
    const BaseMotion base(study.excitation, draw, nullptr);
    const Block& below = draw.blocks[static_cast<std::size_t>(draw.joints.front().lower)];
    const double end_s = base.duration_s() + study.excitation.tail_s.value_or(0);
    LimitStates limits(draw, study.outcome, below.y_m + below.half_height_m,
                       static_cast<std::uint64_t>(std::ceil(1 / scales_of(draw).p_rad_s / step_s)));
    std::vector<BlockMotion> moved(draw.blocks.size());
    const std::vector<int> inside(draw.blocks.size(), -1);
    const double leaning = leaning_acceleration(draw);
    int n = 0;
    while (n * step_s < end_s) {
        world->step(leaning + (n * step_s < base.duration_s() ? mean_acceleration(base, n, step_s) : 0));
        if (++n % check_steps_of_engines != 0)
            continue;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            const Pose at = world->pose(i), &from = scene.bodies[i].start;
            moved[i] = {at.x_m - from.x_m, at.y_m - from.y_m, at.theta_rad - from.theta_rad};
            if (!std::isfinite(at.x_m + at.y_m + at.theta_rad))
                return {true, n * step_s};
        }
        limits.check(draw, static_cast<std::uint64_t>(n), moved, inside, check_steps_of_engines);
        if (limits.fallen())
            return {true, n * step_s};
    }
    limits.conclude();
    return {limits.fallen(), n * step_s};
}

std::vector<CellContender> cell_contenders(const Engine& engine, bool all_settings)
{
    std::vector<CellContender> all;
    for (std::size_t s = 0; s < engine.settings.size(); ++s) {
        if (!all_settings && !is_chosen(engine, s))
            continue;
        all.push_back({engine.name, engine.version, engine.settings[s], false, false, engine_levels,
                       [](const Cell&, int level) { return halved_step(level); },
                       [engine, s](const Cell& cell, int level, std::uint64_t begin, std::uint64_t end) {
                           return run_engine(engine, s, cell, level, begin, end);
                       }});
    }
    return all;
}

std::vector<CellContender> own_cell_contenders()
{
    std::vector<CellContender> all;
    all.push_back({"Stylobate", code_version(), "rigid blocks", true, true, rigid_levels,
                   [](const Cell&, int level) { return halved_step(level); },
                   [](const Cell& cell, int level, std::uint64_t begin, std::uint64_t end) {
                       return run_own(rigid_study(cell, halved_step(level)), begin, end);
                   }});
    const std::pair<const char*, Law> laws[]{{"two corners", {ContactForm::two_corner, 1e8, 0.1}},
                                             {"two corners", {ContactForm::two_corner, 1e8, 0.5}},
                                             {"area", {ContactForm::area, 1e8, 0.1}}};
    for (const auto& [name, law] : laws) {
        const auto study_at = [law = law](const Cell& cell, int level) {
            Study study = cell_study(cell, law, 1'000'000);
            study.run.step_fraction = std::ldexp(study.run.step_fraction, -level);
            return study;
        };
        all.push_back(
            {"Stylobate", code_version(),
             fmt::format("{}, K_N {:.0e} N/m2, damping ratio {:g}", name, law.stiffness_n_m2, law.damping_ratio), true,
             false, compliant_levels,
             [study_at](const Cell& cell, int level) {
                 return Experiment(study_at(cell, level)).sampler().realization(0).step_s;
             },
             [study_at](const Cell& cell, int level, std::uint64_t begin, std::uint64_t end) {
                 return run_own(study_at(cell, level), begin, end);
             }});
    }
    return all;
}

} // namespace stylobate::peers
