#pragma once
/// What may be hidden in a virtual campaign: the mechanisms by the names of verdicts, and effects that no list has.

#include "tests/hidden/draws.hpp"
#include "tests/hidden/specimen.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stylobate::hidden {

struct HiddenEffect {
    std::string name;            ///< of a mechanism, or of an effect outside the list
    bool listed = true;          ///< false: the right verdict is "unexplained"
    std::string place;           ///< "joint 0", "block 2", "base", "all"
    std::string parameter;       ///< what `size` is
    double size = 0;             ///< in the unit of the parameter
    bool size_comparable = true; ///< false: the parameter belongs to this laboratory's law alone
    bool is_law = false;         ///< all joints have it: a healthy law, and nothing to be found
    Effects effects;             ///< this effect alone
};

/// Names in the order of their numbers: the mechanisms, then those outside the list.
const std::vector<std::string>& listed_names();
const std::vector<std::string>& outside_names();
/// Other forms of listed mechanisms, which only a wish draws; the effect has the name of its mechanism.
const std::vector<std::string>& variant_names();

/// True if an effect means something under a law and on a specimen.
bool applies(std::string_view name, Law law);
/// True if the table's own sensor would show it, so that it is hidden only where the command alone is known.
bool needs_command(std::string_view name);

/// Draws place and strength of an effect; strengths range from less than the scatter to what the eye sees.
HiddenEffect draw_effect(std::string_view name, const Planned& planned, const Model& model, Draws& draws);

/// All of them at once. @pre no two change the same parameter
Effects together(const std::vector<HiddenEffect>& effects);

} // namespace stylobate::hidden
