#include "ensemble/motion/distortion.hpp"

#include "ensemble/numerics/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

namespace stylobate {
namespace {

constexpr double longest_rise_s = 0.5;
constexpr double rise_fraction = 0.02;
constexpr std::size_t padding = 2; ///< the signal is followed by as many zeros: its end does not touch its beginning

/// The analytic signal of samples that begin and end with 0.
std::vector<std::complex<double>> analytic_signal(const std::vector<double>& u)
{
    const std::size_t n = power_of_two_from(padding * u.size());
    std::vector<std::complex<double>> z(n);
    std::copy(u.begin(), u.end(), z.begin());
    transform(z);
    for (std::size_t k = 0; k < n; ++k) {
        const double weight = k == 0 || k == n / 2 ? 1 : k < n / 2 ? 2 : 0;
        z[k] = std::conj(z[k]) * (weight / static_cast<double>(n));
    }
    transform(z); // the inverse transform is the conjugate of the conjugate's transform
    z.resize(u.size());
    for (std::complex<double>& value : z)
        value = std::conj(value);
    return z;
}

} // namespace

Distortion::Distortion(const Motion& motion)
{
    const std::vector<double>& u = motion.displacement_m;
    const std::size_t n = u.size();
    const double last = static_cast<double>(n - 1);
    std::vector<double> about_line(n);
    for (std::size_t i = 0; i < n; ++i)
        about_line[i] = u[i] - (u.front() + (u.back() - u.front()) * (static_cast<double>(i) / last));
    const auto z = analytic_signal(about_line);

    std::array<std::vector<double>, 4> terms;
    for (std::vector<double>& term : terms)
        term.resize(n);
    const double rise = std::min(longest_rise_s, rise_fraction * motion.duration_s()) / motion.dt_s; // in samples
    for (std::size_t i = 0; i < n; ++i) {
        // exp(i psi) = i z / |z|
        const double envelope = std::sqrt(z[i].real() * z[i].real() + z[i].imag() * z[i].imag());
        if (!(envelope > 0))
            continue;
        const double cosine = -z[i].imag() / envelope, sine = z[i].real() / envelope;
        const double x = std::min(1.0, static_cast<double>(std::min(i, n - 1 - i)) / std::max(rise, 1.0));
        const double size = envelope * (x * x * x * (10 + x * (6 * x - 15)));
        const double sine_2 = 2 * sine * cosine, cosine_2 = cosine * cosine - sine * sine;
        terms[0][i] = size * sine_2;
        terms[1][i] = size * cosine_2;
        terms[2][i] = size * (sine_2 * cosine + cosine_2 * sine);
        terms[3][i] = size * (cosine_2 * cosine - sine_2 * sine);
    }
    for (std::size_t k = 0; k < terms.size(); ++k)
        acceleration_[k] = acceleration_through(terms[k], motion.dt_s);
}

Motion Distortion::distorted(const Motion& motion, const BaseChange& change) const
{
    std::vector<double> a = motion.acceleration_m_s2;
    const std::array part = {change.second, change.second_quadrature, change.third, change.third_quadrature};
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < part.size(); ++k)
            a[i] += part[k] * acceleration_[k][i];
    Motion result = motion_of(std::move(a), motion.dt_s);
    for (std::size_t i = 0; i < result.velocity_m_s.size(); ++i) { // one that is measured may begin with a velocity
        const double t = static_cast<double>(i) * motion.dt_s;
        result.displacement_m[i] += motion.displacement_m.front() + t * motion.velocity_m_s.front();
        result.velocity_m_s[i] += motion.velocity_m_s.front();
    }
    result.pga_m_s2 = motion.pga_m_s2;
    result.predominant_frequency_hz = motion.predominant_frequency_hz;
    result.source = motion.source;
    return result;
}

} // namespace stylobate
