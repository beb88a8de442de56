#include "studies/diagnosis/decision/evidence.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/diagnosis/statistics/balance_scores.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace stylobate {

namespace {

// Under which name the gains of structures are kept.
constexpr const char* structure = "structure";
// Fewer campaigns do not show what one in twenty does: more than the most that they gave is asked for.
constexpr std::size_t enough_campaigns = 20;
constexpr double few_factor = 1.5;
// Of a tail that is continued beyond the campaigns there are.
constexpr double least_excess = 1;

} // namespace

const char* to_string(Channel channel)
{
    switch (channel) {
    case Channel::direct:
        return "direct";
    case Channel::balance:
        return "balance";
    case Channel::windows:
        return "windows";
    case Channel::statistics:
        return "statistics";
    }
    return "";
}

std::vector<CauseFit> best_of_each(std::vector<CauseFit> fits)
{
    std::erase_if(fits, [](const CauseFit& fit) { return !possible(fit); });
    std::stable_sort(fits.begin(), fits.end(), [](const CauseFit& a, const CauseFit& b) { return a.gain > b.gain; });
    std::set<std::pair<std::string, std::string>> seen;
    std::erase_if(fits,
                  [&](const CauseFit& fit) { return !seen.emplace(fit.cause.mechanism, fit.cause.place).second; });
    return fits;
}

BalanceEvidence balance_evidence(const Campaign& campaign, const TrackScales& scales,
                                 const std::vector<std::vector<double>>& base_m, const std::vector<Cause>& given)
{
    BalanceEvidence out;
    out.scales = scales;
    out.fit = fit_balance(campaign, scales, base_m);
    if (!out.fit) {
        out.why_not = "No joint with known forces slid or rocked long enough.";
        return out;
    }
    std::vector<CauseFit> fits;
    for (const Cause& cause : balance_causes(campaign.specimen, scales))
        fits.push_back(out.fit->fit(cause, given));
    out.causes = best_of_each(std::move(fits));
    out.structures = out.fit->describe(given);
    return out;
}

void ChanceGains::add(Channel channel, const std::vector<CauseFit>& fits)
{
    std::map<std::string, double> most;
    for (const CauseFit& fit : fits)
        most[fit.cause.mechanism] = std::max(most[fit.cause.mechanism], fit.gain);
    // one that this campaign does not name, or those before it did not, had 0 there
    const std::size_t before = campaigns_[channel]++;
    for (const auto& [mechanism, gain] : most)
        gains_[{channel, mechanism}].resize(before, 0);
    for (auto& [key, gains] : gains_)
        if (key.first == channel && key.second != structure) {
            const auto found = most.find(key.second);
            gains.push_back(found == most.end() ? 0 : found->second);
        }
}

void ChanceGains::add(const std::vector<StructureFit>& structures)
{
    gains_[{Channel::balance, structure}].push_back(structures.empty() ? 0 : structures.front().gain);
}

std::size_t ChanceGains::campaigns(Channel channel) const
{
    const auto found = campaigns_.find(channel);
    return found == campaigns_.end() ? 0 : found->second;
}

bool ChanceGains::tell_of(Channel channel, const std::string& mechanism) const
{
    return gains_.contains({channel, mechanism});
}

const std::vector<double>& ChanceGains::of(Channel channel, const std::string& mechanism) const
{
    static const std::vector<double> nothing;
    const auto found = gains_.find({channel, mechanism});
    return found == gains_.end() ? nothing : found->second;
}

double ChanceGains::quantile95(Channel channel, const std::string& mechanism) const
{
    std::vector<double> gains = of(channel, mechanism);
    if (gains.empty())
        return 0;
    std::sort(gains.begin(), gains.end());
    if (gains.size() < enough_campaigns)
        return few_factor * gains.back() + 1;
    return sorted_quantile(gains, 0.95, QuantileDefinition::linear);
}

double ChanceGains::quantile95_of_structures() const
{
    return quantile95(Channel::balance, structure);
}

double ChanceGains::probability(Channel channel, const std::string& mechanism, double gain) const
{
    std::vector<double> gains = of(channel, mechanism);
    const auto n = static_cast<double>(gains.size());
    if (gains.empty())
        return 1;
    std::sort(gains.begin(), gains.end());
    const auto tail = static_cast<std::size_t>(0.9 * n);
    const double from = gains[std::min(tail, gains.size() - 1)];
    if (gain <= from) {
        const auto above = gains.end() - std::lower_bound(gains.begin(), gains.end(), gain);
        return (static_cast<double>(above) + 1) / (n + 1);
    }
    double excess = 0;
    for (std::size_t k = tail; k < gains.size(); ++k)
        excess += gains[k] - from;
    excess /= static_cast<double>(gains.size() - tail);
    const double share = (static_cast<double>(gains.size() - tail) + 1) / (n + 1);
    return share * std::exp(-(gain - from) / std::max(excess, least_excess));
}

double ChanceGains::probability_of_structure(double gain) const
{
    return probability(Channel::balance, structure, gain);
}

void ChanceGains::set(Channel channel, const std::string& mechanism, std::vector<double> gains)
{
    if (mechanism != structure)
        campaigns_[channel] = std::max(campaigns_[channel], gains.size());
    gains_[{channel, mechanism}] = std::move(gains);
}

} // namespace stylobate
