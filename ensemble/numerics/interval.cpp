#include "ensemble/numerics/interval.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stylobate {

const char* to_string(IntervalMethod method)
{
    return method == IntervalMethod::own ? "own" : "surface";
}

BinomialInterval wilson(std::uint64_t trials, std::uint64_t successes, double level)
{
    assert(successes <= trials && level > 0 && level < 1);
    if (trials == 0)
        return {};
    const double z = quantile(complement(boost::math::normal_distribution<double>(), (1 - level) / 2));
    const double n = static_cast<double>(trials);
    const double p = static_cast<double>(successes) / n;
    const double centre = p + z * z / (2 * n);
    const double reach = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    const double scale = 1 + z * z / n;
    return {successes == 0 ? 0 : std::max(0.0, (centre - reach) / scale),
            successes == trials ? 1 : std::min(1.0, (centre + reach) / scale)};
}

BinomialInterval jeffreys(std::uint64_t trials, std::uint64_t successes, double level)
{
    assert(successes <= trials && level > 0 && level < 1);
    if (trials == 0)
        return {};
    const boost::math::beta_distribution<double> posterior(static_cast<double>(successes) + 0.5,
                                                           static_cast<double>(trials - successes) + 0.5);
    const double tail = (1 - level) / 2;
    return {successes == 0 ? 0 : quantile(posterior, tail),
            successes == trials ? 1 : quantile(complement(posterior, tail))};
}

} // namespace stylobate
