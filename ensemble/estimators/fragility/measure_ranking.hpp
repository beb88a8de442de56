#pragma once
/// Ranking of intensity measures by their information on a limit state (efficiency), and a test whether other features
/// of the records add to it (sufficiency). The terms are those of Luco & Cornell, "Structure-specific scalar intensity
/// measures for near-source and ordinary earthquake ground motions", Earthquake Spectra 23 (2007) 357; the gain in
/// information per run is an own choice.

#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// The contribution of another feature of the records to one measure.
struct Sufficiency {
    std::string feature;    ///< such as magnitude or distance
    double coefficient = 0; ///< of the standardised feature beside ln measure
    Limits limits;          ///< by the records
    double p_value = 1;     ///< that it adds nothing
};

struct RankedMeasure {
    std::string name;
    std::size_t column = 0; ///< in the data
    /// Of the lognormal curve in this measure alone: the smaller, the more efficient. Without a curve it is NaN, as is
    /// the gain.
    double dispersion = 0;
    Limits dispersion_limits;
    double gain = 0; ///< information on the outcome: (log likelihood - that of the mean share) / runs [nat]
    Limits behind;   ///< by how much the best measure's gain exceeds it, by records [nat]; 0, 0 of the best itself
    std::vector<Sufficiency> sufficiency; ///< for each feature
    bool sufficient = true;               ///< no feature adds anything at the level, all tested together (Bonferroni)
    std::string says;
};

/// @param names    (measures)
/// @param features (features) names of other known features of the records
/// @param values   (features x records) their values, in the order of the records' numbers
/// @return best gain first; measures without a curve last. The gain compares measures with different units and slopes,
///         which the dispersion does only after division by the scatter of the measure itself.
/// @throws InputError for names or features of another count, or fewer than `least_records` records
std::vector<RankedMeasure> ranked_measures(const FragilityData& data, const std::vector<std::string>& names,
                                           const std::vector<std::string>& features,
                                           const std::vector<std::vector<double>>& values, double level = 0.95);

} // namespace stylobate
