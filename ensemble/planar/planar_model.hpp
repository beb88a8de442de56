#pragma once
/// The planar model: rectangles of a stack or a colonnade in the lanes of a bundle (`ensemble/engine/lanes.hpp`).

#include "ensemble/engine/lanes.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "ensemble/planar/limit_states.hpp"
#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/planar/planar_watch.hpp"
#include "ensemble/planar/rigid_order.hpp"
#include "ensemble/planar/single_bundle.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/realization/realization.hpp"
#include "kernels/isa.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

class PlanarModel;
using LaneSet = LaneSetOf<PlanarModel>;

/// What the planar model keeps of a lane from check to check.
struct PlanarMeasured {
    LimitStates limits;
    std::vector<BlockMotion> moved;     ///< (blocks) at the last check
    std::vector<int> inside;            ///< (blocks) `OfBlock::inside` of its chunk
    std::vector<double> start_offset_m; ///< (beds) `face_offset` at rest
    double start_top_x_m = 0;
};

/// A realization of the rigid form in the middle of a step, from where contacts that yield take it over: its blocks are
/// about to meet otherwise than at beds.
struct HandOver {
    Realization realization; ///< with rigid contacts
    Watch watch;
    PlanarMeasured measured;
    std::vector<BlockMotion> increment;            ///< (blocks) change of their places in the last step
    std::vector<double> max_rotation_rad;          ///< (beds)
    std::array<double, OfRealization::count> of{}; ///< as in the bundle
};

class PlanarModel {
public:
    using Realization = stylobate::Realization;
    using HandOver = stylobate::HandOver;
    using Measured = PlanarMeasured;
    using Place = LanePlace<PlanarModel>;

    /// What an empty lane has in place of blocks: faces of this half width, that may touch so deep [m]. The closed form
    /// of every contact form holds for them, so that the bundle does not take the general overlap, which is many times
    /// slower. Without stiffness they carry no force.
    static constexpr double empty_half_width = 0.01, empty_depth_limit = 1;

    /// @throws std::invalid_argument if the study asks for single precision and the pattern for more than the paper's
    ///         model
    PlanarModel(const Study& study, const KernelTable& kernels, const Realization& pattern, std::uint64_t waiting);

    static Scales scales(const Realization& realization) { return scales_of(realization); }
    /// Along x, upwards, and the rotation [rad]. The last two are still where the realization has no samples of them.
    static constexpr int channels = 3;
    static std::array<BaseMotion, channels> motions(const ExcitationSpec& excitation, const Realization& realization,
                                                    const Motion* record);
    int lanes() const { return static_cast<int>(lanes_); }
    bool twice() const { return twice_; }
    int check_steps() const { return stylobate::check_steps(topology_); }
    void clear(int lane);
    void begin(int lane, Place& place);
    void run(const LaneBases& bases, const std::vector<Place>& places, int first, int last);
    /// Where the blocks are, and when they were inside their limits last.
    void read(int lane, Place& place) const;

    bool finite(int lane) const { return is_finite(topology_, bundle_, lane); }
    bool unbalanced(int lane, const Place& place) const
    {
        return stylobate::unbalanced(topology_, bundle_, lane, place.watch);
    }
    bool rests(int lane, Place& place) const
    {
        return watch_rest(topology_, bundle_, lane, place.measured.limits.undecided(), place.watch);
    }
    EnergyBalance balance(int lane, const Place& place) const
    {
        return energy_balance(topology_, bundle_, lane, place.watch);
    }
    static void check_limits(int lane, Place& place, int done);
    static bool fallen(const Place& place) { return place.measured.limits.fallen(); }
    static void conclude(Place& place) { place.measured.limits.conclude(); }
    bool leaves(int lane, const Place& place) const { return leaves_beds(topology_, bundle_, lane, place.watch); }
    HandOver hand_over(int lane, const Place& place) const;
    /// Displacements, slip and rotations of a realization that has ended.
    void measure(int lane, const Place& place, State state, Outcome& outcome) const;
    /// Of what stood: `State::stood`, `rocked` or `slid`.
    State motion_of(const Place& place, const Outcome& outcome) const;
    Snapshot snapshot(int lane, const Place& place) const;
    /// The trajectory of a realization before its first sample. @param names of its blocks without the ground
    static Trajectory trajectory_of(const Realization& realization, std::vector<std::string> names);

    /// Where its base is at a time, of the channel base_x_m [m].
    static std::array<double, 1> base_place(const Place& place, double time_s)
    {
        return {place.motions[0].displacement_m(time_s)};
    }

    // ---- the state, for what steps or moves lanes in other ways ----

    const Topology& topology() const { return topology_; }
    std::size_t rigid_order_size() const { return rigid_order_.list.size(); }
    const Bundle& bundle() const { return bundle_; }
    Bundle& bundle() { return bundle_; }
    /// All registers of the bundle, lane by lane: (bundle_registers x lanes).
    double* memory() const { return memory_.get(); }
    /// Kernel's block -> realization's block: the fixed ones first.
    const std::vector<int>& order() const { return order_; }
    /// Realization's block -> kernel's block, -1 for one that touches no free block.
    int place_of(int block) const { return place_of_[static_cast<std::size_t>(block)]; }
    bool single() const { return single_.has_value(); }
    /// Steps in single precision go on from what has been written into a lane.
    void take_single(int lane)
    {
        if (single_)
            single_->take(lane);
    }
    /// Makes the tables of the base's motion of the next chunk: of all lanes, and what mechanisms need of one.
    void fill_tables(const LaneBases& bases, const std::vector<Place>& places);
    void fill_mechanisms(int lane, const LaneBases& bases, const Place& place);
    /// The rotation of the base by its own samples (`RealizationHeader::tilt`), in the tables of a lane.
    void fill_tilt(int lane, double first_step, const Place& place);
    /// The rotation of the base and its change in a step.
    struct Turn {
        double angle_rad = 0, increment_rad = 0;
    };
    /// @param reach steps between the three second differences of the base's displacement [m]
    static Turn turn_of(const Realization& r, double reach, double before, double now, double after);
    /// Displacement of a (kernel's) block's geometric centre.
    BlockMotion centre(int k, int lane) const;

private:
    /// Parameters and static rest of a realization into its lane.
    void store_state(int lane, const Place& place);
    void store_rigid(int lane, const Realization& r);
    void await_rods(Place& place);
    void first_increments(int lane, Watch& watch);
    /// Which blocks the clamps join: the same in all realizations of a study.
    void list_clamps(const Realization& pattern);

    const Study& study_;
    const KernelTable& kernels_;
    std::size_t lanes_ = 0;
    bool twice_ = false; ///< whether two registers are stepped at a time
    std::vector<int> order_;
    std::vector<int> place_of_;
    std::vector<TopologyJoint> joints_;
    std::vector<int> close_; ///< for the kernel
    std::vector<int> bed_lists_;
    RigidOrder rigid_order_;
    Topology topology_;
    AlignedArray<double> memory_;
    Bundle bundle_;
    std::optional<SingleBundle> single_; ///< that is stepped for `bundle_`, in single precision
};

/// Accelerates a block (of the realization's numbering) from outside until the next call, in a model with mechanisms.
/// The work counts as the base's.
void nudge(LaneSet& set, int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2);

} // namespace stylobate
