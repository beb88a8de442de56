#include "ensemble/sampling/distribution.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/elementary.hpp"

#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const char* name(DistributionKind kind)
{
    switch (kind) {
    case DistributionKind::normal:
        return "normal";
    case DistributionKind::lognormal:
        return "lognormal";
    case DistributionKind::uniform:
        return "uniform";
    case DistributionKind::log_uniform:
        return "log_uniform";
    }
    return "?";
}

double log_ratio(double a, double b)
{
    return (log_pair(a) - log_pair(b)).rounded();
}

} // namespace

Distribution::Distribution(const Spread& spread, const std::string& key, double nominal)
    : kind_(spread.distribution), location_(nominal), scale_(0), min_(spread.min.value_or(-infinity)),
      max_(spread.max.value_or(infinity))
{
    const boost::math::normal_distribution<double> standard;
    const auto none_left = [&] {
        return InputError(
            fmt::format("{}: a {} distribution about the nominal value {:g} has no "
                        "probability between min = {:g} and max = {:g}. Widen these limits, or omit them.",
                        key, name(kind_), nominal, min_, max_));
    };
    const auto set_tails = [&](double lower, double upper) {
        // quantities at infinity are taken from the initial values: Boost refuses infinite arguments in some versions
        if (lower > -infinity) {
            below_min_ = cdf(standard, lower);
            above_min_ = cdf(complement(standard, lower));
        }
        if (upper < infinity) {
            below_max_ = cdf(standard, upper);
            above_max_ = cdf(complement(standard, upper));
        }
        const double inside = lower > 0 ? above_min_ - above_max_ : below_max_ - below_min_;
        if (!(inside > 0))
            throw none_left();
    };

    switch (kind_) {
    case DistributionKind::normal:
        scale_ = spread.cov > 0 ? spread.cov * std::abs(nominal) : spread.sd;
        if (scale_ > 0)
            set_tails((min_ - location_) / scale_, (max_ - location_) / scale_);
        break;
    case DistributionKind::lognormal:
        if (!(nominal > 0))
            throw InputError(fmt::format("{}: a lognormal distribution needs a nominal value above 0; it is {:g}. Use "
                                         "\"normal\" with an sd instead.",
                                         key, nominal));
        scale_ = spread.sigma_ln;
        if (!(max_ > 0))
            throw none_left();
        if (scale_ > 0)
            set_tails(min_ > 0 ? log_ratio(min_, nominal) / scale_ : -infinity,
                      max_ < infinity ? log_ratio(max_, nominal) / scale_ : infinity);
        break;
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        location_ = std::max(spread.from, min_);
        scale_ = std::min(spread.to, max_);
        if (!(location_ <= scale_))
            throw none_left();
        min_ = location_;
        max_ = scale_;
        break;
    }
    // without spread the distribution is the nominal value
    if (scale_ == 0 && (location_ < min_ || location_ > max_))
        throw none_left();
}

double Distribution::value(double u) const
{
    if (kind_ == DistributionKind::uniform)
        return std::clamp(location_ * (1 - u) + scale_ * u, min_, max_);
    if (kind_ == DistributionKind::log_uniform) {
        const DoublePair exponent = log_pair(location_) * DoublePair(1 - u) + log_pair(scale_) * DoublePair(u);
        return std::clamp(exp_of(exponent).rounded(), min_, max_);
    }
    if (scale_ == 0)
        return location_;

    const boost::math::normal_distribution<double> standard;
    const double below = below_min_ * (1 - u) + below_max_ * u;
    const double above = above_min_ * (1 - u) + above_max_ * u;
    const double z = below <= above ? quantile(standard, below) : quantile(complement(standard, above));
    const double x = kind_ == DistributionKind::normal
                         ? location_ + scale_ * z
                         : (DoublePair(location_) * exp_of(exact_product(scale_, z))).rounded();
    return std::clamp(x, min_, max_);
}

} // namespace stylobate
