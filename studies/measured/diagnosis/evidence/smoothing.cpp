#include "studies/measured/diagnosis/evidence/smoothing.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

// The instruction set is chosen where the program runs. The bits are the same: no sum changes its order, and products
// are not fused with sums. (Under ThreadSanitizer the function that chooses is instrumented, too, and runs before the
// sanitizer does: the program would end before `main`.)
#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_THREAD__)
#define STYLOBATE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STYLOBATE_CLONES
#endif

namespace stylobate {

namespace {

constexpr std::size_t together = 16;

/// Sums of `count` products for several samples side by side, each in the order of `LocalCubic::at`.
STYLOBATE_CLONES void sums_side_by_side(const double* coefficients, std::size_t count, const double* from, double* out)
{
    std::array<double, together> sums{};
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t j = 0; j < together; ++j)
            sums[j] += coefficients[k] * from[k + j];
    std::copy(sums.begin(), sums.end(), out);
}

} // namespace

LocalCubic::LocalCubic(int half_width, double dt_s) : half_width_(half_width)
{
    const int n = 2 * half_width + 1;
    Eigen::MatrixX4d powers(n, 4);
    Eigen::VectorXd weights(n);
    for (int i = 0; i < n; ++i) {
        // in half widths: the equations stay well conditioned
        const double t = static_cast<double>(i - half_width) / half_width;
        powers.row(i) << 1, t, t * t, t * t * t;
        const double inside = 1 - std::pow(static_cast<double>(i - half_width) / (half_width + 1), 2);
        weights(i) = inside * inside;
    }
    const Eigen::Matrix4d normal = powers.transpose() * weights.asDiagonal() * powers;
    const Eigen::MatrixXd fit = normal.ldlt().solve(powers.transpose() * weights.asDiagonal());
    const double scale = half_width * dt_s;
    for (int d = 0; d < 3; ++d) {
        const double factor = (d == 2 ? 2 : 1) / std::pow(scale, d);
        double squares = 0;
        for (int i = 0; i < n; ++i) {
            coefficients_[d].push_back(factor * fit(d, i));
            squares += coefficients_[d].back() * coefficients_[d].back();
        }
        noise_[d] = std::sqrt(squares);
    }
}

std::vector<double> LocalCubic::apply(int derivative, const std::vector<double>& series) const
{
    const std::vector<double>& c = coefficients_[derivative];
    const auto half = static_cast<std::size_t>(half_width_);
    std::vector<double> smooth(series.size(), 0.0);
    std::size_t i = half;
    for (; i + half + together <= series.size(); i += together)
        sums_side_by_side(c.data(), c.size(), series.data() + (i - half), smooth.data() + i);
    for (; i < series.size(); ++i)
        smooth[i] = at(derivative, series, i);
    return smooth;
}

double LocalCubic::at(int derivative, const std::vector<double>& series, std::size_t sample) const
{
    const auto half = static_cast<std::size_t>(half_width_);
    if (sample < half || sample + half >= series.size())
        return 0;
    const std::vector<double>& c = coefficients_[derivative];
    const double* from = series.data() + (sample - half);
    double sum = 0;
    for (std::size_t k = 0; k < c.size(); ++k)
        sum += c[k] * from[k];
    return sum;
}

} // namespace stylobate
