#include "ensemble/numerics/elementary.hpp"

#include <utility>

namespace stylobate {

void transform(std::vector<std::complex<double>>& z)
{
    const std::size_t n = z.size();
    for (std::size_t i = 1, j = 0; i < n; ++i) { // into the order of reversed bits
        std::size_t bit = n / 2;
        for (; j & bit; bit /= 2)
            j ^= bit;
        j ^= bit;
        if (i < j)
            std::swap(z[i], z[j]);
    }
    std::vector<std::complex<double>> turn(n / 2);
    for (std::size_t k = 0; k < n / 2; ++k)
        turn[k] = {cosine_of(static_cast<double>(k) / static_cast<double>(n)),
                   -sine_of(static_cast<double>(k) / static_cast<double>(n))};
    for (std::size_t half = 1; half < n; half *= 2)
        for (std::size_t start = 0; start < n; start += 2 * half)
            for (std::size_t k = 0; k < half; ++k) {
                const std::complex<double> w = turn[k * (n / (2 * half))], odd = z[start + half + k];
                const std::complex<double> t(w.real() * odd.real() - w.imag() * odd.imag(),
                                             w.real() * odd.imag() + w.imag() * odd.real());
                z[start + half + k] = z[start + k] - t;
                z[start + k] += t;
            }
}

std::size_t power_of_two_from(std::size_t n)
{
    std::size_t size = 2;
    while (size < n)
        size *= 2;
    return size;
}

} // namespace stylobate
