/// What a diagnosis can show: of the labelled campaigns that it simulates (a known cause at a known place, of a known
/// size), how many are named with the right mechanism, by mechanism and size. Each is judged by a fit that has not
/// seen its law.
///
///   stylobate_diagnosis_power CAMPAIGN.h5... [--nulls N] [--seed N] [--threads N] [--cache FOLDER]

#include "io/measured/measured_file.hpp"
#include "kernels/isa.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/campaigns/ensemble_diagnosis.hpp"
#include "studies/measured/diagnosis/prediction.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace stylobate;

namespace {

// Parts of the largest size that was simulated: weak, medium, strong.
constexpr std::array size_classes = {std::pair{0.0, 0.4}, std::pair{0.4, 0.7}, std::pair{0.7, 1.01}};

struct Counts {
    int right = 0, all = 0;
};
using Power = std::map<std::string, std::array<Counts, size_classes.size()>>;

void add(const EnsembleDiagnosis& found, Power& power)
{
    std::size_t i = 0;
    for (const SimulatedCampaign& row : found.ensemble.campaigns) {
        if (row.cause < 0)
            continue;
        if (i == found.by_statistics.labelled_right.size())
            break; // what follows are the rounds of the causes' own
        const CandidateCause& cause = found.causes[static_cast<std::size_t>(row.cause)];
        const double part = std::fabs(row.z) / (row.z < 0 ? -cause.least : cause.most);
        const std::string name = cause.cause.mechanism + (cause.ratio && cause.at_one > 1 ? ", more"
                                                          : cause.ratio                   ? ", less"
                                                                                          : "");
        for (std::size_t k = 0; k < size_classes.size(); ++k)
            if (part > size_classes[k].first && part <= size_classes[k].second) {
                ++power[name][k].all;
                power[name][k].right += found.by_statistics.labelled_right[i] ? 1 : 0;
            }
        ++i;
    }
}

} // namespace

int main(int argc, char** argv)
{
    std::vector<std::string> files;
    std::optional<std::filesystem::path> cache;
    std::uint64_t seed = 1, nulls = EnsemblePlan{}.nulls;
    int threads = 2;
    CLI::App app("How often labelled campaigns are named rightly, by mechanism and size, as a table.");
    app.add_option("campaigns", files, "Measured campaigns, whose specimens, motions and laws are taken")->required();
    app.add_option("--nulls", nulls, "As of `stylobate diagnose`");
    app.add_option("--seed", seed, "Of the simulated campaigns");
    app.add_option("--threads", threads, "Of the simulations");
    app.add_option("--cache", cache, "Folder that keeps the simulated campaigns, so that the program can be continued");
    CLI11_PARSE(app, argc, argv);

    Power power;
    Observer observer;
    for (const std::string& file : files) {
        const Campaign measured = read_campaign(file);
        const CampaignScales scales = campaign_scales(measured);
        const DirectResult direct = direct_tests(measured, scales);
        EnsemblePlan plan = EnsemblePlan::with(nulls);
        plan.seed = seed;
        std::optional<std::filesystem::path> rows;
        if (cache)
            rows = *cache / (std::filesystem::path(file).stem().string() + ".txt");
        add(ensemble_diagnosis(
                corrected(measured, direct), default_study(measured), scales, {}, direct.base_m, plan, rows,
                {best_isa(), threads}, [](std::uint64_t, std::uint64_t) {}, observer),
            power);
        fmt::print(stderr, "{}\n", file);
    }
    fmt::print("| named rightly, of {} campaigns' labelled ones | weak | medium | strong |\n|---|---:|---:|---:|\n",
               files.size());
    for (const auto& [mechanism, counts] : power) {
        fmt::print("| {} |", mechanism);
        for (const Counts& c : counts)
            fmt::print(" {} of {} |", c.right, c.all);
        fmt::print("\n");
    }
    return 0;
}
