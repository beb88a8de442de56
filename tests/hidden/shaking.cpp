#include "tests/hidden/shaking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate::hidden {

namespace {

constexpr double pi = std::numbers::pi;

Jet sine(const Jet& phase)
{
    const double s = std::sin(phase.u), c = std::cos(phase.u);
    return {s, c * phase.v, c * phase.a - s * phase.v * phase.v};
}

/// 10 x3 - 15 x4 + 6 x5 from 0 to 1, with its first two derivatives.
Jet smooth_rise(double time, double length)
{
    const double x = std::clamp(time / length, 0.0, 1.0);
    const double rest = 1 - x;
    return {x * x * x * (10 - 15 * x + 6 * x * x), 30 * x * x * rest * rest / length,
            60 * x * rest * (1 - 2 * x) / (length * length)};
}

/// Greatest absolute displacement and acceleration, on a grid of a millisecond.
Jet peaks(const Shaking& shaking)
{
    Jet most;
    for (double t = 0; t < shaking.duration_s; t += 1e-3) {
        const Jet now = shaking.at(t);
        most.u = std::max(most.u, std::abs(now.u));
        most.a = std::max(most.a, std::abs(now.a));
    }
    return most;
}

/// The table's own harmonics: of a sine of amplitude U, one at 2 or 3 times its frequency, and nothing else but a
/// constant. With z = u / U the added displacement is U d z2 or U d (z3 - 3 z / 4).
Jet distorted(const Jet& u, const BaseEffect& effect, double peak_m)
{
    if (effect.distortion_ratio == 0)
        return u;
    const Jet z = (1 / peak_m) * u;
    if (effect.distortion_order == 2) // U d z2 = U d (1 - cos 2wt) / 2: acceleration ratio 4 d / 2
        return u + (peak_m * effect.distortion_ratio / 2) * (z * z);
    // U d (z3 - 3 z / 4) = -U d sin 3wt / 4: acceleration ratio 9 d / 4
    return u + (peak_m * effect.distortion_ratio * 4 / 9) * (z * z * z + -0.75 * z);
}

} // namespace

Jet Shaking::at(double time) const
{
    const Jet rise = smooth_rise(time - from_s, rise_s);
    const Jet fall = smooth_rise(to_s - time, fall_s);
    const Jet envelope = rise * Jet{fall.u, -fall.v, fall.a};
    if (envelope.u == 0)
        return {};
    Jet sum;
    const double t = time - from_s;
    for (const Sine& one : sines)
        sum = sum + one.amplitude_m * sine({2 * pi * (one.hz + 0.5 * one.hz_per_s * t) * t + one.phase_rad,
                                            2 * pi * (one.hz + one.hz_per_s * t), 2 * pi * one.hz_per_s});
    return envelope * sum;
}

void Shaking::scale_to(double peak)
{
    const double factor = peak / peaks(*this).a;
    for (Sine& one : sines)
        one.amplitude_m *= factor;
    peak_m_s2 = peak;
}

Shaking draw_shaking(const std::string& kind, const ShakingBand& band, Draws& draws)
{
    Shaking made;
    made.kind = kind;
    made.duration_s = band.duration_s;
    made.from_s = 0.1 * band.duration_s;
    made.to_s = draws.uniform(0.75, 0.88) * band.duration_s; // then what rocks is free
    if (kind == "harmonic") {
        const double hz = draws.log_uniform(band.low_hz, band.high_hz);
        made.rise_s = made.fall_s = draws.uniform(1, 2.5) / hz;
        made.sines = {{1, hz, 0, 0}};
    } else if (kind == "sweep") {
        double from = draws.log_uniform(band.low_hz, band.high_hz), to = from * draws.uniform(1.4, 2.2);
        if (draws.chance(0.4))
            std::swap(from, to);
        made.rise_s = made.fall_s = 1.5 / std::min(from, to);
        made.sines = {{1, from, (to - from) / (made.to_s - made.from_s), 0}};
        // constant displacement would shake ever harder: the envelope alone cannot help, so that the faster end is
        // the strong one, as of a table that is run at constant stroke
    } else {
        const double middle = draws.log_uniform(band.low_hz, 0.8 * band.high_hz);
        made.rise_s = draws.uniform(0.1, 0.25) * band.duration_s;
        made.fall_s = draws.uniform(0.25, 0.45) * band.duration_s;
        for (int i = 0; i < 24; ++i) { // a soil layer's spectrum of acceleration, as displacements
            const double hz = middle * 0.4 * std::pow(2.4 / 0.4, (i + draws.uniform()) / 24);
            const double r = hz / middle;
            const double layer = std::sqrt((1 + 1.44 * r * r) / ((1 - r * r) * (1 - r * r) + 1.44 * r * r));
            made.sines.push_back({layer * std::sqrt(hz) / (hz * hz), hz, 0, draws.uniform(0, 2 * pi)});
        }
    }
    made.scale_to(1);
    return made;
}

Jet reported(const Shaking& shaking, const BaseEffect& effect, bool of_command, double time)
{
    // The clock: the table does at t what the file says for t + tau.
    const double at = time - effect.time_offset_s;
    const bool distorts = !of_command && effect.distortion_ratio != 0;
    return reported(shaking.at(at), effect, of_command, distorts ? peaks(shaking).u : 0);
}

Jet reported(const Jet& commanded, const BaseEffect& effect, bool of_command, double peak_m)
{
    // what the table does is the gain times that
    return of_command ? commanded : distorted(commanded, effect, peak_m);
}

BaseState table_at(const Jet& commanded, const BaseEffect& effect, double peak_m)
{
    const Jet u = effect.gain * distorted(commanded, effect, peak_m);
    BaseState state;
    state.x = u.u;
    state.vx = u.v;
    state.y = effect.vertical_ratio * u.u;
    state.vy = effect.vertical_ratio * u.v;
    state.theta = effect.pitch_rad_s2_m * u.a;
    return state;
}

TableMotion::TableMotion(const Shaking& shaking, const BaseEffect& effect, double step_s)
{
    const double peak = peaks(shaking).u;
    const long steps = std::lround(shaking.duration_s / step_s);
    states_.reserve(static_cast<std::size_t>(2 * steps + 2));
    const double w = 2 * pi * effect.vertical_hz;
    double pitch_before = 0;
    for (long i = 0; i <= 2 * steps; ++i) {
        const double t = 0.5 * step_s * static_cast<double>(i);
        BaseState state = table_at(shaking.at(t), effect, peak);
        if (effect.vertical_m_s2 != 0) {
            const Jet rise = smooth_rise(t - shaking.from_s, shaking.rise_s);
            const Jet fall = smooth_rise(shaking.to_s - t, shaking.fall_s);
            const Jet own =
                effect.vertical_m_s2 / (w * w) * (rise * Jet{fall.u, -fall.v, fall.a} * sine({w * t, w, 0}));
            state.y += own.u;
            state.vy += own.v;
        }
        state.omega = i > 0 ? (state.theta - pitch_before) / (0.5 * step_s) : 0;
        pitch_before = state.theta;
        states_.push_back(state);
    }
}

BaseState TableMotion::at(long half_step) const
{
    const long last = static_cast<long>(states_.size()) - 1;
    if (half_step <= 0) { // still before
        BaseState first = states_.front();
        first.vx = first.vy = first.omega = 0;
        return first;
    }
    return states_[static_cast<std::size_t>(std::min(half_step, last))];
}

} // namespace stylobate::hidden
