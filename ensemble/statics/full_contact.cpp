#include "ensemble/statics/full_contact.hpp"

#include "ensemble/statics/extension.hpp"
#include "ensemble/statics/reinforcement.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

FullContact full_contact(const std::vector<Block>& blocks, const Joint& joint)
{
    const Block& a = blocks[static_cast<std::size_t>(joint.lower)];
    const Block& b = blocks[static_cast<std::size_t>(joint.upper)];
    const double left = std::max(a.x_m - a.half_width_m, b.x_m - b.half_width_m);
    const double right = std::min(a.x_m + a.half_width_m, b.x_m + b.half_width_m);
    assert(right > left && "the blocks of a joint lie on each other");
    const double chord = right - left;
    return {chord,
            (left + right) / 2,
            joint.normal_stiffness_n_m2 * chord,
            joint.normal_stiffness_n_m2 * chord * chord * chord / 12,
            joint.tangential_stiffness_n_m,
            joint.normal_damping_n_s_m,
            0,
            joint.tangential_damping_n_s_m};
}

FullContact extended_contact(const Realization& r, int bed, double times)
{
    const Joint& joint = r.joints[static_cast<std::size_t>(bed)];
    const JointExtension& e = joint.extension;
    FullContact contact = full_contact(r.blocks, joint);
    const JointReinforcement& held = joint.reinforcement;
    const double L = contact.chord, load = times * bed_force_n(r, bed);
    const BedLaw law = bed_law(r, bed);
    const double area = law.area(load);
    double tangent = (1 + law.exponent) * load / (area * law.K_n); // of the force over that of the linear law
    if (r.form == ContactForm::points)                             // pressure rho d^1.5
        tangent *= 1.5 * std::cbrt(area / L * law.faces.per_root_depth * law.faces.per_root_depth);
    const double spread = r.form == ContactForm::two_corner ? 4 : 12;
    contact.k_n *= tangent;
    contact.k_theta = contact.k_n * L * L / spread;
    contact.k_t += e.dowel_stiffness_n_m + held.bearing_n_m + held.bearing_per_m * load;
    contact.c_t += held.bearing_n_s_m;
    if (held.hold_n > 0) {
        contact.k_n += 2 * held.hold_stiffness_n_m;
        contact.k_theta += 2 * held.hold_stiffness_n_m * held.hold_spread_m * held.hold_spread_m;
    }
    const double length = joint.damping_chord_m > 0 ? joint.damping_chord_m : face_length_m(r, bed);
    const double C = joint.normal_damping_n_s_m;
    if (r.form != ContactForm::area)
        contact.c_theta = C * L * L / spread;
    else
        contact.c_theta = e.face_damping * C * L / length * L * L / 4;
    contact.c_n = C * std::max(1.0, joint.damping_chord_m > 0 ? L / length : 1.0) +
                  e.rate_s_m * std::min(times, bound_load) * bed_force_n(r, bed);
    return contact;
}

} // namespace stylobate
