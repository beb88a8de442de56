#pragma once
/// Statics of the nominal structure of a study: first frequency, limit of rest.

#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"

#include <cstddef>
#include <optional>

namespace stylobate {

/// The structure of a study on its beds, without shaking, without mechanisms and without anything drawn.
Realization still_realization(const Study& study);

/// The first natural frequency of the nominal structure, without mechanisms, its beds in full contact [Hz] (generalized
/// eigenvalue problem K v = w2 M v): 0 if it buckles under its own weight.
double first_frequency_hz(const Study& study);

/// The structure of a study as it stands on rigid beds, nothing drawn: the largest base acceleration, held for ever,
/// at which it can rest [m/s2] (limit analysis, `ensemble/planar/structure/limit_analysis.hpp`).
struct StaticLimit {
    double rocking_m_s2 = 0; ///< if no bed could slide
    double limit_m_s2 = 0;   ///< with the friction of the study
    double rough_m_s2 = 0;   ///< with a tenth more of it
};
inline constexpr std::ptrdiff_t most_static_limit_blocks = 60;
/// Nothing for more free blocks than `most_static_limit_blocks`, for which the dense linear programme is slow, and
/// where rigid blocks cannot rest. @throws InputError as `lay_out`
std::optional<StaticLimit> static_limit(const Study& study);

} // namespace stylobate
