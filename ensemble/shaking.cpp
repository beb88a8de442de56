#include "ensemble/shaking.hpp"

#include <stdexcept>

namespace stylobate {

Shaking::Shaking(const Study& study, const Motion* record)
{
    if (study.excitation.kind != ExcitationKind::record)
        return;
    if (record == nullptr || record->empty())
        throw std::invalid_argument("a study with a record was given no base motion");
    record_frequency_hz_ = record->predominant_frequency_hz / study.excitation.time_scale;
    record_pga_m_s2_ = record->pga_m_s2;
}

void Shaking::apply(const Study& study, const DrawnShaking& drawn, Realization& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    realization.base_tilt_rad = drawn.base_tilt_rad;
    realization.phase_rad = drawn.phase_rad;
    if (study.surface) {
        const auto cell = static_cast<int>(study.cell(realization.index));
        realization.frequency_hz = study.surface->frequency_hz.value(cell / study.surface->pga_m_s2.count);
        realization.pga_m_s2 = study.surface->pga_m_s2.value(cell % study.surface->pga_m_s2.count);
        return;
    }
    switch (excitation.kind) {
    case ExcitationKind::none:
        break;
    case ExcitationKind::harmonic:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        realization.frequency_hz = excitation.frequency_hz;
        realization.pga_m_s2 = excitation.pga_m_s2;
        break;
    case ExcitationKind::record:
        realization.frequency_hz = record_frequency_hz_;
        realization.pga_m_s2 = excitation.pga_m_s2 > 0 ? excitation.pga_m_s2 : record_pga_m_s2_;
        break;
    }
}

} // namespace stylobate
