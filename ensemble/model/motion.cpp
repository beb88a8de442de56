#include "ensemble/model/motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stylobate {

double peak(const std::vector<double>& values)
{
    double largest = 0;
    for (const double value : values)
        largest = std::max(largest, std::fabs(value));
    return largest;
}

double size_of_pair(OfPair definition, double first, double second, double at_once)
{
    switch (definition) {
    case OfPair::first:
        return first;
    case OfPair::larger:
        return std::max(first, second);
    case OfPair::geometric_mean:
        return std::sqrt(first * second);
    case OfPair::at_once:
        return at_once;
    }
    return first;
}

double peak_at_once(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        const double along = i < a.size() ? a[i] : 0, across = i < b.size() ? b[i] : 0;
        largest = std::max(largest, along * along + across * across);
    }
    return std::sqrt(largest);
}

Integrated integrate(const std::vector<double>& a, double d)
{
    Integrated motion{std::vector<double>(a.size()), std::vector<double>(a.size())};
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
        motion.v[i + 1] = motion.v[i] + d * (a[i] + a[i + 1]) / 2;
        motion.u[i + 1] = motion.u[i] + motion.v[i] * d + d * d * (a[i] / 3 + a[i + 1] / 6);
    }
    return motion;
}

std::vector<double> acceleration_through(const std::vector<double>& u, double d)
{
    // The slope is continuous at every sample: a(i-1) + 4 a(i) + a(i+1) = 6 (u(i+1) - 2 u(i) + u(i-1)) / d2, at rest
    // at the first one: 2 a(0) + a(1) = 6 (u(1) - u(0)) / d2, and a = 0 at the last one. By elimination from the left.
    assert(u.size() >= 2 && "a motion passes through two displacements at least");
    const std::size_t n = u.size();
    const double per_d2 = 6 / (d * d);
    std::vector<double> a(n), above(n);
    double diagonal = 2;
    a[0] = per_d2 * (u[1] - u[0]) / diagonal;
    above[0] = 1 / diagonal;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        diagonal = 4 - above[i - 1];
        above[i] = 1 / diagonal;
        a[i] = (per_d2 * ((u[i + 1] - u[i]) - (u[i] - u[i - 1])) - a[i - 1]) / diagonal;
    }
    a[n - 1] = 0;
    for (std::size_t i = n - 1; i-- > 0;)
        a[i] -= above[i] * a[i + 1];
    return a;
}

Motion motion_of(std::vector<double> acceleration, double dt_s)
{
    Motion motion;
    motion.dt_s = dt_s;
    motion.acceleration_m_s2 = std::move(acceleration);
    Integrated moved = integrate(motion.acceleration_m_s2, dt_s);
    motion.velocity_m_s = std::move(moved.v);
    motion.displacement_m = std::move(moved.u);
    motion.pga_m_s2 = peak(motion.acceleration_m_s2);
    return motion;
}

} // namespace stylobate
