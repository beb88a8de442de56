#include "ensemble/estimators/past/rate_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stylobate {

RateCurve::RateCurve(std::vector<double> intensity, const std::vector<double>& rate) : intensity_(std::move(intensity))
{
    assert(intensity_.size() >= 2 && intensity_.size() == rate.size() && "a curve has two points at least");
    for (const double each : rate)
        log_rate_.push_back(std::log(each));
}

std::size_t RateCurve::piece(double intensity) const
{
    const auto above = std::upper_bound(intensity_.begin() + 1, intensity_.end() - 1, intensity);
    return static_cast<std::size_t>(above - intensity_.begin()) - 1;
}

double RateCurve::slope(std::size_t i) const
{
    return (log_rate_[i] - log_rate_[i + 1]) / std::log(intensity_[i + 1] / intensity_[i]);
}

double RateCurve::rate(double intensity) const
{
    if (power_)
        return k0_ * std::pow(intensity, -k_);
    const std::size_t i = piece(intensity);
    return std::exp(log_rate_[i] - slope(i) * std::log(intensity / intensity_[i]));
}

double RateCurve::density(double intensity) const
{
    return (power_ ? k_ : slope(piece(intensity))) * rate(intensity);
}

} // namespace stylobate
