#include "ensemble/numerics/random.hpp"

#include <Random123/philox.h>

#include <array>
#include <cmath>

namespace stylobate {

namespace {

using Coefficients = std::array<double, 8>; // of x^0 to x^7

double polynomial(const Coefficients& c, double x)
{
    double sum = c[7];
    for (std::size_t k = 7; k-- > 0;)
        sum = sum * x + c[k];
    return sum;
}

double ratio(const Coefficients& over, const Coefficients& under, double x)
{
    return polynomial(over, x) / polynomial(under, x);
}

// The middle, as a function of (u - 1/2)^2; the tails, of sqrt(-ln u).
constexpr Coefficients middle_over = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                                      1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                                      3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr Coefficients middle_under = {1,
                                       4.2313330701600911252e1,
                                       6.8718700749205790830e2,
                                       5.3941960214247511077e3,
                                       2.1213794301586595867e4,
                                       3.9307895800092710610e4,
                                       2.8729085735721942674e4,
                                       5.2264952788528545610e3};
constexpr Coefficients near_over = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                    3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Coefficients near_under = {1,
                                     2.05319162663775882187e0,
                                     1.67638483018380384940e0,
                                     6.89767334985100004550e-1,
                                     1.48103976427480074590e-1,
                                     1.51986665636164571966e-2,
                                     5.47593808499534494600e-4,
                                     1.05075007164441684324e-9};
constexpr Coefficients far_over = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                   2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                   2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Coefficients far_under = {1,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};

} // namespace

double to_normal(double u)
{
    const double q = u - 0.5;
    if (std::fabs(q) <= 0.425)
        return q * ratio(middle_over, middle_under, 0.180625 - q * q);
    const double r = std::sqrt(-std::log(q < 0 ? u : 1 - u));
    const double z = r <= 5 ? ratio(near_over, near_under, r - 1.6) : ratio(far_over, far_under, r - 5);
    return q < 0 ? -z : z;
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element)
{
    using Philox = r123::Philox4x64;
    const Philox::key_type key = {{seed, index}};
    const Philox::ctr_type counter = {{static_cast<std::uint64_t>(stream), element, 0, 0}};
    return Philox()(counter, key)[0];
}

double to_uniform01(std::uint64_t bits)
{
    // The highest 53 bits with the last one set: with 53 free bits one end of the interval would have to be in it.
    return static_cast<double>((bits >> 11) | 1U) * 0x1p-53;
}

double uniform01(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element)
{
    return to_uniform01(random_bits(seed, index, stream, element));
}

} // namespace stylobate
