/// What a diagnosis could name at best: how well campaigns with a hidden effect differ from campaigns without it, for
/// an observer who knows the healthy contact law, the effect, its place and its size, and has many campaigns of both
/// sorts from the laboratory itself. A diagnosis knows none of these.
///
///   stylobate_detection_ceiling --seed N [--campaigns N] [--repeats N] [--threads N]
///
/// One campaign with each effect (as `scripts/hidden.sh each SEED`), and then repeats of it: the same motions, law and
/// effect, another specimen of the plan, other placements and noise; with and without the effect. Their numbers are
/// those of the diagnosis: means over the motions of the statistics of joints, and the scores of the balance of forces.
/// What is found in the base, in sensors and at rest is left out: direct tests find it.

#include "bench/separation.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"
#include "studies/measured/diagnosis/evidence/balance_evidence.hpp"
#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"
#include "tests/hidden/score/detectability.hpp"
#include "tests/hidden/virtual_campaign.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <array>
#include <cstdio>

using namespace stylobate;

namespace {

constexpr std::array elsewhere = {"table_pitch", "vertical_motion", "harmonic_distortion", "time_offset",
                                  "sensor_gain", "wedge",           "drum_offset"};

/// The numbers that the diagnosis takes from a campaign whose base motion is right.
Eigen::RowVectorXd numbers_of(const Campaign& campaign)
{
    const CampaignScales scales = campaign_scales(campaign);
    const DirectResult base = apply_corrections(campaign, scales, {});
    const Summary joints = over_motions(statistic_labels(campaign));
    std::vector<double> row = means(joints, statistics_of(campaign, scales, base.base_m).values);
    for (const double score :
         balance_scores(fit_balance(campaign, scales, base.base_m), score_plan(campaign.specimen, scales)))
        row.push_back(std::isfinite(score) ? std::asinh(score) : 0);
    return Eigen::Map<const Eigen::RowVectorXd>(row.data(), static_cast<Eigen::Index>(row.size()));
}

Eigen::MatrixXd repeats_of(const hidden::VirtualCampaign& made, std::uint64_t first, std::uint64_t count,
                           bool with_effect)
{
    std::vector<Eigen::RowVectorXd> rows(count);
    in_parallel(std::uint64_t{0}, count,
                [&](std::uint64_t i) { rows[i] = numbers_of(another_like(made, first + i, with_effect).campaign); });
    Eigen::MatrixXd table(static_cast<Eigen::Index>(count), rows.front().cols());
    for (std::uint64_t i = 0; i < count; ++i)
        table.row(static_cast<Eigen::Index>(i)) = rows[i];
    return table;
}

} // namespace

int main(int argc, char** argv)
{
    std::uint64_t seed = 0, rounds = 1, repeats = 100;
    int threads = 2;
    CLI::App app("What a diagnosis could name at best, as a table.");
    app.add_option("--seed", seed, "Of the first campaign; each effect takes the next")->required();
    app.add_option("--campaigns", rounds, "With each effect");
    app.add_option("--repeats", repeats, "Of each campaign, with and without its effect")
        ->check(CLI::Range(std::uint64_t{20}, std::uint64_t{100000}));
    app.add_option("--threads", threads, "Of the simulations")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);

    std::vector<std::string> names = hidden::listed_names();
    names.insert(names.end(), hidden::outside_names().begin(), hidden::outside_names().end());
    fmt::print("| seed | specimen | hidden | snr_noise | snr_scatter | power at 1.5 % | at 0.1 %, were scores normal "
               "|\n|---|---|---|---:|---:|---:|---:|\n");
    tbb::task_arena arena(threads);
    for (std::uint64_t round = 0; round < rounds; ++round)
        for (const std::string& name : names) {
            const std::uint64_t number = seed++;
            if (std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end())
                continue;
            hidden::Wish wish;
            wish.effects = {name};
            const hidden::VirtualCampaign made = hidden::make_campaign(number, wish);
            const hidden::Detectability seen = hidden::detectability_of(made).front();
            if (!seen.detectable())
                continue;
            arena.execute([&] {
                const Separation told =
                    separate(repeats_of(made, 0, repeats, false), repeats_of(made, repeats, repeats, true));
                double mean = 0, square = 0;
                for (const double score : told.nulls) {
                    mean += score / static_cast<double>(repeats);
                    square += score * score / static_cast<double>(repeats);
                }
                const double bar = mean + 3.09 * std::sqrt(square - mean * mean); // 0.1 % of a normal distribution
                const auto above =
                    std::count_if(told.others.begin(), told.others.end(), [&](double score) { return score > bar; });
                fmt::print("| {} | {} | {}, {} | {:.0f} | {:.1f} | {:.2f} | {:.2f} |\n", number,
                           made.planned.specimen.name, name, made.effects.front().place, seen.snr_noise,
                           seen.snr_scatter, told.power(0.015),
                           static_cast<double>(above) / static_cast<double>(repeats));
                std::fflush(stdout);
            });
        }
    return 0;
}
