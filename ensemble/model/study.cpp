#include "ensemble/model/study.hpp"

#include "ensemble/numerics/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {

const char* to_string(Quantity quantity)
{
    switch (quantity) {
    case Quantity::friction:
        return "friction";
    case Quantity::normal_stiffness:
        return "normal_stiffness";
    case Quantity::tangential_stiffness:
        return "tangential_stiffness";
    case Quantity::damping_ratio:
        return "damping_ratio";
    case Quantity::drum_width:
        return "drum_width";
    case Quantity::drum_height:
        return "drum_height";
    case Quantity::drum_offset:
        return "drum_offset";
    case Quantity::density:
        return "density";
    case Quantity::tilt:
        return "tilt";
    case Quantity::phase:
        return "phase";
    case Quantity::pulse_frequency:
        return "pulse_frequency";
    case Quantity::pulse_gamma:
        return "pulse_gamma";
    case Quantity::direction:
        return "direction";
    case Quantity::drum_offset_z:
        return "drum_offset_z";
    case Quantity::tilt_x:
        return "tilt_x";
    }
    return "?";
}

double Axis::value(int i) const
{
    if (i <= 0)
        return from;
    if (i >= count - 1)
        return to;
    // In twice the digits, so that the value is the nearest double on every processor: the axis is part of a study's
    // identity.
    const DoublePair t = DoublePair(i) / (count - 1), a = from, b = to;
    if (spacing != Spacing::log)
        return (a + (b - a) * t).rounded();
    return (a * exp_of((log_pair(to) - log_pair(from)) * t)).rounded();
}

double usual_trajectory_rate_hz(const Study& study)
{
    double shortest = 0; // half a diagonal [m]
    const auto meet = [&](double width, double height) {
        const double half = std::hypot(width, height) / 2;
        shortest = shortest == 0 ? half : std::min(shortest, half);
    };
    for (const ColumnSpec& column : study.structure.columns)
        for (std::size_t i = static_cast<std::size_t>(column.fixed_blocks); i < column.drums.size(); ++i)
            meet(column.drums[i].width_m, column.drums[i].height_m);
    for (const EpistyleSpec& epistyle : study.structure.epistyles)
        meet(epistyle.length_m, epistyle.height_m);

    double rate = 100;
    if (shortest > 0)
        rate = std::max(rate, 100 * std::sqrt(0.75 * study.structure.gravity_m_s2 / shortest) / (2 * std::numbers::pi));
    const ExcitationSpec& e = study.excitation;
    rate = std::max(rate, 20 * std::max({e.frequency_hz, e.from_hz, e.to_hz}));
    if (const Axis* axis = study.design().frequency_hz)
        rate = std::max(rate, 20 * std::max(axis->from, axis->to));
    return 10 * std::ceil(rate / 10 - 1e-9);
}

} // namespace stylobate
