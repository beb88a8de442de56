#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace stylobate {

namespace {

/// A centre of mass farther aside than in any simulated campaign, by two standard deviations: no block of one stone has
/// it, and a sideways force looks like it.
bool too_eccentric(const CauseFit& fit, const Specimen& specimen)
{
    return fit.cause.mechanism == "eccentricity" &&
           std::fabs(fit.size) - 2 * fit.sd >
               largest_eccentricity * 2 * specimen.half_width_m[static_cast<std::size_t>(fit.cause.block)];
}

} // namespace

bool of_possible_size(const CauseFit& fit, const Specimen& specimen)
{
    return possible(fit) && !too_eccentric(fit, specimen);
}

bool not_by_one_run(double gain, const std::vector<double>& gain_by_run, double part)
{
    return gain_by_run.size() > 1 && gain - *std::max_element(gain_by_run.begin(), gain_by_run.end()) > part * gain;
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

BalanceEvidence balance_evidence(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m, const std::vector<Cause>& given)
{
    BalanceEvidence out;
    out.fit = fit_balance(campaign, scales, base_m);
    if (!out.fit) {
        out.why_not = "No joint with known forces slid or rocked long enough.";
        return out;
    }
    std::vector<CauseFit> fits;
    for (const Cause& cause : balance_causes(campaign.specimen, scales)) {
        CauseFit fit = out.fit->fit(cause, given);
        if (of_possible_size(fit, campaign.specimen))
            fits.push_back(std::move(fit));
        else if (std::isfinite(fit.gain) && fit.gain > (out.impossible ? out.impossible->gain : 0))
            out.impossible = std::move(fit);
    }
    out.causes = best_of_each(std::move(fits));
    out.structures = out.fit->describe(given);
    return out;
}

ScorePlan score_plan(const Specimen& specimen, const CampaignScales& scales)
{
    return {balance_causes(specimen, scales), balance_structures(specimen)};
}

std::optional<BalanceFit> fit_balance(const Campaign& campaign, const CampaignScales& scales,
                                      const std::vector<std::vector<double>>& base_m)
{
    const double friction = nominal_friction(campaign.specimen);
    std::vector<LawSample> all;
    for (const std::vector<LawSample>& run : law_samples(campaign, scales, base_m, friction))
        all.insert(all.end(), run.begin(), run.end());
    if (all.empty())
        return std::nullopt;
    return BalanceFit(campaign.specimen, std::move(all), friction, static_cast<int>(campaign.runs.size()));
}

std::vector<double> balance_scores(const std::optional<BalanceFit>& fit, const ScorePlan& plan)
{
    if (!fit)
        return std::vector<double>(plan.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<double> scores;
    for (const Cause& cause : plan.causes)
        scores.push_back(fit->score(cause));
    for (const Structure& structure : plan.structures)
        scores.push_back(fit->score(structure));
    return scores;
}

} // namespace stylobate
