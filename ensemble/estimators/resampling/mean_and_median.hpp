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

/// Student's interval, 95 % (Student, "The probable error of a mean", Biometrika 6 (1908) 1); NaN are left out. Below
/// two values the interval is unbounded.
Estimated mean_of(const std::vector<double>& values);

/// The interval between two order statistics that contains the median with at least 95 %, whatever the distribution
/// (David & Nagaraja, "Order Statistics" (2003), section 7.1); below six values it is unbounded. Infinite values (the
/// time of an event that did not occur) are the greatest, and nothing else is assumed of them: the median is infinite
/// where more than half of the values are.
Estimated median_of(std::vector<double> values);

} // namespace stylobate
