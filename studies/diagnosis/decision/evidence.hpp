#pragma once
/// Evidence of the balance of forces of a campaign for each cause and for forces of unknown kind.

#include "ensemble/model/campaign.hpp"
#include "studies/diagnosis/laws/balance_fit.hpp"
#include "studies/diagnosis/laws/track.hpp"
#include "studies/diagnosis/tests/direct_tests.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// By which of three ways a cause is found.
enum class Channel {
    direct,    ///< base and sensors, while the lowest block rides on the table; blocks at rest
    forces,    ///< the balance of forces, compared with that of simulated campaigns
    statistics ///< statistics of the whole campaign, compared with simulated campaigns
};

/// The forces of a campaign.
struct BalanceEvidence {
    TrackScales scales;
    std::optional<BalanceFit> fit; ///< nothing where no joint slid or rocked long enough
    /// One for each mechanism and place, best first; possible ones, of sizes that a damaged specimen may have.
    std::vector<CauseFit> causes;
    /// The best fit of a size that no specimen may have: a drag that drives, a turning point outside its corner.
    std::optional<CauseFit> impossible;
    std::vector<StructureFit> structures; ///< most telling first
    std::string why_not;                  ///< where there is no fit
};

/// @param base_m (runs)(nt) the base displacement to be used; empty: not known
/// @param given causes that are taken as given: what is fitted is fitted beside them
BalanceEvidence balance_evidence(const Campaign& campaign, const TrackScales& scales,
                                 const std::vector<std::vector<double>>& base_m, const std::vector<Cause>& given = {});

/// Whether a specimen may have it: a possible fit, and no centre of mass farther aside than in any simulated campaign.
bool of_possible_size(const CauseFit& fit, const Specimen& specimen);

/// The best of each mechanism and place (over sides and second parameters), possible ones alone, best first.
std::vector<CauseFit> best_of_each(std::vector<CauseFit> fits);

/// Whether a gain is not that of one run alone: without the best run this part of it is left.
bool not_by_one_run(double gain, const std::vector<double>& gain_by_run, double part);

} // namespace stylobate
