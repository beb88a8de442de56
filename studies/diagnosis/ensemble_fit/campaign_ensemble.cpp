#include "studies/diagnosis/ensemble_fit/campaign_ensemble.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/diagnosis/statistics/balance_scores.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

namespace stylobate {

namespace {

/// Campaigns that are simulated together: many bundles with full lanes, and often enough a word on progress.
constexpr std::uint64_t together = 72;
// Of the laws near the likest ones (`draw_near`), and by how much less in each further round.
constexpr double first_spread = 1.0 / 3, narrower = 0.5;
// Of the numbers of joints by which laws are found that are like the measured one.
constexpr double numbers_kept = 0.9;

std::string line_of(const SimulatedCampaign& campaign)
{
    std::string text = fmt::format("{}\t{}\t{:.17g}", campaign.number, campaign.cause, campaign.z);
    for (const auto* values : {&campaign.numbers.descriptors, &campaign.numbers.values, &campaign.scores})
        for (const double value : *values)
            text += fmt::format("\t{:.17g}", value);
    return text;
}

/// How many numbers a row has of each kind.
struct RowShape {
    std::size_t descriptors, statistics, scores;
};

/// A line as above. False: it is none, or of another shape.
bool read_line(const std::string& line, const RowShape& shape, SimulatedCampaign& campaign)
{
    std::vector<double> numbers;
    std::stringstream in(line);
    for (std::string part; std::getline(in, part, '\t');) {
        char* end = nullptr;
        numbers.push_back(std::strtod(part.c_str(), &end));
        if (end == part.c_str() || *end != '\0')
            return false;
    }
    if (numbers.size() != 3 + shape.descriptors + shape.statistics + shape.scores)
        return false;
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
                   const std::vector<SizedCause>& known, const EnsemblePlan& plan, const CampaignStatistics& shown)
{
    std::string key = std::string(head) + campaign_key(measured, study, plan.seed) +
                      fmt::format(" {} {} {} {} {} {} {}", plan.wide, plan.pairs, plan.rounds, plan.of_each_round,
                                  plan.parents, plan.nulls, plan.of_each_cause);
    for (const ContactForm form : plan.family.forms)
        key += fmt::format(" form {}", static_cast<int>(form));
    for (const DampingKind kind : plan.family.kinds)
        key += fmt::format(" damping {}", to_string(kind));
    for (const CandidateCause& cause : causes)
        key += fmt::format(" {} {:.17g} {:g} {:g}", cause.cause.label(), cause.at_one, cause.least, cause.most);
    for (const SizedCause& cause : known)
        key += fmt::format(" {} {:.17g}", cause.cause.label(), cause.size);
    for (const auto* values : {&shown.descriptors, &shown.values}) // the parents' laws depend on them
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
    const std::vector<std::string> costs = ranks.of_all(fmt::format("{} {}", out.simulations, out.block_steps));
    out.simulations = out.block_steps = 0;
    for (const std::string& text : costs) {
        std::istringstream numbers(text);
        std::uint64_t simulations = 0, block_steps = 0;
        numbers >> simulations >> block_steps;
        out.simulations += simulations;
        out.block_steps += block_steps;
    }
}

/// The healthy laws of an ensemble, round by round nearer to the measured one.
class LikeLaws {
public:
    LikeLaws(const EnsemblePlan& plan, const std::vector<StatisticLabel>& labels, const CampaignStatistics& shown)
        : plan_(plan), labels_(labels), shown_(joint_numbers(labels, shown))
    {
    }

    /// @param rows all campaigns of the rounds before
    HealthyLaw of(std::uint64_t number, const std::vector<SimulatedCampaign>& rows)
    {
        if (number < plan_.wide)
            return draw_law(plan_.family, plan_.seed, number);
        if (number < plan_.scouts())
            return draw_law(plan_.family, plan_.seed, number - plan_.wide);
        const std::uint64_t round = plan_.round(number);
        while (parents_.size() < round)
            parents_.push_back(likest(parents_.size() + 1, rows));
        const double spread = first_spread * std::pow(narrower, static_cast<double>(round - 1));
        return draw_near(plan_.family, parents_[round - 1][plan_.parent(number)], spread, plan_.seed, number);
    }

    std::vector<double> distances(const std::vector<SimulatedCampaign>& rows) const
    {
        const LawLikeness likeness = likeness_of(plan_, labels_, rows, joint_numbers, numbers_kept);
        std::vector<double> out;
        for (const SimulatedCampaign& row : rows)
            out.push_back(likeness.distance(shown_, joint_numbers(labels_, row.numbers)));
        return out;
    }

private:
    /// The laws of those campaigns before a round that are nearest.
    std::vector<HealthyLaw> likest(std::uint64_t round, const std::vector<SimulatedCampaign>& rows)
    {
        const std::vector<double> distance = distances(rows);
        std::vector<std::pair<double, std::uint64_t>> order;
        for (std::uint64_t i = 0; i < plan_.begin_of(round); ++i)
            order.emplace_back(distance[i], i);
        std::sort(order.begin(), order.end());
        std::vector<HealthyLaw> laws;
        for (std::uint64_t i = 0; i < plan_.parents; ++i)
            laws.push_back(of(order[i % order.size()].second, rows));
        return laws;
    }

    const EnsemblePlan& plan_;
    const std::vector<StatisticLabel>& labels_;
    std::vector<double> shown_;
    std::vector<std::vector<HealthyLaw>> parents_; ///< [round - 1]
};

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

LawLikeness likeness_of(const EnsemblePlan& plan, const std::vector<StatisticLabel>& labels,
                        const std::vector<SimulatedCampaign>& rows, NumbersOf numbers, double kept)
{
    std::vector<std::pair<std::vector<double>, std::vector<double>>> pairs;
    for (std::uint64_t i = 0; i < plan.pairs; ++i)
        pairs.emplace_back(numbers(labels, rows[i].numbers), numbers(labels, rows[plan.wide + i].numbers));
    return {pairs, kept};
}

CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const std::vector<SizedCause>& known,
                                   const EnsemblePlan& plan, const CampaignStatistics& shown,
                                   const std::filesystem::path& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer)
{
    CampaignEnsemble out;
    const TrackScales scales = track_scales(measured);
    const std::vector<StatisticLabel> labels = statistic_labels(measured);
    const ScorePlan scored = score_plan(measured.specimen, scales);
    const std::uint64_t total = plan.total(causes.size());
    const std::string key = key_of(measured, study, causes, known, plan, shown);
    const RowShape shape{shown.descriptors.size(), labels.size(), scored.size()};
    std::string kept;
    if (options.leads() && !cache.empty()) {
        std::ifstream in(cache, std::ios::binary);
        kept.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::istringstream in(options.ranks ? options.ranks->of_first(kept) : std::move(kept));
    std::string text = key + "\n", line;
    if (std::getline(in, line) && line == key)
        for (SimulatedCampaign campaign;
             out.campaigns.size() < total && std::getline(in, line) && !in.eof() && // one without its end is cut
             read_line(line, shape, campaign) && campaign.number == out.campaigns.size();
             text += line + "\n")
            out.campaigns.push_back(campaign);
    out.cached = out.campaigns.size();
    LikeLaws laws(plan, labels, shown);
    const VirtualLaboratory laboratory(measured);
    progress(out.campaigns.size(), total);
    while (out.campaigns.size() < total) {
        const std::uint64_t first = out.campaigns.size(), round = plan.round(first);
        const std::uint64_t end = round > plan.rounds ? total : plan.begin_of(round + 1);
        const Portion portion(options.ranks, first, end);
        HealthyScatter scatter;
        std::vector<std::vector<SizedCause>> acting(portion.count, known);
        for (std::uint64_t i = 0; i < portion.count; ++i) {
            scatter.laws.push_back(laws.of(portion.first + i, out.campaigns));
            if (const auto [cause, z] = plan.label(causes, portion.first + i); cause >= 0) {
                const CandidateCause& candidate = causes[static_cast<std::size_t>(cause)];
                acting[i].push_back({candidate.cause, candidate.size_of(z)});
            }
        }
        const VirtualCampaigns made = virtual_campaigns(laboratory, study, plan.seed, portion.first, portion.count,
                                                        scatter, acting, options, observer);
        out.simulations += made.simulations;
        out.block_steps += made.block_steps;
        if (!all_agree(options.ranks, made.complete))
            return out;
        std::vector<SimulatedCampaign> rows(portion.count);
        tbb::task_arena(options.threads).execute([&] {
            tbb::parallel_for(std::uint64_t{0}, portion.count, [&](std::uint64_t i) {
                SimulatedCampaign& row = rows[i];
                row.number = portion.first + i;
                std::tie(row.cause, row.z) = plan.label(causes, portion.first + i);
                row.numbers = statistics_of(made.campaigns[i], scales, made.base_m);
                row.scores = balance_scores(fit_balance(made.campaigns[i], scales, made.base_m), scored);
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
        if (options.leads() && !cache.empty())
            write_whole(cache, text);
        progress(out.campaigns.size(), total);
    }
    if (options.ranks)
        add_costs(*options.ranks, out);
    out.distance = laws.distances(out.campaigns);
    out.complete = true;
    return out;
}

} // namespace stylobate
