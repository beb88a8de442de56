#include "studies/measured/diagnosis/campaigns/campaign_ensemble.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/measured/diagnosis/campaigns/conformal.hpp"
#include "studies/measured/diagnosis/campaigns/evidence_rows.hpp"
#include "studies/measured/diagnosis/campaigns/number_rows.hpp"
#include "studies/measured/diagnosis/campaigns/proposals.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>
#include <string_view>

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

LawLikeness::LawLikeness(const std::vector<std::pair<std::vector<double>, std::vector<double>>>& pairs, double kept)
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

namespace {

/// Campaigns that are simulated together: many bundles with full lanes, and often enough a word on progress.
constexpr std::uint64_t together = 72;

std::string line_of(const SimulatedCampaign& campaign)
{
    std::vector<double> row = {static_cast<double>(campaign.number), static_cast<double>(campaign.cause), campaign.z};
    for (const auto* values : {&campaign.numbers.descriptors, &campaign.numbers.values, &campaign.scores})
        row.insert(row.end(), values->begin(), values->end());
    return number_row(row);
}

/// How many numbers a row has of each kind.
struct RowShape {
    std::size_t descriptors, statistics, scores;
};

/// A line as above. False: it is none, or of another shape.
bool read_line(const std::string& line, const RowShape& shape, SimulatedCampaign& campaign)
{
    const std::optional<std::vector<double>> row = numbers_of_row(line);
    if (!row || row->size() != 3 + shape.descriptors + shape.statistics + shape.scores)
        return false;
    const std::vector<double>& numbers = *row;
    campaign.number = static_cast<std::uint64_t>(numbers[0]);
    campaign.cause = static_cast<int>(numbers[1]);
    campaign.z = numbers[2];
    const auto statistics = numbers.begin() + 3 + static_cast<std::ptrdiff_t>(shape.descriptors);
    const auto scores = statistics + static_cast<std::ptrdiff_t>(shape.statistics);
    campaign.numbers.descriptors.assign(numbers.begin() + 3, statistics);
    campaign.numbers.values.assign(statistics, scores);
    campaign.scores.assign(scores, numbers.end());
    return true;
}

constexpr std::string_view head = "# stylobate simulated campaigns ";

/// What a file of rows is of: another campaign, plan or version has another key.
std::string key_of(const Campaign& measured, const Study& study, const std::vector<CandidateCause>& causes,
                   const std::vector<SizedCause>& known, const EnsemblePlan& plan, const SimulatedCampaign& shown)
{
    std::string key = std::string(head) + campaign_key(measured, study, plan.seed) +
                      fmt::format(" {} {} {} {} {} {} {}", plan.wide, plan.pairs, plan.rounds, plan.of_each_round,
                                  plan.parents, plan.nulls, plan.of_each_cause);
    for (const ContactForm form : plan.family.forms)
        key += fmt::format(" form {}", static_cast<int>(form));
    for (const DampingKind kind : plan.family.kinds)
        key += fmt::format(" damping {}", to_string(kind));
    for (const CandidateCause& cause : causes)
        key += fmt::format(" {} {:.17g} {:.17g} {:g} {:g}", cause.cause.label(), cause.cause.fixed, cause.at_one,
                           cause.least, cause.most);
    for (const SizedCause& cause : known)
        key += fmt::format(" {} {:.17g}", cause.cause.label(), cause.size);
    for (const auto* values :
         {&shown.numbers.descriptors, &shown.numbers.values, &shown.scores}) // proposals depend on them
        for (const double value : *values)
            key += fmt::format(" {:.17g}", value);
    return key;
}

/// The campaigns that are simulated next, and by several processes those of them that this one simulates.
struct Portion {
    /// @param ranks null: this process is alone
    Portion(const Ranks* ranks, std::uint64_t begin, std::uint64_t end)
    {
        const std::uint64_t rank = ranks ? static_cast<std::uint64_t>(ranks->rank()) : 0;
        const std::uint64_t size = ranks ? static_cast<std::uint64_t>(ranks->size()) : 1;
        const std::uint64_t all = std::min(together * size, end - begin);
        first = begin + all * rank / size;
        count = begin + all * (rank + 1) / size - first;
    }
    std::uint64_t first = 0, count = 0;
};

/// Gives every rank what each has simulated.
/// @param lines of this one; afterwards of all
std::vector<SimulatedCampaign> of_all_ranks(Ranks& ranks, std::string& lines, const RowShape& shape)
{
    std::vector<SimulatedCampaign> rows;
    std::string all;
    for (const std::string& text : ranks.of_all(lines)) {
        all += text;
        std::istringstream in(text);
        SimulatedCampaign campaign;
        for (std::string line; std::getline(in, line);)
            if (read_line(line, shape, campaign))
                rows.push_back(campaign);
    }
    lines = std::move(all);
    return rows;
}

/// Makes the cost that of all ranks.
void add_costs(Ranks& ranks, CampaignEnsemble& out)
{
    const std::vector<std::string> costs =
        ranks.of_all(fmt::format("{} {}", out.cost.simulations, out.cost.block_steps));
    out.cost = {};
    for (const std::string& text : costs) {
        std::istringstream numbers(text);
        SimulationCount cost;
        numbers >> cost.simulations >> cost.block_steps;
        out.cost += cost;
    }
}

} // namespace

EnsemblePlan EnsemblePlan::with(std::uint64_t nulls)
{
    const EnsemblePlan all;
    const auto part = [&](std::uint64_t of, std::uint64_t least) { return std::max(of * nulls / all.nulls, least); };
    EnsemblePlan plan;
    plan.wide = part(all.wide, 24);
    plan.pairs = std::min(part(all.pairs, 12), plan.wide);
    plan.of_each_round = part(all.of_each_round, 12);
    plan.of_each_cause = part(all.of_each_cause, 3);
    plan.nulls = nulls;
    return plan;
}

std::uint64_t EnsemblePlan::round(std::uint64_t number) const
{
    return number < scouts()
               ? 0
               : std::min(1 + (number - scouts()) / std::max<std::uint64_t>(of_each_round, 1), rounds + 1);
}

std::uint64_t EnsemblePlan::begin_of(std::uint64_t round) const
{
    return round == 0 ? 0 : scouts() + (round - 1) * of_each_round;
}

std::pair<int, double> EnsemblePlan::label(const std::vector<CandidateCause>& causes, std::uint64_t number) const
{
    if (number < healthy())
        return {-1, 0};
    const std::uint64_t k = number - healthy();
    const auto cause = static_cast<std::size_t>(k % causes.size());
    const std::uint64_t place = k / causes.size();
    const CandidateCause& c = causes[cause];
    // from weak to strong, each side where there are two; the neutral size is that of the nulls
    const std::uint64_t sides = c.least < 0 ? 2 : 1, of_a_side = (of_each_cause + sides - 1) / sides;
    const std::uint64_t rank = place / sides + 1;
    const double part = static_cast<double>(rank) / static_cast<double>(of_a_side);
    return {static_cast<int>(cause), (place % sides == 0 ? c.most : c.least) * part};
}

void refuse_foreign_cache(const std::filesystem::path& cache)
{
    std::ifstream in(cache);
    std::string line;
    std::getline(in, line);
    // (of one that was cut there may be a part of the first line)
    if (!line.empty() && !line.starts_with(head) && !head.starts_with(line))
        throw InputError(cache.string(), 1,
                         "keeps no simulated campaigns of a diagnosis, and nothing was written.\n  Remove it, or name "
                         "another output.");
}

LawLikeness likeness_of(const EnsemblePlan& plan, const std::vector<SimulatedCampaign>& rows, const NumbersOf& numbers,
                        double kept)
{
    std::vector<std::pair<std::vector<double>, std::vector<double>>> pairs;
    for (std::uint64_t i = 0; i < plan.pairs; ++i)
        pairs.emplace_back(numbers(rows[i]), numbers(rows[plan.wide + i]));
    return {pairs, kept};
}

CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const std::vector<SizedCause>& known,
                                   const EnsemblePlan& plan, const SimulatedCampaign& shown,
                                   const std::optional<std::filesystem::path>& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer)
{
    CampaignEnsemble out;
    const CampaignScales scales = campaign_scales(measured);
    const std::vector<StatisticLabel> labels = statistic_labels(measured);
    const ScorePlan scored = score_plan(measured.specimen, scales);
    const std::string key = key_of(measured, study, causes, known, plan, shown);
    const RowShape shape{shown.numbers.descriptors.size(), labels.size(), scored.size()};
    std::string kept;
    if (options.leads() && cache) {
        std::ifstream in(*cache, std::ios::binary);
        kept.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::istringstream in(options.ranks ? options.ranks->of_first(kept) : std::move(kept));
    std::string text = key + "\n", line;
    if (std::getline(in, line) && line == key)
        for (SimulatedCampaign campaign; std::getline(in, line) && !in.eof() && // one without its end is cut
                                         read_line(line, shape, campaign) && campaign.number == out.campaigns.size();
             text += line + "\n")
            out.campaigns.push_back(campaign);
    out.cached = out.campaigns.size();
    Proposals proposals(plan, causes, labels, shown);
    const VirtualLaboratory laboratory(measured);
    for (;;) {
        const std::uint64_t first = out.campaigns.size(), end = proposals.end_of_round(first);
        progress(first, plan.total(causes.size()));
        if (first >= end)
            break;
        const Portion portion(options.ranks, first, end);
        HealthyScatter scatter;
        scatter.placed_as_seen = true;
        std::vector<std::vector<SizedCause>> acting(portion.count, known);
        std::vector<SimulatedCampaign> rows(portion.count);
        for (std::uint64_t i = 0; i < portion.count; ++i) {
            const Proposal proposal = proposals.of(portion.first + i, out.campaigns);
            scatter.laws.push_back(proposal.law);
            rows[i].number = portion.first + i;
            rows[i].cause = proposal.cause;
            rows[i].z = proposal.z;
            if (proposal.cause >= 0) {
                const CandidateCause& candidate = causes[static_cast<std::size_t>(proposal.cause)];
                acting[i].push_back({candidate.cause, candidate.size_of(proposal.z)});
            }
        }
        const VirtualCampaigns made = virtual_campaigns(laboratory, study, plan.seed, portion.first, portion.count,
                                                        scatter, acting, options, observer);
        out.cost += made.cost;
        if (!all_agree(options.ranks, made.complete))
            return out;
        tbb::task_arena(options.threads).execute([&] {
            in_parallel(std::uint64_t{0}, portion.count, [&](std::uint64_t i) {
                rows[i].numbers = statistics_of(made.campaigns[i], scales, made.base_m);
                rows[i].scores = balance_scores(fit_balance(made.campaigns[i], scales, made.base_m), scored);
            });
        });
        std::string lines;
        for (const SimulatedCampaign& row : rows)
            lines += line_of(row) + "\n";
        if (options.ranks)
            rows = of_all_ranks(*options.ranks, lines, shape);
        for (SimulatedCampaign& row : rows)
            out.campaigns.push_back(std::move(row));
        text += lines;
        if (options.leads() && cache)
            write_whole(*cache, text);
    }
    if (options.ranks)
        add_costs(*options.ranks, out);
    out.distance = proposals.law_distances(out.campaigns);
    out.complete = true;
    return out;
}

} // namespace stylobate
