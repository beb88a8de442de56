#include "ensemble/numerics/quantiles.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <numbers>

namespace stylobate {

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
