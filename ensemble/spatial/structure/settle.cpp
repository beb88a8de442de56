#include "ensemble/spatial/structure/settle.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/plan_face.hpp"
#include "ensemble/spatial/structure/equilibrium.hpp"
#include "ensemble/spatial/structure/initial_tilt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace stylobate {
namespace {

using B = spatial::OfBody;
using J = spatial::OfJoint;

/// "drum 3 of column 2" or "epistyle 1": as the layout names them.
std::string name_of(const SpatialStructure& structure, int solid)
{
    const Solid& named = structure.solids[static_cast<std::size_t>(solid)];
    int number = 0, columns = 0;
    for (std::size_t i = 0; i < structure.solids.size(); ++i) {
        const Solid& other = structure.solids[i];
        columns = std::max(columns, other.column + 1);
        number += static_cast<int>(i) <= solid && other.role == named.role && other.column == named.column ? 1 : 0;
    }
    if (named.role != BlockRole::drum)
        return fmt::format("epistyle {}", number);
    return fmt::format("drum {}", number) + (columns > 1 ? fmt::format(" of column {}", named.column + 1) : "");
}

/// What stands on a bed; of a body on several seats each carries an equal part.
struct Above {
    double kg = 0;
    std::array<double, 3> moment{}; ///< kg x the place of its centre of mass
    bool alone = true;              ///< the bed is the only one below its upper body
    void add(double part, double more_kg, const std::array<double, 3>& more)
    {
        kg += part * more_kg;
        for (std::size_t k = 0; k < 3; ++k)
            moment[k] += part * more[k];
    }
};

/// @return (joints); 0 kg on butt joints
std::vector<Above> weights_above(const SpatialStructure& structure)
{
    const std::vector<Solid>& solids = structure.solids;
    std::vector<std::size_t> order(solids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return solids[a].centre_m[1] > solids[b].centre_m[1]; });
    std::vector<Above> carried(solids.size()), above(structure.joints.size()); // the first with the body itself
    for (const std::size_t i : order) {
        const auto& c = solids[i].centre_m;
        const double m = solids[i].mass_kg;
        carried[i].add(1, m, {m * c[0], m * c[1], m * c[2]});
        const auto carries = [&](const SolidJoint& joint) {
            return static_cast<std::size_t>(joint.upper) == i && joint.normal == Normal::y;
        };
        const auto seats = std::count_if(structure.joints.begin(), structure.joints.end(), carries);
        for (std::size_t j = 0; j < above.size(); ++j) {
            if (!carries(structure.joints[j]))
                continue;
            above[j].add(1.0 / static_cast<double>(seats), carried[i].kg, carried[i].moment);
            above[j].alone = seats == 1;
            if (seats > 1) // its part of the weight passes about through the seat
                for (const std::size_t k : {std::size_t{0}, std::size_t{2}})
                    above[j].moment[k] = above[j].kg * structure.joints[j].point_m[k];
            carried[static_cast<std::size_t>(structure.joints[j].lower)].add(1, above[j].kg, above[j].moment);
        }
    }
    return above;
}

/// How far the weight on a bed passes beside its faces [m]; below 0: it presses on them.
double overhang_m(const SolidJoint& joint, const Above& above, const spatial::Vector<double>& gravity)
{
    const double height = above.moment[1] / above.kg - joint.point_m[1];
    const double x = above.moment[0] / above.kg - height * gravity.x / gravity.y - joint.point_m[0];
    const double z = above.moment[2] / above.kg - height * gravity.z / gravity.y - joint.point_m[2];
    const auto outside = [&](const Face& face, const std::array<double, 2>& middle) {
        return outside_m({face.round, middle[1], middle[0], face.half_x_m, face.half_z_m}, x, z);
    };
    return std::max(outside(joint.lower_face, joint.lower_middle_m), outside(joint.upper_face, joint.upper_middle_m));
}

/// The moment that the weight on a bed gains with its tilt, over that of the bed, to a factor of the shape.
double softness(const SolidJoint& joint, const Above& above)
{
    const auto half = [](const Face& face) { return std::min(face.half_x_m, face.half_z_m); };
    const double least = std::min(half(joint.lower_face), half(joint.upper_face));
    return (above.moment[1] - above.kg * joint.point_m[1]) /
           (joint.normal_stiffness_n_m3 * (std::pow(least, 4) - std::pow(joint.inner_ratio * least, 4)));
}

[[noreturn]] void refuse(const Realization& r, const SolidTopology& topology, const ForcesAtRest& forces,
                         const Rest& rest)
{
    const SpatialStructure& s = r.space;
    const spatial::Vector<double> g = forces.gravity();
    const double slope = std::hypot(g.x, g.z) / std::fabs(g.y);
    const std::vector<Above> above = weights_above(s);
    std::size_t softest = 0;
    for (std::size_t j = 0; j < above.size(); ++j) {
        const SolidJoint& joint = s.joints[j];
        if (!(above[j].kg > 0))
            continue;
        const std::string name = name_of(s, joint.upper);
        if (const double outside = overhang_m(joint, above[j], g); above[j].alone && outside >= 0)
            throw InputError(fmt::format("structure: realization {} cannot stand: the weight of {} and of what it "
                                         "carries passes {:.3g} m outside the bed below it. Reduce the offsets of "
                                         "drums, the eccentricities and the tilt of the base, or their spread.",
                                         r.index, name, outside));
        if (joint.friction <= slope)
            throw InputError(fmt::format("structure: realization {} cannot stand: {} slides on a base that is tilted "
                                         "by {:.3g} rad, with a friction coefficient of {:g}. Reduce the tilt of the "
                                         "base, or increase the friction of its bed.",
                                         r.index, name, std::atan(slope), joint.friction));
        if (!(above[softest].kg > 0) || softness(joint, above[j]) > softness(s.joints[softest], above[softest]))
            softest = j;
    }
    if (rest.balanced())
        throw InputError(fmt::format("structure: realization {} cannot stand: the bed of {} is too soft for the weight "
                                     "on it, which turns over or sinks deeper than a tenth of a block. Increase "
                                     "contact.normal_stiffness_n_m3.",
                                     r.index, name_of(s, s.joints[softest].upper)));
    const int body = topology.order()[static_cast<std::size_t>(rest.worst)];
    throw InputError(fmt::format("structure: realization {} does not come to rest: {:.2g} of the weight of {} is not "
                                 "balanced. Reduce offsets and tilts, or increase the friction and the stiffness of "
                                 "the beds.",
                                 r.index, rest.unbalanced, name_of(s, body)));
}

/// Whether no faces are so deep in each other that they do not touch in the kernel's eyes.
bool within_depth(const SolidTopology& topology, ForcesAtRest& forces, const Rest& rest)
{
    std::vector<double> normal_n;
    for (int j = 0; j < topology.kernel().joints; ++j)
        normal_n.push_back(forces.normal_n(j));
    forces.limit_depth(true);
    forces.put(rest.poses);
    for (int j = 0; j < topology.kernel().joints; ++j)
        if (forces.normal_n(j) < 0.5 * normal_n[static_cast<std::size_t>(j)])
            return false;
    return true;
}

} // namespace

void settle(const Realization& r, const SolidTopology& topology, const spatial::Bundle& bundle, int lane)
{
    ForcesAtRest forces(r.space, topology, bundle, lane);
    forces.limit_depth(false);
    Rest rest = rest_of(r.space, topology, forces);
    if (!rest.balanced() || !rest.stable || !within_depth(topology, forces, rest))
        refuse(r, topology, forces, rest);
    const spatial::Topology& kernel = topology.kernel();
    for (int j = 0; j < kernel.joints; ++j)
        for (int k = 0; k < 3; ++k)
            bundle.at(static_cast<J::Field>(J::spring_1 + k), j, lane) = forces.spring_n(j, k);
    if (r.space.initial_tilt_rad != 0)
        lean(r.space, topology, forces, rest.poses);
    for (int i = kernel.fixed; i < kernel.bodies; ++i) {
        const auto& [u, q] = rest.poses[static_cast<std::size_t>(i)];
        const double values[] = {u.x, u.y, u.z, q.w, q.x, q.y, q.z};
        for (int k = 0; k < 7; ++k)
            bundle.at(static_cast<B::Field>(B::x + k), i, lane) = values[k];
    }
}

} // namespace stylobate
