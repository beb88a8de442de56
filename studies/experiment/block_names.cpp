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

std::vector<std::string> bed_names(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const auto name = [&](int block) {
        return block < 0 ? std::string("the ground") : layout.blocks[static_cast<std::size_t>(block)].name;
    };
    std::vector<std::string> names;
    for (const PlacedBed& bed : layout.beds)
        names.push_back(name(bed.upper) + " on " + name(bed.lower));
    return names;
}

} // namespace stylobate
