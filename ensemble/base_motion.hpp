#pragma once
/// The base motion of one realization: by the kernels' formulas (harmonic, half and full sine), by one in closed form
/// on the host (the other pulses and sines), or along a record or noise.

#include "ensemble/motion.hpp"
#include "ensemble/realization.hpp"
#include "ensemble/study.hpp"
#include "ensemble/synthetic_motion.hpp"
#include "kernels/base_motion.hpp"

#include <memory>
#include <optional>

namespace stylobate {

class BaseMotion {
public:
    BaseMotion() = default;
    /// @param record needed for `ExcitationKind::record`, and must outlive this object; a realization with a motion of
    ///        its own (noise) is driven by that
    BaseMotion(const ExcitationSpec& excitation, const Realization& realization, const Motion* record);

    /// Along samples from time 0 on, for steps of `step_s`.
    static BaseMotion along(std::shared_ptr<const Motion> motion, double step_s);

    static MotionFormula formula(ExcitationKind kind);
    /// Whether `fill` makes the table, not the kernels.
    static bool on_host(ExcitationKind kind);

    /// Writes this realization's parameters into its lane.
    void store(const FormulaParameters& parameters, int lane) const;

    /// @pre on_host: second differences of the displacement for `chunk_steps` steps from `first_step` on, into
    /// table[k * lanes]. Their bits depend on the realization and the step only.
    void fill(double first_step, double* table, int lanes) const;

    /// End of the shaking [s].
    double duration_s() const { return duration_s_; }
    /// Between the samples that it goes along [s]; 0 where it is in closed form.
    double spacing_s() const { return spacing_s_; }
    /// Displacement of the base at a time [m].
    double displacement_m(double time_s) const;

private:
    void follow(const Motion& motion, double stretch, double scale);
    void fill_sampled(double first_step, double* table, int lanes) const;
    void fill_synthetic(double first_step, double* table, int lanes) const;

    MotionFormula formula_ = MotionFormula::still;
    double step_s_ = 0;
    double duration_s_ = 0;
    // formula
    double rate_hz_ = 0, amplitude_m_ = 0, cycles_ = 0, phase_cycles_ = 0, offset_ = 0;
    double start_ramps_per_cycle_ = 0, end_ramps_per_cycle_ = 0, end_velocity_ = 0;
    // closed form on the host
    std::optional<SyntheticMotion> synthetic_;
    // sampled
    std::shared_ptr<const Motion> own_; ///< keeps alive what `record_` points to where it is no record
    const Motion* record_ = nullptr;
    double spacing_s_ = 0; ///< of the record's samples after stretching its time
    double scale_ = 0;     ///< of its acceleration
};

/// How long a structure is watched after the shaking unless the study says: 12 / p with p = sqrt(3 g / (4 R)) and R
/// half the diagonal of the whole structure, which is about three times as long as it takes to topple from near its
/// balance.
double tail_after_shaking(const Realization& realization);

} // namespace stylobate
