#include "ensemble/study.hpp"

#include <cmath>

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
    }
    return "?";
}

double Axis::value(int i) const
{
    if (i <= 0)
        return from;
    if (i >= count - 1)
        return to;
    // In long double, so that the value is the nearest double whichever version of pow the machine's library picks:
    // the axis is part of a study's identity.
    const long double t = static_cast<long double>(i) / (count - 1);
    const long double a = from;
    const long double b = to;
    return static_cast<double>(spacing == Spacing::log ? a * std::pow(b / a, t) : a + (b - a) * t);
}

} // namespace stylobate
