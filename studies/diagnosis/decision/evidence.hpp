#pragma once
/// Evidence of a campaign for each cause, by every method, and the same for null campaigns (without a hidden effect).

#include "ensemble/model/campaign.hpp"
#include "studies/diagnosis/laws/balance_fit.hpp"
#include "studies/diagnosis/laws/track.hpp"
#include "studies/diagnosis/tests/direct_tests.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Ways of looking. Each has its own chance gains.
enum class Channel {
    direct,    ///< base and sensors, while the lowest block rides on the table; blocks at rest
    balance,   ///< the laws of the joints, from the balance of forces
    windows,   ///< free windows of the simulation
    statistics ///< statistics of the whole campaign, compared with simulated campaigns
};
const char* to_string(Channel channel);

/// The forces of a campaign.
struct BalanceEvidence {
    TrackScales scales;
    std::optional<BalanceFit> fit;        ///< nothing where no joint slid or rocked long enough
    std::vector<CauseFit> causes;         ///< one for each mechanism and place, physically possible ones, best first
    std::vector<StructureFit> structures; ///< most telling first
    std::string why_not;                  ///< where there is no fit
};

/// @param base_m (runs)(nt) the base displacement to be used; empty: not known
/// @param given causes that are taken as given: what is fitted is fitted beside them
BalanceEvidence balance_evidence(const Campaign& campaign, const TrackScales& scales,
                                 const std::vector<std::vector<double>>& base_m, const std::vector<Cause>& given = {});

/// The best of each mechanism and place (over sides and second parameters), possible ones alone, best first.
std::vector<CauseFit> best_of_each(std::vector<CauseFit> fits);

/// Gains that campaigns with nothing hidden give.
class ChanceGains {
public:
    /// Takes the largest gain of each mechanism in one campaign; a mechanism that it does not name had 0.
    void add(Channel channel, const std::vector<CauseFit>& fits);
    /// The most telling structure of one campaign.
    void add(const std::vector<StructureFit>& structures);

    /// How many were taken, also those that name no mechanism.
    std::size_t campaigns(Channel channel) const;
    /// Whether any campaign names the mechanism. Where none does, it may be that it cannot show in them (nothing
    /// slides), so that they do not contribute to its null distribution.
    bool tell_of(Channel channel, const std::string& mechanism) const;
    /// 95 % quantile; 0 where no campaign informs about the mechanism.
    double quantile95(Channel channel, const std::string& mechanism) const;
    double quantile95_of_structures() const;
    /// Probability of a gain at least as large by chance: the share of the campaigns, beyond their upper tenth
    /// continued exponentially with its mean excess (at least 1 nat: chi square's tail).
    double probability(Channel channel, const std::string& mechanism, double gain) const;
    double probability_of_structure(double gain) const;

    /// (campaigns) gains by channel and mechanism, for storing; "structure" is the mechanism of structures.
    const std::map<std::pair<Channel, std::string>, std::vector<double>>& gains() const { return gains_; }
    void set(Channel channel, const std::string& mechanism, std::vector<double> gains);

private:
    const std::vector<double>& of(Channel channel, const std::string& mechanism) const;
    std::map<std::pair<Channel, std::string>, std::vector<double>> gains_;
    std::map<Channel, std::size_t> campaigns_;
};

} // namespace stylobate
