#pragma once
/// Value, rate and acceleration of a noisy series, by local cubics: each sample's neighbours within a half width are
/// fitted by weighted least squares (weights (1 - (k / (h + 1))^2)^2), which is a fixed set of coefficients. What the
/// noise of the samples makes of the result is therefore known.

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
    /// The same of one sample.
    double at(int derivative, const std::vector<double>& series, std::size_t sample) const;

    /// Standard deviation of the result where the samples have independent noise of standard deviation 1.
    double noise(int derivative) const { return noise_[derivative]; }

private:
    int half_width_;
    std::vector<double> coefficients_[3]; ///< (2 half_width + 1) of each derivative
    double noise_[3]{};
};

} // namespace stylobate
