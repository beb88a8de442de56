#include "studies/kinds/single/single_kind.hpp"

#include "ensemble/experiment.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/store/result_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

std::uint64_t trajectory_bytes(int dimensions, std::uint64_t samples, std::uint64_t blocks)
{
    std::uint64_t values = 1; // the time
    for (const TrajectoryChannel& channel : trajectory_channels(dimensions))
        values += channel.of == ListOf::times ? 1 : channel.of == ListOf::poses ? blocks : 0;
    return samples * values * sizeof(double);
}

KeptTrajectories plan_trajectories(const Experiment& experiment, const std::string& file)
{
    const Study& study = experiment.study();
    const OutputSpec& output = study.output;
    const std::uint64_t total = study.total();
    constexpr std::uint64_t looked_at = 32;
    double end_s = 0;
    std::uint64_t blocks = 0;
    for (std::uint64_t index = 0; index < std::min(total, looked_at); ++index) {
        const Realization r = experiment.sampler().realization(index);
        end_s = std::max(end_s, longest_s(experiment, r));
        blocks = static_cast<std::uint64_t>(r.spatial() ? r.space.drums : r.drums);
    }
    KeptTrajectories kept;
    const auto samples = static_cast<std::uint64_t>(std::ceil(end_s * output.trajectory_rate_hz)) + 1;
    kept.each_mb = static_cast<double>(trajectory_bytes(study.structure.dimensions, samples, blocks)) / 1e6;
    const auto size = [&](std::uint64_t count) { return static_cast<double>(count) * kept.each_mb; };
    const auto refuse = [&](std::uint64_t count, const std::string& otherwise) {
        throw InputError(
            file, 0,
            fmt::format("the trajectories of {} of {} realizations need about {:.3g} MB at output.trajectory_rate_hz = "
                        "{}, more than output.most_mb = {}.\n  Give output.most_mb = {:.0f}, a lower rate, or {}.",
                        count, total, size(count), output.trajectory_rate_hz, output.most_mb, std::ceil(size(count)),
                        otherwise));
    };
    if (output.trajectories) {
        kept.count = std::min(*output.trajectories, total);
        if (size(kept.count) > output.most_mb)
            refuse(kept.count, "output.trajectories = \"fit\" for as many as fit");
    } else {
        kept.count = std::min(total, static_cast<std::uint64_t>(output.most_mb / kept.each_mb));
        if (kept.count == 0)
            refuse(1, "output.trajectories = 0 for none");
    }
    kept.mb = size(kept.count);

    constexpr double worth_saying_mb = 10;
    if (kept.count < total)
        kept.words = fmt::format("Trajectories are kept of the first {} of {} realizations: about {:.3g} of {:.3g} MB "
                                 "at {} Hz. `stylobate replay` computes that of any other realization.{}",
                                 kept.count, total, kept.mb, size(total), output.trajectory_rate_hz,
                                 output.trajectories
                                     ? std::string()
                                     : fmt::format(" For all: output.trajectories = \"all\", output.most_mb = {:.0f}.",
                                                   std::ceil(size(total))));
    else if (kept.mb > worth_saying_mb)
        kept.words = fmt::format("Trajectories of {} realizations at {} Hz: at most about {:.3g} MB.", total,
                                 output.trajectory_rate_hz, kept.mb);
    return kept;
}

} // namespace stylobate
