#include "bench/peers/column.hpp"

#include "bench/peers/engine.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace stylobate::peers {

namespace {

constexpr int least_columns = 3;

} // namespace

Scene scene_of(const Study& study, const Realization& realization)
{
    Scene scene;
    scene.gravity_m_s2 = realization.gravity_m_s2 * std::cos(realization.base_tilt_rad);
    for (const Block& b : realization.blocks)
        scene.bodies.push_back(
            {b.half_width_m, b.half_height_m, study.structure.depth_m, b.mass_kg, {b.x_m, b.y_m, 0}, b.fixed});
    for (const Joint& j : realization.joints)
        if (j.lower + 1 == j.upper)
            scene.bodies[static_cast<std::size_t>(j.upper)].friction = j.friction;
    return scene;
}

double leaning_acceleration(const Realization& realization)
{
    return -realization.gravity_m_s2 * std::sin(realization.base_tilt_rad);
}

bool has_fallen(const World& world, const Scene& scene, const Study& study)
{
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (!(world.pose(i).y_m >= study.outcome.collapse_height_fraction * scene.bodies[i].start.y_m))
            return true;
    return false;
}

double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Study column_study(bool shaken, double normal_stiffness_n_m2)
{
    Study study = rocking_column(7);
    study.realizations = most_columns;
    study.contact.normal_stiffness_n_m2 = normal_stiffness_n_m2;
    study.contact.tangential_stiffness_n_m = normal_stiffness_n_m2 * 0.048;
    study.excitation.cycles = column_seconds * study.excitation.frequency_hz;
    study.excitation.tail_s = 0;
    if (!shaken) {
        study.excitation = {};
        study.excitation.duration_s = column_seconds;
    }
    Perturbation offset;
    offset.quantity = Quantity::drum_offset;
    offset.per = Per::block;
    offset.sd = 1e-6;
    study.perturbations = {offset};
    return study;
}

Columns run_columns(const Engine& engine, std::size_t setting, double step_s, bool shaken, double seconds)
{
    const Study study = column_study(shaken);
    const Sampler sampler(study, nullptr);
    Columns columns;
    std::vector<double> best(static_cast<std::size_t>(column_seconds), std::numeric_limits<double>::infinity());
    const double start = processor_seconds();
    while (columns.count < least_columns || (columns.count < most_columns && processor_seconds() - start < seconds)) {
        const Realization r = sampler.realization(static_cast<std::uint64_t>(columns.count++));
        const BaseMotion base(study.excitation, r, nullptr);
        const Scene scene = scene_of(study, r);
        const auto world = engine.make(scene, setting, step_s);
        bool collapsed = false;
        int n = 0;
        for (std::size_t second = 0; second < best.size() && !collapsed; ++second) {
            const double begin = processor_seconds();
            for (; n * step_s < static_cast<double>(second + 1) && !collapsed; ++n) {
                world->step(shaken ? mean_acceleration(base, n, step_s) : 0);
                collapsed = n % 16 == 15 && has_fallen(*world, scene, study);
            }
            if (!collapsed)
                best[second] = std::min(best[second], processor_seconds() - begin);
        }
        collapsed = collapsed || has_fallen(*world, scene, study);
        columns.collapsed += collapsed;
        const Body& top = scene.bodies.back();
        columns.moved += collapsed || !(std::fabs(world->pose(scene.bodies.size() - 1).x_m - top.start.x_m) <
                                        0.02 * top.half_width_m);
    }
    double spent = 0;
    int seen = 0;
    for (const double second : best)
        if (std::isfinite(second)) {
            spent += second;
            ++seen;
        }
    columns.realizations_per_second = seen > 0 ? seen / spent / column_seconds : 0;
    return columns;
}

} // namespace stylobate::peers
