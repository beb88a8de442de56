#include "studies/experiment/trajectory.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/plot_strip.hpp"
#include "library/inside.hpp"
#include "library/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stylobate::api {

namespace {

[[noreturn]] void refuse_rare()
{
    throw InputError(
        "study.kind = \"rare\": a realization of a chain depends on all previous ones; it cannot be run alone");
}

/// The lists of numbers of a trajectory of the engine or of the library.
template <class From, class To>
void copy_lists(const From& from, To& to)
{
    inner::visit_lists<From, To>([&](auto, auto, auto, auto field, auto its_field) { to.*its_field = from.*field; });
}

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
    copy_lists(f.trajectory, t);
    for (std::size_t i = 0; i < t.blocks(); ++i) {
        t.fixed.push_back(f.realization.blocks[i].fixed);
        t.epistyle.push_back(f.trajectory.role[i] == inner::BlockRole::epistyle);
    }
    t.column = std::move(f.trajectory.column);
    t.name = std::move(f.trajectory.name);
    return t;
}

/// @throws InputError if the arrays of a trajectory do not fit each other
void check(const Trajectory& t)
{
    const std::size_t n = t.blocks();
    if (t.time_s.empty() || n == 0 || !inner::lists_fit(t) || t.fixed.size() != n || t.epistyle.size() != n ||
        t.column.size() != n)
        throw InputError("a trajectory with arrays of inconsistent sizes");
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
    check(t);
    const std::size_t n = t.blocks(), sample = t.sample_at(time_s);
    const double* x = &t.x_m[sample * n];
    const double* y = &t.y_m[sample * n];
    const double* theta = &t.theta_rad[sample * n];
    // the frame holds the structure as it stood and as it is
    double left = 0, right = 0, top = 0, bottom = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double reach = std::hypot(t.half_width_m[i], t.half_height_m[i]);
        left = std::min({left, x[i] - reach, t.rest_x_m[i] - reach});
        right = std::max({right, x[i] + reach, t.rest_x_m[i] + reach});
        top = std::max({top, y[i] + reach, t.rest_y_m[i] + reach});
        bottom = std::min(bottom, y[i] - reach);
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
        const double c = std::cos(theta[i]), s = std::sin(theta[i]);
        std::string points;
        for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            const double u = a * t.half_width_m[i], v = b * t.half_height_m[i];
            points += fmt::format("{:.2f},{:.2f} ", px(x[i] + c * u - s * v), py(y[i] + s * u + c * v));
        }
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

void write_strip(const Trajectory& t, const std::filesystem::path& png, const std::string& title)
{
    check(t);
    inner::Trajectory strip;
    strip.index = t.outcome.index;
    copy_lists(t, strip);
    strip.name = t.name;
    strip.column = t.column;
    for (const bool epistyle : t.epistyle)
        strip.role.push_back(epistyle ? inner::BlockRole::epistyle : inner::BlockRole::drum);
    translated([&] {
        inner::plot_strip(strip, t.outcome.fall_time_s,
                          title.empty() ? fmt::format("realization {}", t.outcome.index) : title, png);
    });
}

} // namespace stylobate::api
