#include "ensemble/estimators/fragility/link.hpp"

#include <boost/math/special_functions/erf.hpp>

#include <cassert>
#include <cmath>
#include <numbers>

namespace stylobate {

const char* to_string(Link link)
{
    return link == Link::probit ? "probit" : "logit";
}

LinkValue link_at(Link link, double eta)
{
    using std::numbers::inv_sqrtpi;
    using std::numbers::sqrt2;
    if (link == Link::probit) {
        const double density = inv_sqrtpi / sqrt2 * std::exp(-eta * eta / 2);
        return {std::erfc(-eta / sqrt2) / 2, std::erfc(eta / sqrt2) / 2, density, -eta * density};
    }
    // by the smaller exponential, so that neither tail overflows
    const double small = std::exp(-std::abs(eta));
    const double far = small / (1 + small), near = 1 / (1 + small);
    const double below = eta < 0 ? far : near, above = eta < 0 ? near : far;
    return {below, above, far * near, far * near * (above - below)};
}

double link_quantile(Link link, double probability)
{
    assert(probability > 0 && probability < 1);
    if (link == Link::probit)
        return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * probability);
    return std::log(probability / (1 - probability));
}

} // namespace stylobate
