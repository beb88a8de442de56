#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

namespace {

// Smoothing may take this part of the specimen's time scale: less than a tenth of a rocking period, more than an
// impact.
constexpr double widest = 0.2;
constexpr double width_ratio = 1.5;
constexpr int narrowest = 6; // samples
// For slip velocities and angles.
constexpr double rate_width = 0.12;
// A joint slips faster than this part of sqrt(g x height), and faster than its noise.
constexpr double slip_part = 0.01;
constexpr double slip_noise = 4;
// A joint is open beyond this part of the specimen's slenderness, and beyond its noise.
constexpr double open_part = 0.03;
constexpr double open_noise = 8;

/// Differences of the fourth order are all noise.
double noise_of(const Series& series, std::size_t columns)
{
    if (series.noise_sd)
        return *series.noise_sd;
    std::vector<double> squares;
    const std::vector<double>& v = series.values;
    for (std::size_t i = 4 * columns; i < v.size(); ++i) {
        const double d =
            v[i] - 4 * v[i - columns] + 6 * v[i - 2 * columns] - 4 * v[i - 3 * columns] + v[i - 4 * columns];
        if (std::isfinite(d))
            squares.push_back(d * d / 70);
    }
    if (squares.empty())
        return 0;
    return std::sqrt(upper_median(std::move(squares)) / 0.4549); // median of chi square with one degree of freedom
}

/// Why no run can be used: which data sets are absent, or from where on nothing more is known.
std::string nothing_seen(const Campaign& campaign)
{
    std::string absent;
    const auto need = [&](const char* name, auto member) {
        if (std::all_of(campaign.runs.begin(), campaign.runs.end(),
                        [&](const MeasuredRun& run) { return (run.blocks.*member).empty(); }))
            absent += (absent.empty() ? "" : ", ") + std::string(name);
    };
    need("blocks/x_m", &SeenMotion::x_m);
    need("blocks/y_m", &SeenMotion::y_m);
    need("blocks/theta_rad", &SeenMotion::theta_rad);
    return fmt::format("has no run in which x, y and rotation of the blocks were measured{}.\n  The forces in the "
                       "joints cannot be computed without them.",
                       !campaign.runs.empty()   ? absent.empty() ? "" : "; no run has " + absent
                       : campaign.tests.empty() ? ": it has no runs"
                                                : ": it has tests of joints, but no shake runs");
}

} // namespace

std::vector<double> resampled(const std::vector<double>& time_s, const double* values, std::size_t stride,
                              double from_s, double spacing_s, std::size_t count)
{
    std::vector<double> out(count);
    std::size_t k = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = from_s + spacing_s * static_cast<double>(i);
        while (k + 2 < time_s.size() && time_s[k + 1] < t)
            ++k;
        const double part = std::clamp((t - time_s[k]) / (time_s[k + 1] - time_s[k]), 0.0, 1.0);
        out[i] = (1 - part) * values[k * stride] + part * values[(k + 1) * stride];
        if (part < 1e-9) // a gap beside a sample that is there
            out[i] = values[k * stride];
        else if (part > 1 - 1e-9)
            out[i] = values[(k + 1) * stride];
    }
    return out;
}

CampaignScales campaign_scales(const Campaign& campaign)
{
    const Specimen& s = campaign.specimen;
    CampaignScales scales;
    double top = 0, bottom = std::numeric_limits<double>::infinity(), width = 0;
    for (std::size_t i = 0; i < s.rest_y_m.size(); ++i) {
        top = std::max(top, s.rest_y_m[i] + s.half_height_m[i]);
        bottom = std::min(bottom, s.rest_y_m[i] - s.half_height_m[i]);
        width = std::max(width, s.rest_y_m[i] - s.half_height_m[i] < bottom + 1e-9 ? 2 * s.half_width_m[i] : 0);
    }
    scales.time_s = std::sqrt((top - bottom) / s.gravity_m_s2);
    for (const MeasuredRun& run : campaign.runs) {
        if (!run.has_blocks())
            continue;
        std::vector<double> spacing;
        for (std::size_t i = 1; i < run.time_s.size(); ++i)
            spacing.push_back(run.time_s[i] - run.time_s[i - 1]);
        scales.spacing_s = std::max(scales.spacing_s, upper_median(std::move(spacing)));
        const std::size_t n = s.half_width_m.size();
        scales.noise_m = std::max({scales.noise_m, noise_of(run.blocks.x_m, n), noise_of(run.blocks.y_m, n)});
        scales.noise_rad = std::max(scales.noise_rad, noise_of(run.blocks.theta_rad, n));
    }
    if (scales.spacing_s == 0)
        throw InputError(campaign.source, 0, nothing_seen(campaign));
    const double most = widest * scales.time_s / scales.spacing_s;
    if (most < narrowest)
        throw InputError(
            campaign.source, 0,
            fmt::format("has samples every {:g} s, too few for a specimen whose time scale sqrt(height / g) "
                        "is {:.3g} s.\n  At least {} samples are needed in that time.",
                        scales.spacing_s, scales.time_s, static_cast<int>(narrowest / widest)));
    for (double w = narrowest; w <= most; w *= width_ratio)
        scales.widths.emplace_back(static_cast<int>(std::lround(w)), scales.spacing_s);
    scales.rates = LocalCubic(std::max(3, static_cast<int>(std::lround(rate_width * scales.time_s / scales.spacing_s))),
                              scales.spacing_s);
    const double height = top - bottom;
    scales.slip_m_s = std::max(slip_part * std::sqrt(s.gravity_m_s2 * height),
                               slip_noise * std::sqrt(2.0) * scales.noise_m * scales.rates.noise(1));
    scales.rotation_rad =
        std::max(open_part * width / height, open_noise * std::sqrt(2.0) * scales.noise_rad * scales.rates.noise(0));
    return scales;
}

SmoothedRun::SmoothedRun(const Specimen& specimen, const MeasuredRun& run, const CampaignScales& scales,
                         const std::vector<double>& base_m)
    : blocks_(specimen.blocks()), widths_(scales.widths)
{
    const double dt = scales.spacing_s;
    const auto n = run.time_s.size() < 2
                       ? 0
                       : static_cast<std::size_t>(std::floor((run.time_s.back() - run.time_s.front()) / dt + 1e-6)) + 1;
    for (std::size_t i = 0; i < n; ++i)
        time_s_.push_back(run.time_s.front() + dt * static_cast<double>(i));

    const auto columns = static_cast<std::size_t>(blocks_);
    std::vector<char> bad(n, 0);
    for (const Series* series : {&run.blocks.x_m, &run.blocks.y_m, &run.blocks.theta_rad})
        for (std::size_t b = 0; b < columns; ++b) {
            if (series->empty()) {
                raw_.emplace_back(n, 0.0);
                std::fill(bad.begin(), bad.end(), 1);
                continue;
            }
            raw_.push_back(resampled(run.time_s, series->values.data() + b, columns, time_s_.front(), dt, n));
            for (std::size_t i = 0; i < n; ++i)
                if (!std::isfinite(raw_.back()[i])) {
                    raw_.back()[i] = 0;
                    bad[i] = 1;
                }
        }
    if (const auto fell_s = run.fell_at_s())
        for (std::size_t i = 0; i < n; ++i)
            if (time_s_[i] > *fell_s - falls_before * scales.time_s)
                bad[i] = 1;
    bad_before_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        bad_before_[i + 1] = bad_before_[i] + bad[i];

    for (int d = 0; d < 2; ++d)
        for (const auto& series : raw_)
            now_[static_cast<std::size_t>(d)].push_back(scales.rates.apply(d, series));
    if (!base_m.empty()) {
        const std::vector<double> base = resampled(run.time_s, base_m.data(), 1, time_s_.front(), dt, n);
        for (int d = 0; d < 2; ++d)
            base_[static_cast<std::size_t>(d)] = scales.rates.apply(d, base);
    }
}

bool SmoothedRun::usable(std::size_t i, int margin) const
{
    const auto m = static_cast<std::size_t>(margin);
    return i >= m && i + m < samples() && bad_before_[i + m + 1] == bad_before_[i - m];
}

} // namespace stylobate
