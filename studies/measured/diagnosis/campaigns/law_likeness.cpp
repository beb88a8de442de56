#include "studies/measured/diagnosis/campaigns/law_likeness.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

constexpr double far = 10;             // a larger distance of one number counts as this one
constexpr std::size_t least_pairs = 6; // that have a number

std::vector<double> with_descriptors(const CampaignStatistics& campaign, const std::vector<double>& others)
{
    std::vector<double> numbers = campaign.descriptors;
    numbers.insert(numbers.end(), others.begin(), others.end());
    return numbers;
}

double nearest_mean(std::vector<double> distances, std::size_t count)
{
    std::sort(distances.begin(), distances.end());
    distances.resize(std::min(distances.size(), count));
    return std::accumulate(distances.begin(), distances.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(distances.size(), 1));
}

} // namespace

std::vector<double> law_numbers(const std::vector<StatisticLabel>& labels, const CampaignStatistics& campaign)
{
    return with_descriptors(campaign, medians(over_joints(labels), campaign.values));
}

std::vector<double> joint_numbers(const std::vector<StatisticLabel>& labels, const CampaignStatistics& campaign)
{
    return with_descriptors(campaign, means(over_motions(labels), campaign.values));
}

LawLikeness::LawLikeness(const std::vector<std::pair<std::vector<double>, std::vector<double>>>& pairs, double kept,
                         const std::vector<double>& least)
    : kept_(kept)
{
    const std::size_t count = pairs.empty() ? 0 : pairs.front().first.size();
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<double> apart;
        for (const auto& [one, other] : pairs)
            if (const double d = std::fabs(one[k] - other[k]); std::isfinite(d))
                apart.push_back(d);
        // of a difference of two
        scatter_.push_back(apart.size() < least_pairs ? 0 : 1.4826 * upper_median(std::move(apart)) / std::sqrt(2.0));
        if (!least.empty())
            scatter_.back() = std::max(scatter_.back(), least[k]);
    }
}

double LawLikeness::distance(const std::vector<double>& of, const std::vector<double>& other) const
{
    std::vector<double> squares;
    for (std::size_t k = 0; k < scatter_.size(); ++k) {
        if (!std::isfinite(of[k]) || !(scatter_[k] > 0))
            continue;
        const double apart = std::isfinite(other[k]) ? std::fabs(of[k] - other[k]) / scatter_[k] : far;
        squares.push_back(std::pow(std::min(apart, far), 2));
    }
    if (squares.empty())
        return 0;
    std::sort(squares.begin(), squares.end());
    squares.resize(static_cast<std::size_t>(std::ceil(kept_ * static_cast<double>(squares.size()))));
    double sum = 0;
    for (const double square : squares)
        sum += square;
    return std::sqrt(sum / static_cast<double>(squares.size()));
}

double isolation(const LawLikeness& likeness, const std::vector<double>& of,
                 const std::vector<std::vector<double>>& others, std::size_t neighbours)
{
    std::vector<double> distance;
    for (const std::vector<double>& other : others)
        distance.push_back(likeness.distance(of, other));
    return nearest_mean(std::move(distance), neighbours);
}

std::vector<double> isolations(const LawLikeness& likeness, const std::vector<std::vector<double>>& campaigns,
                               std::size_t neighbours)
{
    std::vector<double> out;
    for (std::size_t own = 0; own < campaigns.size(); ++own) {
        std::vector<double> distance;
        for (std::size_t i = 0; i < campaigns.size(); ++i)
            if (i != own)
                distance.push_back(likeness.distance(campaigns[own], campaigns[i]));
        out.push_back(nearest_mean(std::move(distance), neighbours));
    }
    return out;
}

double isolation_p_value(const LawLikeness& likeness, const std::vector<std::vector<double>>& nulls,
                         const std::vector<double>& law)
{
    constexpr std::size_t neighbours = 12;
    return conformal_p_value(isolations(likeness, nulls, neighbours), isolation(likeness, law, nulls, neighbours));
}

} // namespace stylobate
