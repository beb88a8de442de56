#include "studies/diagnosis/ensemble_fit/campaign_ensemble.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/atomic_file.hpp"
#include "studies/diagnosis/statistics/campaign_statistics.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace stylobate {

namespace {

/// Campaigns that are simulated together: many bundles with full lanes, and often enough a word on progress.
constexpr std::uint64_t together = 32;

std::string line_of(const SimulatedCampaign& campaign)
{
    std::string text = fmt::format("{}\t{}\t{:.17g}", campaign.number, campaign.cause, campaign.z);
    for (const double value : campaign.descriptors)
        text += fmt::format("\t{:.17g}", value);
    for (const double value : campaign.statistics)
        text += fmt::format("\t{:.17g}", value);
    return text;
}

/// A line as above. False: it is none, or of another shape.
bool read_line(const std::string& line, std::size_t descriptors, std::size_t statistics, SimulatedCampaign& campaign)
{
    std::vector<double> numbers;
    std::stringstream in(line);
    for (std::string part; std::getline(in, part, '\t');) {
        char* end = nullptr;
        numbers.push_back(std::strtod(part.c_str(), &end));
        if (end == part.c_str() || *end != '\0')
            return false;
    }
    if (numbers.size() != 3 + descriptors + statistics)
        return false;
    campaign.number = static_cast<std::uint64_t>(numbers[0]);
    campaign.cause = static_cast<int>(numbers[1]);
    campaign.z = numbers[2];
    const auto middle = numbers.begin() + 3 + static_cast<std::ptrdiff_t>(descriptors);
    campaign.descriptors.assign(numbers.begin() + 3, middle);
    campaign.statistics.assign(middle, numbers.end());
    return true;
}

/// What a file of rows is of: another campaign, plan or version has another key.
std::string key_of(const Campaign& measured, const Study& study, const std::vector<CandidateCause>& causes,
                   const EnsemblePlan& plan, const std::vector<double>& shown)
{
    std::string key = "# stylobate simulated campaigns " + campaign_key(measured, study, plan.seed) +
                      fmt::format(" {} {} {} {}", plan.scouts, plan.parents, plan.nulls, plan.of_each_cause);
    for (const CandidateCause& cause : causes)
        key += fmt::format(" {} {:.17g}", cause.cause.label(), cause.at_one);
    for (const double value : shown) // the parents' laws depend on them
        key += fmt::format(" {:.17g}", value);
    return key;
}

Eigen::MatrixXd matrix_of(const std::vector<const SimulatedCampaign*>& rows,
                          std::vector<double> SimulatedCampaign::*values)
{
    const std::size_t columns = rows.empty() ? 0 : (rows.front()->*values).size();
    Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j)
            out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = (rows[i]->*values)[j];
    return out;
}

/// The laws of those scouts whose descriptors are nearest to the measured ones, each over its scatter among the scouts.
std::vector<HealthyLaw> likest_laws(const CampaignEnsemble& ensemble, const EnsemblePlan& plan,
                                    const std::vector<double>& shown)
{
    const Eigen::MatrixXd scouts = ensemble.scouts(plan).descriptors;
    std::vector<std::pair<double, std::uint64_t>> distance;
    for (Eigen::Index i = 0; i < scouts.rows(); ++i)
        distance.emplace_back(0, static_cast<std::uint64_t>(i));
    for (Eigen::Index k = 0; k < scouts.cols(); ++k) {
        std::vector<double> known;
        for (const double value : scouts.col(k))
            if (std::isfinite(value))
                known.push_back(value);
        if (!std::isfinite(shown[static_cast<std::size_t>(k)]) || known.size() < 2)
            continue;
        const double middle = upper_median(known);
        for (double& value : known)
            value = std::fabs(value - middle);
        const double spread = std::max(1.4826 * upper_median(std::move(known)), 1e-12);
        constexpr double most = 5; // one strange descriptor does not decide; a missing one is as strange
        for (Eigen::Index i = 0; i < scouts.rows(); ++i) {
            const double off = (scouts(i, k) - shown[static_cast<std::size_t>(k)]) / spread;
            const double part = std::isfinite(off) ? std::min(std::fabs(off), most) : most;
            distance[static_cast<std::size_t>(i)].first += part * part;
        }
    }
    std::sort(distance.begin(), distance.end());
    std::vector<HealthyLaw> laws;
    for (std::uint64_t i = 0; i < plan.parents; ++i)
        laws.push_back(draw_law(plan.family, plan.seed, distance[i % distance.size()].second));
    return laws;
}

} // namespace

std::pair<int, double> EnsemblePlan::label(const std::vector<CandidateCause>& causes, std::uint64_t number) const
{
    if (number < scouts + nulls)
        return {-1, 0};
    const std::uint64_t k = number - scouts - nulls;
    const auto cause = static_cast<std::size_t>(k % causes.size());
    const std::uint64_t place = k / causes.size();
    const CandidateCause& c = causes[cause];
    // from weak to strong, each side where there are two; the neutral size is that of the nulls
    const double part = static_cast<double>(place + 1) / static_cast<double>(of_each_cause);
    double z = c.most * part;
    if (c.least < 0 && place % 2 == 1)
        z = c.least * part;
    return {static_cast<int>(cause), z};
}

CampaignTable CampaignEnsemble::scouts(const EnsemblePlan& plan) const
{
    return table_of(0, plan.scouts);
}

CampaignTable CampaignEnsemble::nulls(const EnsemblePlan& plan) const
{
    return table_of(plan.scouts, plan.scouts + plan.nulls);
}

CampaignTable CampaignEnsemble::table_of(std::uint64_t first, std::uint64_t end) const
{
    std::vector<const SimulatedCampaign*> rows;
    for (const SimulatedCampaign& campaign : campaigns)
        if (campaign.number >= first && campaign.number < end)
            rows.push_back(&campaign);
    return {matrix_of(rows, &SimulatedCampaign::descriptors), matrix_of(rows, &SimulatedCampaign::statistics)};
}

LabelledCampaigns CampaignEnsemble::labelled() const
{
    LabelledCampaigns out;
    std::vector<const SimulatedCampaign*> rows;
    for (const SimulatedCampaign& campaign : campaigns)
        if (campaign.cause >= 0) {
            rows.push_back(&campaign);
            out.cause.push_back(campaign.cause);
            out.size.push_back(campaign.z);
        }
    out.table = {matrix_of(rows, &SimulatedCampaign::descriptors), matrix_of(rows, &SimulatedCampaign::statistics)};
    return out;
}

CampaignEnsemble simulate_ensemble(const Campaign& measured, const Study& study,
                                   const std::vector<CandidateCause>& causes, const EnsemblePlan& plan,
                                   const std::vector<double>& shown, const std::filesystem::path& cache,
                                   const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer)
{
    CampaignEnsemble out;
    const TrackScales scales = track_scales(measured);
    const std::size_t descriptors = descriptor_labels(measured).size(), statistics = statistic_labels(measured).size();
    const std::uint64_t total = plan.total(causes.size());
    const std::string key = key_of(measured, study, causes, plan, shown);
    std::string text = key + "\n";
    if (!cache.empty()) {
        std::ifstream in(cache);
        std::string line;
        SimulatedCampaign campaign;
        if (std::getline(in, line) && line == key)
            while (out.campaigns.size() < total && std::getline(in, line) && !in.eof() && // one without its end is cut
                   read_line(line, descriptors, statistics, campaign) && campaign.number == out.campaigns.size()) {
                out.campaigns.push_back(campaign);
                text += line + "\n";
            }
        out.cached = out.campaigns.size();
    }
    std::vector<HealthyLaw> parents;
    progress(out.campaigns.size(), total);
    while (out.campaigns.size() < total) {
        const std::uint64_t first = out.campaigns.size();
        const std::uint64_t count = std::min(together, (first < plan.scouts ? plan.scouts : total) - first);
        HealthyScatter scatter;
        if (first < plan.scouts) {
            scatter.laws = draw_laws(plan.family, plan.seed, first, count);
        } else {
            if (parents.empty())
                parents = likest_laws(out, plan, shown);
            for (std::uint64_t i = first; i < first + count; ++i)
                scatter.laws.push_back(draw_near(plan.family, parents[plan.parent(i)], plan.seed, i));
        }
        std::vector<std::vector<SizedCause>> acting(count);
        for (std::uint64_t i = 0; i < count; ++i)
            if (const auto [cause, z] = plan.label(causes, first + i); cause >= 0) {
                const CandidateCause& candidate = causes[static_cast<std::size_t>(cause)];
                acting[i] = {{candidate.cause, candidate.size_of(z)}};
            }
        const VirtualCampaigns made =
            virtual_campaigns(measured, study, plan.seed, first, count, scatter, acting, options, observer);
        out.simulations += made.simulations;
        out.block_steps += made.block_steps;
        if (!made.complete)
            return out;
        std::vector<SimulatedCampaign> rows(count);
        tbb::task_arena(options.threads).execute([&] {
            tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) {
                SimulatedCampaign& row = rows[i];
                row.number = first + i;
                std::tie(row.cause, row.z) = plan.label(causes, first + i);
                const CampaignStatistics numbers = statistics_of(made.campaigns[i], scales, made.base_m);
                row.descriptors = numbers.descriptors;
                row.statistics = numbers.values;
            });
        });
        for (SimulatedCampaign& row : rows) {
            text += line_of(row) + "\n";
            out.campaigns.push_back(std::move(row));
        }
        if (!cache.empty())
            write_whole(cache, text);
        progress(out.campaigns.size(), total);
    }
    out.complete = true;
    return out;
}

} // namespace stylobate
