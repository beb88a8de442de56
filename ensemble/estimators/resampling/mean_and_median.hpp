#pragma once
/// Means and medians of independent values, with their intervals.

#include <cstddef>
#include <vector>

namespace stylobate {

struct Estimated {
    std::size_t count = 0;
    double value = 0; ///< NaN without values
    double lower = 0, upper = 0;
};

/// Student's interval, 95 %; what is NaN is left out. Below two values the interval is everything.
Estimated mean_of(const std::vector<double>& values);

/// The interval between two order statistics that holds the median in at least 95 %, whatever the distribution; below
/// six values it is everything. Infinite values (a time that did not come) are the greatest: nothing is assumed of
/// them but that. So the median is infinite where more than half of the values are.
Estimated median_of(std::vector<double> values);

} // namespace stylobate
