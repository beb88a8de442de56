#pragma once
/// How a realization is shaken: its frequency, its PGA, and what was drawn for its excitation.

#include "ensemble/motion.hpp"
#include "ensemble/realization.hpp"
#include "ensemble/study.hpp"

#include <vector>

namespace stylobate {

/// What is drawn of the shaking, or its nominal value.
struct DrawnShaking {
    double base_tilt_rad = 0;
    double phase_rad = 0;
    double pulse_frequency_hz = 0; ///< of a study that is no surface
    double pulse_gamma = 0;
};

/// The part of a realization that says how it is shaken: a pure function of (study, index) and what was drawn.
class Shaking {
public:
    Shaking() = default;
    /// @param record the base motion of a study with `excitation.kind = "record"`, else ignored; not kept
    /// @throws std::invalid_argument if such a study comes without its record
    Shaking(const Study& study, const Motion* record);

    /// Fills in the shaking of a realization whose index is set.
    /// @param study the one this was made for
    void apply(const Study& study, const DrawnShaking& drawn, Realization& realization) const;

private:
    void set_nominal(const ExcitationSpec& excitation, const DrawnShaking& drawn, Realization& realization) const;

    double record_frequency_hz_ = 0;
    double record_pga_m_s2_ = 0;
    std::vector<double>
        mean_peak_; ///< noise with the PGA of the mean: of unit noise, a surface's frequency by frequency
};

} // namespace stylobate
