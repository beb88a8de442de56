#include "studies/measured/diagnosis/campaigns/nearest_cause.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/campaigns/conformal.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace stylobate {

NearestCause nearest_cause(const NearnessEvidence& evidence, std::size_t rivals, const NearnessRule& rule)
{
    NearestCause out;
    std::map<int, double> nearest; // of each mechanism
    for (std::size_t c = 0; c < evidence.distance.size(); ++c) {
        const double d = evidence.distance[c];
        if (!std::isfinite(d))
            continue;
        if (out.best < 0 || d < evidence.distance[static_cast<std::size_t>(out.best)])
            out.best = static_cast<int>(c);
        const auto [at, fresh] = nearest.try_emplace(evidence.mechanism[c], d);
        at->second = std::min(at->second, d);
    }
    out.healthy_p = conformal_p_value(evidence.nulls, evidence.healthy);
    if (out.best < 0)
        return out;
    const auto best = static_cast<std::size_t>(out.best);
    const double least = evidence.distance[best];
    const auto apart = [&](double distance) { return evidence.numbers * std::log(distance / least); };
    out.gain = apart(evidence.healthy);
    out.named =
        out.healthy_p <= rule.far && least <= rule.nearer * evidence.healthy && evidence.gain_p_value <= rule.likely;

    double sum = std::exp(-out.gain);
    std::vector<std::pair<double, int>> others;
    for (const auto& [mechanism, distance] : nearest) {
        sum += std::exp(-apart(distance));
        if (mechanism != evidence.mechanism[best] && distance <= rule.rivals * least)
            others.emplace_back(distance, mechanism);
    }
    out.probability = out.set_probability = 1 / sum;
    std::sort(others.begin(), others.end());
    for (const auto& [distance, mechanism] : others) {
        if (out.set.size() < rivals)
            out.set_probability += std::exp(-apart(distance)) / sum;
        out.set.push_back(mechanism);
    }
    return out;
}

void name_nearest(const NearestCause& nearest, const std::vector<int>& mechanism, EnsembleVerdict& verdict)
{
    const auto of = [&](int candidate) { return mechanism[static_cast<std::size_t>(candidate)]; };
    if (of(verdict.best) != of(nearest.best) || verdict.probability < nearest.probability) {
        verdict.probability = nearest.probability;
        verdict.set = nearest.set;
        verdict.set_probability = nearest.set_probability;
    }
    verdict.best = nearest.best;
    verdict.p_value = nearest.healthy_p;
    verdict.named = true;
    verdict.second = -1;
    verdict.contrasts = verdict.unexplained = false;
}

bool nearer_than_healthy(const NearnessEvidence& evidence, int mechanism, const NearnessRule& rule)
{
    for (std::size_t c = 0; c < evidence.distance.size(); ++c)
        if (evidence.mechanism[c] == mechanism && evidence.distance[c] < rule.hardly * evidence.healthy)
            return true;
    return false;
}

double independent_numbers(const std::vector<double>& squares)
{
    constexpr double least = 4, most = 40; // a few pairs show it badly
    std::vector<double> logarithms;
    for (const double s : squares)
        logarithms.push_back(std::log(s));
    const double middle = upper_median(logarithms);
    for (double& l : logarithms)
        l = std::fabs(l - middle);
    const double sd = 1.4826 * upper_median(std::move(logarithms));
    return std::clamp(2 / (sd * sd), least, most);
}

} // namespace stylobate
