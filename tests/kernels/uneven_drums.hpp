#pragma once

#include "studies/evidence/verification/model.hpp"

#include <random>
#include <vector>

namespace stylobate::model {

/// Six of the specimen's drums of unequal widths, a little out of line: no two sides are flush.
inline std::vector<Stone> uneven_drums(unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> error(0, 0.0003);
    std::vector<Stone> stones(6, spec_drum);
    for (Stone& stone : stones) {
        stone.width += error(random);
        stone.offset = error(random);
    }
    return stones;
}

} // namespace stylobate::model
