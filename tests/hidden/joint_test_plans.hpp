#pragma once
/// Plans of tests on single joints, for the tests of the virtual laboratory.

#include "tests/hidden/joint_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate::hidden {

inline constexpr double camera_rate_hz = 500;

/// A small column without runs, as it was made, and without noise or scatter by hand unless a test adds them.
inline VirtualCampaign a_column(Law law, SpecimenKind kind = SpecimenKind::small_column)
{
    Wish wish;
    wish.law = law;
    wish.specimen = kind;
    wish.effects = std::vector<std::string>{};
    wish.most_motions = 0;
    VirtualCampaign made = make_campaign(7, wish);
    made.planned.camera_m = made.planned.camera_rad = made.planned.sensor_m = 0;
    made.planned.specimen.placement_tolerance_m = 0;
    return made;
}

/// A test of a joint of a column: all below is clamped, all above the tested block away.
inline MeasuredRun plan_of(const VirtualCampaign& made, RunKind kind, int joint, double duration_s)
{
    MeasuredRun run;
    run.name = "test";
    run.test = kind;
    run.joint = joint;
    run.rate_hz = camera_rate_hz;
    const int tested = made.model.beds[static_cast<std::size_t>(joint)].upper;
    for (int i = 0; i <= tested; ++i)
        run.present.push_back(i);
    for (int j = 0; j < joint; ++j)
        run.clamped.push_back(j);
    for (int k = 0; k <= std::lround(duration_s * camera_rate_hz); ++k)
        run.time_s.push_back(k / camera_rate_hz);
    return run;
}

/// Two dummies like the tested block, taped on top of it.
inline void tape_dummies(const VirtualCampaign& made, MeasuredRun& run)
{
    const Specimen& s = made.planned.specimen;
    const auto b = static_cast<std::size_t>(run.present.back());
    for (const int storey : {1, 2})
        run.dummies.push_back({run.present.back(), s.mass_kg[b], s.half_width_m[b], s.half_height_m[b], 0,
                               2 * s.half_height_m[b] * storey});
}

inline ForceGauge gauge_on(const MeasuredRun& run, double height_m, bool to_laboratory, double speed_m_s)
{
    ForceGauge gauge;
    gauge.name = "rod";
    gauge.block = run.present.back();
    gauge.height_m = height_m;
    gauge.to_laboratory = to_laboratory;
    gauge.speed_m_s = speed_m_s;
    gauge.stiffness_n_m = 2e4;
    gauge.gain_sd = 1e-12;
    gauge.value_n.noise_sd = 0;
    return gauge;
}

/// Displacement of a table that goes to and fro with a constant speed and turns within 20 ms.
inline void go_to_and_fro(MeasuredRun& run, double stroke_m, double speed_m_s, double from_s)
{
    const double quarter = stroke_m / speed_m_s, blend = 0.02;
    const auto speed = [&](double t) {
        if (t < from_s)
            return 0.0;
        const double turns = (t - from_s + quarter) / (2 * quarter),
                     to_next = (turns - std::floor(turns)) * 2 * quarter;
        const double side = std::lround(std::floor(turns)) % 2 == 0 ? 1 : -1;
        if (t - from_s < blend)
            return speed_m_s * 0.5 * (1 - std::cos(std::numbers::pi * (t - from_s) / blend));
        if (to_next < blend && turns >= 1)
            return -side * speed_m_s * std::cos(std::numbers::pi * to_next / blend);
        return side * speed_m_s;
    };
    double u = 0;
    for (std::size_t k = 0; k < run.time_s.size(); ++k) {
        run.base_displacement_m.values.push_back(u);
        for (int part = 0; part < 20; ++part)
            u += speed(run.time_s[k] + (part + 0.5) / 20 / camera_rate_hz) / 20 / camera_rate_hz;
    }
}

inline MeasuredRun do_test(const VirtualCampaign& made, const MeasuredRun& planned)
{
    return performed(made, planned, 3, nullptr, nullptr);
}

inline double column(const VirtualCampaign& made, const Series& series, std::size_t k, int block)
{
    return series.values[k * static_cast<std::size_t>(made.model.body_count) + static_cast<std::size_t>(block)];
}

inline MeasuredRun pull_of(const VirtualCampaign& made, int joint, double speed_m_s, double duration_s = 4)
{
    MeasuredRun plan = plan_of(made, RunKind::pull, joint, duration_s);
    go_to_and_fro(plan, 0.008, speed_m_s, 0.5);
    plan.forces = {gauge_on(plan, 0.00725, true, 0)};
    return plan;
}

inline MeasuredRun drop_of(const VirtualCampaign& made)
{
    MeasuredRun plan = plan_of(made, RunKind::drop, 1, 1.2);
    tape_dummies(made, plan);
    plan.released_s = 0.2;
    const Specimen& s = made.planned.specimen;
    const double missing = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < plan.time_s.size(); ++k)
        for (int i = 0; i < made.model.body_count; ++i) {
            const bool held = i == 1 && plan.time_s[k] <= 0.2;
            plan.blocks.x_m.values.push_back(held ? s.rest_x_m[1] : missing);
            plan.blocks.y_m.values.push_back(held ? s.rest_y_m[1] + 0.003 : missing);
            plan.blocks.theta_rad.values.push_back(held ? 0 : missing);
        }
    return plan;
}

} // namespace stylobate::hidden
