/// Intensity measures of a record: peaks, Arias intensity, Fourier amplitude, response spectrum.

#include "ensemble/numerics/elementary.hpp"
#include "io/records/ground_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace stylobate {

namespace {

constexpr double standard_gravity = 9.80665;
constexpr double pi = std::numbers::pi;

struct Spectrum {
    std::vector<double> amplitude; ///< at k df, from 0 to the Nyquist frequency
    double df_hz = 0;
};

std::vector<std::complex<double>> without_mean(const std::vector<double>& a, std::size_t size)
{
    const double mean = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
    std::vector<std::complex<double>> z(size);
    std::transform(a.begin(), a.end(), z.begin(), [mean](double x) { return x - mean; });
    return z;
}

Spectrum amplitudes(const std::vector<std::complex<double>>& transformed, std::size_t n, double dt_s)
{
    Spectrum spectrum;
    spectrum.df_hz = 1 / (static_cast<double>(n) * dt_s);
    for (std::size_t k = 0; k <= n / 2; ++k)
        spectrum.amplitude.push_back(dt_s * std::abs(transformed[k]));
    return spectrum;
}

/// Of the samples less their mean, followed by zeros to at least four times their number: the peak of the smoothed
/// amplitude then no longer depends on the spacing of the frequencies.
Spectrum padded_spectrum(const std::vector<double>& a, double dt_s)
{
    const std::size_t n = power_of_two_from(4 * a.size());
    auto z = without_mean(a, n);
    transform(z);
    return amplitudes(z, n, dt_s);
}

/// Of the samples less their mean at the record's own frequencies k / (n dt), on which the mean period is defined.
/// Bluestein: j k = (j2 + k2 - (k - j)2) / 2 makes the transform of any length a convolution.
Spectrum own_spectrum(const std::vector<double>& a, double dt_s)
{
    const std::size_t n = a.size(), size = power_of_two_from(2 * n);
    const auto chirp = [n](std::size_t j) { // exp(i pi j2 / n), with j2 reduced first
        return std::polar(1.0, pi * static_cast<double>(j * j % (2 * n)) / static_cast<double>(n));
    };
    auto z = without_mean(a, size);
    std::vector<std::complex<double>> kernel(size);
    for (std::size_t j = 0; j < n; ++j) {
        kernel[j] = chirp(j);
        if (j > 0)
            kernel[size - j] = kernel[j];
        z[j] *= std::conj(kernel[j]);
    }
    transform(z);
    transform(kernel);
    for (std::size_t k = 0; k < size; ++k)
        z[k] = std::conj(z[k] * kernel[k]); // the inverse transform is the conjugate of the conjugate's transform
    transform(z);
    for (std::complex<double>& value : z) // what is left out, a chirp of modulus one, does not change amplitudes
        value /= static_cast<double>(size);
    return amplitudes(z, n, dt_s);
}

/// Konno and Ohmachi (1998): W = [sin(x) / x]^4, x = b log10(f / fc); to the first zero of W on either side, which
/// holds all but 0.2 % of it.
class Smoothed {
public:
    explicit Smoothed(const Spectrum& spectrum) : spectrum_(spectrum), log_(spectrum.amplitude.size())
    {
        for (std::size_t k = 1; k < log_.size(); ++k)
            log_[k] = std::log10(static_cast<double>(k));
    }

    double operator()(double centre_hz) const
    {
        const double centre = centre_hz / spectrum_.df_hz, log_centre = std::log10(centre);
        const auto first = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(centre / reach_)));
        const auto last = std::min(log_.size() - 1, static_cast<std::size_t>(centre * reach_));
        double sum = 0, weights = 0;
        for (std::size_t k = first; k <= last; ++k) {
            const double x = b * (log_[k] - log_centre);
            const double sinc = std::fabs(x) < 1e-6 ? 1 : std::sin(x) / x;
            const double weight = sinc * sinc * sinc * sinc;
            sum += weight * spectrum_.amplitude[k];
            weights += weight;
        }
        return weights > 0 ? sum / weights : 0;
    }

private:
    static constexpr double b = 40;
    const Spectrum& spectrum_;
    std::vector<double> log_;
    double reach_ = std::pow(10, pi / b);
};

/// Rathje et al. (2004): the mean of the periods, weighted by the squares of the amplitudes, 0.25 to 20 Hz.
double mean_frequency(const Spectrum& spectrum)
{
    double squares = 0, periods = 0;
    for (std::size_t k = 1; k < spectrum.amplitude.size(); ++k) {
        const double f = static_cast<double>(k) * spectrum.df_hz;
        if (f < 0.25 || f > 20)
            continue;
        const double square = spectrum.amplitude[k] * spectrum.amplitude[k];
        squares += square;
        periods += square / f;
    }
    return periods > 0 ? squares / periods : 0;
}

/// The running integral of a2 by the trapezium rule, which is exact for what the samples can carry (an acceleration
/// linear between them would lose up to a third of it near the Nyquist frequency).
struct Husid {
    double total = 0;
    double d5_95_s = 0;
};

Husid husid(const std::vector<double>& a, double d)
{
    std::vector<double> sum(a.size());
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
        sum[i + 1] = sum[i] + d * (a[i] * a[i] + a[i + 1] * a[i + 1]) / 2;
    const auto time_of = [&](double level) {
        const auto above = std::upper_bound(sum.begin(), sum.end(), level);
        if (above == sum.begin() || above == sum.end())
            return 0.0;
        const auto i = static_cast<double>(above - sum.begin() - 1);
        return d * (i + (level - *(above - 1)) / (*above - *(above - 1)));
    };
    return {sum.back(), time_of(0.95 * sum.back()) - time_of(0.05 * sum.back())};
}

/// Integral of |a| for an acceleration that is linear between its samples, and may change its sign between them.
double cumulative_absolute_velocity(const std::vector<double>& a, double d)
{
    double sum = 0;
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
        const double before = std::fabs(a[i]), after = std::fabs(a[i + 1]);
        sum += a[i] * a[i + 1] < 0 ? (before * before + after * after) / (before + after) : before + after;
    }
    return d * sum / 2;
}

/// The oscillator u'' + 2 z w u' + w2 u = -a(t), exactly over steps in which a is linear.
class Oscillator {
public:
    Oscillator(double omega, double damping_ratio, double step_s)
        : w_(omega), z_(damping_ratio), w_d_(omega * std::sqrt(1 - damping_ratio * damping_ratio)), h_(step_s),
          cosine_(std::exp(-z_ * w_ * h_) * std::cos(w_d_ * h_)), sine_(std::exp(-z_ * w_ * h_) * std::sin(w_d_ * h_))
    {
    }

    /// The step from a0 to a1; the largest |u| in it is kept. u = exp(-z w t) (A cos w_d t + B sin w_d t) + particular
    /// solution.
    void advance(double a0, double a1)
    {
        const double slope = (a1 - a0) / h_, w2 = w_ * w_;
        const double lag = 2 * z_ * slope / (w2 * w_); // particular: -(a0 + slope t) / w2 + lag
        const double A = u_ + a0 / w2 - lag;
        const double B = (v_ + z_ * w_ * A + slope / w2) / w_d_;
        const double swing = cosine_ * A + sine_ * B;
        const double before = u_, leaving = v_;
        u_ = swing - a1 / w2 + lag;
        v_ = w_d_ * (cosine_ * B - sine_ * A) - z_ * w_ * swing - slope / w2;
        largest_ = std::max(largest_, std::fabs(u_));
        if (leaving * v_ < 0) // it turns within the step, of which it is a small part of a swing: a parabola
            largest_ = std::max(largest_, std::fabs(before + leaving * leaving / (leaving - v_) * h_ / 2));
    }

    double largest_displacement() const { return largest_; }
    double displacement() const { return u_; }
    double velocity() const { return v_; }

private:
    double w_, z_, w_d_, h_;
    double cosine_, sine_;
    double u_ = 0, v_ = 0, largest_ = 0;
};

/// Parts of a sample in which an oscillator is stepped.
double parts_of_sample(double dt_s, double period_s)
{
    constexpr double looks_per_period = 50, looks_per_sample = 4;
    return std::max(looks_per_sample, std::ceil(dt_s * looks_per_period / period_s));
}

double spectral_acceleration(const std::vector<double>& a, double dt_s, double period_s, double damping_ratio)
{
    if (period_s == 0)
        return peak(a);
    const double parts = parts_of_sample(dt_s, period_s);
    const double omega = 2 * pi / period_s;
    Oscillator oscillator(omega, damping_ratio, dt_s / parts);
    const auto follow = [&](double a0, double a1) {
        for (double j = 0; j < parts; ++j) {
            const double slope = (a1 - a0) / parts;
            oscillator.advance(a0 + slope * j, a0 + slope * (j + 1));
        }
    };
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
        follow(a[i], a[i + 1]);
    for (double t = 0; t < period_s / 2; t += dt_s)
        follow(0, 0);
    return omega * omega * oscillator.largest_displacement();
}

/// Largest length of the vector of the displacements of two equal oscillators, times w2.
double spectral_acceleration_at_once(const std::vector<double>& a, const std::vector<double>& b, double dt_s,
                                     double period_s, double damping_ratio)
{
    const double parts = parts_of_sample(dt_s, period_s), step = dt_s / parts, omega = 2 * pi / period_s;
    Oscillator first(omega, damping_ratio, step), second = first;
    double largest2 = 0, length2 = 0, rate = 0; // of the length squared
    const auto follow = [&](double a0, double a1, double b0, double b1) {
        for (double j = 0; j < parts; ++j) {
            const double of_a = (a1 - a0) / parts, of_b = (b1 - b0) / parts;
            first.advance(a0 + of_a * j, a0 + of_a * (j + 1));
            second.advance(b0 + of_b * j, b0 + of_b * (j + 1));
            const double before = length2, leaving = rate;
            const double u = first.displacement(), v = second.displacement();
            length2 = u * u + v * v;
            rate = 2 * (u * first.velocity() + v * second.velocity());
            largest2 = std::max(largest2, length2);
            if (leaving > 0 && rate < 0) // as one oscillator: a parabola
                largest2 = std::max(largest2, before + leaving * leaving / (leaving - rate) * step / 2);
        }
    };
    const auto at = [](const std::vector<double>& samples, std::size_t i) {
        return i < samples.size() ? samples[i] : 0;
    };
    for (std::size_t i = 0; i + 1 < std::max(a.size(), b.size()); ++i)
        follow(at(a, i), at(a, i + 1), at(b, i), at(b, i + 1));
    for (double t = 0; t < period_s / 2; t += dt_s)
        follow(0, 0, 0, 0);
    return omega * omega * std::sqrt(largest2);
}

} // namespace

double predominant_frequency(const std::vector<double>& acceleration_m_s2, double dt_s)
{
    constexpr double step = 1.0025;
    if (acceleration_m_s2.size() < 2)
        return 0;
    const Spectrum spectrum = padded_spectrum(acceleration_m_s2, dt_s);
    const Smoothed amplitude(spectrum);
    const double nyquist = 0.5 / dt_s;
    double largest = 0, frequency = 0;
    for (double f = 2 / (dt_s * static_cast<double>(acceleration_m_s2.size() - 1)); f <= nyquist; f *= step)
        if (const double here = amplitude(f); here > largest) {
            largest = here;
            frequency = f;
        }
    return frequency;
}

RockingMeasures rocking_measures(const IntensityMeasures& im, double b_m, double h_m, double g_m_s2)
{
    RockingMeasures m;
    m.tan_alpha = b_m / h_m;
    m.p_rad_s = std::sqrt(0.75 * g_m_s2 / std::hypot(b_m, h_m));
    m.pga_over_g_tan_alpha = im.pga_m_s2 / (g_m_s2 * m.tan_alpha);
    m.p_pgv_over_g_tan_alpha = m.p_rad_s * im.pgv_m_s / (g_m_s2 * m.tan_alpha);
    m.omega_p_over_p = 2 * pi * im.predominant_frequency_hz / m.p_rad_s;
    return m;
}

namespace {

/// @param motion for velocity and displacement
IntensityMeasures measures_of(const std::vector<double>& a, double dt_s, const Motion& motion)
{
    const Husid arias = husid(a, dt_s);
    IntensityMeasures im;
    im.pga_m_s2 = peak(a);
    im.pgv_m_s = peak(motion.velocity_m_s);
    im.pgd_m = peak(motion.displacement_m);
    im.arias_m_s = pi / (2 * standard_gravity) * arias.total;
    im.d5_95_s = arias.d5_95_s;
    im.cav_m_s = cumulative_absolute_velocity(a, dt_s);
    im.pgv_per_pga_s = im.pgv_m_s / im.pga_m_s2;
    im.predominant_frequency_hz = motion.predominant_frequency_hz;
    im.mean_frequency_hz = mean_frequency(own_spectrum(a, dt_s));
    return im;
}

} // namespace

IntensityMeasures intensity_measures(const Record& record)
{
    return measures_of(record.acceleration_m_s2, record.dt_s, make_motion(record, true));
}

IntensityMeasures intensity_measures(const Motion& motion)
{
    return measures_of(motion.acceleration_m_s2, motion.dt_s, motion);
}

IntensityMeasures intensity_of_pair(const Motion& first, const Motion& second, OfPair definition)
{
    IntensityMeasures pair = intensity_measures(first);
    const IntensityMeasures other = intensity_measures(second);
    const auto lengths = [&] {
        const std::vector<double>&a = first.acceleration_m_s2, &b = second.acceleration_m_s2;
        double sum = 0;
        for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
            sum += std::hypot(i < a.size() ? a[i] : 0, i < b.size() ? b[i] : 0) *
                   (i == 0 || i + 1 == std::max(a.size(), b.size()) ? 0.5 : 1);
        return first.dt_s * sum;
    };
    const auto take = [&](double IntensityMeasures::*member, double at_once) {
        pair.*member = size_of_pair(definition, pair.*member, other.*member, at_once);
    };
    take(&IntensityMeasures::pga_m_s2, peak_at_once(first.acceleration_m_s2, second.acceleration_m_s2));
    take(&IntensityMeasures::pgv_m_s, peak_at_once(first.velocity_m_s, second.velocity_m_s));
    take(&IntensityMeasures::pgd_m, peak_at_once(first.displacement_m, second.displacement_m));
    take(&IntensityMeasures::arias_m_s, pair.arias_m_s + other.arias_m_s);
    take(&IntensityMeasures::cav_m_s, lengths());
    pair.pgv_per_pga_s = pair.pgv_m_s / pair.pga_m_s2;
    return pair;
}

double spectral_acceleration_of_pair(const Motion& first, const Motion& second, double period_s, OfPair definition,
                                     double damping_ratio)
{
    const std::vector<double>&a = first.acceleration_m_s2, &b = second.acceleration_m_s2;
    if (definition == OfPair::at_once)
        return spectral_acceleration_at_once(a, b, first.dt_s, period_s, damping_ratio);
    return size_of_pair(definition, spectral_acceleration(a, first.dt_s, period_s, damping_ratio),
                        spectral_acceleration(b, second.dt_s, period_s, damping_ratio), 0);
}

std::vector<double> spectral_acceleration(const Record& record, const std::vector<double>& periods_s,
                                          double damping_ratio)
{
    return spectral_acceleration(record.acceleration_m_s2, record.dt_s, periods_s, damping_ratio);
}

std::vector<double> spectral_acceleration(const std::vector<double>& acceleration_m_s2, double dt_s,
                                          const std::vector<double>& periods_s, double damping_ratio)
{
    assert(damping_ratio >= 0 && damping_ratio < 1);
    std::vector<double> spectrum;
    for (const double period : periods_s) {
        assert(period >= 0);
        spectrum.push_back(spectral_acceleration(acceleration_m_s2, dt_s, period, damping_ratio));
    }
    return spectrum;
}

} // namespace stylobate
