#include "library/trajectory.hpp"

#include "ensemble/planar/planar_poses.hpp"
#include "ensemble/spatial/spatial_poses.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/plot_strip.hpp"
#include "library/inside.hpp"
#include "library/result.hpp"
#include "studies/experiment/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace stylobate::api {

namespace {

[[noreturn]] void refuse_rare()
{
    throw InputError(
        "study.kind = \"rare\": a realization of a chain depends on all previous ones; it cannot be run alone");
}

/// Every channel has a public list: one that is missing does not compile.
constexpr bool has_all_lists(std::span<const inner::TrajectoryChannel> channels)
{
    for (const inner::TrajectoryChannel& channel : channels)
        list_of(channel.name);
    return true;
}
static_assert(has_all_lists(inner::planar_channels) && has_all_lists(inner::spatial_channels));

Trajectory followed(const inner::LoadedStudy& loaded, std::uint64_t index, const std::function<bool()>& go_on = {})
{
    const inner::Study& study = loaded.study();
    if (study.design().chained())
        refuse_rare();
    if (index >= study.total())
        throw InputError(fmt::format("realization {}: the study has realizations 0 to {}", index, study.total() - 1));
    inner::TracedRealization f = inner::trace(loaded.experiment(), index, inner::best_isa(), go_on);
    Trajectory t;
    t.outcome = outcome_of(inner::result_row(study, f.realization, f.outcome));
    t.dimensions = study.structure.dimensions;
    visit_channels(t, [&](const inner::TrajectoryChannel& channel, std::vector<double>& list) {
        list = std::move(f.trajectory[channel.name]);
    });
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        t.fixed.push_back(f.realization.spatial() ? f.realization.space.solids[i].fixed
                                                  : f.realization.blocks[i].fixed);
        t.epistyle.push_back(f.trajectory.role[i] == inner::BlockRole::epistyle);
    }
    t.column = std::move(f.trajectory.column);
    t.name = std::move(f.trajectory.name);
    return t;
}

/// The engine's trajectory.
/// @throws InputError if the structure is in space, or if the arrays do not fit each other
inner::Trajectory drawn_from(const Trajectory& t)
{
    if (t.dimensions != 2)
        throw InputError(fmt::format("realization {}: {}", t.outcome.index, inner::no_motion_in_space));
    inner::Trajectory drawn(inner::planar_channels);
    drawn.index = t.outcome.index;
    visit_channels(t, [&](const inner::TrajectoryChannel& channel, const std::vector<double>& list) {
        drawn[channel.name] = list;
    });
    for (const bool epistyle : t.epistyle)
        drawn.role.push_back(epistyle ? inner::BlockRole::epistyle : inner::BlockRole::drum);
    drawn.column = t.column;
    drawn.name = t.name;
    if (t.time_s.empty() || t.blocks() == 0 || !inner::lists_fit(drawn) || t.fixed.size() != t.blocks())
        throw InputError("a trajectory with arrays of inconsistent sizes");
    return drawn;
}

} // namespace

std::size_t Trajectory::sample_at(double at_s) const
{
    if (time_s.empty())
        throw std::out_of_range("a trajectory without samples");
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), at_s);
    return after == time_s.begin() ? 0 : static_cast<std::size_t>(after - time_s.begin()) - 1;
}

Trajectory replay(const Experiment& experiment, std::uint64_t index)
{
    return translated([&] { return followed(Inside::of(experiment).loaded, index); });
}

Trajectory replay(const Result& result, std::uint64_t index, const std::vector<std::string>& settings,
                  const std::function<bool()>& go_on)
{
    return translated([&] {
        const auto& of = Inside::of(result);
        if (of.study.design().chained()) // before its motions are read
            refuse_rare();
        try {
            return followed(inner::LoadedStudy::from_results(of.study, of.header, of.name, settings), index, go_on);
        } catch (const inner::TraceStopped&) {
            throw Stopped(fmt::format("realization {} was stopped", index));
        }
    });
}

void write_svg(const Trajectory& t, double time_s, const std::filesystem::path& file)
{
    const inner::Trajectory drawn = drawn_from(t);
    const std::size_t n = t.blocks(), sample = t.sample_at(time_s);
    // the frame holds the structure as it stood and as it is
    double left = 0, right = 0, top = 0, bottom = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const inner::Rectangle block = rectangle_of(drawn, sample, i);
        const double reach = block.reach();
        left = std::min({left, block.x - reach, t.rest_x_m[i] - reach});
        right = std::max({right, block.x + reach, t.rest_x_m[i] + reach});
        top = std::max({top, block.y + reach, t.rest_y_m[i] + reach});
        bottom = std::min(bottom, block.y - reach);
    }
    const double margin = 0.05 * std::max(right - left, top - bottom);
    const double scale = 600 / (std::max(right - left, top - bottom) + 2 * margin); // pixels per metre
    const double width = (right - left + 2 * margin) * scale, height = (top - bottom + 2 * margin) * scale;
    const auto px = [&](double metres) { return (metres - left + margin) * scale; };
    const auto py = [&](double metres) { return (top + margin - metres) * scale; };
    std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                                  "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n<title>realization {2}, {3:.3f} s</title>\n"
                                  "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                                  width, height + 24, t.outcome.index, t.time_s[sample]);
    svg += fmt::format("<line x1=\"0\" y1=\"{0:.2f}\" x2=\"{1:.0f}\" y2=\"{0:.2f}\" stroke=\"#555\"/>\n", py(0), width);
    for (std::size_t i = 0; i < n; ++i) {
        std::string points;
        for (const auto& [x, y] : rectangle_of(drawn, sample, i).corners())
            points += fmt::format("{:.2f},{:.2f} ", px(x), py(y));
        points.pop_back();
        svg += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"#333\"/>\n", points,
                           t.fixed[i]      ? "#a89878"
                           : t.epistyle[i] ? "#9db4cc"
                                           : "#e6dcc3");
    }
    svg +=
        fmt::format("<text x=\"6\" y=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"14\">{:.3f} s</text>\n</svg>\n",
                    height + 16, t.time_s[sample]);
    translated([&] { inner::write_whole(file, svg); });
}

void write_strip(const Trajectory& t, const std::filesystem::path& png, const std::optional<std::string>& title)
{
    const inner::Trajectory drawn = drawn_from(t);
    translated([&] {
        inner::plot_strip(drawn, t.outcome.fall_time_s, title.value_or(fmt::format("realization {}", t.outcome.index)),
                          png);
    });
}

} // namespace stylobate::api
