#pragma once
/// The shaking of a realization: its frequency, its PGA, and the drawn parameters of its excitation.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/distortion.hpp"

#include <memory>
#include <span>
#include <vector>

namespace stylobate {

/// The drawn parameters of the shaking, or their nominal values.
struct DrawnShaking {
    double phase_rad = 0;
    double pulse_frequency_hz = 0; ///< of a study other than a surface
    double pulse_gamma = 0;
    double direction_rad = 0; ///< of a study in space
};

/// The shaking as a part of a realization: a pure function of (study, index) and the drawn parameters.
class Shaking {
public:
    Shaking() = default;
    /// @param record   the base motion of a study with `excitation.kind` "record" or "table", else ignored; not kept
    /// @param vertical that of a study with a vertical record, else ignored; not kept
    /// @param motions  those of a study with a set of motions, else ignored
    /// @param second   the second horizontal component of a record in space, else ignored; not kept
    /// @throws std::invalid_argument if such a study comes without its record, second component, vertical record or
    ///         motions
    Shaking(const Study& study, const Motion* record, const Motion* vertical,
            std::shared_ptr<const MotionSet> motions = nullptr, const Motion* second = nullptr);

    /// Fills in the shaking of a realization whose index and whose `change` of the base motion are set.
    /// @param study  the one this was made for
    /// @param scales of the realization: a pause between several events follows from them
    void apply(const Study& study, const DrawnShaking& drawn, const Scales& scales,
               RealizationHeader& realization) const;
    /// About how long `apply` would shake it [s], without making its motion. Of its shaking the realization then has
    /// its frequency, PGA and direction.
    double duration_s(const Study& study, const DrawnShaking& drawn, const Scales& scales,
                      RealizationHeader& realization) const;

private:
    /// What the cell and the drawn parameters give. @return the row of cells
    std::size_t set_cell(const Study& study, const StudyDesign& design, const DrawnShaking& drawn,
                         RealizationHeader& realization) const;
    void set_nominal(const ExcitationSpec& excitation, const DrawnShaking& drawn, RealizationHeader& realization) const;
    void apply_motion(const StudyDesign& design, RealizationHeader& realization) const;
    void shake_by_noise(const Study& study, std::uint64_t motion, std::size_t row,
                        RealizationHeader& realization) const;
    void distort(const ExcitationSpec& excitation, RealizationHeader& realization) const;
    void distort_second(const ExcitationSpec& excitation, RealizationHeader& realization) const;
    void move_vertically(RealizationHeader& realization) const;
    /// Several events instead of one. @param row of the surface
    void repeat(const Study& study, int events, std::size_t row, const Scales& scales,
                RealizationHeader& realization) const;

    Motion record_;                           ///< where it is distorted, or repeated
    Distortion distortion_;                   ///< of it
    std::shared_ptr<const Motion> distorted_; ///< the record as every realization has it; null where each has its own
    std::shared_ptr<const Motion> second_;    ///< of a record in space
    std::shared_ptr<const Motion> vertical_;
    std::shared_ptr<const MotionSet> motions_;
    double predominant_hz_ = 0; ///< of the record as it stands; 0: there is none
    double record_s_ = 0;       ///< its duration
    double record_frequency_hz_ = 0;
    double record_pga_m_s2_ = 0; ///< of a pair by its definition
    double first_share_ = 1;     ///< PGA of its first component over that
    std::vector<double>
        mean_peak_; ///< noise with the PGA of the mean: of unit noise, a surface's frequency by frequency
};

/// Several events in succession as one motion: what the first has displaced the next one finds so. All events of a
/// realization have its frequency and its PGA. Noise is drawn anew for each; any other motion is the same again.
/// Between the end of one and the begin of the next the ground is at rest, or moves on at the velocity that the first
/// has left it, for a pause in which the structure comes to rest (own choice of a history: a past of n equally strong
/// events). The accelerations stand one after the other, with `pause_s` of rest after each but the last; all samples
/// have the spacing of the first motion.
/// @pre at least one motion; all have the same spacing
Motion repeated_motion(std::span<const Motion> events, double pause_s);

} // namespace stylobate
