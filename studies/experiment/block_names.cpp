#include "studies/experiment/block_names.hpp"

#include "ensemble/model/structure.hpp"

namespace stylobate {

std::vector<std::string> block_names(const Study& study)
{
    std::vector<std::string> names;
    for (const PlacedBlock& block : lay_out(study.structure).blocks)
        names.push_back(block.name);
    return names;
}

} // namespace stylobate
