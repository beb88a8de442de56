#pragma once
/// The base motion of one realization: by the kernels' formulas (harmonic, half and full sine), by one in closed form
/// on the host (the other pulses and sines), or along samples (a record, a table, noise, a distorted motion).
/// `kernels/THEORY.md`, section 4, derives the second differences.
///
/// A realization may change it (`BaseChange`). A gain multiplies it. With an offset in time the base is at time t where
/// it would be at t + offset: for an offset > 0 the structure has moved with the base, at rest on it, up to the start.
/// Harmonic distortion of a harmonic motion is in its formula, with the same ramps (own choice):
///
///   U = A s(...) s(...) (w(c + phase) - w(phase)),
///   w(c) = sin 2 pi c + sum over m = 2, 3 of a_m sin 2 pi m c + b_m cos 2 pi m c
///
/// with w(phase) for an abrupt start only, as in the kernels' formula. For all other motions see `distortion.hpp`.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "kernels/base_motion.hpp"
#include "kernels/sampled_motion.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace stylobate {

class BaseMotion {
public:
    BaseMotion() = default;
    /// @param record needed for a record or a table (except in a fragility study), and must outlive this object; a
    ///        realization with its own motion (noise, a distorted motion, one of a set) is driven by that
    BaseMotion(const ExcitationSpec& excitation, const RealizationHeader& realization, const Motion* record);

    /// Along samples, for steps of `step_s`, from the time `offset_s` of the samples on.
    static BaseMotion along(std::shared_ptr<const Motion> motion, double step_s, double offset_s = 0);

    static MotionFormula formula(ExcitationKind kind);
    /// Whether `fill` computes the table, not the kernels: the same for all realizations of a study.
    static bool on_host(const Study& study);
    /// Whether the realizations of a study go along samples that they share and that outlive them, from the beginning
    /// of the samples on: a record, a table, the motions of a fragility study.
    static bool along_shared_samples(const Study& study);
    /// What it goes along.
    /// @pre it goes along samples, and `sample` is read no longer than these live
    SampledMotion samples() const;

    /// Writes this realization's parameters into its lane.
    void store(const FormulaParameters& parameters, int lane) const;

    /// Second differences of the displacement for `chunk_steps` steps from `first_step` on, into
    /// table[k * lanes]. Their bits depend on the realization and the step only.
    void fill(double first_step, double* table, int lanes) const;

    /// End of the shaking [s].
    double duration_s() const { return std::max(0.0, duration_s_ - change_.offset_s); }
    /// Between the samples that it goes along [s]; 0 where it is in closed form.
    double spacing_s() const { return spacing_s_; }
    /// Displacement of the base at a time [m].
    double displacement_m(double time_s) const;

private:
    void follow(const Motion& motion, double stretch, double scale);
    void fill_formula(double first_step, double* table, int lanes) const;
    void fill_sampled(double first_step, double* table, int lanes) const;
    void fill_synthetic(double first_step, double* table, int lanes) const;
    FormulaParameters parameters(std::array<double, 8>& values, double cycles_per_step) const;
    double formula_displacement(double cycles_per_step, double steps) const;
    double distorted_harmonic(double cycles_per_step, double steps) const;
    double wave(double cycles) const;
    double own_displacement_m(double time_s) const;

    MotionFormula formula_ = MotionFormula::still;
    BaseChange change_;
    double step_s_ = 0;
    double duration_s_ = 0; ///< of the motion without its offset
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

/// A motion by one of the kernels' formulas along samples, as dense as those of `sampled(SyntheticMotion)`.
/// @pre it starts at rest
Motion sampled(const BaseMotion& motion, double fastest_hz);

/// Default of the simulated time after the shaking: 12 / p with p = sqrt(3 g / (4 R)) (Housner, "The behavior of
/// inverted pendulum structures during earthquakes", Bulletin of the Seismological Society of America 53 (1963) 403)
/// and R half the diagonal of the whole structure. This is about three times the time in which it overturns from near
/// its unstable equilibrium (own choice).
double tail_after_shaking(const Scales& scales);
/// Limit of the simulated time after the shaking where a study reports what remains of the motion (`Tail::rest`):
/// `rest_tails` times as long.
double longest_tail(const Scales& scales);
/// Default of the time between earthquakes that follow each other: 10 times `tail_after_shaking`. A stack rocks on for
/// long: after a short pause the next earthquake meets it in motion, which topples it more easily.
double pause_until_rest(const Scales& scales);
/// The most that is simulated after the shaking of a realization [s]; 0 where nothing shakes.
double tail_s(const ExcitationSpec& excitation, const Scales& scales);

} // namespace stylobate
