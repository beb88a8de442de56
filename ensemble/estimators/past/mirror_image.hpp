#pragma once
/// A structure seen from behind: shaking of the other sense leaves it in the mirror image of the state.
///
/// The state of a block or joint is then that of the one in its place on the other side, with the other sign. Of one
/// column it is its own; of a colonnade the columns change places.

#include "ensemble/model/structure.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

/// The block and the bed that stand in the place of each.
struct MirrorImage {
    std::vector<std::size_t> blocks, beds; ///< of `Layout`
};

/// Sizes, masses and places have to be alike to 1e-6; offsets of drums within a column do not count. Nothing: seen from
/// behind it is another structure.
std::optional<MirrorImage> mirror_image(const Layout& layout);

} // namespace stylobate
