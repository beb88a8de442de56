#include "ensemble/motion/synthetic_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace stylobate {

template <class Shape>
double peak_acceleration(const Shape& shape)
{
    constexpr double looks_per_cycle = 32, near = 0.98, golden = 0.6180339887498949;
    const auto looks = static_cast<std::size_t>(std::ceil(looks_per_cycle * shape.duration_s() * shape.fastest_hz()));
    const double d = shape.duration_s() / static_cast<double>(looks);
    const auto size = [&](double t) { return std::fabs(shape.acceleration(t)); };
    std::vector<double> seen(looks + 1);
    for (std::size_t i = 0; i <= looks; ++i)
        seen[i] = size(d * static_cast<double>(i));
    const double largest_seen = *std::max_element(seen.begin(), seen.end());
    double largest = largest_seen;
    for (std::size_t i = 1; i < looks; ++i) {
        if (seen[i] < near * largest_seen || seen[i] < seen[i - 1] || seen[i] < seen[i + 1])
            continue;
        double low = d * static_cast<double>(i - 1), high = d * static_cast<double>(i + 1);
        while (high - low > 1e-7 * d) { // the square of which is far below rounding
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            (size(a) < size(b) ? low : high) = size(a) < size(b) ? a : b;
        }
        largest = std::max(largest, size((low + high) / 2));
    }
    return largest;
}

template double peak_acceleration(const RickerWavelet&);
template double peak_acceleration(const VelocityPulse&);
template double peak_acceleration(const TaperedSine&);
template double peak_acceleration(const SineSweep&);

bool SyntheticMotion::covers(ExcitationKind kind)
{
    return kind == ExcitationKind::ricker || kind == ExcitationKind::pulse || kind == ExcitationKind::tapered ||
           kind == ExcitationKind::sweep;
}

SyntheticMotion::Shape SyntheticMotion::shape_of(const ExcitationSpec& e, const RealizationHeader& r)
{
    const double phase_cycles = r.phase_rad / (2 * std::numbers::pi);
    switch (e.kind) {
    case ExcitationKind::ricker:
        return RickerWavelet{r.frequency_hz};
    case ExcitationKind::pulse:
        return VelocityPulse{r.frequency_hz, phase_cycles, r.pulse_gamma};
    case ExcitationKind::tapered:
        return TaperedSine(r.frequency_hz, e.cycles, e.ramp_cycles, phase_cycles);
    case ExcitationKind::sweep: {
        // its time is stretched until its central frequency is the realization's
        const double squeeze = r.frequency_hz / e.central_frequency_hz();
        return SineSweep(e.from_hz * squeeze, e.to_hz * squeeze, e.spacing, e.duration_s / squeeze, e.ramp_cycles);
    }
    default:
        throw std::invalid_argument("an excitation that is not in closed form on the host");
    }
}

double SyntheticMotion::duration_s(const ExcitationSpec& excitation, const RealizationHeader& realization)
{
    return std::visit([](const auto& shape) { return shape.duration_s(); }, shape_of(excitation, realization));
}

SyntheticMotion::SyntheticMotion(const ExcitationSpec& e, const RealizationHeader& r) : shape_(shape_of(e, r))
{
    std::visit(
        [&](const auto& shape) {
            scale_ = r.pga_m_s2 / peak_acceleration(shape);
            duration_s_ = shape.duration_s();
            end_m_ = scale_ * shape.displacement(duration_s_);
        },
        shape_);
}

double SyntheticMotion::fastest_hz() const
{
    return std::visit([](const auto& shape) { return shape.fastest_hz(); }, shape_);
}

void SyntheticMotion::sample(double first, double step_s, std::span<double> displacements_m) const
{
    std::visit(
        [&](const auto& shape) {
            double i = first;
            for (double& u : displacements_m) {
                const double t = i++ * step_s;
                u = t <= 0 ? 0 : t >= duration_s_ ? end_m_ : scale_ * shape.displacement(t);
            }
        },
        shape_);
}

double SyntheticMotion::displacement_m(double time_s) const
{
    double u = 0;
    sample(1, time_s, {&u, 1});
    return u;
}

double SyntheticMotion::acceleration_m_s2(double time_s) const
{
    if (time_s <= 0 || time_s >= duration_s_)
        return 0;
    return scale_ * std::visit([time_s](const auto& shape) { return shape.acceleration(time_s); }, shape_);
}

namespace {

/// The length of the vector of two motions.
struct Together {
    const SyntheticMotion& first;
    const SyntheticMotion& second;

    double duration_s() const { return std::max(first.duration_s(), second.duration_s()); }
    double fastest_hz() const { return std::max(first.fastest_hz(), second.fastest_hz()); }
    double acceleration(double t) const { return std::hypot(first.acceleration_m_s2(t), second.acceleration_m_s2(t)); }
};

} // namespace

double peak_at_once(const SyntheticMotion& first, const SyntheticMotion& second)
{
    return peak_acceleration(Together{first, second});
}

Motion sampled(const SyntheticMotion& motion)
{
    constexpr double samples_per_cycle = 64;
    const auto pieces = static_cast<std::size_t>(
        std::ceil(std::max(motion.duration_s() * motion.fastest_hz(), 1.0) * samples_per_cycle));
    const double dt = motion.duration_s() / static_cast<double>(pieces);
    std::vector<double> u(pieces + 1);
    motion.sample(0, dt, u);
    return motion_of(acceleration_through(u, dt), dt);
}

} // namespace stylobate
