#include "studies/evidence/measured/parts/split.hpp"

#include <iterator>
#include <set>

namespace stylobate::measured {

std::vector<bool> fitting_half(const std::vector<std::string>& group)
{
    const std::set<std::string> names(group.begin(), group.end());
    std::vector<bool> fits;
    for (const std::string& name : group)
        fits.push_back(std::distance(names.begin(), names.find(name)) % 2 == 0);
    return fits;
}

} // namespace stylobate::measured
