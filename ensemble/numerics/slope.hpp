#pragma once
/// The least-squares slope of points that are added one by one (updating sums of products of deviations: Welford, "Note
/// on a method for calculating corrected sums of squares and products", Technometrics 4 (1962) 419).

#include <limits>

namespace stylobate {

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
