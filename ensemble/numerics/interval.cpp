#include "ensemble/numerics/interval.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cassert>
#include <cmath>
#include <numbers>

namespace stylobate {

const char* to_string(IntervalMethod method)
{
    return method == IntervalMethod::own ? "own" : "surface";
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

double student_quantile(double probability, double degrees)
{
    return boost::math::quantile(boost::math::students_t(degrees), probability);
}

double normal_quantile(double probability)
{
    return boost::math::quantile(boost::math::normal(), probability);
}

double normal_below(double z)
{
    return std::erfc(-z / std::numbers::sqrt2) / 2;
}

double normal_density(double z)
{
    return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

} // namespace stylobate
