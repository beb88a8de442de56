#include "ensemble/motion/base_motion.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/numerics/elementary.hpp"

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

BaseMotion::BaseMotion(const ExcitationSpec& e, const RealizationHeader& r, const Motion* record)
    : formula_(formula(e.kind)), change_(r.change), step_s_(r.step_s)
{
    if (e.kind == ExcitationKind::none) {
        duration_s_ = e.duration_s;
        return;
    }
    const bool sampled = e.kind == ExcitationKind::record || e.kind == ExcitationKind::table;
    if (sampled && record != nullptr) {
        // a surface's frequency axis is the record's predominant frequency, moved by stretching its time
        own_ = r.motion;
        follow(own_ ? *own_ : *record, record->predominant_frequency_hz / r.frequency_hz,
               r.pga_m_s2 > 0 ? r.pga_m_s2 / record->pga_m_s2 : 1);
        return;
    }
    if (r.motion) {
        own_ = r.motion;
        follow(*own_, 1, r.motion_scale);
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

BaseMotion BaseMotion::along(std::shared_ptr<const Motion> motion, double step_s, double offset_s)
{
    BaseMotion base;
    base.own_ = std::move(motion);
    base.step_s_ = step_s;
    base.change_.offset_s = offset_s;
    base.follow(*base.own_, 1, 1);
    return base;
}

bool BaseMotion::on_host(const Study& study)
{
    const ExcitationKind kind = study.excitation.kind;
    return study.design().motions != nullptr || study.events() > 1 || kind == ExcitationKind::record ||
           kind == ExcitationKind::table || kind == ExcitationKind::noise || SyntheticMotion::covers(kind) ||
           study.names(Mechanism::time_offset) || study.names(Mechanism::harmonic_distortion);
}

bool BaseMotion::along_shared_samples(const Study& study)
{
    const ExcitationKind kind = study.excitation.kind;
    const bool shared =
        study.design().motions != nullptr || kind == ExcitationKind::record || kind == ExcitationKind::table;
    return shared && study.events() == 1 && !study.names(Mechanism::time_offset) &&
           !study.names(Mechanism::harmonic_distortion);
}

void BaseMotion::follow(const Motion& motion, double stretch, double scale)
{
    record_ = &motion;
    spacing_s_ = motion.dt_s * stretch;
    scale_ = scale * change_.gain;
    duration_s_ = motion.duration_s() * stretch;
}

void BaseMotion::store(const FormulaParameters& p, int lane) const
{
    p.cycles_per_step[lane] = rate_hz_ * step_s_;
    p.amplitude_m[lane] = amplitude_m_ * change_.gain;
    p.cycles[lane] = cycles_;
    p.phase_cycles[lane] = phase_cycles_;
    p.offset[lane] = offset_;
    p.start_ramps_per_cycle[lane] = start_ramps_per_cycle_;
    p.end_ramps_per_cycle[lane] = end_ramps_per_cycle_;
    p.end_velocity[lane] = end_velocity_;
}

void BaseMotion::fill(double first_step, double* table, int lanes) const
{
    if (record_ != nullptr)
        fill_sampled(first_step, table, lanes);
    else if (synthetic_)
        fill_synthetic(first_step, table, lanes);
    else
        fill_formula(first_step, table, lanes);
}

void BaseMotion::fill_formula(double first_step, double* table, int lanes) const
{
    // as the kernels do it, at times between the steps; without an offset with the same bits
    const double rate = rate_hz_ * step_s_, first = first_step + change_.offset_s / step_s_;
    const double over = formula_ == MotionFormula::still ? 0 : cycles_ / rate;
    double before = formula_displacement(rate, first - 1), now = formula_displacement(rate, first);
    for (int k = 0; k < chunk_steps; ++k) {
        const double n = first + k, next = formula_displacement(rate, n + 1);
        table[k * lanes] = n - 1 >= over ? 0 : (next - now) - (now - before);
        before = now;
        now = next;
    }
}

void BaseMotion::fill_synthetic(double first_step, double* table, int lanes) const
{
    std::array<double, chunk_steps + 2> u; // from one step before the chunk to one after it
    const double first = first_step + change_.offset_s / step_s_;
    synthetic_->sample(first - 1, step_s_, u);
    for (std::size_t k = 0; k < chunk_steps; ++k) {
        // once it is over nothing but rounding is left of the difference
        const bool over = (first + static_cast<double>(k) - 1) * step_s_ >= duration_s_;
        table[k * static_cast<std::size_t>(lanes)] =
            over ? 0 : change_.gain * ((u[k + 2] - u[k + 1]) - (u[k + 1] - u[k]));
    }
}

SampledMotion BaseMotion::samples() const
{
    const std::vector<double>& a = record_->acceleration_m_s2;
    return {a.data(), static_cast<double>(a.size() - 1), step_s_ / spacing_s_, step_s_ * step_s_ * scale_};
}

void BaseMotion::fill_sampled(double first_step, double* table, int lanes) const
{
    const SampledMotion m = samples();
    if (change_.offset_s == 0)
        return fill_sampled_rows(m, first_step, table, lanes);
    const double shift = change_.offset_s / spacing_s_;
    for (int k = 0; k < chunk_steps; ++k) {
        const double position = (first_step + k) * m.ratio + shift;
        if (position >= m.ratio) {
            table[k * lanes] = sampled_difference(m, position);
            continue;
        }
        // about the start, where the acceleration may jump: the displacement is too small there to lose digits
        const double t = position * spacing_s_;
        table[k * lanes] = (own_displacement_m(t + step_s_) - own_displacement_m(t)) -
                           (own_displacement_m(t) - own_displacement_m(t - step_s_));
    }
}

double BaseMotion::displacement_m(double time_s) const
{
    return own_displacement_m(time_s + change_.offset_s);
}

/// In the time of the motion itself.
double BaseMotion::own_displacement_m(double time_s) const
{
    if (time_s <= 0) {
        if (record_ == nullptr)
            return 0;
        // before its first sample it is at rest, or comes at the velocity that it has there
        const double stretch = spacing_s_ / record_->dt_s;
        return scale_ * stretch * (stretch * record_->displacement_m.front() + time_s * record_->velocity_m_s.front());
    }
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
    if (synthetic_)
        return change_.gain * synthetic_->displacement_m(time_s);
    return formula_displacement(rate_hz_ * time_s, 1);
}

FormulaParameters BaseMotion::parameters(std::array<double, 8>& v, double cycles_per_step) const
{
    v = {cycles_per_step,        amplitude_m_ * change_.gain, cycles_,      phase_cycles_, offset_,
         start_ramps_per_cycle_, end_ramps_per_cycle_,        end_velocity_};
    return {&v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]};
}

/// U after a number of steps, whole or not.
double BaseMotion::formula_displacement(double cycles_per_step, double steps) const
{
    if (formula_ == MotionFormula::harmonic && change_.distorts())
        return distorted_harmonic(cycles_per_step, steps);
    std::array<double, 8> values;
    return base_displacement<double>(formula_, parameters(values, cycles_per_step), steps);
}

double BaseMotion::distorted_harmonic(double cycles_per_step, double steps) const
{
    // time in cycles, as a rounded product and its rounding error, as in the kernels' formula
    const double product = steps * cycles_per_step, error = fma(steps, cycles_per_step, -product);
    const double c = std::clamp(product, 0.0, cycles_), rest = c != product ? 0 : error;
    const double turn = (c - round_of(c)) + rest + phase_cycles_;
    const bool holds = end_ramps_per_cycle_ == abrupt; // the last displacement
    const double end = holds ? 1 : smooth_ramp((cycles_ - c) * end_ramps_per_cycle_);
    const double at_start = start_ramps_per_cycle_ == abrupt ? wave(phase_cycles_) : 0;
    return amplitude_m_ * change_.gain * smooth_ramp(c * start_ramps_per_cycle_) * end * (wave(turn) - at_start);
}

double BaseMotion::wave(double c) const
{
    return sine_of(c) + change_.second * sine_of(2 * c) + change_.second_quadrature * cosine_of(2 * c) +
           change_.third * sine_of(3 * c) + change_.third_quadrature * cosine_of(3 * c);
}

Motion sampled(const BaseMotion& motion, double fastest_hz)
{
    constexpr double samples_per_cycle = 64;
    const auto pieces =
        static_cast<std::size_t>(std::ceil(std::max(motion.duration_s() * fastest_hz, 1.0) * samples_per_cycle));
    const double dt = motion.duration_s() / static_cast<double>(pieces);
    std::vector<double> u(pieces + 1);
    for (std::size_t i = 0; i <= pieces; ++i)
        u[i] = motion.displacement_m(static_cast<double>(i) * dt);
    return motion_of(acceleration_through(u, dt), dt);
}

double tail_after_shaking(const Scales& scales)
{
    return 12 / scales.p_rad_s;
}

double longest_tail(const Scales& scales)
{
    return rest_tails * tail_after_shaking(scales);
}

double pause_until_rest(const Scales& scales)
{
    return pause_tails * tail_after_shaking(scales);
}

double tail_s(const ExcitationSpec& excitation, const Scales& scales)
{
    if (excitation.kind == ExcitationKind::none)
        return 0;
    if (excitation.tail_s)
        return *excitation.tail_s;
    return excitation.tail == Tail::rest ? longest_tail(scales) : tail_after_shaking(scales);
}

} // namespace stylobate
