#include "studies/diagnosis/decision/evidence.hpp"

#include "studies/diagnosis/statistics/balance_scores.hpp"

#include <algorithm>
#include <set>

namespace stylobate {

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

} // namespace stylobate
