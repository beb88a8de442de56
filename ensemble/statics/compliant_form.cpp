#include "ensemble/statics/compliant_form.hpp"

#include "ensemble/statics/extension.hpp"
#include "ensemble/statics/scales.hpp"
#include "ensemble/statics/step_bound.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

constexpr double sunk_part = 1e-4;
constexpr double shear_part = 0.5;
constexpr double ratio_of_damping = 0.5;
// Of the bound: as runs have it unless they say otherwise.
constexpr double step_fraction = 0.8;
// So that the rigid step's checks, and the middle of its steps, are at whole steps.
constexpr double step_multiple = 8;

/// The longest contact of a pair: of a bed its faces', of others the shorter one's longer side.
double chord_m(const Realization& r, int j)
{
    if (j < r.beds())
        return face_length_m(r, j);
    const Joint& joint = r.joints[static_cast<std::size_t>(j)];
    const auto longest = [&](int block) {
        const Block& b = r.blocks[static_cast<std::size_t>(block)];
        return std::max(b.half_width_m, b.half_height_m);
    };
    return 2 * std::min(longest(joint.lower), longest(joint.upper));
}

double effective_mass_kg(const Realization& r, const Joint& joint)
{
    const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
    const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
    if (lower.fixed)
        return upper.mass_kg;
    return upper.fixed ? lower.mass_kg : std::min(lower.mass_kg, upper.mass_kg);
}

} // namespace

Realization compliant_form(const Realization& rigid)
{
    assert(rigid.form == ContactForm::rigid && rigid.step_s > 0);
    Realization r = rigid;
    r.form = ContactForm::area;
    double line_load_n_m = 0;
    for (int j = 0; j < r.beds(); ++j)
        line_load_n_m = std::max(line_load_n_m, bed_load_n(r, j) / face_length_m(r, j));
    const double K_n = line_load_n_m / (sunk_part * scales_of(r).least_size_m);
    for (int j = 0; j < static_cast<int>(r.joints.size()); ++j) {
        Joint& joint = r.joints[static_cast<std::size_t>(j)];
        const double chord = chord_m(r, j), mass = effective_mass_kg(r, joint);
        joint.normal_stiffness_n_m2 = K_n;
        joint.tangential_stiffness_n_m = shear_part * K_n * chord;
        joint.normal_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(K_n * chord * mass);
        joint.tangential_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(joint.tangential_stiffness_n_m * mass);
        joint.damping_chord_m = chord;
        joint.restitution = 0;
    }
    const double longest_s = step_fraction * step_bound_to_rest(r).dt_s;
    r.step_s = rigid.step_s / (step_multiple * std::ceil(rigid.step_s / (step_multiple * longest_s)));
    return r;
}

} // namespace stylobate
