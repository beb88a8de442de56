#include "io/motion/band_pass.hpp"

#include "ensemble/numerics/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace stylobate {

namespace {

constexpr double order = 4;
constexpr double pad_cycles = 1.5 * order; // of the low corner, on either side

/// (1 + ratio^(2 order))^(-1/2)
double butterworth(double ratio)
{
    const double square = ratio * ratio, fourth = square * square;
    return 1 / std::sqrt(1 + fourth * fourth);
}

} // namespace

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
