#pragma once
/// Two campaigns are the same bit by bit.

#include "ensemble/model/campaign.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace stylobate {

inline void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b, const std::string& what)
{
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::isnan(a[i]) && std::isnan(b[i]))
            continue;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << what << ' ' << i;
    }
}

inline void expect_same(const Series& a, const Series& b, const std::string& what)
{
    expect_same_bits(a.values, b.values, what);
    EXPECT_EQ(a.noise_sd, b.noise_sd) << what;
}

inline void expect_same(const SeenMotion& a, const SeenMotion& b, const std::string& what)
{
    expect_same(a.x_m, b.x_m, what + " x");
    expect_same(a.y_m, b.y_m, what + " y");
    expect_same(a.theta_rad, b.theta_rad, what + " theta");
}

inline void expect_same(const ForceGauge& a, const ForceGauge& b, const std::string& what)
{
    EXPECT_EQ(std::tie(a.name, a.block, a.height_m, a.gain_sd, a.to_laboratory, a.speed_m_s, a.stiffness_n_m),
              std::tie(b.name, b.block, b.height_m, b.gain_sd, b.to_laboratory, b.speed_m_s, b.stiffness_n_m))
        << what;
    expect_same(a.value_n, b.value_n, what);
}

inline void expect_same(const std::vector<MeasuredRun>& a, const std::vector<MeasuredRun>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const MeasuredRun &r = a[i], &q = b[i];
        EXPECT_EQ(r.name, q.name);
        EXPECT_EQ(std::tie(r.test, r.joint, r.present, r.clamped, r.taped, r.dummies, r.released_s),
                  std::tie(q.test, q.joint, q.present, q.clamped, q.taped, q.dummies, q.released_s))
            << r.name;
        expect_same(r.base_tilt_rad, q.base_tilt_rad, r.name + " tilt");
        ASSERT_EQ(r.forces.size(), q.forces.size()) << r.name;
        for (std::size_t f = 0; f < r.forces.size(); ++f)
            expect_same(r.forces[f], q.forces[f], r.name + " " + r.forces[f].name);
        EXPECT_EQ(r.motion_id, q.motion_id);
        EXPECT_EQ(r.repeat, q.repeat);
        EXPECT_EQ(r.kind, q.kind);
        EXPECT_EQ(r.rate_hz, q.rate_hz);
        EXPECT_EQ(r.run_order, q.run_order);
        EXPECT_EQ(r.collapsed, q.collapsed);
        EXPECT_EQ(r.collapse_time_s, q.collapse_time_s);
        EXPECT_EQ(r.base_source, q.base_source);
        EXPECT_EQ(r.base_clock, q.base_clock);
        expect_same_bits(r.time_s, q.time_s, r.name + " time");
        expect_same(r.base_acceleration_m_s2, q.base_acceleration_m_s2, r.name + " base acceleration");
        expect_same(r.base_displacement_m, q.base_displacement_m, r.name + " base displacement");
        expect_same(r.table, q.table, r.name + " table");
        expect_same(r.blocks, q.blocks, r.name + " blocks");
    }
}

/// Everything but the source and the findings.
inline void expect_same(const Campaign& a, const Campaign& b)
{
    const Specimen &s = a.specimen, &t = b.specimen;
    EXPECT_EQ(s.name, t.name);
    EXPECT_EQ(s.gravity_m_s2, t.gravity_m_s2);
    EXPECT_EQ(s.friction_nominal, t.friction_nominal);
    EXPECT_EQ(s.mass_tolerance, t.mass_tolerance);
    EXPECT_EQ(s.width_tolerance, t.width_tolerance);
    EXPECT_EQ(s.placement_tolerance_m, t.placement_tolerance_m);
    EXPECT_EQ(s.base_block_half_width_m, t.base_block_half_width_m);
    EXPECT_EQ(s.base_block_top_m, t.base_block_top_m);
    expect_same_bits(s.half_width_m, t.half_width_m, "half_width_m");
    expect_same_bits(s.half_height_m, t.half_height_m, "half_height_m");
    expect_same_bits(s.depth_m, t.depth_m, "depth_m");
    expect_same_bits(s.mass_kg, t.mass_kg, "mass_kg");
    expect_same_bits(s.rest_x_m, t.rest_x_m, "rest_x_m");
    expect_same_bits(s.rest_y_m, t.rest_y_m, "rest_y_m");
    expect_same_bits(s.centre_of_mass_m, t.centre_of_mass_m, "centre_of_mass_m");
    expect_same_bits(s.bearing_left_m, t.bearing_left_m, "bearing_left_m");
    expect_same_bits(s.bearing_right_m, t.bearing_right_m, "bearing_right_m");
    EXPECT_EQ(s.joints, t.joints);
    const Laboratory &l = a.laboratory, &m = b.laboratory;
    EXPECT_EQ(std::tie(l.stroke_m, l.speed_m_s, l.acceleration_m_s2, l.tilt_rad, l.force_n, l.may_dismantle, l.cost),
              std::tie(m.stroke_m, m.speed_m_s, m.acceleration_m_s2, m.tilt_rad, m.force_n, m.may_dismantle, m.cost));
    expect_same(a.runs, b.runs);
    expect_same(a.tests, b.tests);
}

} // namespace stylobate
