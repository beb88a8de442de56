#include "ensemble/base_motion.hpp"

#include "ensemble/scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

constexpr double abrupt = 1e300; // ramps per cycle of an abrupt start: any time > 0 is past it

} // namespace

MotionFormula BaseMotion::formula(ExcitationKind kind)
{
    switch (kind) {
    case ExcitationKind::harmonic:
        return MotionFormula::harmonic;
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        return MotionFormula::pulse;
    default:
        return MotionFormula::still;
    }
}

BaseMotion::BaseMotion(const ExcitationSpec& e, const Realization& r, const Motion* record)
    : formula_(formula(e.kind)), step_s_(r.step_s)
{
    if (e.kind == ExcitationKind::none) {
        duration_s_ = e.duration_s;
        return;
    }
    if (e.kind == ExcitationKind::record) {
        // a surface's frequency axis is the record's predominant frequency, moved by stretching its time
        follow(*record, record->predominant_frequency_hz / r.frequency_hz,
               r.pga_m_s2 > 0 ? r.pga_m_s2 / record->pga_m_s2 : 1);
        return;
    }
    if (e.kind == ExcitationKind::noise) {
        own_ = r.motion;
        follow(*own_, 1, 1);
        return;
    }
    if (SyntheticMotion::covers(e.kind)) {
        synthetic_.emplace(e, r);
        duration_s_ = synthetic_->duration_s();
        return;
    }
    const double w = 2 * std::numbers::pi * r.frequency_hz;
    rate_hz_ = r.frequency_hz;
    amplitude_m_ = r.pga_m_s2 / (w * w);
    if (formula_ == MotionFormula::pulse) {
        cycles_ = e.kind == ExcitationKind::half_sine ? 0.5 : 1;
        end_velocity_ = e.kind == ExcitationKind::half_sine ? 2 : 0;
    } else {
        cycles_ = e.cycles;
        const double turns = r.phase_rad / (2 * std::numbers::pi);
        phase_cycles_ = turns - std::nearbyint(turns);
        const bool smooth_start = e.start == HarmonicEdge::smooth;
        offset_ = smooth_start ? 0 : std::sin(r.phase_rad);
        start_ramps_per_cycle_ = smooth_start ? 1 / e.ramp_cycles : abrupt;
        end_ramps_per_cycle_ = e.end == HarmonicEdge::smooth ? 1 / e.ramp_cycles : abrupt;
    }
    duration_s_ = cycles_ / rate_hz_;
}

BaseMotion BaseMotion::along(std::shared_ptr<const Motion> motion, double step_s)
{
    BaseMotion base;
    base.own_ = std::move(motion);
    base.step_s_ = step_s;
    base.follow(*base.own_, 1, 1);
    return base;
}

bool BaseMotion::on_host(ExcitationKind kind)
{
    return kind == ExcitationKind::record || kind == ExcitationKind::noise || SyntheticMotion::covers(kind);
}

void BaseMotion::follow(const Motion& motion, double stretch, double scale)
{
    record_ = &motion;
    spacing_s_ = motion.dt_s * stretch;
    scale_ = scale;
    duration_s_ = motion.duration_s() * stretch;
}

void BaseMotion::store(const FormulaParameters& p, int lane) const
{
    p.cycles_per_step[lane] = rate_hz_ * step_s_;
    p.amplitude_m[lane] = amplitude_m_;
    p.cycles[lane] = cycles_;
    p.phase_cycles[lane] = phase_cycles_;
    p.offset[lane] = offset_;
    p.start_ramps_per_cycle[lane] = start_ramps_per_cycle_;
    p.end_ramps_per_cycle[lane] = end_ramps_per_cycle_;
    p.end_velocity[lane] = end_velocity_;
}

void BaseMotion::fill(double first_step, double* table, int lanes) const
{
    if (synthetic_)
        fill_synthetic(first_step, table, lanes);
    else
        fill_sampled(first_step, table, lanes);
}

void BaseMotion::fill_synthetic(double first_step, double* table, int lanes) const
{
    std::array<double, chunk_steps + 2> u; // from one step before the chunk to one after it
    synthetic_->sample(first_step - 1, step_s_, u);
    for (std::size_t k = 0; k < chunk_steps; ++k) {
        // once it is over nothing but rounding is left of the difference
        const bool over = (first_step + static_cast<double>(k) - 1) * step_s_ >= duration_s_;
        table[k * static_cast<std::size_t>(lanes)] = over ? 0 : (u[k + 2] - u[k + 1]) - (u[k + 1] - u[k]);
    }
}

void BaseMotion::fill_sampled(double first_step, double* table, int lanes) const
{
    // The second difference of a displacement with piecewise linear acceleration is dt2 times the acceleration, plus
    // what the bend at the nearest sample adds within one step of it: (change of slope) x (dt - distance)^3 / 6.
    const std::vector<double>& a = record_->acceleration_m_s2;
    const double last = static_cast<double>(a.size() - 1);
    const double ratio = step_s_ / spacing_s_; // steps in samples
    const double dt2 = step_s_ * step_s_ * scale_;
    const auto sample = [&](double i) { return i < 0 || i > last ? 0.0 : a[static_cast<std::size_t>(i)]; };
    for (int k = 0; k < chunk_steps; ++k) {
        const double position = (first_step + k) * ratio;
        if (position - ratio > last + 1) { // the motion ends one sample after its last, at rest
            table[k * lanes] = 0;
            continue;
        }
        const double i = std::floor(position);
        const double a0 = sample(i), a1 = sample(i + 1);
        double difference = dt2 * std::fma(position - i, a1 - a0, a0);
        for (double knot = std::ceil(position - ratio); knot < position + ratio; ++knot) {
            const double reach = ratio - std::fabs(position - knot);
            const double bend = sample(knot + 1) - 2 * sample(knot) + sample(knot - 1);
            difference += dt2 * bend * reach * reach * reach / (6 * ratio * ratio);
        }
        table[k * lanes] = difference;
    }
}

double BaseMotion::displacement_m(double time_s) const
{
    if (time_s <= 0)
        return 0;
    if (synthetic_)
        return synthetic_->displacement_m(time_s);
    if (record_ != nullptr) {
        // the acceleration goes to 0 within one sample after the last one, as in `fill`; then the velocity stays
        const std::vector<double>& a = record_->acceleration_m_s2;
        const double position = time_s / spacing_s_;
        const std::size_t i = std::min(static_cast<std::size_t>(position), a.size() - 1);
        const double d = record_->dt_s, t = (position - static_cast<double>(i)) * d, within = std::min(t, d);
        const double a0 = a[i], jerk = ((i + 1 < a.size() ? a[i + 1] : 0) - a0) / d;
        const double v = record_->velocity_m_s[i];
        const double u = record_->displacement_m[i] + within * (v + within * (a0 / 2 + within * jerk / 6)) +
                         (t - within) * (v + d * (a0 + d * jerk / 2));
        const double stretch = spacing_s_ / d;
        return u * scale_ * stretch * stretch;
    }
    double rate = rate_hz_ * time_s, amplitude = amplitude_m_, cycles = cycles_, phase = phase_cycles_,
           offset = offset_, start = start_ramps_per_cycle_, end = end_ramps_per_cycle_, velocity = end_velocity_;
    const FormulaParameters p{&rate, &amplitude, &cycles, &phase, &offset, &start, &end, &velocity};
    return base_displacement<double>(formula_, p, 1.0);
}

double tail_after_shaking(const Realization& realization)
{
    return 12 / scales_of(realization).p_rad_s;
}

} // namespace stylobate
