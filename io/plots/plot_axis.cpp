#include "io/plots/plot_axis.hpp"

#include "ensemble/model/input_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

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

/// Tics of a logarithmic axis: 1, 2, 5 of each decade, all digits if that gives fewer than three labels.
std::string log_tics(char letter, double from, double to)
{
    std::string tics;
    const auto add = [&](std::array<bool, 10> labelled) {
        int labels = 0;
        tics.clear();
        for (int exponent = static_cast<int>(std::floor(std::log10(from))); std::pow(10.0, exponent) <= to; ++exponent)
            for (std::size_t digit = 1; digit <= 9; ++digit) {
                // From its text, so that 0.3 is 0.3.
                const double value = std::stod(fmt::format("{}e{}", digit, exponent));
                if (value < from || value > to)
                    continue;
                labels += labelled[digit] ? 1 : 0;
                tics += labelled[digit] ? fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", value, value)
                                        : fmt::format("{}'' {} 1", tics.empty() ? "" : ", ", value);
            }
        return labels;
    };
    if (add({false, true, true, false, false, true, false, false, false, false}) < 3)
        add({false, true, true, true, true, true, true, true, true, true});
    // An axis within one digit has no such tic: gnuplot's own then.
    return tics.empty() ? std::string() : fmt::format("set {}tics ({})\n", letter, tics);
}

} // namespace

double PlotAxis::scaled(double value) const
{
    return log ? std::log(value) : value;
}

double PlotAxis::unscaled(double position) const
{
    return log ? std::exp(position) : position;
}

double PlotAxis::in_unit(double value) const
{
    const double first = scaled(edges.front()), last = scaled(edges.back());
    return (scaled(value) - first) / (last - first);
}

double PlotAxis::from_unit(double unit) const
{
    const double first = scaled(edges.front()), last = scaled(edges.back());
    return unscaled(first + unit * (last - first));
}

std::string PlotAxis::commands(char letter) const
{
    const std::string range = fmt::format("set {}range [{}:{}]\n", letter, edges.front(), edges.back());
    if (!log)
        return range;
    return fmt::format("set logscale {}\n", letter) + range + log_tics(letter, edges.front(), edges.back());
}

PlotAxis make_plot_axis(const std::vector<double>& values, const std::string& name)
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
    PlotAxis axis;
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

} // namespace stylobate
