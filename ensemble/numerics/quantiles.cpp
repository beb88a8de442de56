#include "ensemble/numerics/quantiles.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace stylobate {

double student_quantile(double probability, double degrees)
{
    return boost::math::quantile(boost::math::students_t(degrees), probability);
}

double normal_quantile(double probability)
{
    return boost::math::quantile(boost::math::normal(), probability);
}

} // namespace stylobate
