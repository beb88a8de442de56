#pragma once
/// Hand-built colonnades: nothing here goes through a study file, the layout or the sampler.

#include "studies/evidence/verification/model.hpp"

namespace stylobate::model {

/// Columns of equal drums on wide ground, one epistyle over each bay or one over all.
struct Colonnade {
    int columns = 2;
    int drums = 1; ///< of each column
    double spacing = 0.09;
    Stone drum{0.06, 0.1, 0.75};
    Stone epistyle{0.15, 0.06, 1.14};
    bool one_epistyle = true; ///< over all bays
};

/// COLO of the paper: two columns of 60 x 100 mm with a flush epistyle of 150 x 60 mm.
inline Colonnade paper_colonnade(int drums)
{
    Colonnade c;
    c.drums = drums;
    c.drum = {0.06, 0.1 / drums, 0.75 / drums};
    return c;
}

/// @param watch also lists all pairs that are no beds, so that whatever falls is caught
inline Realization colonnade(const Colonnade& c, const Bed& bed, double step_s, bool watch = true)
{
    Realization r;
    const auto add = [&](const Stone& s, double x, double bottom, BlockRole role, int column) {
        const double inertia = s.mass * (s.width * s.width + s.height * s.height) / 12;
        r.blocks.push_back({0.5 * s.width, 0.5 * s.height, s.mass, inertia, x, bottom + 0.5 * s.height, false});
        r.blocks.back().role = role;
        r.blocks.back().column = column;
        return static_cast<int>(r.blocks.size()) - 1;
    };
    const int ground = c.columns * c.drums + (c.one_epistyle ? 1 : c.columns - 1);
    const auto join = [&](int lower, int upper, double mass, double width) {
        const double k = bed.K_n * width, C = 2 * bed.xi * std::sqrt(k * mass);
        r.joints.push_back({lower, upper, bed.K_n, bed.K_n * c.drum.width, C, C, bed.per_chord ? width : 0, bed.mu});
    };
    for (int column = 0; column < c.columns; ++column)
        for (int i = 0; i < c.drums; ++i) {
            const int at = add(c.drum, column * c.spacing, i * c.drum.height, BlockRole::drum, column);
            join(i == 0 ? ground : at - 1, at, c.drum.mass, c.drum.width);
        }
    for (int k = 0; k < ground - c.columns * c.drums; ++k) {
        const double middle = c.one_epistyle ? 0.5 * (c.columns - 1) : k + 0.5;
        const int at = add(c.epistyle, middle * c.spacing, c.drums * c.drum.height, BlockRole::epistyle, -1);
        for (int column = c.one_epistyle ? 0 : k; column <= (c.one_epistyle ? c.columns - 1 : k + 1); ++column) {
            const double right =
                std::min(c.epistyle.width / 2 + middle * c.spacing, column * c.spacing + c.drum.width / 2);
            const double left =
                std::max(-c.epistyle.width / 2 + middle * c.spacing, column * c.spacing - c.drum.width / 2);
            join(column * c.drums + c.drums - 1, at, c.drum.mass, right - left);
        }
    }
    const double far = 50 * c.columns * c.spacing;
    r.blocks.push_back({far, c.drum.height, 1, 1, 0, -c.drum.height, true, BlockRole::ground, -1});
    r.drums = ground;
    const auto lie_together = [&](int a, int b) {
        for (const Joint& joint : r.joints)
            if ((joint.lower == a && joint.upper == b) || (joint.lower == b && joint.upper == a))
                return true;
        return false;
    };
    if (watch) {
        std::vector<std::pair<int, int>> pairs;
        for (int a = 0; a < ground; ++a)
            for (int b = a + 1; b < ground; ++b)
                pairs.emplace_back(a, b);
        for (int b = 0; b < ground; ++b)
            pairs.emplace_back(ground, b);
        for (const auto& [a, b] : pairs) {
            if (lie_together(a, b))
                continue;
            const auto long_face = [&](int i) {
                const Block& block = r.blocks[static_cast<std::size_t>(i)];
                return 2 * std::max(block.half_width_m, block.half_height_m);
            };
            const double chord = std::min(long_face(a), long_face(b));
            join(a, b, c.drum.mass, chord);
            r.joints.back().damping_chord_m = chord;
            ++r.watched;
        }
    }
    r.step_s = step_s;
    return r;
}

} // namespace stylobate::model
