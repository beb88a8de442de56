#pragma once
/// Variance components of the response: record, imperfections, contact parameters, and chaos.
///
/// A nested design: each record shakes several structures (the same columns with other imperfections), each structure
/// has several sets of contact parameters, each of these several perturbed replicas that differ by a negligible amount.
/// The response y is 0 or 1 (the limit state at one intensity), or a number (ln of a displacement, of a capacity). With
/// y the sum of independent parts, half the mean squared difference of two runs that first differ at a level is the sum
/// of the variances of that level and of all below it,
///
///   D_l = E (y - y')^2 / 2,   the runs being equal above l and different at l
///
/// (own derivation; the model is that of Searle, Casella & McCulloch, "Variance Components" (1992)). D_l is estimated
/// without bias from all such pairs, with any number of runs anywhere. The variance of the level is D_l - D_(l+1), the
/// total is D of the records. An estimated variance may be negative where the true value is near 0; it is given as it
/// is, because truncating it would bias it. The shares are those of the nearest variances that are possible (none
/// negative), so that each is between 0 and 1 and they add up to 1.

#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

enum class DispersionLevel : std::uint8_t { record, imperfection, contact, chaos };
inline constexpr std::size_t dispersion_levels = 4;
const char* to_string(DispersionLevel level);

/// One run of the nested design.
struct NestedRun {
    std::uint32_t record = 0;
    std::uint32_t imperfection = 0; ///< identifies the structures of one record
    std::uint32_t contact = 0;      ///< identifies the contact parameters of one structure
    std::uint32_t stripe = 0;       ///< only runs of the same stripe are compared
    double response = 0;
};

struct DispersionShare {
    bool known = false;  ///< false where no two runs differ at this level: it is then part of the level above
    double variance = 0; ///< in the square of the response's unit
    Limits variance_limits;
    double share = 0; ///< of the total, in [0, 1]; NaN where all responses are equal
    Limits share_limits;

    /// Whether the runs say anything of the share: its interval is not the whole of [0, 1].
    bool determined() const { return share_limits.lower >= 0 && share_limits.upper <= 1; }
};

struct DispersionShares {
    std::size_t records = 0;
    double total = 0; ///< variance over records and all below
    Limits total_limits;
    std::array<DispersionShare, dispersion_levels> levels; ///< by DispersionLevel
    std::vector<std::string> says;
};

/// Intervals by the jackknife over records: for a variance Student's; for a share the set of Fieller ("Some problems in
/// interval estimation", Journal of the Royal Statistical Society B 16 (1954) 175), the shares s at which the level's
/// variance - s total is not significantly different from 0, cut to [0, 1]: a set keeps its coverage when what cannot
/// be true is cut from it. Unbounded where the whole of [0, 1] is in it.
///
/// @throws InputError with fewer than two records, a response that is not finite, or a level outside (0.5, 1)
DispersionShares dispersion_shares(std::span<const NestedRun> runs, double level = 0.95);

} // namespace stylobate
