#pragma once
/// Columns of small blocks, 48 x 29 mm, for the tests of single joints.

#include "ensemble/model/campaign.hpp"

namespace stylobate {

/// Equal blocks on a table, joints from below. @param x_m of their centres
inline Specimen small_blocks(int blocks, double friction, double mass_kg = 0.135, double x_m = 0)
{
    Specimen s;
    s.name = "small blocks";
    s.friction_nominal = friction;
    for (int i = 0; i < blocks; ++i) {
        s.half_width_m.push_back(0.024);
        s.half_height_m.push_back(0.0145);
        s.depth_m.push_back(0.048);
        s.mass_kg.push_back(mass_kg);
        s.rest_x_m.push_back(x_m);
        s.rest_y_m.push_back((2 * i + 1) * 0.0145);
        s.joints.emplace_back(i - 1, i);
    }
    return s;
}

} // namespace stylobate
