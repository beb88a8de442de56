#include "io/records/ground_motion.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

namespace stylobate {

namespace {

constexpr double taper_fraction = 0.02; // of the duration, at each end
constexpr double longest_taper_s = 0.5;
constexpr double shortest_taper = 2; // samples
constexpr double least_left = 1e-6;  // of the PGA after the correction: less is rounding
constexpr std::size_t coefficients = 4;
constexpr std::size_t constraints = 2;

/// Rises from 0 to 1 at both ends, with a smooth first and second derivative.
std::vector<double> taper(std::size_t n, double d)
{
    const double duration = d * static_cast<double>(n - 1);
    const double length = std::max(shortest_taper, std::min(longest_taper_s, taper_fraction * duration) / d);
    std::vector<double> w(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = std::min(1.0, static_cast<double>(std::min(i, n - 1 - i)) / length);
        w[i] = x * x * x * (10 + x * (6 * x - 15));
    }
    return w;
}

/// Solves a small dense system in place by elimination with pivots; rows hold the matrix and the right-hand side.
template <std::size_t N>
std::array<double, N> solve(std::array<std::array<double, N + 1>, N> rows)
{
    for (std::size_t k = 0; k < N; ++k) {
        const auto pivot =
            std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                             [k](const auto& a, const auto& b) { return std::fabs(a[k]) < std::fabs(b[k]); });
        std::swap(rows[k], *pivot);
        for (std::size_t i = k + 1; i < N; ++i) {
            const double factor = rows[i][k] / rows[k][k];
            for (std::size_t j = k; j <= N; ++j)
                rows[i][j] -= factor * rows[k][j];
        }
    }
    std::array<double, N> x{};
    for (std::size_t k = N; k-- > 0;) {
        x[k] = rows[k][N];
        for (std::size_t j = k + 1; j < N; ++j)
            x[k] -= rows[k][j] * x[j];
        x[k] /= rows[k][k];
    }
    return x;
}

/// Subtracts w q from the acceleration, q = sum c_k P_k with the Legendre polynomials of the record's duration:
/// least sum of v2 over c, with v = u = 0 at the end (two Lagrange multipliers).
void remove_trend(std::vector<double>& a, const std::vector<double>& w, double d)
{
    const std::size_t n = a.size();
    const double end = d * static_cast<double>(n - 1);
    std::array<std::vector<double>, coefficients> basis;
    std::array<Integrated, coefficients> moved;
    for (std::size_t k = 0; k < coefficients; ++k) {
        basis[k].resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double s = 2 * static_cast<double>(i) / static_cast<double>(n - 1) - 1;
            const std::array<double, coefficients> legendre = {1, s, (3 * s * s - 1) / 2, (5 * s * s * s - 3 * s) / 2};
            basis[k][i] = w[i] * legendre[k];
        }
        moved[k] = integrate(basis[k], d);
    }
    // twice: the second time takes out what rounding left at the end
    for (int pass = 0; pass < 2; ++pass) {
        const Integrated drift = integrate(a, d);
        // velocities in units of the duration, displacements in units of its square: all entries of order 1
        std::array<std::array<double, coefficients + constraints + 1>, coefficients + constraints> rows{};
        const double scale = 1 / (end * end * static_cast<double>(n));
        for (std::size_t j = 0; j < coefficients; ++j) {
            for (std::size_t k = 0; k < coefficients; ++k)
                rows[j][k] = scale * std::inner_product(moved[j].v.begin(), moved[j].v.end(), moved[k].v.begin(), 0.0);
            rows[j].back() = scale * std::inner_product(moved[j].v.begin(), moved[j].v.end(), drift.v.begin(), 0.0);
            rows[coefficients][j] = rows[j][coefficients] = moved[j].v.back() / end;
            rows[coefficients + 1][j] = rows[j][coefficients + 1] = moved[j].u.back() / (end * end);
        }
        rows[coefficients].back() = drift.v.back() / end;
        rows[coefficients + 1].back() = drift.u.back() / (end * end);
        const auto c = solve<coefficients + constraints>(rows);
        for (std::size_t k = 0; k < coefficients; ++k)
            for (std::size_t i = 0; i < n; ++i)
                a[i] -= c[k] * basis[k][i];
    }
}

constexpr double order = 4;
constexpr double pad_cycles = 1.5 * order; // of the low corner, on either side

/// (1 + ratio^(2 order))^(-1/2)
double butterworth(double ratio)
{
    const double square = ratio * ratio, fourth = square * square;
    return 1 / std::sqrt(1 + fourth * fourth);
}

} // namespace

Motion make_motion(const Record& record, bool correct_baseline, const std::optional<BandPass>& filter)
{
    const std::vector<double>& recorded = record.acceleration_m_s2;
    if (recorded.size() < fewest_samples)
        throw InputError(record.file, 0,
                         fmt::format("{}: the record has {} samples; at least {} are required.", record.component,
                                     recorded.size(), fewest_samples));
    const auto [least, most] = std::minmax_element(recorded.begin(), recorded.end());
    const bool still = correct_baseline ? *least == *most : *least == 0 && *most == 0;
    if (still)
        throw InputError(record.file, 0,
                         fmt::format("{}: the acceleration is {} m/s2 at all times: there is no motion. Take another "
                                     "component.",
                                     record.component, *least));
    if (filter && !(filter->high_hz < 0.5 / record.dt_s))
        throw InputError(record.file, 0,
                         fmt::format("{}: a band-pass up to {} Hz needs more than {} samples a second; the record has "
                                     "{}. Reduce excitation.band_pass_hz.",
                                     record.component, filter->high_hz, 2 * filter->high_hz, 1 / record.dt_s));
    Motion motion;
    motion.corrected = correct_baseline;
    motion.band_pass = filter;
    motion.dt_s = record.dt_s;
    motion.source = fmt::format("{}, {}", record.file, record.component);
    if (record.direction != Direction::unknown)
        motion.is_vertical = record.direction == Direction::vertical;
    motion.predominant_frequency_hz = predominant_frequency(recorded, record.dt_s);
    motion.acceleration_m_s2 = recorded;
    if (correct_baseline) {
        std::vector<double>& a = motion.acceleration_m_s2;
        const double mean = std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
        const std::vector<double> w = taper(a.size(), record.dt_s);
        for (std::size_t i = 0; i < a.size(); ++i)
            a[i] = w[i] * (a[i] - mean);
        if (filter) {
            band_pass(a, record.dt_s, *filter);
            for (std::size_t i = 0; i < a.size(); ++i)
                a[i] *= w[i];
        }
        remove_trend(a, w, record.dt_s);
    }
    Integrated moved = integrate(motion.acceleration_m_s2, record.dt_s);
    motion.velocity_m_s = std::move(moved.v);
    motion.displacement_m = std::move(moved.u);
    motion.pga_m_s2 = peak(motion.acceleration_m_s2);
    if (const double left = motion.pga_m_s2 / peak(recorded); left < least_left)
        throw InputError(record.file, 0,
                         fmt::format("{}: the baseline correction leaves {:.2g} of the acceleration: the record is a "
                                     "drift of the instrument and no motion. Take another component, or give "
                                     "baseline = false.",
                                     record.component, left));
    const Integrated before = integrate(recorded, record.dt_s);
    motion.baseline = {before.v.back(), before.u.back(), motion.velocity_m_s.back(), motion.displacement_m.back(),
                       peak(recorded),  motion.pga_m_s2, peak(motion.velocity_m_s),  peak(motion.displacement_m)};
    return motion;
}

double band_pass_gain(double frequency_hz, const BandPass& corners)
{
    return frequency_hz > 0 ? butterworth(corners.low_hz / frequency_hz) * butterworth(frequency_hz / corners.high_hz)
                            : 0;
}

void band_pass(std::vector<double>& samples, double dt_s, const BandPass& corners)
{
    const auto pad = static_cast<std::size_t>(std::ceil(pad_cycles / (corners.low_hz * dt_s)));
    const std::size_t n = power_of_two_from(samples.size() + 2 * pad);
    std::vector<std::complex<double>> z(n);
    std::copy(samples.begin(), samples.end(), z.begin() + static_cast<std::ptrdiff_t>(pad));
    transform(z);
    const double df = 1 / (static_cast<double>(n) * dt_s);
    for (std::size_t k = 0; k < n; ++k)
        z[k] = std::conj(z[k] * band_pass_gain(df * static_cast<double>(std::min(k, n - k)), corners));
    transform(z); // the inverse transform is the conjugate of the conjugate's transform
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = z[pad + i].real() / static_cast<double>(n);
}

} // namespace stylobate
