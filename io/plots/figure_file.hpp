#pragma once
/// Figures as picture files.

#include "io/plots/figure_panel.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Writes a picture of one figure below a heading, with its legend.
/// @throws InputError as `write_picture`
void write_figure(const Figure& figure, const std::string& title, const std::string& subtitle,
                  const std::filesystem::path& file, PictureSize size = {});

/// Several figures side by side and below one another, each under its own title; the names of the series stand once
/// above them all, those of the first figure, unless the others have other names: then each has its own.
/// @param columns >= 1   @param unit pixels for each of a page's figure; 0: by the width
void write_figures(const std::vector<Figure>& figures, std::size_t columns, const std::string& title,
                   const std::string& subtitle, const std::filesystem::path& file, PictureSize size = {},
                   double unit = 0);

} // namespace stylobate
