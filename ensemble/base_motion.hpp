#pragma once
/// The base motion of one realization: by formula (harmonic, pulses), or along a record.

#include "ensemble/motion.hpp"
#include "ensemble/realization.hpp"
#include "ensemble/study.hpp"
#include "kernels/base_motion.hpp"

namespace stylobate {

class BaseMotion {
public:
    BaseMotion() = default;
    /// @param record needed for `ExcitationKind::record`, and must outlive this object
    BaseMotion(const ExcitationSpec& excitation, const Realization& realization, const Motion* record);

    static MotionFormula formula(ExcitationKind kind);

    /// Writes this realization's parameters into its lane.
    void store(const FormulaParameters& parameters, int lane) const;

    /// Record only: second differences of the displacement for `chunk_steps` steps from `first_step` on,
    /// into table[k * lanes].
    void fill(double first_step, double* table, int lanes) const;

    /// End of the shaking [s].
    double duration_s() const { return duration_s_; }
    /// Displacement of the base at a time [m].
    double displacement_m(double time_s) const;

private:
    MotionFormula formula_ = MotionFormula::still;
    double step_s_ = 0;
    double duration_s_ = 0;
    // formula
    double rate_hz_ = 0, amplitude_m_ = 0, cycles_ = 0, phase_cycles_ = 0, offset_ = 0;
    double start_ramps_per_cycle_ = 0, end_ramps_per_cycle_ = 0, end_velocity_ = 0;
    // record
    const Motion* record_ = nullptr;
    double spacing_s_ = 0; ///< of the record's samples after stretching its time
    double scale_ = 0;     ///< of its acceleration
};

/// How long a structure is watched after the shaking unless the study says: 12 / p with p = sqrt(3 g / (4 R)) and R
/// half the diagonal of the whole structure, which is about three times as long as it takes to topple from near its
/// balance.
double tail_after_shaking(const Realization& realization);

} // namespace stylobate
