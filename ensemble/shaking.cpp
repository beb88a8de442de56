#include "ensemble/shaking.hpp"

#include "ensemble/synthetic_noise.hpp"

#include <memory>
#include <stdexcept>

namespace stylobate {

Shaking::Shaking(const Study& study, const Motion* record)
{
    const ExcitationSpec& excitation = study.excitation;
    if (excitation.kind == ExcitationKind::record) {
        if (record == nullptr || record->empty())
            throw std::invalid_argument("a study with a record was given no base motion");
        record_frequency_hz_ = record->predominant_frequency_hz / excitation.time_scale;
        record_pga_m_s2_ = record->pga_m_s2;
    }
    if (excitation.kind == ExcitationKind::noise && excitation.pga_of == PgaOf::mean) {
        const int frequencies = study.surface ? study.surface->frequency_hz.count : 1;
        for (int i = 0; i < frequencies; ++i) {
            const double frequency = study.surface ? study.surface->frequency_hz.value(i) : excitation.frequency_hz;
            mean_peak_.push_back(SyntheticNoise(excitation, frequency).mean_peak(study.seed));
        }
    }
}

void Shaking::apply(const Study& study, const DrawnShaking& drawn, Realization& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    realization.base_tilt_rad = drawn.base_tilt_rad;
    realization.phase_rad = drawn.phase_rad;
    realization.pulse_gamma = drawn.pulse_gamma;
    std::size_t row = 0; // of the surface
    if (study.surface) {
        const auto cell = static_cast<int>(study.cell(realization.index));
        const int columns = study.surface->pga_m_s2.count;
        row = static_cast<std::size_t>(cell / columns);
        realization.frequency_hz = study.surface->frequency_hz.value(cell / columns);
        realization.pga_m_s2 = study.surface->pga_m_s2.value(cell % columns);
    } else {
        set_nominal(excitation, drawn, realization);
    }
    if (excitation.kind == ExcitationKind::noise) {
        const SyntheticNoise noise(excitation, realization.frequency_hz);
        realization.motion = std::make_shared<const Motion>(
            excitation.pga_of == PgaOf::mean
                ? noise.motion(study.seed, realization.index, realization.pga_m_s2 / mean_peak_[row])
                : noise.motion_of_peak(study.seed, realization.index, realization.pga_m_s2));
    }
}

/// Frequency and PGA of a study that is no surface.
void Shaking::set_nominal(const ExcitationSpec& excitation, const DrawnShaking& drawn, Realization& realization) const
{
    if (excitation.kind != ExcitationKind::none)
        realization.pga_m_s2 = excitation.pga_m_s2;
    switch (excitation.kind) {
    case ExcitationKind::none:
        break;
    case ExcitationKind::harmonic:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
    case ExcitationKind::ricker:
    case ExcitationKind::tapered:
    case ExcitationKind::noise:
        realization.frequency_hz = excitation.frequency_hz;
        break;
    case ExcitationKind::pulse:
        realization.frequency_hz = drawn.pulse_frequency_hz;
        break;
    case ExcitationKind::sweep:
        realization.frequency_hz = excitation.central_frequency_hz();
        break;
    case ExcitationKind::record:
        realization.frequency_hz = record_frequency_hz_;
        if (!(excitation.pga_m_s2 > 0))
            realization.pga_m_s2 = record_pga_m_s2_;
        break;
    }
}

} // namespace stylobate
