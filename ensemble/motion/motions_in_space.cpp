#include "ensemble/motion/motions_in_space.hpp"

#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/numerics/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

/// A motion of the same shape, `factor` times as large.
RealizationHeader times(RealizationHeader realization, double factor)
{
    realization.pga_m_s2 *= factor;
    realization.motion_scale *= factor;
    return realization;
}

bool has_phase(ExcitationKind kind)
{
    return kind == ExcitationKind::harmonic || kind == ExcitationKind::tapered || kind == ExcitationKind::pulse;
}

/// At rest, in the form in which the kernels or the host make the tables of the other components.
BaseMotion still(const ExcitationSpec& excitation, const RealizationHeader& first)
{
    const bool by_kernels = BaseMotion::formula(excitation.kind) != MotionFormula::still && first.motion == nullptr;
    return by_kernels ? BaseMotion(excitation, times(first, 0), nullptr) : BaseMotion{};
}

} // namespace

RealizationHeader first_component(const RealizationHeader& realization)
{
    RealizationHeader first = realization;
    first.pga_m_s2 *= realization.first_share;
    return first;
}

RealizationHeader second_component(const ExcitationSpec& excitation, const RealizationHeader& first)
{
    RealizationHeader second = times(first, excitation.second_ratio);
    if (has_phase(excitation.kind))
        second.phase_rad += excitation.second_phase_deg * (std::numbers::pi / 180);
    return second;
}

std::array<BaseMotion, 3> motions_in_space(const ExcitationSpec& excitation, const RealizationHeader& realization,
                                           const Motion* record)
{
    const RealizationHeader first = first_component(realization);
    std::array<BaseMotion, 3> motions = {BaseMotion(excitation, first, record), still(excitation, first),
                                         still(excitation, first)};
    if (realization.second != nullptr) {
        RealizationHeader second = first;
        second.motion = realization.second;
        motions[1] = BaseMotion(excitation, second, record);
    } else if (excitation.second_ratio > 0 && first.motion == nullptr) {
        motions[1] = BaseMotion(excitation, second_component(excitation, first), record);
    }
    if (realization.vertical != nullptr)
        motions[2] = BaseMotion::along(realization.vertical, realization.step_s, realization.change.offset_s);
    else if (excitation.vertical_ratio > 0)
        motions[2] = BaseMotion(excitation, times(first, excitation.vertical_ratio), record);
    return motions;
}

double pga_of_pair_over_first(const ExcitationSpec& excitation, const RealizationHeader& realization)
{
    const double ratio = excitation.second_ratio, ratio2 = ratio * ratio;
    if (ratio == 0 || excitation.pga_of_pair != OfPair::at_once)
        return size_of_pair(ratio == 0 ? OfPair::first : excitation.pga_of_pair, 1, ratio, 1);
    double at_once = std::sqrt(1 + ratio2);
    if (excitation.kind == ExcitationKind::harmonic) {
        const double cosine = cosine_of(excitation.second_phase_deg / 180); // of twice the phase, in cycles
        at_once = std::sqrt((1 + ratio2 + std::sqrt(1 + ratio2 * ratio2 + 2 * ratio2 * cosine)) / 2);
    } else if (has_phase(excitation.kind) && excitation.second_phase_deg != 0) {
        RealizationHeader first = realization;
        first.pga_m_s2 = 1;
        at_once = peak_at_once(SyntheticMotion(excitation, first),
                               SyntheticMotion(excitation, second_component(excitation, first)));
    }
    return at_once;
}

} // namespace stylobate
