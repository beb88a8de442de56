#pragma once
/// Means with their standard errors, for programs that compare outcomes of the same realizations.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stylobate {

struct Mean {
    double sum = 0, squares = 0, count = 0;
    void add(double x)
    {
        sum += x;
        squares += x * x;
        ++count;
    }
    double value() const { return sum / count; }
    /// Of the mean.
    double error() const { return std::sqrt(std::max(0.0, squares / count - value() * value()) / count); }
};

/// (realizations) 1: fell, 0: did not, -1: invalid, which takes no part in a mean.
using Fallen = std::vector<signed char>;

inline Mean share_of(const Fallen& fallen)
{
    Mean mean;
    for (const signed char one : fallen)
        if (one >= 0)
            mean.add(one);
    return mean;
}

/// How much larger the share of `a` is than that of `b`, of the same realizations.
inline Mean paired_difference(const Fallen& a, const Fallen& b)
{
    Mean mean;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] >= 0 && b[i] >= 0)
            mean.add(a[i] - b[i]);
    return mean;
}

} // namespace stylobate
