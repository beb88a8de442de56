#include "bench/pairs.hpp"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stylobate {

Comparison compare(std::vector<double> ratios, double confidence, double matters)
{
    if (ratios.empty() ||
        std::any_of(ratios.begin(), ratios.end(), [](double r) { return !(r > 0) || !std::isfinite(r); }))
        throw std::invalid_argument("pairs: there must be some, with positive, finite ratios");
    std::sort(ratios.begin(), ratios.end());
    const std::size_t n = ratios.size();
    Comparison c;
    c.pairs = static_cast<int>(n);
    c.ratio = n % 2 == 1 ? ratios[n / 2] : std::sqrt(ratios[n / 2 - 1] * ratios[n / 2]);
    c.high = std::numeric_limits<double>::infinity();
    // between the k-th smallest and the k-th largest: 1 - 2 P(fewer than k of n on one side)
    const boost::math::binomial side(static_cast<double>(n), 0.5);
    for (std::size_t k = n / 2; k >= 1; --k) {
        const double covered = 1 - 2 * boost::math::cdf(side, static_cast<double>(k - 1));
        c.confidence = covered;
        if (covered >= confidence) {
            c.low = ratios[k - 1];
            c.high = ratios[n - k];
            break;
        }
    }
    if (c.low <= 0)
        return c;
    const bool differs = c.low > 1 || c.high < 1;
    if (differs && c.ratio > 1 + matters)
        c.verdict = Verdict::faster;
    else if (differs && c.ratio < 1 - matters)
        c.verdict = Verdict::slower;
    else if (differs || (c.low >= 1 - matters && c.high <= 1 + matters))
        c.verdict = Verdict::same;
    return c;
}

const char* to_string(Verdict verdict)
{
    switch (verdict) {
    case Verdict::faster:
        return "faster";
    case Verdict::slower:
        return "slower";
    case Verdict::same:
        return "the same";
    case Verdict::open:
        break;
    }
    return "not decided";
}

} // namespace stylobate
