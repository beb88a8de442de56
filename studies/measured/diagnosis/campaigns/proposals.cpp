#include "studies/measured/diagnosis/campaigns/proposals.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace stylobate {

namespace {

// Of the laws near the likest ones (`draw_near`), and by how much less in each further round.
constexpr double first_spread = 1.0 / 3, narrower = 0.5;
// Of the numbers of joints by which laws are found that are like the measured one.
constexpr double numbers_kept = 0.9;

} // namespace

Proposals::Proposals(const EnsemblePlan& plan, const std::vector<CandidateCause>& causes,
                     const std::vector<StatisticLabel>& labels, const SimulatedCampaign& shown)
    : plan_(plan), causes_(causes), labels_(labels), shown_(shown)
{
}

std::uint64_t Proposals::end_of_round(std::uint64_t number) const
{
    const std::uint64_t all = plan_.total(causes_.size()), round = plan_.round(number);
    return number >= all || round > plan_.rounds ? all : plan_.begin_of(round + 1);
}

Proposal Proposals::of(std::uint64_t number, const std::vector<SimulatedCampaign>& rows)
{
    Proposal out;
    std::tie(out.cause, out.z) = plan_.label(causes_, number);
    if (number < plan_.scouts()) {
        out.law = draw_law(plan_.family, plan_.seed, number < plan_.wide ? number : number - plan_.wide);
        return out;
    }
    const std::uint64_t round = plan_.round(number);
    while (parents_.size() < round)
        parents_.push_back(likest(parents_.size() + 1, rows));
    const double spread = first_spread * std::pow(narrower, static_cast<double>(round - 1));
    out.law = draw_near(plan_.family, parents_[round - 1][plan_.parent(number)], spread, plan_.seed, number);
    return out;
}

std::vector<double> Proposals::law_distances(const std::vector<SimulatedCampaign>& rows) const
{
    const NumbersOf of_joints = [this](const SimulatedCampaign& row) { return joint_numbers(labels_, row.numbers); };
    const LawLikeness likeness = likeness_of(plan_, rows, of_joints, numbers_kept);
    const std::vector<double> shown = of_joints(shown_);
    std::vector<double> out;
    for (const SimulatedCampaign& row : rows)
        out.push_back(likeness.distance(shown, of_joints(row)));
    return out;
}

/// The laws of those healthy campaigns before a round that are nearest.
std::vector<HealthyLaw> Proposals::likest(std::uint64_t round, const std::vector<SimulatedCampaign>& rows)
{
    const std::vector<double> distance = law_distances(rows);
    std::vector<std::pair<double, std::uint64_t>> order;
    for (std::uint64_t i = 0; i < plan_.begin_of(round); ++i)
        order.emplace_back(distance[i], i);
    std::sort(order.begin(), order.end());
    std::vector<HealthyLaw> laws;
    for (std::uint64_t i = 0; i < plan_.parents; ++i)
        laws.push_back(of(order[i % order.size()].second, rows).law);
    return laws;
}

} // namespace stylobate
