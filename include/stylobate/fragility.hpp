#pragma once
/// Fragility curves: the probability of damage over the intensity of the shaking.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace stylobate::api {

/// A number with its 95 % interval, by how the motions differ; NaN, or without bounds, where the data do not determine
/// it.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// The curve of one limit state: P = Phi(ln(intensity / median) / dispersion).
struct FragilityCurve {
    std::string limit_state; ///< "peak_0.15", "collapse": one word
    std::string meaning;     ///< when it is reached
    std::uint64_t trials = 0;
    std::uint64_t reached = 0;
    Estimate median;                   ///< in the unit of the measure
    Estimate dispersion;               ///< standard deviation of ln capacity
    std::vector<Estimate> probability; ///< (`Fragility::intensity`) along the curve
    std::vector<Estimate> share;       ///< (`Fragility::stripe`) of the realizations, without the form of a curve
};

/// What a fragility study found.
struct Fragility {
    std::string measure;           ///< of the intensities, its unit in its name: "pgv_m_s"
    std::vector<double> intensity; ///< at which the curves are given, ascending
    std::vector<double> stripe;    ///< intensities to which the motions were scaled; empty of a cloud
    std::vector<FragilityCurve> curves;
};

} // namespace stylobate::api
