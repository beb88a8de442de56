/// What each convention of a study changes in one collapse probability, on the same draws: contact form, K_N, place of
/// the dashpots, start and length of the shaking. A table for docs/sensitivity.md, by scripts/tables.sh conventions.
///
///   stylobate_conventions [--draws N] [--study STUDY.toml] [--frequency HZ] [--pga M_S2]

#include "studies/experiment/conventions.hpp"
#include "bench/mean.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/table.hpp"
#include "studies/experiment/contact_laws.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

/// One convention that differs from the study.
struct Variant {
    std::string words;
    std::string setting; ///< as `--set` takes it; empty: a contact law
    std::string law{};   ///< by its name
};

const std::vector<Variant> variants{
    {"contact at two corners", "contact.form=\"two_corner\""},
    {"rigid contacts", "", "rigid"},
    {"dashpots at the ends", "contact.damping=\"ends\""},
    {"K_N and K_T a third", "", "softer"},
    {"K_N and K_T three times", "", "stiffer"},
    {"ramps of 1 cycle", "excitation.ramp_cycles=1"},
    {"ramps of 4 cycles", "excitation.ramp_cycles=4"},
    {"abrupt start", "excitation.start=\"abrupt\""},
    {"5 cycles in all", "excitation.cycles=5"},
    {"20 cycles in all", "excitation.cycles=20"},
};

Study varied(const std::string& file, std::vector<std::string> settings, const Variant& variant)
{
    if (!variant.setting.empty())
        settings.push_back(variant.setting);
    const Study study = read_study(file, settings);
    if (variant.law.empty())
        return study;
    const std::vector<ContactLaw> laws = contact_laws(study);
    const ContactLaw& law = *std::ranges::find(laws, variant.law, &ContactLaw::name);
    if (!law.study)
        throw InputError(variant.law + ": " + law.why_not);
    return *law.study;
}

Fallen run(const Study& study)
{
    Fallen fallen(study.total());
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) {
        fallen[r.index] = o.state == State::invalid ? -1 : o.state == State::collapsed;
    };
    Observer quiet;
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, quiet);
    return fallen;
}

std::string probability(const Fallen& fallen)
{
    const Mean share = share_of(fallen);
    const BinomialInterval interval =
        jeffreys(static_cast<std::uint64_t>(share.count), static_cast<std::uint64_t>(share.sum), 0.95);
    return fmt::format("{:.3f} ({:.3f} to {:.3f})", share.value(), interval.lower, interval.upper);
}

void print_table(const std::string& file, const std::vector<std::string>& cell)
{
    const Study base = read_study(file, cell);
    const Fallen given = run(base);
    fmt::print(
        "Conventions of the study as given: {}.\n\n{}", conventions_text(base),
        markdown_head("convention that differs | collapse probability (95 %) | paired difference | end otherwise"));
    fmt::print("{}", markdown_row("none: as given | {} | | ", probability(given)));
    for (const Variant& variant : variants) {
        const Fallen other = run(varied(file, cell, variant));
        const Mean difference = paired_difference(other, given);
        fmt::print("{}", markdown_row("{}{} | {} | {:+.3f} ± {:.3f} | {:.0f} %", variant.words,
                                      variant.setting.empty() ? " (law `" + variant.law + "` of `run --laws`)"
                                                              : " (`" + variant.setting + "`)",
                                      probability(other), difference.value(), difference.error(),
                                      100 * difference.squares / difference.count));
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("What each convention of a study changes in one collapse probability");
    std::string file = "studies/inputs/small_scale_column.toml";
    std::uint64_t draws = 8192;
    double frequency_hz = 4, pga_m_s2 = 5;
    app.add_option("--study", file, "a surface under a harmonic")->capture_default_str();
    app.add_option("--draws", draws, "realizations of each row")->check(CLI::Range(64, 1000000));
    app.add_option("--frequency", frequency_hz, "of the cell [Hz]");
    app.add_option("--pga", pga_m_s2, "of the cell [m/s2]");
    CLI11_PARSE(app, argc, argv);
    const auto axis = [](const char* key, double value) {
        return std::vector<std::string>{fmt::format("surface.{}.from={}", key, value),
                                        fmt::format("surface.{}.to={}", key, value),
                                        fmt::format("surface.{}.count=1", key)};
    };
    std::vector<std::string> cell{fmt::format("study.realizations={}", draws)};
    for (const auto& settings : {axis("frequency_hz", frequency_hz), axis("pga_m_s2", pga_m_s2)})
        cell.insert(cell.end(), settings.begin(), settings.end());
    try {
        print_table(file, cell);
        fmt::print("\n({} draws of each row, the same in all; {}. *End otherwise*: the share of realizations of which "
                   "exactly one of the two falls.)\n",
                   draws, processor());
    } catch (const InputError& e) {
        fmt::print(stderr, "stylobate_conventions: {}\n", e.what());
        return 2;
    }
    return 0;
}
