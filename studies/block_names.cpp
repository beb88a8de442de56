#include "studies/block_names.hpp"

#include <fmt/format.h>

namespace stylobate {

std::vector<std::string> block_names(const Study& study)
{
    std::vector<std::string> names;
    for (int i = 0; i < study.structure.blocks; ++i)
        names.push_back(fmt::format("drum {}", i));
    return names;
}

} // namespace stylobate
