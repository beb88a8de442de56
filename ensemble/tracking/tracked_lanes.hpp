#pragma once
/// Lanes whose realizations are watched from outside: stepped without checks, read, nudged, and continued elsewhere.

#include "ensemble/planar/planar_model.hpp"

#include <vector>

namespace stylobate {

class TrackedLanes {
public:
    /// Arguments as those of `LaneSet`; the pattern is one of a model with mechanisms, whose steps leave a trace.
    TrackedLanes(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern)
        : set_(study, record, kernels, pattern)
    {
    }

    int lanes() const { return set_.lanes(); }
    int active() const { return set_.active(); }
    bool free(int lane) const { return set_.free(lane); }
    void clear(int lane) { set_.clear(lane); }

    /// All that the steps of a realization depend on but its base motion: in another lane, of this set or of another
    /// one for the same structure and model, it goes on with the same bits.
    std::vector<double> state(int lane) const;
    /// Puts a realization into a free lane when steps 0 to `phase - 1` of the chunk have been done: at its static rest.
    /// @pre its base motion is made on the host (`BaseMotion::on_host`), here and below
    void load(int lane, Realization realization, int phase);
    /// In a state that it had after `step` steps; no nudging.
    void load(int lane, Realization realization, int phase, const std::vector<double>& state, std::uint64_t step);
    /// Accelerates a block (of the realization's numbering) from outside until the next call: how a simulation is made
    /// to follow measured motion. The work counts as the base's.
    void nudge(int lane, int block, double x_m_s2, double y_m_s2, double theta_rad_s2);
    /// Steps `first` to `last - 1` of the chunk, and no check: nothing ends, nothing is set aside.
    void step(int first, int last);
    /// Displacement of a block's geometric centre (of the realization's numbering) from the reference stack, along the
    /// axes of the laboratory even where the base turns.
    /// @param phase  number of steps of the chunk that are done: one of those that the last `step` did, or now
    /// @param behind time before that, in steps: 0 to 1, on the straight line between the last two
    BlockMotion moved(int lane, int block, int phase, double behind = 0) const;
    /// What the last step added to it.
    BlockMotion increment(int lane, int block, int phase) const;

private:
    const Topology& topology() const { return set_.model().topology(); }
    std::size_t state_registers() const { return bundle_registers(topology()) - chunk_steps; }
    std::size_t stride() const { return static_cast<std::size_t>(lanes()); }
    void begin(int lane, int phase, std::uint64_t step);
    /// The rotation of the base after a number of steps of the chunk.
    PlanarModel::Turn turn(int lane, int phase) const;
    /// Field `OfBlock::x` of a (kernel's) block in a lane, then; the other traced fields follow, `lanes()` apart.
    const double* traced(int k, int lane, int phase) const;

    LaneSet set_;
    AlignedArray<double> trace_; ///< of the last `step`, which did the steps between these two of the chunk
    int trace_first_ = 0, trace_last_ = 0;
};

} // namespace stylobate
