#pragma once
/// Quantiles and medians of a sample. The definitions are those of Hyndman & Fan, "Sample quantiles in statistical
/// packages", The American Statistician 50 (1996) 361; x_(1) <= ... <= x_(n) are the sorted values.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace stylobate {

enum class QuantileDefinition {
    weibull, ///< definition 6: linear, x_(k) at p = k / (n + 1). The tails keep their nominal weight.
    linear,  ///< definition 7: linear, x_(k) at p = (k - 1) / (n - 1). The quantiles 0 and 1 are the extremes.
    above    ///< x_(floor(p n) + 1), not interpolated: definition 1, but the upper value where p n is whole
};

/// The quantile p of ascending values.
/// @param p in [0, 1]
/// @pre at least one value
double sorted_quantile(std::span<const double> ascending, double p, QuantileDefinition definition);

/// The mean of the two middle values (the same one, if their number is odd): p = 1/2 of definitions 2 and 5 to 9.
/// @pre at least one value
double sorted_median(std::span<const double> ascending);

/// x_(floor(n / 2) + 1), in any order given: a value of the sample, the upper of the two middle ones.
/// @pre at least one value
double upper_median(std::vector<double> values);

// Means and medians of independent values, with their intervals.

struct Estimated {
    std::size_t count = 0;
    double value = 0; ///< NaN without values
    double lower = 0, upper = 0;
};

/// Student's interval, 95 % (Student, "The probable error of a mean", Biometrika 6 (1908) 1); NaN are left out. Below
/// two values the interval is unbounded.
Estimated estimated_mean(const std::vector<double>& values);

/// The interval between two order statistics that contains the median with at least 95 %, whatever the distribution
/// (David & Nagaraja, "Order Statistics" (2003), section 7.1); below six values it is unbounded. Infinite values (the
/// time of an event that did not occur) are the greatest, and nothing else is assumed of them: the median is infinite
/// where more than half of the values are.
Estimated estimated_median(std::vector<double> values);

// The least-squares slope of points that are added one by one (updating sums of products of deviations: Welford, "Note
// on a method for calculating corrected sums of squares and products", Technometrics 4 (1962) 419).

class Slope {
public:
    void add(double t, double y)
    {
        ++count_;
        const double dt = t - t_, n = count_;
        t_ += dt / n;
        y_ += (y - y_) / n;
        tt_ += dt * (t - t_);
        ty_ += dt * (y - y_);
    }
    int count() const { return count_; }
    /// NaN below two points, or if all have the same t.
    double value() const { return tt_ > 0 ? ty_ / tt_ : std::numeric_limits<double>::quiet_NaN(); }

private:
    int count_ = 0;
    double t_ = 0, y_ = 0;   ///< means
    double tt_ = 0, ty_ = 0; ///< sums of products of deviations
};

} // namespace stylobate
