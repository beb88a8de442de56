#include "studies/decisions/risk/risk.hpp"

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
    for (const StateRisk* s : all)
        if (s->state == "collapse")
            return *s;
    return *all.back();
}

} // namespace stylobate
