#pragma once
/// What the checks of plausibility have in common, and those of the structure.

#include "ensemble/numerics/unit_slip.hpp"
#include "ensemble/sampling/plausible.hpp"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <utility>

namespace stylobate::plausible {

constexpr double standard_gravity = 9.80665;

using Finding = std::optional<Implausibility>;
struct Subject {
    const Study& study;
    const StudyFacts& facts;
};

/// The range of an axis, or of what is given in its place.
struct Extent {
    double low = 0, high = 0;
};

/// " Did you mean cm/s2 (1.2 m/s2) or mm/s2 (0.12 m/s2)?": those with which the value is plausible.
std::string meant(double value, std::span<const UnitSlip> slips, double high, const char* unit, double low = 0.05);

template <class... Values>
Implausibility implausible(bool refused, fmt::format_string<Values...> text, Values&&... values)
{
    return {"", refused, fmt::format(text, std::forward<Values>(values)...)};
}

// Of the structure and its contacts.

Finding check_sinkage(const Subject& s);
Finding check_density(const Subject& s);
Finding check_friction(const Subject& s);
Finding check_damping(const Subject& s);
Finding check_stiffness(const Subject& s);
Finding check_size(const Subject& s);
Finding check_spread(const Subject& s);

} // namespace stylobate::plausible
