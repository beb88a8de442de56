#pragma once
/// The forces of the beds on the bodies in any poses, by the kernel's own step: what statics is computed from.

#include "ensemble/numerics/aligned.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "kernels/isa.hpp"
#include "kernels/spatial/vector.hpp"

#include <vector>

namespace stylobate {

/// Where a body is: displacement of its centre of mass from the reference state [m], and its attitude.
struct SolidPose {
    spatial::Vector<double> displacement;
    spatial::Quaternion<double> attitude;
};

/// The attitude after another turn, by a vector of the base frame [rad].
spatial::Quaternion<double> after_turn(const spatial::Quaternion<double>& attitude,
                                       const spatial::Vector<double>& turn);

/// Force and moment [N, N m].
struct SolidLoad {
    spatial::Vector<double> force, moment;
};

/// A joint in some poses: its load on the upper body of the kernel's topology, about that body's centre of mass, and
/// its moment about the lower one's; the force on the lower body is opposite.
struct BedForces {
    spatial::Vector<double> force, upper_moment, lower_moment;
};

/// A realization in a bundle of one lane of its own.
///
/// Friction at rest is counted from the reference state on: one step of the kernel in which the bodies move from there
/// to their poses, without dashpots and from unstressed springs. The springs are then K_T times the sliding of the
/// faces at the centre of the pressure, within the friction cone: a function of the poses.
///
/// Wedges and dowels act at rest, dowels from the reference state on. Friction has its full coefficient and no bond,
/// and ties are not there yet.
class ForcesAtRest {
public:
    /// @param lane as `store_solids` has left it; it is copied
    ForcesAtRest(const SpatialStructure& structure, const SolidTopology& topology, const spatial::Bundle& bundle,
                 int lane);

    /// Computes the forces in poses. @param poses (bodies of the topology); those of fixed bodies are not read
    void put(const std::vector<SolidPose>& poses);
    /// The mean depth beyond which faces are not in contact: the kernel's, or none.
    void limit_depth(bool limited);
    /// The friction cone: the kernel's, or none.
    void limit_friction(bool limited);

    BedForces forces(int joint) const;
    /// Of all joints and gravity on a body, about its centre of mass.
    SolidLoad unbalanced(int body) const;
    double normal_n(int joint) const { return bundle_.at(spatial::OfJoint::normal, joint, 0); }
    /// One of the three springs of friction [N].
    double spring_n(int joint, int k) const;
    /// Whether the springs are at the limit of friction.
    bool slips(int joint) const;
    /// Acceleration of gravity in the frame of the base [m/s2].
    spatial::Vector<double> gravity() const { return gravity_; }
    const spatial::Topology& topology() const { return topology_; }

private:
    const spatial::Topology& topology_;
    AlignedArray<double> memory_;
    spatial::Bundle bundle_;
    spatial::Vector<double> gravity_;
    std::vector<spatial::Vector<double>> inertia_; ///< (bodies) principal ones [kg m2]
    std::vector<double> depth_limit_m_, friction_; ///< (joints)
};

} // namespace stylobate
