#pragma once
/// Columns of equal drums as realizations, for tests of the step.

#include "ensemble/realization/realization.hpp"

#include <cmath>

namespace stylobate {

struct Column {
    int free_blocks = 6;
    double width = 0.048, height = 0.029, mass = 0.1355;
    double normal_stiffness = 1e8;
    double ratio = 1; ///< K_T / (K_N B)
    double xi = 0;
    bool chord = false;
    bool ends = false; ///< normal dashpots at the ends of the contact
};

/// A fixed block and equal free ones on it.
inline Realization make(const Column& column)
{
    Realization r;
    const double k_n = column.normal_stiffness * column.width;
    for (int i = 0; i <= column.free_blocks; ++i) {
        Block block;
        block.half_width_m = column.width / 2;
        block.half_height_m = column.height / 2;
        block.mass_kg = column.mass;
        block.inertia_kg_m2 = column.mass * (column.width * column.width + column.height * column.height) / 12;
        block.y_m = (i + 0.5) * column.height;
        block.fixed = i == 0;
        r.blocks.push_back(block);
        if (i == 0)
            continue;
        Joint joint;
        joint.lower = i - 1;
        joint.upper = i;
        joint.normal_stiffness_n_m2 = column.normal_stiffness;
        joint.tangential_stiffness_n_m = column.ratio * k_n;
        joint.normal_damping_n_s_m = 2 * column.xi * std::sqrt(k_n * column.mass);
        joint.tangential_damping_n_s_m = 2 * column.xi * std::sqrt(column.ratio * k_n * column.mass);
        joint.damping_chord_m = column.chord ? column.width : 0;
        joint.mechanisms.face_damping = column.ends ? 1 : 0;
        r.joints.push_back(joint);
    }
    r.drums = column.free_blocks + 1;
    return r;
}

inline const Column spec{};
inline const Column mono{.free_blocks = 1, .height = 0.174, .mass = 0.813};

inline Column with(Column column, double normal_stiffness, double xi = 0)
{
    column.normal_stiffness = normal_stiffness;
    column.xi = xi;
    return column;
}

} // namespace stylobate
