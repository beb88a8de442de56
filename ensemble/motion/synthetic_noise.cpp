#include "ensemble/motion/synthetic_noise.hpp"

#include "ensemble/motion/synthetic_sine.hpp"
#include "ensemble/numerics/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace stylobate {

namespace {

using std::numbers::pi;
constexpr double samples_per_second = 200, samples_per_cycle = 100;

/// u'' + 2 z w u' + w2 u = f, exactly over steps in which f is linear (Nigam & Jennings 1969).
class Filter {
public:
    Filter(double frequency_hz, double damping_ratio, double step_s)
        : w_(2 * pi * frequency_hz), z_(damping_ratio), w_d_(w_ * std::sqrt(1 - z_ * z_)), h_(step_s)
    {
        const double decay = exp_of(-z_ * w_ * h_), cycles = w_d_ * h_ / (2 * pi);
        cosine_ = decay * cosine_of(cycles);
        sine_ = decay * sine_of(cycles);
    }

    void advance(double f0, double f1)
    {
        // u = exp(-z w t) (A cos w_d t + B sin w_d t) + (f0 + slope t) / w2 - lag
        const double slope = (f1 - f0) / h_, w2 = w_ * w_, lag = 2 * z_ * slope / (w2 * w_);
        const double A = u_ - f0 / w2 + lag;
        const double B = (v_ + z_ * w_ * A - slope / w2) / w_d_;
        const double swing = cosine_ * A + sine_ * B;
        u_ = swing + f1 / w2 - lag;
        v_ = w_d_ * (cosine_ * B - sine_ * A) - z_ * w_ * swing + slope / w2;
    }
    /// 2 z w u' + w2 u: the force of spring and dashpot.
    double held() const { return 2 * z_ * w_ * v_ + w_ * w_ * u_; }

private:
    double w_, z_, w_d_, h_;
    double cosine_ = 1, sine_ = 0;
    double u_ = 0, v_ = 0;
};

/// Independent normal numbers, two at a time (Box and Muller 1958): number i depends on (seed, index, stream, i) alone.
std::vector<double> white_noise(std::uint64_t seed, std::uint64_t index, Stream stream, std::size_t count)
{
    std::vector<double> noise(count + count % 2);
    for (std::size_t i = 0; i < noise.size(); i += 2) {
        const double radius = std::sqrt(-2 * log_of(uniform01(seed, index, stream, i)));
        const double turn = uniform01(seed, index, stream, i + 1);
        noise[i] = radius * cosine_of(turn);
        noise[i + 1] = radius * sine_of(turn);
    }
    noise.resize(count);
    return noise;
}

/// Velocity and displacement at the end of an acceleration that is linear between its samples; along it, where asked.
std::pair<double, double> integrate_along(const std::vector<double>& a, double d, Motion* along = nullptr)
{
    double v = 0, u = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (i > 0) {
            u += v * d + d * d * (a[i - 1] / 3 + a[i] / 6);
            v += d * (a[i - 1] + a[i]) / 2;
        }
        if (along != nullptr) {
            along->velocity_m_s.push_back(v);
            along->displacement_m.push_back(u);
        }
    }
    return {v, u};
}

} // namespace

SyntheticNoise::SyntheticNoise(const ExcitationSpec& e, double ground_frequency_hz)
    : frequency_hz_(ground_frequency_hz), damping_ratio_(e.ground_damping_ratio),
      low_cut_hz_(ground_frequency_hz * e.low_cut_ratio), low_cut_damping_ratio_(e.low_cut_damping_ratio),
      rise_s_(e.rise_s), strong_s_(e.strong_s), decay_s_(e.decay_s)
{
    const double planned = rise_s_ + strong_s_ + noise_decays * decay_s_;
    const double rate = std::max(samples_per_second, samples_per_cycle * frequency_hz_);
    const double intervals = std::ceil(planned * rate);
    samples_ = static_cast<std::size_t>(intervals) + 1;
    dt_s_ = 1 / rate;
    duration_s_ = intervals * dt_s_;
}

double SyntheticNoise::envelope(double t) const
{
    if (t < rise_s_)
        return (t / rise_s_) * (t / rise_s_);
    const double late = t - rise_s_ - strong_s_;
    return late <= 0 ? 1 : exp_of(-late / decay_s_);
}

std::vector<double> SyntheticNoise::acceleration(std::uint64_t seed, std::uint64_t index, Stream stream) const
{
    std::vector<double> a = white_noise(seed, index, stream, samples_);
    Filter ground(frequency_hz_, damping_ratio_, dt_s_), low_cut(low_cut_hz_, low_cut_damping_ratio_, dt_s_);
    double shaken = 0, ground_acceleration = 0; // at the sample before
    for (std::size_t i = 0; i < samples_; ++i) {
        const double noise = i == 0 ? 0 : -envelope(static_cast<double>(i) * dt_s_) * a[i];
        ground.advance(std::exchange(shaken, noise), noise);
        const double moved = -ground.held();
        low_cut.advance(std::exchange(ground_acceleration, moved), moved);
        a[i] = moved - low_cut.held();
    }
    // twice: the second time removes the remainder of the first, which is not a polynomial between samples
    for (int pass = 0; pass < 2; ++pass) {
        const auto [v, u] = integrate_along(a, dt_s_);
        const RestPolynomial rest(duration_s_, u, v, a.back());
        for (std::size_t i = 0; i < samples_; ++i)
            a[i] -= rest.acceleration(static_cast<double>(i) * dt_s_);
    }
    a.back() = 0;
    return a;
}

double SyntheticNoise::mean_peak(std::uint64_t seed) const
{
    double sum = 0;
    for (std::uint64_t i = 0; i < motions_for_mean_peak; ++i)
        sum += peak(acceleration(seed, i, Stream::mean_peak));
    return sum / static_cast<double>(motions_for_mean_peak);
}

Motion SyntheticNoise::motion_from(std::vector<double> acceleration, double scale) const
{
    Motion m;
    m.dt_s = dt_s_;
    m.acceleration_m_s2 = std::move(acceleration);
    for (double& a : m.acceleration_m_s2)
        a *= scale;
    integrate_along(m.acceleration_m_s2, dt_s_, &m);
    m.pga_m_s2 = peak(m.acceleration_m_s2);
    m.predominant_frequency_hz = frequency_hz_;
    return m;
}

Motion SyntheticNoise::motion(std::uint64_t seed, std::uint64_t index, double scale) const
{
    return motion_from(acceleration(seed, index, Stream::base_noise), scale);
}

Motion SyntheticNoise::motion_of_peak(std::uint64_t seed, std::uint64_t index, double pga_m_s2) const
{
    std::vector<double> a = acceleration(seed, index, Stream::base_noise);
    const double scale = pga_m_s2 / peak(a);
    return motion_from(std::move(a), scale);
}

} // namespace stylobate
