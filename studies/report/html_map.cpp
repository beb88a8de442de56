#include "studies/report/html_map.hpp"

#include "io/plots/plot_surface.hpp"

#include <fmt/format.h>

namespace stylobate {

Html map_svg(const SurfaceTable& surface, const std::string& limit)
{
    constexpr PictureSize size{640, 496};
    const FigureLook look{1, true};
    DrawingSheet sheet(size, look.letters());
    const PlotFrame frame = draw_surface(sheet, look, surface, limit, {29, 10, size.width, size.height - 2});
    const std::string name = fmt::format("Map of the probability of {}, {} {} by {} values of PGA", limit,
                                         surface.rows().size(), surface.row_quantity().plural, surface.pga_m_s2.size());
    return Html::ready(fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cells\" data-frame=\"{} {} {} {}\" viewBox=\"0 0 {} {}\" "
        "width=\"{}\" role=\"img\" aria-label=\"{}\" font-family=\"inherit\" font-size=\"13\">\n{}</svg>",
        frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top, size.width, size.height, size.width,
        html_escaped(name), sheet.elements()));
}

} // namespace stylobate
