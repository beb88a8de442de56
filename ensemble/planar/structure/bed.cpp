#include "ensemble/planar/structure/bed.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

/// @return the bed without its loads and law
BedAtRest bed_of(const Realization& r, int bed)
{
    const Joint& joint = r.joints[static_cast<std::size_t>(bed)];
    const Block &lower = block_of(r, joint.lower), &upper = block_of(r, joint.upper);
    const double ll = lower.x_m - lower.half_width_m, lr = lower.x_m + lower.half_width_m;
    const double ul = upper.x_m - upper.half_width_m, ur = upper.x_m + upper.half_width_m;
    const double left = std::max(ll, ul), right = std::min(lr, ur);
    const double length = right - left - joint.mechanisms.chip_left_m - joint.mechanisms.chip_right_m;
    return {joint, lower, upper, left, right, ll > ul, lr < ur, length, 0, {}};
}

BedLaw law_of(const BedAtRest& bed, ContactForm form, double load_n)
{
    const JointMechanisms& e = bed.joint.mechanisms;
    BedLaw law;
    law.form = form;
    law.faces.sizes = {bed.lower.half_width_m, bed.lower.half_height_m, bed.upper.half_width_m,
                       bed.upper.half_height_m};
    law.faces.depth_limit = 0.1 * std::min(bed.lower.half_height_m, bed.upper.half_height_m);
    law.faces.loss = face_loss<double>(e.chip_left_m, e.chip_right_m, bed.left_of_lower, bed.right_of_lower);
    law.faces.wedge_sine = std::sin(e.wedge_rad);
    law.faces.wedge_versine = 2 * std::sin(0.5 * e.wedge_rad) * std::sin(0.5 * e.wedge_rad);
    law.K_n = bed.joint.normal_stiffness_n_m2;
    law.bonded = bed.joint.bonded();
    law.exponent = e.force_exponent - 1;
    law.per_reference = 1 / e.reference_overlap_m2;
    if (form == ContactForm::points)
        law.faces.per_root_depth = std::sqrt(law.K_n * bed.length_m / load_n);
    return law;
}

/// Springs of the form `points`: their area A L = sum w_i d_i^1.5 / sqrt(d_ref) and first moment by Newton's method in
/// the depth at the middle and the slope along the face, times L / 2.
Bedding on_points(double per_root_depth, double L, double area, double e)
{
    constexpr FaceRule<5> rule = lobatto_rule();
    const double want = area / L;
    double depth = std::pow(want / per_root_depth, 2.0 / 3), slope = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
        double sum = 0, moment = 0, k = 0, k_x = 0, k_xx = 0;
        for (int i = 0; i < 5; ++i) {
            const double x = 2 * rule.at[i] - 1, d = depth + slope * x;
            if (d <= 0)
                continue;
            const double p = rule.part[i] * per_root_depth * std::sqrt(d);
            sum += p * d;
            moment += p * d * x;
            k += 1.5 * p;
            k_x += 1.5 * p * x;
            k_xx += 1.5 * p * x * x;
        }
        const double lacks = want - sum, lacks_moment = want * 2 * e / L - moment;
        if (std::fabs(lacks) + std::fabs(lacks_moment) < 1e-15 * want)
            break;
        const double determinant = k * k_xx - k_x * k_x;
        if (!(determinant > 1e-12 * k * k)) { // one point is left: press deeper, and turn towards the load
            depth += 0.1 * std::fabs(depth);
            slope *= 0.7;
            continue;
        }
        double by_depth = (k_xx * lacks - k_x * lacks_moment) / determinant;
        double by_slope = (k * lacks_moment - k_x * lacks) / determinant;
        // no farther than the bed is deep, so that not all of it opens at once
        const double most = 0.5 * (std::fabs(depth) + std::fabs(slope)),
                     far = std::fabs(by_depth) + std::fabs(by_slope);
        const double part = far > most ? most / far : 1;
        depth += part * by_depth;
        slope += part * by_slope;
    }
    return {depth, -std::atan(2 * slope / L)};
}

} // namespace

double face_length_m(const Realization& r, int bed)
{
    return bed_of(r, bed).length_m;
}

double bed_load_n(const Realization& r, int bed)
{
    const auto upper_of = [&](int j) { return r.joints[static_cast<std::size_t>(j)].upper; };
    const Block& foot = block_of(r, upper_of(bed));
    const auto seats = [&](int block) {
        int count = 0;
        for (int j = 0; j < r.beds(); ++j)
            count += upper_of(j) == block ? 1 : 0;
        return count;
    };
    double mass = 0;
    if (foot.role == BlockRole::epistyle) {
        mass = foot.mass_kg / seats(upper_of(bed));
    } else {
        for (int j = 0; j < r.beds(); ++j) {
            const Joint& joint = r.joints[static_cast<std::size_t>(j)];
            const Block& upper = block_of(r, joint.upper);
            if (upper.role == BlockRole::epistyle && block_of(r, joint.lower).column == foot.column)
                mass += upper.mass_kg / seats(joint.upper);
            else if (upper.role == BlockRole::drum && upper.column == foot.column && j >= bed)
                mass += upper.mass_kg;
        }
    }
    return mass * r.gravity_m_s2 * std::cos(r.base_tilt_rad);
}

double longest_contact_m(const Block& a, const Block& b)
{
    return 2 * std::min(std::max(a.half_width_m, a.half_height_m), std::max(b.half_width_m, b.half_height_m));
}

double contact_mass_kg(const Block& a, const Block& b)
{
    return a.fixed ? b.mass_kg : b.fixed ? a.mass_kg : std::min(a.mass_kg, b.mass_kg);
}

double BedLaw::force(double area) const
{
    return exponent == 0 || area <= 0 ? K_n * area : K_n * area * std::pow(area * per_reference, exponent);
}

double BedLaw::area(double force) const
{
    return exponent == 0 ? force / K_n : std::pow(force * per_reference / K_n, 1 / (1 + exponent)) / per_reference;
}

std::vector<BedAtRest> beds_at_rest(const Realization& r)
{
    std::vector<BedAtRest> beds;
    beds.reserve(static_cast<std::size_t>(r.beds()));
    for (int j = 0; j < r.beds(); ++j) {
        BedAtRest bed = bed_of(r, j);
        const double load_n = bed_load_n(r, j);
        bed.law = law_of(bed, r.form, load_n);
        bed.force_n = load_n;
        for (int k = j; k < r.beds(); ++k) {
            const Block& above = block_of(r, r.joints[static_cast<std::size_t>(k)].upper);
            if (bed.upper.role == BlockRole::drum && above.role == BlockRole::drum && above.column == bed.upper.column)
                bed.force_n += above.strengthening.tendon_prestress_n;
        }
        beds.push_back(bed);
    }
    return beds;
}

Bedding bedding(double K, double L, double N, double e)
{
    const double eccentric = std::fabs(e);
    if (eccentric <= L / 6)
        return {N / (K * L), -12 * N * e / (K * L * L * L)};
    if (eccentric >= L / 2)
        return {N / (K * L), 0};
    const double pressed = 3 * (L / 2 - eccentric); // a triangle under the nearer edge
    const double edge_depth = 2 * N / (K * pressed);
    const double rotation = edge_depth / pressed;
    return {edge_depth - rotation * L / 2, e > 0 ? -rotation : rotation};
}

Bedding bedding(const BedLaw& law, double L, double N, double e)
{
    const double area = law.area(N);
    if (law.bonded)
        return {area / L, -12 * area * e / (L * L * L)};
    if (law.form == ContactForm::area || std::fabs(e) >= L / 2)
        return bedding(N / area, L, N, e);
    if (law.form == ContactForm::points)
        return on_points(law.faces.per_root_depth, L, area, e);
    // springs of L / 2 at the ends, by the lever rule
    const double left = area * (1 - 2 * e / L) / L, right = area * (1 + 2 * e / L) / L;
    return {0.5 * (left + right), -std::atan((right - left) / L)};
}

FullContact full_contact(const Block& a, const Block& b, const Joint& joint)
{
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

FullContact full_contact(const BedAtRest& bed, double times)
{
    const Joint& joint = bed.joint;
    const JointMechanisms& e = joint.mechanisms;
    FullContact contact = full_contact(bed.lower, bed.upper, joint);
    const JointStrengthening& held = joint.strengthening;
    const BedLaw& law = bed.law;
    const double L = contact.chord, load = times * bed.force_n;
    const double area = law.area(load);
    double tangent = (1 + law.exponent) * load / (area * law.K_n); // of the force over that of the linear law
    if (law.form == ContactForm::points)                           // pressure rho d^1.5
        tangent *= 1.5 * std::cbrt(area / L * law.faces.per_root_depth * law.faces.per_root_depth);
    const double spread = law.form == ContactForm::two_corner ? 4 : 12;
    contact.k_n *= tangent;
    contact.k_theta = contact.k_n * L * L / spread;
    contact.k_t += e.dowel_stiffness_n_m + held.bearing_n_m + held.bearing_per_m * load;
    contact.c_t += held.bearing_n_s_m;
    if (held.hold_n > 0) {
        contact.k_n += 2 * held.hold_stiffness_n_m;
        contact.k_theta += 2 * held.hold_stiffness_n_m * held.hold_spread_m * held.hold_spread_m;
    }
    const double length = joint.damping_chord_m > 0 ? joint.damping_chord_m : bed.length_m;
    const double C = joint.normal_damping_n_s_m;
    if (law.form != ContactForm::area)
        contact.c_theta = C * L * L / spread;
    else
        contact.c_theta = e.face_damping * C * L / length * L * L / 4;
    contact.c_n = C * std::max(1.0, joint.damping_chord_m > 0 ? L / length : 1.0) +
                  e.rate_s_m * std::min(times, bound_load) * bed.force_n;
    return contact;
}

} // namespace stylobate
