#pragma once
/// Figures of a page, drawn as SVG.

#include "io/plots/figure.hpp"
#include "studies/report/html.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// The figure without its title and caption: axes, series, and a legend if a series has a name; and its values for the
/// script of the page, which shows them under the pointer and switches series. Bars of several series stand side by
/// side where they meet. What is not finite, or not positive on a logarithmic axis, is left out; without any point
/// there are empty axes with a note. Lines of more samples than the width has pixels are drawn by the least and the
/// greatest of neighbours.
/// @param height of the plot alone [px]
Html figure_svg(const Figure& figure, double height = 330);

/// A bar from 0 for a cell of a table, with a mark: how large a gain is, and how large chance makes it.
/// @param most what the full width stands for, > 0
Html bar_svg(double value, std::optional<double> mark, double most);

/// A text of a drawing at a place [px]. @param anchor "start", "middle" or "end"   @param more attributes, with a space
/// before each
std::string svg_text(double x, double y, const char* anchor, const std::string& text, const std::string& more = "");

} // namespace stylobate
