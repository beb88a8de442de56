#include "ensemble/tracking/tracking_score.hpp"

#include "ensemble/numerics/interval.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stylobate {

namespace {

constexpr double lost = 1e4;         // residual over s of a model that is no longer finite
constexpr double least_scale = 0.02; // of k: no prediction is better than a part of the noise
constexpr std::size_t fewest_values = 12;
// Rocking: the block turned against its rest within the window by more than this many times the noise of a rotation.
constexpr double rocking_noise = 5;

} // namespace

double log_student(double t, double degrees)
{
    return log_gamma((degrees + 1) / 2) - log_gamma(degrees / 2) - 0.5 * std::log(degrees * std::numbers::pi) -
           (degrees + 1) / 2 * std::log1p(t * t / degrees);
}

double student_scale(const std::vector<double>& z, double degrees)
{
    if (z.empty())
        return std::numeric_limits<double>::quiet_NaN();
    // from the median outwards; each step raises the likelihood (it is an EM step)
    std::vector<double> size;
    for (const double value : z)
        size.push_back(std::fabs(value));
    const double middle = upper_median(std::move(size));
    double k2 = std::max(middle * middle, 1e-300);
    for (int i = 0; i < 200; ++i) {
        double sum = 0;
        for (const double value : z)
            sum += value * value / (degrees + value * value / k2);
        const double next = std::max((degrees + 1) * sum / static_cast<double>(z.size()), 1e-300);
        const bool settled = std::fabs(next - k2) < 1e-12 * k2;
        k2 = next;
        if (settled)
            break;
    }
    return std::sqrt(k2);
}

std::vector<std::vector<SeenValue>> seen_values(const SeenRun& run, const std::vector<SeenWindow>& windows,
                                                double lag_s)
{
    std::vector<std::vector<SeenValue>> values(windows.size());
    const std::size_t n = run.time_s.size(), turning = static_cast<std::size_t>(BlockCoordinate::theta);
    for (std::size_t w = 0; w < windows.size(); ++w) {
        const SeenWindow& window = windows[w];
        for (std::size_t b = 0; b < run.blocks; ++b) {
            double turned = 0;
            for (std::size_t k = window.rows.front(); k <= window.rows.back(); ++k)
                if (const double theta = run.smooth[turning][k * run.blocks + b]; std::isfinite(theta))
                    turned = std::max(turned, std::fabs(theta));
            const bool rocking = turned > rocking_noise * run.noise_sd[turning];
            for (std::size_t j = 0; j < window.rows.size(); ++j)
                for (std::size_t c = 0; c < coordinate_count; ++c) {
                    const std::size_t row = window.rows[j];
                    const double seen = run.seen[c][row * run.blocks + b];
                    // the speed about the sample: at a turning point an error in time still shows
                    double sum = 0;
                    std::size_t count = 0;
                    for (std::size_t k = row; k > 0 && run.time_s[row] - run.time_s[k - 1] <= lag_s; --k)
                        if (const double v = run.rate[c][(k - 1) * run.blocks + b]; std::isfinite(v))
                            sum += v * v, ++count;
                    for (std::size_t k = row; k < n && run.time_s[k] - run.time_s[row] <= lag_s; ++k)
                        if (const double v = run.rate[c][k * run.blocks + b]; std::isfinite(v))
                            sum += v * v, ++count;
                    if (!std::isfinite(seen) || count == 0)
                        continue;
                    SeenValue value;
                    value.time = j;
                    value.block = b;
                    value.coordinate = static_cast<BlockCoordinate>(c);
                    value.value = seen;
                    const double noise = std::isfinite(run.noise_sd[c]) ? run.noise_sd[c] : 0;
                    value.scale = std::max(noise + lag_s * std::sqrt(sum / static_cast<double>(count)), 1e-12);
                    value.kind = (b * coordinate_count + c) * 2 + (rocking ? 1 : 0);
                    values[w].push_back(value);
                }
        }
    }
    return values;
}

std::vector<double> residuals(const std::vector<SeenValue>& seen, const Readings& readings, std::size_t blocks,
                              const std::vector<double>& rest_y_m)
{
    std::vector<double> z;
    for (const SeenValue& value : seen) {
        const std::size_t k = value.time * blocks + value.block;
        const double model = value.coordinate == BlockCoordinate::x   ? readings.x_m[k]
                             : value.coordinate == BlockCoordinate::y ? readings.y_m[k] - rest_y_m[value.block]
                                                                      : readings.theta_rad[k];
        const double r = (model - value.value) / value.scale;
        z.push_back(std::isfinite(r) ? std::clamp(r, -lost, lost) : lost);
    }
    return z;
}

void ResidualScales::add(const std::vector<SeenValue>& seen, const std::vector<double>& z)
{
    for (std::size_t i = 0; i < seen.size(); ++i)
        z_[seen[i].kind].push_back(z[i]);
}

void ResidualScales::fit()
{
    constexpr std::size_t shared_kinds = coordinate_count * 2;
    std::vector<std::vector<double>> shared(shared_kinds);
    for (std::size_t kind = 0; kind < z_.size(); ++kind)
        shared[kind % shared_kinds].insert(shared[kind % shared_kinds].end(), z_[kind].begin(), z_[kind].end());
    std::vector<double> shared_k;
    for (const std::vector<double>& z : shared)
        shared_k.push_back(z.empty() ? 1 : std::max(student_scale(z, student_degrees), least_scale));
    for (std::size_t kind = 0; kind < z_.size(); ++kind)
        k_[kind] = z_[kind].size() < fewest_values ? shared_k[kind % shared_kinds]
                                                   : std::max(student_scale(z_[kind], student_degrees), least_scale);
}

double ResidualScales::score(const std::vector<SeenValue>& seen, const std::vector<double>& z) const
{
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const double k = k_[seen[i].kind];
        sum += log_student(z[i] / k, student_degrees) - std::log(k * seen[i].scale);
    }
    return sum;
}

} // namespace stylobate
