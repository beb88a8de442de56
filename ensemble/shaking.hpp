#pragma once
/// How a realization is shaken: its frequency, its PGA, and what was drawn for its excitation.

#include "ensemble/motion.hpp"
#include "ensemble/realization.hpp"
#include "ensemble/study.hpp"

namespace stylobate {

/// What is drawn of the shaking, or its nominal value.
struct DrawnShaking {
    double base_tilt_rad = 0;
    double phase_rad = 0;
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
    double record_frequency_hz_ = 0;
    double record_pga_m_s2_ = 0;
};

} // namespace stylobate
