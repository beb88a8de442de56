#pragma once
/// How much stronger the shaking must be with an intervention, frequency by frequency.

#include "ensemble/estimators/paired/capacity_ratio.hpp"
#include "studies/decisions/compare/comparison.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A frequency of a surface, or all stripes of a fragility study.
struct CapacityRow {
    std::string place; ///< "0.5 Hz", "all stripes"
    CapacityRatio ratio;
};

/// Of a limit state that is damage. None where the study has less than two intensities, and none of an adaptive
/// comparison: it stops a cell by its outcomes.
std::vector<CapacityRow> capacity_rows(const Comparison& comparison, const LimitComparison& limit);

/// The measure in which the capacity is: "PGA".
std::string capacity_measure(const Comparison& comparison);

/// "1.20 (1.12 to 1.29; steps x 1.1)", "at least 3.1 (2.9 to 3.3; steps x 1.1)", "not in this range" where no intensity
/// separates the two.
std::string capacity_text(const CapacityRatio& ratio);

} // namespace stylobate
