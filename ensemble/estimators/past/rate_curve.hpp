#pragma once
/// A hazard curve: the annual rate H(a) at which an intensity is exceeded, a power of the intensity between its points
/// and beyond them (Cornell, "Engineering seismic risk analysis", Bulletin of the Seismological Society of America 58
/// (1968) 1583, for the power law).

#include <cstddef>
#include <vector>

namespace stylobate {

class RateCurve {
public:
    /// k0 a^-k
    RateCurve(double k0, double k) : power_(true), k0_(k0), k_(k) {}
    /// Points: intensities ascending, rates descending, both above 0. @pre at least two
    RateCurve(std::vector<double> intensity, const std::vector<double>& rate);

    /// H(a), a > 0.
    double rate(double intensity) const;
    /// -dH / d ln a: the rate of events of an intensity within a small interval of its logarithm, over that interval.
    double density(double intensity) const;

private:
    /// Number of the piece that an intensity lies in, or next to.
    std::size_t piece(double intensity) const;
    double slope(std::size_t piece) const;

    std::vector<double> intensity_, log_rate_;
    bool power_ = false;
    double k0_ = 0, k_ = 0;
};

} // namespace stylobate
