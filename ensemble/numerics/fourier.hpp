#pragma once
/// The fast Fourier transform, with the same bits on every machine (Cooley & Tukey, "An algorithm for the machine
/// calculation of complex Fourier series", Mathematics of Computation 19 (1965) 297).

#include <complex>
#include <cstddef>
#include <vector>

namespace stylobate {

/// Discrete Fourier transform in place, decimation in time: Z_k = sum of z_j exp(-2 pi i j k / n).
/// @pre the size is a power of two
void transform(std::vector<std::complex<double>>& z);

/// The least power of two that is not below n, and at least 2.
std::size_t power_of_two_from(std::size_t n);

} // namespace stylobate
