#pragma once
/// The map of a surface on a page.

#include "io/store/result_store.hpp"
#include "studies/report/html.hpp"

#include <string>

namespace stylobate {

/// For the script of the page (map.js) the drawing has left, top, width and height of its frame in `data-frame`; the
/// rest is as `draw_surface` says.
/// @throws InputError as `draw_surface`
Html map_svg(const SurfaceTable& surface, const std::string& limit = "collapse");

} // namespace stylobate
