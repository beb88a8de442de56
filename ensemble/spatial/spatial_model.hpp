#pragma once
/// The spatial model: drums and prisms in the lanes of a bundle (`ensemble/engine/lanes.hpp`).

#include "ensemble/engine/fall_states.hpp"
#include "ensemble/engine/lanes.hpp"
#include "ensemble/motion/motions_in_space.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "ensemble/spatial/spatial_watch.hpp"
#include "ensemble/spatial/structure/solid_bundle.hpp"
#include "ensemble/spatial/structure/spatial_scales.hpp"
#include "kernels/isa.hpp"

#include <array>
#include <string>
#include <vector>

namespace stylobate {

class SpatialModel;
using SpatialLaneSet = LaneSetOf<SpatialModel>;

/// What the spatial model keeps of a lane from check to check.
struct SpatialMeasured {
    FallStates falls;
    std::vector<double> least_y_m;                     ///< (solids) `OfBody::least_y`
    std::vector<double> least_upright;                 ///< (solids) `OfBody::least_upright`
    std::vector<std::array<double, 2>> start_offset_m; ///< (joints) of the faces against each other at rest
    double start_top_x_m = 0, start_top_z_m = 0;
    double quiet_top_z_m = 0;                        ///< as `Watch::quiet_top_m`
    double direction_cosine = 1, direction_sine = 0; ///< of the shaking's first component
};

class SpatialModel {
public:
    using Realization = stylobate::Realization;
    struct HandOver {}; ///< nothing is handed over
    using Measured = SpatialMeasured;
    using Place = LanePlace<SpatialModel>;

    SpatialModel(const Study& study, const KernelTable& kernels, const Realization& pattern, std::uint64_t waiting);

    static Scales scales(const Realization& realization) { return spatial_scales(realization); }
    /// `motions_in_space`: along the direction of the shaking, across it, upwards.
    static constexpr int channels = 3;
    static std::array<BaseMotion, channels> motions(const ExcitationSpec& excitation, const Realization& realization,
                                                    const Motion* record)
    {
        return motions_in_space(excitation, realization, record);
    }
    int lanes() const { return kernels_.lanes; }
    bool twice() const { return false; }
    int check_steps() const { return spatial::check_steps(topology()); }
    void clear(int lane);
    void begin(int lane, Place& place);
    void run(const LaneBases& bases, const std::vector<Place>& places, int first, int last);
    void read(int, Place&) const {}

    bool finite(int lane) const { return is_finite(topology(), bundle_, lane); }
    bool unbalanced(int lane, const Place& place) const
    {
        return stylobate::unbalanced(topology(), bundle_, lane, place.watch);
    }
    bool rests(int lane, Place& place) const;
    EnergyBalance balance(int lane, const Place& place) const
    {
        return energy_balance(topology(), bundle_, lane, place.watch);
    }
    void check_limits(int lane, Place& place, int done) const;
    static bool fallen(const Place& place) { return place.measured.falls.fallen(); }
    static void conclude(Place& place) { place.measured.falls.conclude(); }
    static bool leaves(int, const Place&) { return false; }
    static HandOver hand_over(int, const Place&) { return {}; }
    /// Displacements, slip and rotations of a realization that has ended.
    void measure(int lane, const Place& place, State state, Outcome& outcome) const;
    /// Of what stood: `State::stood`, `rocked` or `slid`.
    State motion_of(const Place& place, const Outcome& outcome) const;
    SolidSnapshot snapshot(int lane, const Place& place) const;
    /// The trajectory of a realization before its first sample. @param names of its bodies without the ground
    static Trajectory trajectory_of(const Realization& realization, std::vector<std::string> names);
    /// Where its base is at a time, in the order of the channels base_x_m, base_y_m, base_z_m [m].
    static std::array<double, channels> base_place(const Place& place, double time_s);

    const spatial::Topology& topology() const { return solids_.kernel(); }
    const spatial::Bundle& bundle() const { return bundle_; }

private:
    void first_increments(int lane, Watch& watch);
    /// Which column fell first, and in which direction.
    void measure_fall(int lane, const SpatialMeasured& measured, const SpatialStructure& space, Outcome& o) const;
    void fill_tables(const LaneBases& bases, const std::vector<Place>& places);
    /// Where the middle of a joint's upper face lies on its lower one, along the first two axes of the joint [m].
    std::array<double, 2> face_offset(int joint, int lane) const;
    spatial::Quaternion<double> attitude(int body, int lane) const;
    spatial::Vector<double> displacement(int body, int lane) const;
    /// Rotation of a joint's upper body as seen from its lower one.
    spatial::Quaternion<double> turned(int joint, int lane) const;

    const Study& study_;
    const KernelTable& kernels_;
    const std::size_t lanes_;
    SolidTopology solids_;
    AlignedArray<double> memory_, tables_; ///< of the bundle; of the three scalar motions (3 x steps x lanes)
    spatial::Bundle bundle_;
};

} // namespace stylobate
