#pragma once
/// A joint on its own, as a laboratory puts it on its table: the tested body as one rigid block on fixed blocks.
///
/// The body is the upper block of the joint, with what is taped to it. As a block it has their mass, moment of inertia
/// and centre of mass, and the lower face of the upper block. Nothing stands on it, so its half height is free: it is
/// that of the centre of mass above the lower face. So all angles at which it turns, and all moments, are exact.
/// Every other block that is present belongs to the base.

#include "ensemble/model/campaign.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/tracking/specimen.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

struct JointBench {
    Realization realization;
    std::size_t body = 0;    ///< place of the body among the realization's blocks
    std::vector<int> blocks; ///< of the specimen, that are parts of the body: the upper block of the joint first
    /// (blocks) centre of each from the centre of the body, in the body's frame
    std::vector<std::pair<double, double>> centre_m;
    std::optional<std::size_t> gauge; ///< of the run, whose rod holds or pushes the body
    double released_s = 0;            ///< in the time of the run: when the simulation begins
};

/// @param whole    a realization of the whole specimen: its contacts, and what acts in them
/// @param planned  with a joint
/// @param offset_m of the body from its place: how well it was put there
/// @param lean_rad of a body that is held until a release, from the planned rotation
/// @throws InputError if the run has no joint, a block or joint that the specimen does not have, or several rods
JointBench joint_bench(const Specimen& specimen, const SpecimenStructure& built, const Realization& whole,
                       const MeasuredRun& planned, double offset_m, double lean_rad = 0);

/// Force of the bench's rod on the body, positive to the right: k (x_e - x_p) of `kernels/planar/mechanisms/rod.hpp`.
/// @param time_s   since the release
/// @param moved    of the body's centre since the start [m], and its rotation then and now
/// @param base_m   displacement of the table since the release
double rod_force_n(const JointBench& bench, double time_s, double moved_m, double start_rad, double now_rad,
                   double base_m);

} // namespace stylobate
