#pragma once
/// One measured run made ready for the balance of forces: equally spaced samples without gaps, smoothed over several
/// half widths, and the time scales and thresholds that the specimen's size and the cameras' noise set.
///
/// Value, rate and acceleration of a noisy series, by local cubics: each sample's neighbours within a half width are
/// fitted by weighted least squares (weights (1 - (k / (h + 1))^2)^2), which is a fixed set of coefficients. What the
/// noise of the samples makes of the result is therefore known.

#include "ensemble/model/campaign.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace stylobate {

class LocalCubic {
public:
    /// @param half_width in samples, at least 2   @param dt_s spacing of the samples
    LocalCubic(int half_width, double dt_s);

    int half_width() const { return half_width_; }

    /// Smoothed value (derivative 0), rate (1) or acceleration (2) of every sample; within a half width of the ends 0.
    /// @param series (n)   @return (n)
    std::vector<double> apply(int derivative, const std::vector<double>& series) const;
    /// Smoothed value, rate or acceleration of one sample.
    double at(int derivative, const std::vector<double>& series, std::size_t sample) const;

    /// Standard deviation of the result where the samples have independent noise of standard deviation 1.
    double noise(int derivative) const { return noise_[derivative]; }

private:
    int half_width_;
    std::vector<double> coefficients_[3]; ///< (2 half_width + 1) of each derivative
    double noise_[3]{};
};

/// x, y or rotation of a block, as an index.
enum Component : int { in_x = 0, in_y = 1, in_theta = 2 };
inline constexpr std::array component_names = {"x", "y", "theta"};

/// A collapse begins this long before it is reported, in time scales.
inline constexpr double falls_before = 1;
/// Half width of a base whose ends are not known [m].
inline constexpr double endless_m = 1e3;

/// What depends on the specimen and its cameras alone.
struct CampaignScales {
    double time_s = 0;              ///< sqrt(height / g) of the whole specimen
    double spacing_s = 0;           ///< of the samples
    double noise_m = 0;             ///< of x and y, the larger one
    double noise_rad = 0;           ///< of the rotations
    std::vector<LocalCubic> widths; ///< of smoothing, narrowest first
    LocalCubic rates{2, 1};         ///< for the detection of slip and rocking
    double slip_m_s = 0;            ///< slower than this counts as at rest
    double rotation_rad = 0;        ///< less than this counts as closed
};

/// @throws InputError if there is no run with x, y and rotation of the blocks, or the cameras are too slow for the
///         specimen: fewer than 12 samples in the time that smoothing may take
CampaignScales campaign_scales(const Campaign& campaign);

/// Motion of all blocks at one instant: [coordinate][block].
using BlockValues = std::array<std::vector<double>, 3>;

class SmoothedRun {
public:
    /// @param base_m the base's displacement at the samples of the run's own clock (the corrected one); empty: not
    /// known
    SmoothedRun(const Specimen& specimen, const MeasuredRun& run, const CampaignScales& scales,
                const std::vector<double>& base_m);

    std::size_t samples() const { return time_s_.size(); }
    double time_s(std::size_t i) const { return time_s_[i]; }
    /// Whether all blocks are seen, and none is falling, `margin` samples to either side.
    bool usable(std::size_t i, int margin) const;

    /// Smoothed by `widths[width]`; derivative 0 to 2. Computed anew by every call: few samples are needed.
    double of(int width, int derivative, Component coordinate, int block, std::size_t i) const
    {
        return widths_[static_cast<std::size_t>(width)].at(derivative, raw_[index(coordinate, block)], i);
    }
    /// (n) the same of all samples, for less.
    std::vector<double> all_of(int width, int derivative, Component coordinate, int block) const
    {
        return widths_[static_cast<std::size_t>(width)].apply(derivative, raw_[index(coordinate, block)]);
    }
    /// Smoothed by `rates`; derivative 0 or 1.
    double now(int derivative, Component coordinate, int block, std::size_t i) const
    {
        return now_[static_cast<std::size_t>(derivative)][index(coordinate, block)][i];
    }
    bool has_base() const { return !base_[0].empty(); }
    /// Base displacement (derivative 0) and velocity (1), smoothed by `rates`.
    double base(int derivative, std::size_t i) const
    {
        return base_[static_cast<std::size_t>(derivative)].empty() ? 0 : base_[static_cast<std::size_t>(derivative)][i];
    }

private:
    std::size_t index(int coordinate, int block) const
    {
        return static_cast<std::size_t>(coordinate * blocks_ + block);
    }
    int blocks_;
    std::vector<double> time_s_;
    std::vector<int> bad_before_; ///< (n + 1) how many samples before the i-th are not usable
    std::vector<LocalCubic> widths_;
    std::vector<std::vector<double>> raw_;                ///< [3 n_block][n]
    std::array<std::vector<std::vector<double>>, 2> now_; ///< [derivative][3 n_block][n]
    std::array<std::vector<double>, 2> base_;
};

/// A series at equally spaced times, by linear interpolation; NaN where a neighbour is missing.
std::vector<double> resampled(const std::vector<double>& time_s, const double* values, std::size_t stride,
                              double from_s, double spacing_s, std::size_t count);

} // namespace stylobate
