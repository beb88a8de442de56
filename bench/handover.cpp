/// Whether what becomes of a rigid column that falls depends on when it is handed over to contacts that yield: outcomes
/// of the same realizations, handed over when their blocks are about to meet otherwise than at beds, and earlier than
/// that.
///
///   stylobate_handover STUDY.toml [--set KEY=VALUE]... [--realizations N]     table for docs/rigid_limit.md
///
/// The study has rigid contacts and outcome.follow = "rest".

#include "bench/mean.hpp"
#include "ensemble/experiment.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/table.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

using namespace stylobate;

namespace {

constexpr int lane = 0;

/// @param until_s when it is handed over, unless it is before
/// @return nothing if it ends with rigid contacts
std::optional<HandOver> handed(const Study& study, const Realization& r, double until_s)
{
    LaneSet lanes(study, nullptr, kernels(Isa::scalar), r);
    lanes.load(lane, r);
    const int interval = lanes.model().check_steps();
    for (int done = 0; !lanes.done(lane); done = (done + interval) % chunk_steps) {
        if (static_cast<double>(lanes.steps(lane)) * r.step_s >= until_s)
            return lanes.model().hand_over(lane, lanes.place(lane));
        lanes.advance(done, done + interval);
    }
    return lanes.handed(lane);
}

Outcome finish(const Study& study, const HandOver& from)
{
    CompliantSet set(study, nullptr, kernels(Isa::scalar), from.realization);
    set.take(from);
    Outcome outcome;
    while (!set.empty())
        set.advance([&](const Realization&, const Outcome& ended) { outcome = ended; });
    return outcome;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Outcomes of rigid columns over the time of their handing over");
    std::string file;
    std::vector<std::string> settings;
    std::uint64_t count = 512;
    app.add_option("study", file, "study file with rigid contacts")->required()->check(CLI::ExistingFile);
    app.add_option("--set", settings, "KEY=VALUE, overrides a key");
    app.add_option("--realizations", count, "the first ones of the study")->check(CLI::Range(8, 1000000));
    CLI11_PARSE(app, argc, argv);
    settings.emplace_back("outcome.follow=rest");
    const Study study = read_study(file, settings);
    const Experiment experiment(study);
    const std::size_t total = std::min<std::uint64_t>(count, study.total());
    const auto realize = [&](std::size_t i) { return experiment.sampler().realization(i); };

    std::vector<double> when_s(total, -1); // -1: it did not come to it
    in_parallel(std::size_t{0}, total, [&](std::size_t i) {
        const Realization r = realize(i);
        if (const auto h = handed(study, r, 1e300))
            when_s[i] = static_cast<double>(h->watch.steps) * r.step_s;
    });
    fmt::print(
        "{} of {} realizations are handed over; {}\n\n{}",
        std::count_if(when_s.begin(), when_s.end(), [](double t) { return t >= 0; }), total, processor(),
        markdown_head("handed over | collapsed | fallen blocks | first to fall is above the middle | offset of the "
                      "top at the end [m] | end of the fall [s] | set aside"));
    for (const double earlier_s : {0.0, 0.05, 0.1, 0.2, 0.4}) {
        std::vector<std::optional<Outcome>> outcomes(total);
        in_parallel(std::size_t{0}, total, [&](std::size_t i) {
            if (when_s[i] < 0)
                return;
            outcomes[i] = finish(study, *handed(study, realize(i), std::max(0.0, when_s[i] - earlier_s)));
        });
        Mean collapsed, fallen, high, offset, end;
        int invalid = 0;
        for (std::size_t i = 0; i < total; ++i)
            if (outcomes[i]) {
                const Outcome& o = *outcomes[i];
                if (o.state == State::invalid) {
                    ++invalid;
                    continue;
                }
                const bool fell = o.state == State::collapsed;
                collapsed.add(fell);
                if (!fell)
                    continue;
                fallen.add(o.fallen_blocks);
                high.add(2 * o.first_collapse_block > static_cast<int>(o.fall_time_s.size()));
                offset.add(std::fabs(o.residual_top_displacement_m));
                end.add(*std::max_element(o.fall_time_s.begin(), o.fall_time_s.end()));
            }
        const auto text = [](const Mean& m) { return fmt::format("{:.3f} ± {:.3f}", m.value(), m.error()); };
        fmt::print("{}", markdown_row("{:g} s before | {} | {} | {} | {} | {} | {}", earlier_s, text(collapsed),
                                      text(fallen), text(high), text(offset), text(end), invalid));
        std::fflush(stdout);
    }
}
