#pragma once
/// The lognormal curve from capacities: incremental dynamic analysis, each record with its own intensities (Vamvatsikos
/// & Cornell, "Incremental dynamic analysis", Earthquake Engineering and Structural Dynamics 31 (2002) 491).
///
/// The capacity of a record is the lowest intensity at which the limit state is reached. It lies above the intensity
/// run before, so the observations are intervals: (below, at], (0, at] where the first run reached it, and (below,
/// infinity) where none did. Their likelihood (interval-censored data) needs neither a spacing nor a capacity for every
/// record.

#include "ensemble/estimators/fragility/curve_target.hpp"

#include <span>
#include <string>
#include <vector>

namespace stylobate {

struct RecordCapacity {
    std::uint32_t record = 0; ///< as numbered in the runs
    double below = 0;         ///< highest intensity before the first that reached the limit state; 0: none
    double at = std::numeric_limits<double>::infinity(); ///< the first that did; infinite: none
    bool resurrected = false;                            ///< a stronger run of the record did not reach it
};

/// @param runs one run of a record at each intensity; where there are several, more than half must have reached
/// @throws InputError as `grouped`, or with more than one measure
std::vector<RecordCapacity> record_capacities(std::span<const FragilityRun> runs);

struct CapacityCurve {
    std::size_t records = 0, resurrected = 0, unreached = 0;
    bool found = false; ///< the likelihood has its maximum at a finite dispersion above 0
    double median = 0;
    Limits median_limits;
    double dispersion = 0;
    Limits dispersion_limits;
    std::vector<std::string> says;
};

/// By maximum likelihood (algorithm EM: Dempster, Laird & Rubin, "Maximum likelihood from incomplete data via the EM
/// algorithm", Journal of the Royal Statistical Society B 39 (1977) 1), with intervals by the jackknife over records
/// with Student's quantile.
/// @throws InputError with fewer than two records
CapacityCurve capacity_curve(std::span<const RecordCapacity> capacities, double level = 0.95);

} // namespace stylobate
