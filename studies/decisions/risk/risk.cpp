#include "studies/decisions/risk/risk.hpp"

#include "studies/decisions/risk/risk_change.hpp"

#include <algorithm>

namespace stylobate {

std::vector<const StateRisk*> Risk::chosen() const
{
    std::vector<const StateRisk*> found;
    for (const StateRisk& s : states)
        if (s.chosen)
            found.push_back(&s);
    return found;
}

const StateRisk& Risk::principal() const
{
    const auto all = chosen();
    const auto collapse = std::ranges::find(all, "collapse", &StateRisk::state);
    return collapse == all.end() ? *all.back() : **collapse;
}

const char* StateChange::verdict() const
{
    return !determined                        ? "not determined"
           : change.frequency.total.upper < 0 ? "lower"
           : change.frequency.total.lower > 0 ? "higher"
                                              : "undecided";
}

const StateChange& VariantChange::principal() const
{
    const auto collapse = std::ranges::find(states, "collapse", &StateChange::state);
    return collapse == states.end() ? states.back() : *collapse;
}

} // namespace stylobate
