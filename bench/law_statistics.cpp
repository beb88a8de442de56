/// What the statistics of a campaign (`studies/measured/diagnosis/evidence`) show of healthy contact laws: how many are
/// there, how they scatter within one law and between laws, how well the descriptors predict them, and what both cost.
/// Campaigns with nothing hidden, of the specimen and the motions of a measured one.
///
///   stylobate_law_statistics CAMPAIGN.h5 [--nulls N] [--per-law N] [--seed N] [--threads N]

#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/keys/words.hpp"
#include "io/measured/measured_file.hpp"
#include "io/tables/table.hpp"
#include "kernels/isa.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/campaigns/virtual_campaign.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

using namespace stylobate;

namespace {

struct Rows {
    std::vector<CampaignStatistics> of;
    double simulated_s = 0, statistics_s = 0, base_s = 0;
};

double seconds_since(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<HealthyLaw> draw_laws(const LawFamily& family, std::uint64_t seed, std::uint64_t first, std::uint64_t count)
{
    std::vector<HealthyLaw> laws;
    for (std::uint64_t n = 0; n < count; ++n)
        laws.push_back(draw_law(family, seed, first + n));
    return laws;
}

/// Campaigns with the laws given, and their statistics.
Rows rows_of(const Campaign& measured, const Study& study, std::uint64_t seed, std::uint64_t first,
             const std::vector<HealthyLaw>& laws, const RunOptions& run)
{
    constexpr std::size_t together = 8;
    Rows rows;
    Observer observer;
    const CampaignScales scales = campaign_scales(measured);
    const VirtualLaboratory laboratory(measured);
    for (std::size_t k = 0; k < laws.size(); k += together) {
        HealthyScatter scatter;
        scatter.laws.assign(laws.begin() + static_cast<std::ptrdiff_t>(k),
                            laws.begin() + static_cast<std::ptrdiff_t>(std::min(k + together, laws.size())));
        const auto begin = std::chrono::steady_clock::now();
        const VirtualCampaigns made =
            virtual_campaigns(laboratory, study, seed, first + k, scatter.laws.size(), scatter, {}, run, observer);
        rows.simulated_s += seconds_since(begin);
        for (const Campaign& campaign : made.campaigns) {
            // nothing is hidden in the base: the file's motion is right, and needs no tests
            const auto counted = std::chrono::steady_clock::now();
            const DirectResult base = apply_corrections(campaign, scales, {});
            rows.base_s += seconds_since(counted);
            rows.of.push_back(statistics_of(campaign, scales, base.base_m));
            rows.statistics_s += seconds_since(counted);
        }
    }
    return rows;
}

/// Part of the variance of left-out values that a linear regression on the descriptors explains. NaN: too few values.
double predicted_part(const std::vector<CampaignStatistics>& rows, std::size_t value)
{
    const std::size_t descriptors = rows.front().descriptors.size();
    std::vector<double> mean(descriptors, 0), sd(descriptors, 0);
    for (std::size_t d = 0; d < descriptors; ++d) {
        double n = 0, square = 0;
        for (const CampaignStatistics& r : rows)
            if (std::isfinite(r.descriptors[d])) {
                n += 1;
                mean[d] += r.descriptors[d];
                square += r.descriptors[d] * r.descriptors[d];
            }
        mean[d] = n > 0 ? mean[d] / n : 0;
        sd[d] = n > 0 ? std::sqrt(std::max(square / n - mean[d] * mean[d], 0.0)) : 0;
    }
    std::vector<std::size_t> used;
    for (std::size_t r = 0; r < rows.size(); ++r)
        if (std::isfinite(rows[r].values[value]))
            used.push_back(r);
    const auto n = static_cast<Eigen::Index>(used.size()), p = static_cast<Eigen::Index>(descriptors);
    if (n < 2 * p)
        return NAN;
    Eigen::MatrixXd x = Eigen::MatrixXd::Ones(n, p + 1);
    Eigen::VectorXd y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const CampaignStatistics& row = rows[used[static_cast<std::size_t>(i)]];
        y(i) = row.values[value];
        for (Eigen::Index d = 0; d < p; ++d) {
            const auto k = static_cast<std::size_t>(d);
            const double v = row.descriptors[k];
            x(i, d + 1) = std::isfinite(v) && sd[k] > 0 ? (v - mean[k]) / sd[k] : 0;
        }
    }
    Eigen::MatrixXd normal = x.transpose() * x;
    normal.diagonal().tail(p).array() += 1; // a weak prior
    const Eigen::MatrixXd hat = x * normal.ldlt().solve(x.transpose());
    const Eigen::VectorXd left_out = ((y - hat * y).array() / (1 - hat.diagonal().array())).matrix();
    const double about =
        (y.array() - y.mean()).square().sum() * std::pow(static_cast<double>(n) / static_cast<double>(n - 1), 2);
    return about > 0 ? 1 - left_out.squaredNorm() / about : NAN;
}

struct Scatter {
    double within = NAN, between = NAN;
};

/// Standard deviations among specimens of one law, and among the laws beyond that.
template <class Value>
Scatter scatter_of(const std::vector<CampaignStatistics>& rows, std::size_t per_law, Value&& value)
{
    double within = 0, freedom = 0;
    std::vector<double> means, counts;
    for (std::size_t k = 0; k < rows.size(); k += per_law) {
        double sum = 0, square = 0, n = 0;
        for (std::size_t i = k; i < k + per_law; ++i)
            if (const double v = value(rows[i]); std::isfinite(v)) {
                sum += v;
                square += v * v;
                n += 1;
            }
        if (n < 2)
            continue;
        within += square - sum * sum / n;
        freedom += n - 1;
        means.push_back(sum / n);
        counts.push_back(n);
    }
    if (means.size() < 3)
        return {};
    double mean = 0, square = 0, n = 0;
    for (std::size_t k = 0; k < means.size(); ++k) {
        mean += means[k] / static_cast<double>(means.size());
        n += counts[k] / static_cast<double>(means.size());
    }
    for (const double m : means)
        square += (m - mean) * (m - mean) / static_cast<double>(means.size() - 1);
    const double variance = within / freedom;
    return {std::sqrt(variance), std::sqrt(std::max(square - variance / n, 0.0))};
}

double median_of(std::vector<double> values)
{
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    return values.empty() ? NAN : upper_median(std::move(values));
}

/// Steps of a second, of all laws and by form and kind of damping.
void print_steps(const Campaign& campaign, const Study& study, const std::vector<HealthyLaw>& laws)
{
    const SpecimenStructure built = build_specimen(campaign.specimen);
    std::vector<double> work;
    double all = 0;
    for (const HealthyLaw& law : laws) {
        Study contacts = study;
        apply_law(law, contacts);
        Realization r = nominal_realization(contacts, built.structure);
        apply_law(law, campaign.specimen, built, study.run.step_fraction, r);
        work.push_back(1 / r.step_s);
        all += work.back() / static_cast<double>(laws.size());
    }
    std::map<std::string, std::pair<double, double>> parts;
    for (std::size_t k = 0; k < laws.size(); ++k)
        for (const std::string& name :
             {std::string(word_for(contact_form_names, laws[k].form)), std::string(to_string(laws[k].kind))}) {
            parts[name].first += work[k];
            parts[name].second += 1;
        }
    fmt::print("Steps of a second: {:.0f};", all);
    for (const auto& [name, part] : parts)
        fmt::print(" {} {:.2f}", name, part.first / part.second / all);
    fmt::print(" times as many.\n");
}

/// One line for each kind of statistic.
void print_statistics(const std::vector<StatisticLabel>& labels, const Rows& laws, const Rows& repeated,
                      std::size_t per_law)
{
    struct Line {
        std::size_t count = 0;
        std::vector<double> finite, within, between, predicted;
    };
    std::vector<std::string> order;
    std::map<std::string, Line> lines;
    for (std::size_t v = 0; v < labels.size(); ++v) {
        if (!lines.contains(labels[v].name))
            order.push_back(labels[v].name);
        Line& line = lines[labels[v].name];
        ++line.count;
        double finite = 0;
        for (const CampaignStatistics& row : laws.of)
            finite += std::isfinite(row.values[v]);
        line.finite.push_back(finite / static_cast<double>(laws.of.size()));
        const Scatter s = scatter_of(repeated.of, per_law, [&](const CampaignStatistics& r) { return r.values[v]; });
        line.within.push_back(s.within);
        line.between.push_back(s.between);
        line.predicted.push_back(predicted_part(laws.of, v));
    }
    fmt::print("\n| statistic | numbers | finite | sd within a law | sd between laws | predicted by the descriptors |\n"
               "|---|---:|---:|---:|---:|---:|\n");
    for (const std::string& name : order) {
        const Line& line = lines[name];
        double finite = 0;
        for (const double f : line.finite)
            finite += f / static_cast<double>(line.count);
        fmt::print("| {} | {} | {:.2f} | {:.3f} | {:.3f} | {:.2f} |\n", name, line.count, finite,
                   median_of(line.within), median_of(line.between), median_of(line.predicted));
    }
}

/// How the slip paths of the joints compare with each other: ln path of a joint less the mean of the others, mean over
/// the motions.
void print_contrasts(const std::vector<StatisticLabel>& labels, int joints, const Rows& laws, const Rows& repeated,
                     std::size_t per_law)
{
    const auto contrast = [&](const CampaignStatistics& row, int joint) {
        double own = 0, others = 0, n = 0;
        for (std::size_t v = 0; v < labels.size(); ++v)
            if (labels[v].name == "slip_path") {
                n += labels[v].joint == joint;
                (labels[v].joint == joint ? own : others) += row.values[v];
            }
        return (own - others / (joints - 1)) / n;
    };
    if (joints < 2)
        return;
    fmt::print("\n| contrast of ln slip path | sd within a law | sd between laws | predicted by the descriptors |\n"
               "|---|---:|---:|---:|\n");
    for (int j = 0; j < joints; ++j) {
        const Scatter s =
            scatter_of(repeated.of, per_law, [&](const CampaignStatistics& row) { return contrast(row, j); });
        std::vector<CampaignStatistics> rows = laws.of;
        for (CampaignStatistics& row : rows)
            row.values = {contrast(row, j)};
        fmt::print("| joint {} | {:.3f} | {:.3f} | {:.2f} |\n", j, s.within, s.between, predicted_part(rows, 0));
    }
}

/// Mean and standard deviation of a descriptor among the laws, and how far the measured campaign lies from it.
void print_descriptors(const std::vector<StatisticLabel>& labels, const Rows& laws, const Rows& repeated,
                       std::size_t per_law, const CampaignStatistics& measured)
{
    fmt::print(
        "\n| descriptor | finite | sd within a law | sd between laws | mean of the laws | measured | over the sd |\n"
        "|---|---:|---:|---:|---:|---:|---:|\n");
    for (std::size_t d = 0; d < labels.size(); ++d) {
        double finite = 0, mean = 0, square = 0;
        for (const CampaignStatistics& row : laws.of)
            if (const double v = row.descriptors[d]; std::isfinite(v)) {
                finite += 1;
                mean += v;
                square += v * v;
            }
        mean /= finite;
        const double sd = std::sqrt(std::max(square / finite - mean * mean, 0.0));
        const Scatter s =
            scatter_of(repeated.of, per_law, [&](const CampaignStatistics& r) { return r.descriptors[d]; });
        fmt::print("| {} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n", labels[d].name,
                   finite / static_cast<double>(laws.of.size()), s.within, s.between, mean, measured.descriptors[d],
                   (measured.descriptors[d] - mean) / sd);
    }
}

} // namespace

int main(int argc, char** argv)
{
    std::string file;
    std::uint64_t seed = 1, nulls = 60, per_law = 6;
    int threads = 2;
    CLI::App app("What the statistics of campaigns show of healthy contact laws, as tables.");
    app.add_option("campaign", file, "Measured campaign, whose specimen and motions are taken")->required();
    app.add_option("--nulls", nulls, "Campaigns with nothing hidden, each with a law of its own");
    app.add_option("--per-law", per_law, "Specimens of one law, in as many campaigns again");
    app.add_option("--seed", seed, "Of all draws");
    app.add_option("--threads", threads, "Of the simulations");
    CLI11_PARSE(app, argc, argv);
    const Campaign campaign = read_campaign(file);
    const Study study = default_study(campaign);
    const RunOptions run{best_isa(), threads};
    const LawFamily family;

    const Rows laws = rows_of(campaign, study, seed, 0, draw_laws(family, seed, 0, nulls), run);
    std::vector<HealthyLaw> again;
    for (const HealthyLaw& law : draw_laws(family, seed, nulls, nulls / per_law))
        again.insert(again.end(), per_law, law);
    const Rows repeated = rows_of(campaign, study, seed, 2 * nulls, again, run);

    const std::vector<StatisticLabel> labels = statistic_labels(campaign);
    const auto count = static_cast<double>(laws.of.size() + repeated.of.size());
    fmt::print("{}: {} runs, {} blocks, {} statistics, {} campaigns of {} laws, and {} of {}; seed {}.\n",
               campaign.specimen.name, campaign.runs.size(), campaign.specimen.blocks(), labels.size(), laws.of.size(),
               laws.of.size(), repeated.of.size(), nulls / per_law, seed);
    fmt::print("Per campaign: {:.2f} s of simulation ({} threads), {:.2f} ms of statistics, of which {:.2f} ms are "
               "for the base motion.\n",
               (laws.simulated_s + repeated.simulated_s) / count, threads,
               1e3 * (laws.statistics_s + repeated.statistics_s) / count,
               1e3 * (laws.base_s + repeated.base_s) / count);
    print_steps(campaign, study, draw_laws(family, seed, 0, nulls));
    for (std::size_t k = 0; k < laws.of.size(); ++k)
        if (std::none_of(laws.of[k].values.begin(), laws.of[k].values.end(), [](double v) { return std::isfinite(v); }))
            fmt::print("Nothing is finite in campaign {}.\n", k);
    print_statistics(labels, laws, repeated, per_law);
    print_contrasts(labels, static_cast<int>(campaign.specimen.joints.size()), laws, repeated, per_law);
    const CampaignScales scales = campaign_scales(campaign);
    print_descriptors(descriptor_labels(campaign), laws, repeated, per_law,
                      statistics_of(campaign, scales, direct_tests(campaign, scales).base_m));
    return 0;
}
