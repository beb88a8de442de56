#pragma once
/// One bundle at work: realizations are put into its lanes, stepped together, watched, and taken out one by one.

#include "ensemble/engine/limit_states.hpp"
#include "ensemble/engine/rigid_order.hpp"
#include "ensemble/engine/single_bundle.hpp"
#include "ensemble/engine/watch.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/numerics/aligned.hpp"
#include "ensemble/statics/scales.hpp"
#include "kernels/isa.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace stylobate {

/// Positions of all blocks of one realization, in the order of `Realization::blocks`, in the frame of the base.
struct Snapshot {
    std::vector<double> x_m, y_m, theta_rad; ///< (blocks) centres and rotations
};

/// A realization of the rigid form in the middle of a step, from where contacts that yield take it over: its blocks are
/// about to meet otherwise than at beds.
struct HandOver {
    Realization realization; ///< with rigid contacts
    Watch watch;
    LimitStates limits;
    std::vector<double> start_offset_m; ///< (beds) `face_offset` at rest
    double start_top_x_m = 0;
    std::vector<BlockMotion> moved, increment;     ///< (blocks) place, and change of it in the last step
    std::vector<double> max_rotation_rad;          ///< (beds)
    std::array<double, OfRealization::count> of{}; ///< as in the bundle
};

/// What is done to a realization is a function of it alone: whether it is looked at, ended or set aside depends on the
/// number of its own steps, never on its lane or on its neighbours.
class LaneSet {
public:
    /// @param record may be null unless the excitation is one
    /// @param waiting realizations that are to be put in: where they do not fit into one register, and the structure is
    ///        so small that two registers at a time are faster, there are twice as many lanes
    /// @throws std::invalid_argument if the study asks for single precision and the pattern for more than the paper's
    ///         model
    LaneSet(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern,
            std::uint64_t waiting = 1);

    /// What an empty lane has in place of blocks: faces of this half width, that may touch so deep [m]. The closed form
    /// of every contact form holds for them, so that the bundle does not take the general overlap, which is many times
    /// slower. Without stiffness they carry no force.
    static constexpr double empty_half_width = 0.01, empty_depth_limit = 1;

    int lanes() const { return static_cast<int>(lanes_); }
    int active() const { return active_; }
    bool free(int lane) const { return !places_[static_cast<std::size_t>(lane)].busy; }
    const Realization& realization(int lane) const { return places_[static_cast<std::size_t>(lane)].realization; }

    /// Puts a realization into a free lane, at its static rest.
    void load(int lane, Realization realization);
    /// Puts one into a free lane that a set of the rigid form has handed over. This set is made from the
    /// `compliant_form` of that set's pattern.
    void load(int lane, const HandOver& handed);

    /// Steps all lanes by one chunk and checks each; `outcome(lane)` then shows which have ended.
    void advance();
    /// Part of a chunk, for trajectories: steps `first` to `last - 1`; the check comes with the chunk's last step.
    void advance(int first, int last);

    /// Accelerates a block (of the realization's numbering) from outside until the next call, for the extended model:
    /// how a simulation is made to follow measured motion. The work counts as the base's.
    void nudge(int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2);

    // ---- a realization that is followed from outside: stepped without checks, read, nudged, and taken up elsewhere
    // ----

    /// All that the steps of a realization depend on but its base motion: in another lane, of this set or of another
    /// one for the same structure and model, it goes on with the same bits.
    std::vector<double> state(int lane) const;
    /// Puts a realization into a free lane when steps 0 to `phase - 1` of the chunk have been done: at its static rest.
    /// @pre its base motion is made on the host (`BaseMotion::on_host`), here and below
    void load_followed(int lane, Realization realization, int phase);
    /// The same in a state that it had after `step` steps; no nudging.
    void load_followed(int lane, Realization realization, int phase, const std::vector<double>& state,
                       std::uint64_t step);
    /// Steps `first` to `last - 1` of the chunk, and no check: nothing ends, nothing is set aside.
    void step_followed(int first, int last);
    /// Displacement of a block's geometric centre (of the realization's numbering) from the reference stack, along the
    /// axes of the laboratory even where the base turns.
    /// @param phase  number of steps of the chunk that are done: one of those that the last `step_followed` did, or now
    /// @param behind time before that, in steps: 0 to 1, on the straight line between the last two
    BlockMotion moved(int lane, int block, int phase, double behind = 0) const;
    /// What the last step added to it.
    BlockMotion increment(int lane, int block, int phase) const;

    // ---- a realization that a device steps (`slots.hpp`): what it needs, and what comes back ----

    const Topology& topology() const { return topology_; }
    std::size_t rigid_order_size() const { return rigid_order_.list.size(); }
    /// All of a realization's numbers, in the order of a slot's column (`slot_tasks.hpp`).
    /// @param column (column_rows);  @param samples where the device has those of the base's motion; null: nowhere
    void write_column(int lane, double* column, const double* samples) const;
    /// Takes its state and its watch over from a column.
    void read_column(int lane, const double* column);
    std::uint64_t steps(int lane) const { return places_[static_cast<std::size_t>(lane)].watch.steps; }
    /// Of the realizations at work, the one that is furthest in simulated time.
    SimulatedTime furthest() const;
    /// The check after `done` steps of a chunk, as `advance` does it; every `check_steps` there is one.
    void check(int lane, int done);
    /// What its base goes along (`BaseMotion::along_shared_samples`).
    SampledMotion samples(int lane) const { return motion(lane).samples(); }
    /// Whether the tables of its base motion are made on the host.
    bool tables_given(int lane) const;
    /// Makes them, for the chunk that begins at a step.
    /// @param tables (table_registers)
    void write_tables(int lane, std::uint64_t step, double* tables);

    /// The outcome of a realization that has ended.
    const std::optional<Outcome>& outcome(int lane) const { return places_[static_cast<std::size_t>(lane)].outcome; }
    /// What has become of one of the rigid form whose blocks are about to meet otherwise than at beds: it goes on in
    /// another set (`compliant_set.hpp`).
    const std::optional<HandOver>& handed(int lane) const { return places_[static_cast<std::size_t>(lane)].handed; }
    /// The same, of a realization of the rigid form that still runs.
    HandOver hand_over(int lane) const;
    /// Whether this set has done with a realization: it has ended, or is handed over.
    bool done(int lane) const { return outcome(lane) || handed(lane); }
    /// Frees a lane; its place is at rest and does nothing until the next `load`.
    void clear(int lane);

    /// Where the blocks are now: in the frame of the base, which turns with `BaseExtension::pitch_rad_s2_m`
    /// (`kernels/mechanisms/table_pitch.hpp` has the transformation to laboratory coordinates).
    Snapshot snapshot(int lane) const;
    const BaseMotion& motion(int lane) const { return places_[static_cast<std::size_t>(lane)].motion; }

private:
    struct Place {
        bool busy = false;
        Realization realization;
        Scales scales;
        BaseMotion motion;
        std::optional<BaseMotion> vertical; ///< where it has a record of its own
        std::optional<Outcome> outcome;
        std::optional<HandOver> handed;
        std::uint64_t steps_before = 0,
                      first_step = 0; ///< steps of the set that handed it over; the first one of its own
        Watch watch;
        LimitStates limits;
        std::vector<BlockMotion> moved;     ///< (blocks) at the last check
        std::vector<int> inside;            ///< (blocks) `OfBlock::inside` of its chunk
        std::vector<double> start_offset_m; ///< (beds) `face_offset` at rest
        double start_top_x_m = 0;
    };

    /// Parameters and static rest of a realization into its lane.
    void store_state(int lane, const Realization& r);
    void store_rigid(int lane, const Realization& r);
    void first_increments(int lane);
    void run(int first, int last);
    void begin_followed(int lane, int phase, std::uint64_t step);
    std::size_t state_registers() const { return bundle_registers(topology_) - chunk_steps; }
    std::array<double, chunk_steps> base_chunk(int lane, double first_step) const;
    /// The rotation of the base and its change in a step.
    struct Turn {
        double angle_rad = 0, increment_rad = 0;
    };
    static Turn turn_of(const Realization& r, double reach, double before, double now, double after);
    /// Time after a number of steps of the chunk.
    Turn turn(int lane, int phase) const;
    /// Field `OfBlock::x` of a (kernel's) block in a lane, then; the other traced fields follow, `lanes()` apart.
    const double* traced(int k, int lane, int phase) const;
    /// Makes the tables of the base's motion of the next chunk.
    void fill_tables();
    /// Tables of the vertical motion and of the base's rotation for the next chunk.
    void fill_extension(int lane);
    /// Which blocks the clamps join: the same in all realizations of a study.
    void list_clamps(const Realization& pattern);
    /// Displacement of a (kernel's) block's geometric centre.
    BlockMotion centre(int k, int lane) const;
    /// Where the blocks are, and when they were inside their limits last: into `Place::moved` and `Place::inside`.
    void read_motion(int lane);
    void end(int lane, State state, InvalidReason reason);

    const Study& study_;
    const Motion* record_;
    const KernelTable& kernels_;
    std::size_t lanes_ = 0;
    bool twice_ = false;        ///< whether two registers are stepped at a time
    std::vector<int> order_;    ///< kernel's block -> realization's block: the fixed ones first
    std::vector<int> place_of_; ///< realization's block -> kernel's block, -1 for one that touches no free block
    std::vector<TopologyJoint> joints_;
    std::vector<int> close_; ///< for the kernel
    std::vector<int> bed_lists_;
    RigidOrder rigid_order_;
    Topology topology_;
    AlignedArray<double> memory_;
    Bundle bundle_;
    AlignedArray<double> trace_; ///< of the last `step_followed`, which did the steps between these two of the chunk
    int trace_first_ = 0, trace_last_ = 0;
    std::optional<SingleBundle> single_; ///< that is stepped for `bundle_`, in single precision
    AlignedArray<double> parameters_memory_;
    FormulaParameters parameters_{};
    double* first_step_ = nullptr;
    std::vector<Place> places_;
    int active_ = 0;
};

} // namespace stylobate
