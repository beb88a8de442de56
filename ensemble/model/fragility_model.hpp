#pragma once
/// Fragility functions as they are passed on to others: plain data.

#include <limits>
#include <string>
#include <vector>

namespace stylobate {

/// A number of a fragility function with its interval; never one without the other.
struct FragilityValue {
    double value = 0;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// One limit state of a function: lognormal, or probabilities at the function's intensities.
struct FragilityState {
    FragilityValue median = {};                   ///< [SI unit of the measure]
    FragilityValue dispersion = {};               ///< standard deviation of ln capacity
    std::vector<FragilityValue> probability = {}; ///< (intensities) of a discrete function
};

struct FragilityFunction {
    std::string id = {};         ///< what stands there (NRML: the taxonomy of the asset)
    std::string measure = "PGA"; ///< OpenQuake's name: PGA, PGV, PGD, SA(1.0), IA, CAV
    bool discrete = false;
    std::vector<double> intensity = {}; ///< of a discrete function, ascending [SI]
    double least = 0;                   ///< of a lognormal one: the range that it was found in [SI]
    double most = 0;
    std::vector<FragilityState> states = {}; ///< in the order of the model's limit states
    std::string note = {};                   ///< what a reader must know, such as a lack of fit
};

struct FragilityModel {
    std::string id = "stylobate";
    std::string description = {};
    double level = 0.95;                        ///< of every interval
    std::vector<std::string> limit_states = {}; ///< from the first that is reached to the last; one word each
    std::vector<FragilityFunction> functions = {};
};

} // namespace stylobate
