/// False alarms of the diagnosis under contact laws that it does not know: campaigns with nothing hidden whose law is
/// of one part of the family of laws (a form, a kind of damping), diagnosed by simulated campaigns of the family
/// without that part.
///
///   stylobate_left_out_laws CAMPAIGN.h5 [--campaigns N] [--seed N] [--threads N]

#include "io/keys/words.hpp"
#include "io/measured/measured_file.hpp"
#include "kernels/isa.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/diagnosis/decision.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>

using namespace stylobate;

namespace {

/// A part of the family, and what is left without it.
struct Part {
    std::string name;
    LawFamily truth, without;
};

std::vector<Part> parts_of(const LawFamily& family)
{
    std::vector<Part> parts = {{"none", family, family}};
    for (const ContactForm form : family.forms) {
        Part part{word_for(contact_form_names, form), family, family};
        part.truth.forms = {form};
        std::erase(part.without.forms, form);
        parts.push_back(part);
    }
    for (const DampingKind kind : family.kinds) {
        Part part{fmt::format("{} damping", to_string(kind)), family, family};
        part.truth.kinds = {kind};
        std::erase(part.without.kinds, kind);
        parts.push_back(part);
    }
    return parts;
}

/// A campaign with nothing hidden, under a law of the family.
Campaign healthy_campaign(const Campaign& like, const Study& study, const LawFamily& family, std::uint64_t seed,
                          std::uint64_t number, const RunOptions& run, std::vector<std::vector<double>>& base_m)
{
    Observer observer;
    HealthyScatter scatter;
    scatter.laws = {draw_law(family, seed, number)};
    VirtualCampaigns made =
        virtual_campaigns(VirtualLaboratory(like), study, seed, number, 1, scatter, {}, run, observer);
    base_m = std::move(made.base_m);
    return std::move(made.campaigns.front());
}

} // namespace

int main(int argc, char** argv)
{
    std::string file;
    std::uint64_t seed = 1, campaigns = 5;
    int threads = 2;
    CLI::App app("False alarms under contact laws that the family of laws does not have, as a table.");
    app.add_option("campaign", file, "Measured campaign, whose specimen and motions are taken")->required();
    app.add_option("--campaigns", campaigns, "Campaigns with nothing hidden of each part of the family");
    app.add_option("--seed", seed, "Of the campaigns; the diagnoses have the seed 1");
    app.add_option("--threads", threads, "Of the simulations");
    CLI11_PARSE(app, argc, argv);
    const Campaign like = read_campaign(file);
    const Study study = default_study(like);
    const RunOptions run{best_isa(), threads};
    Observer observer;

    fmt::print("{}: {} runs, {} blocks; {} campaigns of each part, seed {}\n\n", like.specimen.name, like.runs.size(),
               like.specimen.blocks(), campaigns, seed);
    fmt::print(
        "| left out | campaigns | named | unexplained | p of unknown forces at most 0.1 | p of the statistics at most "
        "0.1 | law outside | seconds a diagnosis |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
    std::uint64_t number = 0;
    for (const Part& part : parts_of({})) {
        int named = 0, unexplained = 0, forces = 0, statistics = 0, outside = 0;
        const auto begin = std::chrono::steady_clock::now();
        for (std::uint64_t i = 0; i < campaigns; ++i) {
            std::vector<std::vector<double>> base_m;
            const Campaign campaign = healthy_campaign(like, study, part.truth, 1000 + seed, number++, run, base_m);
            const CampaignScales scales = campaign_scales(campaign);
            EnsemblePlan plan;
            plan.family = part.without;
            const EnsembleDiagnosis found = ensemble_diagnosis(
                campaign, study, scales, {}, base_m, plan, {}, run, [](std::uint64_t, std::uint64_t) {}, observer);
            const Decided decided = decide({}, balance_evidence(campaign, scales, base_m), &found, {});
            named += decided.verdict == Verdict::named ? 1 : 0;
            unexplained += decided.verdict == Verdict::unexplained ? 1 : 0;
            forces += found.forces.p_value <= 0.1 ? 1 : 0;
            statistics += found.by_statistics.p_value <= 0.1 ? 1 : 0;
            outside += found.by_statistics.contrasts ? 1 : 0;
            for (const JudgedCause& j : decided.named)
                fmt::print(stderr, "{}: {}, probability {:.2f}\n", part.name, j.fit.cause.label(),
                           j.probability.value_or(0));
        }
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.0f} |\n", part.name, campaigns, named, unexplained, forces,
                   statistics, outside, passed.count() / static_cast<double>(campaigns));
        std::fflush(stdout);
    }
    return 0;
}
