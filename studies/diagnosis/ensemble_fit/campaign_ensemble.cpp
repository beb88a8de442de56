#include "studies/diagnosis/ensemble_fit/campaign_ensemble.hpp"

#include "io/files/atomic_file.hpp"
#include "studies/diagnosis/statistics/campaign_statistics.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
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
                   const EnsemblePlan& plan)
{
    std::string key = "# stylobate simulated campaigns " + campaign_key(measured, study, plan.seed) +
                      fmt::format(" {} {}", plan.nulls, plan.of_each_cause);
    for (const CandidateCause& cause : causes)
        key += fmt::format(" {} {:.17g}", cause.cause.label(), cause.at_one);
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

} // namespace

std::pair<int, double> EnsemblePlan::label(const std::vector<CandidateCause>& causes, std::uint64_t number) const
{
    if (number < nulls)
        return {-1, 0};
    const std::uint64_t k = number - nulls;
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

CampaignTable CampaignEnsemble::nulls() const
{
    std::vector<const SimulatedCampaign*> rows;
    for (const SimulatedCampaign& campaign : campaigns)
        if (campaign.cause < 0)
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
                                   const std::filesystem::path& cache, const RunOptions& options,
                                   const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                                   Observer& observer)
{
    CampaignEnsemble out;
    const TrackScales scales = track_scales(measured);
    const std::size_t descriptors = descriptor_labels(measured).size(), statistics = statistic_labels(measured).size();
    const std::uint64_t total = plan.total(causes.size());
    const std::string key = key_of(measured, study, causes, plan);
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
    progress(out.campaigns.size(), total);
    while (out.campaigns.size() < total) {
        const std::uint64_t first = out.campaigns.size(), count = std::min(together, total - first);
        HealthyScatter scatter;
        scatter.laws = draw_laws(plan.family, plan.seed, first, count);
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
