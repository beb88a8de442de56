#pragma once
/// The structure of a study on a page: to scale, with its interventions marked.

#include "ensemble/model/study.hpp"
#include "studies/report/html.hpp"

#include <string>

namespace stylobate {

/// The structure at rest, to scale (SVG): in the plane from the front; in space also from above, and from the side
/// where that differs, with taper, capital and the shapes of all blocks. Mechanisms at joints and blocks, beds that are
/// not those of [contact], and in a comparison blocks of other sizes or masses, are marked by colours, which are named
/// below it.
/// @param base of a comparison: only what it does not have is marked; null: all is
Html structure_sketch(const Study& study, const Study* base = nullptr);

/// "The structure at rest, to scale, from the front and from above; fixed blocks are darker."
std::string sketch_caption(const Study& study);

} // namespace stylobate
