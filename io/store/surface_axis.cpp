#include "io/store/surface_axis.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>

namespace stylobate {
namespace {

/// Standard deviation over mean of the steps between the values.
double unevenness(const std::vector<double>& values, bool log)
{
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double step = log ? std::log(values[i] / values[i - 1]) : values[i] - values[i - 1];
        sum += step;
        squares += step * step;
    }
    const double count = static_cast<double>(values.size() - 1);
    return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))) / (sum / count);
}

} // namespace

double CellAxis::scaled(double value) const
{
    return log ? std::log(value) : value;
}

double CellAxis::unscaled(double position) const
{
    return log ? std::exp(position) : position;
}

double CellAxis::in_unit(double value) const
{
    const double first = scaled(edges.front()), last = scaled(edges.back());
    return (scaled(value) - first) / (last - first);
}

double CellAxis::from_unit(double unit) const
{
    const double first = scaled(edges.front()), last = scaled(edges.back());
    return unscaled(first + unit * (last - first));
}

std::size_t CellAxis::nearest(double value) const
{
    const auto distance = [&](double one) { return std::abs(scaled(one) - scaled(value)); };
    return static_cast<std::size_t>(
        std::min_element(values.begin(), values.end(), [&](double a, double b) { return distance(a) < distance(b); }) -
        values.begin());
}

CellAxis make_cell_axis(const std::vector<double>& values, const std::string& name)
{
    if (values.empty())
        throw InputError(fmt::format("{} has no value: these results have no surface to draw.\n  Draw the results of a "
                                     "study with kind = \"surface\".",
                                     name));
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]) || (i > 0 && !(values[i] > values[i - 1])))
            throw InputError(fmt::format("{}[{}] = {} does not ascend: the results are damaged.\n  Run the study again "
                                         "into a new file.",
                                         name, i, values[i]));
    CellAxis axis;
    axis.values = values;
    axis.log = values.size() > 2 && values.front() > 0 && unevenness(values, true) < unevenness(values, false);

    const std::size_t count = values.size();
    std::vector<double> positions(count);
    std::transform(values.begin(), values.end(), positions.begin(), [&](double v) { return axis.scaled(v); });
    // A lone value gets a cell of a tenth of itself.
    const double lone = values[0] != 0 ? std::abs(values[0]) / 20 : 0.5;
    const double first = count > 1 ? (positions[1] - positions[0]) / 2 : lone;
    const double last = count > 1 ? (positions[count - 1] - positions[count - 2]) / 2 : lone;
    // Half a wide step below the first value may lie below zero, where no frequency and no acceleration is.
    const double lowest = axis.unscaled(positions.front() - first);
    axis.edges.push_back(values.front() > 0 ? std::max(lowest, 0.0) : lowest);
    for (std::size_t i = 1; i < count; ++i)
        axis.edges.push_back(axis.unscaled((positions[i - 1] + positions[i]) / 2));
    axis.edges.push_back(axis.unscaled(positions.back() + last));
    return axis;
}

std::string describe_interval(const std::string& interval)
{
    if (interval == "none")
        return "no interval: fewer than 8 different motions";
    const std::size_t blank = interval.find(' ');
    if (blank == std::string::npos || blank == 0)
        return interval;
    double level = 0; // not by strtod: the locale of a program that uses the library may have commas
    const char* const all = interval.data() + interval.size();
    const auto [end, error] = std::from_chars(interval.data() + blank + 1, all, level);
    if (error != std::errc{} || end != all || !(level > 0 && level < 1))
        return interval;
    std::string name = interval.substr(0, blank);
    if (name == "motions")
        return fmt::format("{:.6g} % interval, clustered by motion", 100 * level);
    if (name != "adaptive" && name != "bootstrap" && name != "resampling") // the others are people
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return fmt::format("{:.6g} % {} interval", 100 * level, name);
}

std::string describe_realizations(const SurfaceTable& surface)
{
    const std::size_t nf = surface.rows().size();
    const std::size_t np = surface.pga_m_s2.size();
    const std::size_t cells = surface.cells();
    if (cells == 0 || surface.trials.size() != cells || surface.collapses.size() != cells ||
        surface.probability.size() != cells || surface.lower.size() != cells || surface.upper.size() != cells)
        throw InputError(
            fmt::format("the surface of {} x {} cells has tables of other sizes: the results are damaged, or not those "
                        "of a surface.\n  Draw the finished results of a study with kind = \"surface\".",
                        nf, np));
    const std::uint64_t all = std::accumulate(surface.trials.begin(), surface.trials.end(), std::uint64_t{0});
    const auto [least, most] = std::minmax_element(surface.trials.begin(), surface.trials.end());
    return fmt::format("{} realizations, {} in each of {} × {} cells", all,
                       *least == *most ? fmt::format("{}", *least) : fmt::format("{} to {}", *least, *most), nf, np);
}

} // namespace stylobate
