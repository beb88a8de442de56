#include "ensemble/planar/structure/compliant_form.hpp"

#include "ensemble/model/study.hpp"
#include "ensemble/planar/structure/bed.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

constexpr double sunk_part = 1e-4;
constexpr double shear_part = 0.5;
constexpr double ratio_of_damping = 0.5;

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
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        const double chord = j < r.beds() ? face_length_m(r, j) : longest_contact_m(lower, upper);
        const double mass = contact_mass_kg(lower, upper);
        joint.normal_stiffness_n_m2 = K_n;
        joint.tangential_stiffness_n_m = shear_part * K_n * chord;
        joint.normal_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(K_n * chord * mass);
        joint.tangential_damping_n_s_m = 2 * ratio_of_damping * std::sqrt(joint.tangential_stiffness_n_m * mass);
        joint.damping_chord_m = chord;
        joint.restitution = 0;
    }
    // an even part, so that the middle of a rigid step is between two of these
    const double longest_s = RunSpec{}.step_fraction * step_bound_to_rest(r).dt_s;
    r.step_s = rigid.step_s / (2 * std::ceil(rigid.step_s / (2 * longest_s)));
    return r;
}

} // namespace stylobate
