/// Collapse probabilities of rigid blocks by a reference that shares no code with the kernels, for laws of impact.
///
///   stylobate_rigid_reference --cell six_drums_a --law together --rate 7680 --draws 512 [--first N]
///   stylobate_rigid_reference --cell six_drums_a --trace N --rate 15360      beside the rigid form, over time

#include "bench/mean.hpp"
#include "bench/rigid_reference/column.hpp"
#include "bench/rocking_cells.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/run/executor.hpp"
#include "io/tables/table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

const std::map<std::string, reference::ImpactLaw> laws{{"together", reference::ImpactLaw::together},
                                                       {"sequential", reference::ImpactLaw::sequential},
                                                       {"viscous", reference::ImpactLaw::viscous},
                                                       {"compliant", reference::ImpactLaw::compliant}};

struct Answer {
    Fallen fallen; ///< (draws)
    reference::Counts counts;
    double simulated_s = 0, processor_s = 0;
};

Answer run_reference(const Study& study, const reference::Impacts& impacts, double step_s, std::uint64_t first,
                     std::uint64_t draws)
{
    const Sampler sampler(study, nullptr);
    Answer out;
    const std::clock_t begin = std::clock();
    for (std::uint64_t i = first; i < first + draws; ++i) {
        reference::Draw draw(study, sampler.realization(i), impacts, step_s);
        while (!draw.over())
            draw.step();
        out.fallen.push_back(draw.conclude());
        out.simulated_s += draw.time_s();
        const reference::Counts& c = draw.column().counts();
        out.counts.impacts += c.impacts;
        out.counts.swept += c.swept;
        out.counts.inexact += c.inexact;
        out.counts.crowded += c.crowded;
    }
    out.processor_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return out;
}

/// The rigid form on the same draws.
Fallen run_rigid_form(const Study& study, std::uint64_t first, std::uint64_t draws)
{
    std::vector<std::uint64_t> indices(draws);
    std::iota(indices.begin(), indices.end(), first);
    Fallen fallen(draws);
    RunPlan plan;
    plan.total = draws;
    plan.indices = indices;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        fallen[r.index - first] = o.state == State::invalid ? -1 : o.state == State::collapsed;
    };
    Observer quiet;
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, quiet);
    return fallen;
}

std::string text_of(const Mean& m, const char* format)
{
    return fmt::format(fmt::runtime(format), m.value(), m.error());
}

/// Rotations of all blocks by the reference and by the rigid form.
void trace(const Study& study, const reference::Impacts& impacts, double step_s, std::uint64_t index, int every,
           double until_s)
{
    const Sampler sampler(study, nullptr);
    const Realization r = sampler.realization(index);
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    reference::Draw draw(study, r, impacts, step_s);
    for (int n = 0; !draw.over() && draw.time_s() < until_s; ++n) {
        draw.step();
        set.advance(n % chunk_steps, n % chunk_steps + 1);
        if ((n + 1) % every != 0)
            continue;
        const Snapshot now = set.snapshot(0);
        double most = 0;
        std::string line = fmt::format("{:.6f} {:6d}", draw.time_s(), draw.column().counts().impacts);
        for (std::size_t i = 1; i < now.theta_rad.size(); ++i) {
            line += fmt::format(" {:+.3e}/{:+.3e}", draw.moved()[i].theta_rad, now.theta_rad[i]);
            most = std::max(most, std::fabs(draw.moved()[i].theta_rad - now.theta_rad[i]));
        }
        fmt::print("{}  {:.2e}\n", line, most);
        if (set.done(0))
            break;
    }
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Collapse probabilities of rigid blocks by a reference of its own");
    std::uint64_t draws = 256, first = 0;
    std::string cell_name = "six_drums_a", law = "together";
    double rate = 7680, until_s = 11;
    long long traced = -1;
    int every = 16;
    bool list = false;
    reference::Impacts impacts;
    app.add_option("--draws", draws, "realizations")->check(CLI::Range(1, 1000000));
    app.add_option("--first", first, "index of the first one");
    app.add_option("--cell", cell_name, "structure and shaking");
    app.add_option("--law", law, "of impacts")->check(CLI::IsMember(laws));
    app.add_option("--along-ratio", impacts.along_ratio, "viscous: dashpot along the face over that across it");
    app.add_option("--damping-ratio", impacts.damping_ratio, "compliant: of the contacts")->check(CLI::Range(0.0, 1e3));
    app.add_option("--rate", rate, "steps per second");
    app.add_flag("--list", list, "1 or 0 for each draw: fallen or not");
    app.add_option("--trace", traced, "one draw over time, beside the rigid form");
    app.add_option("--every", every, "steps between lines of a trace");
    app.add_option("--until", until_s, "end of a trace [s]");
    CLI11_PARSE(app, argc, argv);
    impacts.law = laws.at(law);
    const std::vector<Cell> cells = rocking_cells();
    const auto cell = std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return c.name == cell_name; });
    if (cell == cells.end()) {
        fmt::print(stderr, "--cell {}: there is none of that name\n", cell_name);
        return 2;
    }
    const Study study =
        cell_study(*cell, {.step_s = 1 / rate}, first + draws + static_cast<std::uint64_t>(std::max(0LL, traced)));
    if (traced >= 0) {
        trace(study, impacts, 1 / rate, static_cast<std::uint64_t>(traced), every, until_s);
        return 0;
    }
    const Answer a = run_reference(study, impacts, 1 / rate, first, draws);
    const Fallen own = run_rigid_form(study, first, draws);
    fmt::print(
        "{} {} 1/{:g}: {} | rigid form {} | difference {} | differ {} | impacts/s {:.0f} swept/s {:.0f} inexact {} "
        "crowded {} | "
        "{:.2f} s a realization of 10 s\n",
        cell_name, law, rate, text_of(share_of(a.fallen), "{:.4f} ± {:.4f}"), text_of(share_of(own), "{:.4f} ± {:.4f}"),
        text_of(paired_difference(a.fallen, own), "{:+.4f} ± {:.4f}"),
        std::inner_product(a.fallen.begin(), a.fallen.end(), own.begin(), 0, std::plus<>(), std::not_equal_to<>()),
        static_cast<double>(a.counts.impacts) / a.simulated_s, static_cast<double>(a.counts.swept) / a.simulated_s,
        a.counts.inexact, a.counts.crowded, a.processor_s / a.simulated_s * 10);
    if (list) {
        std::string text;
        for (const signed char one : a.fallen)
            text += one > 0 ? '1' : '0';
        fmt::print("{}\n", text);
    }
}
