#include "studies/measured/diagnosis/campaigns/proposals.hpp"

#include "ensemble/numerics/random.hpp"
#include "studies/measured/diagnosis/campaigns/conformal.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace stylobate {

namespace {

// Of the laws near the likest ones (`draw_near`), and by how much less in each further round.
constexpr double first_spread = 1.0 / 3, narrower = 0.5;
// Of the numbers of joints by which laws are found that are like the measured one.
constexpr double numbers_kept = 0.9;
// Of the draw that moves a size; those of the laws are others (`virtual_campaign.cpp`).
constexpr std::uint64_t size_draw = 1u << 17;

std::vector<double> from(const SimulatedCampaign& shown, const LawLikeness& likeness, const NumbersOf& numbers,
                         const std::vector<SimulatedCampaign>& rows)
{
    const std::vector<double> of = numbers(shown);
    std::vector<double> out;
    for (const SimulatedCampaign& row : rows)
        out.push_back(likeness.distance(of, numbers(row)));
    return out;
}

} // namespace

Proposals::Proposals(const EnsemblePlan& plan, const std::vector<CandidateCause>& causes,
                     const std::vector<StatisticLabel>& labels, const EvidenceRows& evidence,
                     const SimulatedCampaign& shown)
    : plan_(plan), causes_(causes), labels_(labels), evidence_(evidence), shown_(shown)
{
}

std::uint64_t Proposals::end_of_round(std::uint64_t number, const std::vector<SimulatedCampaign>& rows)
{
    const std::uint64_t common = plan_.total(causes_.size());
    if (number < common) {
        const std::uint64_t round = plan_.round(number);
        return round > plan_.rounds ? common : plan_.begin_of(round + 1);
    }
    std::uint64_t end = common;
    for (std::size_t k = 0; k < plan_.own.size(); ++k) {
        if (k == own_.size())
            own_.push_back(own_round(plan_.own[k], end, rows));
        end += own_[k].size();
        if (number < end)
            return end;
    }
    return end;
}

Proposal Proposals::of(std::uint64_t number, const std::vector<SimulatedCampaign>& rows)
{
    const std::uint64_t common = plan_.total(causes_.size());
    if (number >= common) {
        end_of_round(number, rows);
        std::uint64_t place = number - common;
        std::size_t k = 0;
        for (; place >= own_[k].size(); ++k)
            place -= own_[k].size();
        return own_[k][place];
    }
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
    return from(shown_, likeness_of(plan_, rows, of_joints, numbers_kept), of_joints, rows);
}

Proposals::Near Proposals::near(const std::vector<SimulatedCampaign>& rows) const
{
    const NumbersOf numbers_of = [this](const SimulatedCampaign& row) { return evidence_.all(row); };
    const LawLikeness likeness = evidence_.likeness(plan_, rows);
    Near out;
    out.distance = from(shown_, likeness, numbers_of, rows);

    std::vector<std::vector<double>> nulls;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::uint64_t i = plan_.scouts(); i < plan_.healthy(); ++i) {
        order.emplace_back(out.distance[i], nulls.size());
        nulls.push_back(numbers_of(rows[i]));
    }
    const std::vector<double> own = isolations(likeness, nulls, nearest_counted);
    std::sort(order.begin(), order.end());
    order.resize((order.size() + 1) / 2);
    for (const auto& [distance, null] : order)
        out.nulls.push_back(own[null]);

    std::vector<double> squares;
    for (std::uint64_t i = 0; i < plan_.pairs; ++i)
        squares.push_back(std::pow(likeness.distance(numbers_of(rows[i]), numbers_of(rows[plan_.wide + i])), 2));
    out.numbers = independent_numbers(squares);
    return out;
}

void Proposals::find_nearness(CampaignEnsemble& ensemble) const
{
    Near measured = near(ensemble.campaigns);
    NearnessEvidence& out = ensemble.nearness;
    out.nulls = std::move(measured.nulls);
    out.numbers = measured.numbers;
    out.distance.assign(causes_.size(), HUGE_VAL);
    for (const Nearness& n : nearness(ensemble.campaigns, measured.distance, causes_.size()))
        (n.cause < 0 ? out.healthy : out.distance[static_cast<std::size_t>(n.cause)]) = n.distance;
    ensemble.apart = std::move(measured.distance);
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

/// Near the nearest campaigns of each of the nearest causes, and of healthy ones; nothing where a healthy law gives the
/// measured campaign as well as nulls give each other.
/// @param begin first campaign of the round
std::vector<Proposal> Proposals::own_round(const OwnRound& round, std::uint64_t begin,
                                           const std::vector<SimulatedCampaign>& rows)
{
    const std::vector<SimulatedCampaign> before(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(begin));
    const Near measured = near(before);
    const std::vector<double>& distance = measured.distance;
    const auto nearest = nearness(before, distance, causes_.size());
    const auto healthy = std::find_if(nearest.begin(), nearest.end(), [](const Nearness& n) { return n.cause < 0; });
    std::vector<Proposal> out;
    if (conformal_p_value(measured.nulls, healthy->distance) > plan_.far)
        return out;
    const auto propose = [&](const Nearness& n) {
        if (n.rows.empty())
            return;
        for (std::uint64_t k = 0; k < round.of_each; ++k) {
            const std::uint64_t number = begin + out.size();
            const Proposal parent = of(n.rows[k % n.rows.size()], before);
            Proposal child = parent;
            child.law = draw_near(plan_.family, parent.law, round.spread, plan_.seed, number);
            if (parent.cause >= 0) {
                const CandidateCause& cause = causes_[static_cast<std::size_t>(parent.cause)];
                const double moved = to_normal(uniform01(plan_.seed, number, Stream::virtual_specimen, size_draw));
                child.z = std::clamp(parent.z * std::exp(round.size_spread * moved), cause.least, cause.most);
            }
            out.push_back(child);
        }
    };
    const auto parents = nearness(before, distance, causes_.size(), round.parents);
    std::uint64_t causes = 0;
    for (const Nearness& n : nearest) {
        if (n.cause >= 0 && causes++ >= round.causes)
            continue;
        propose(*std::find_if(parents.begin(), parents.end(), [&](const Nearness& p) { return p.cause == n.cause; }));
    }
    return out;
}

std::vector<Nearness> nearness(const std::vector<SimulatedCampaign>& rows, const std::vector<double>& distance,
                               std::size_t causes, std::size_t count)
{
    std::vector<Nearness> out(causes + 1);
    for (std::size_t c = 0; c < out.size(); ++c)
        out[c].cause = static_cast<int>(c) - 1;
    for (std::size_t i = 0; i < rows.size(); ++i)
        out[static_cast<std::size_t>(rows[i].cause + 1)].rows.push_back(i);
    for (Nearness& n : out) {
        std::stable_sort(n.rows.begin(), n.rows.end(),
                         [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
        n.rows.resize(std::min(n.rows.size(), count));
        if (!n.rows.empty())
            n.distance = std::accumulate(n.rows.begin(), n.rows.end(), 0.0,
                                         [&](double s, std::size_t i) { return s + distance[i]; }) /
                         static_cast<double>(n.rows.size());
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Nearness& a, const Nearness& b) { return a.distance < b.distance; });
    return out;
}

} // namespace stylobate
