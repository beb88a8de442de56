#pragma once
/// From a linear predictor to a probability: the probit (the normal distribution; Bliss, "The calculation of the
/// dosage-mortality curve", Annals of Applied Biology 22 (1935) 134) and the logit (the logistic distribution; Berkson,
/// "Application of the logistic function to bio-assay", Journal of the American Statistical Association 39 (1944) 357).

#include <cstdint>

namespace stylobate {

/// Which distribution function maps the linear predictor to a probability. The probit in the logarithm of an intensity
/// is the lognormal fragility curve.
enum class Link : std::uint8_t { probit, logit };
const char* to_string(Link link);

/// A link at one value of the linear predictor.
struct LinkValue {
    double below = 0.5;   ///< probability F(eta)
    double above = 0.5;   ///< 1 - F(eta), with its own relative accuracy
    double density = 0;   ///< dF / d eta
    double curvature = 0; ///< d density / d eta
};
LinkValue link_at(Link link, double eta);

/// The linear predictor of a probability in (0, 1): the inverse of `below`.
double link_quantile(Link link, double probability);

} // namespace stylobate
