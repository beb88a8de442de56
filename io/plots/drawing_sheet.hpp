#pragma once
/// A drawing in pixels, by gnuplot.

#include "io/plots/gnuplot.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Where a text stands beside its point.
enum class TextAt { left, center, right };

/// A drawing in pixels, for gnuplot: rectangles, lines, texts, dimension lines. Places are in pixels from the upper
/// left corner of the picture; what comes later lies above.
class DrawingSheet {
public:
    explicit DrawingSheet(PictureSize size) : size_(size) {}

    void rectangle(double left, double top, double right, double bottom, std::string_view fill,
                   std::string_view line = {});
    /// @param fill and line "": none   @param points of its corners, x and y
    void polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill, std::string_view line = {},
                 double width = 0.8);
    /// Lines from point to point.
    void path(const std::vector<std::array<double, 2>>& points, std::string_view colour, double width = 1);
    void line(double x0, double y0, double x1, double y1, std::string_view colour = "#303030", double width = 1);
    /// @param turned upwards, by a right angle
    void text(std::string_view words, double x, double y, double font, TextAt at = TextAt::center,
              std::string_view colour = "#000000", bool turned = false);
    /// A dimension line below a level or above it: its ends are ticks, its text beside it, turned where it would be
    /// wider than the line. @param above whether the text stands above the line
    void across(double x0, double x1, double y, std::string_view words, bool above = false);
    /// A dimension line on the left: its text on its left.
    /// @param turned along the line
    void along(double x, double y0, double y1, std::string_view words, bool turned = false);

    /// Draws what is on the sheet, below a heading.
    void write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const;

    /// The width of a text, about [pixels].
    static double width(std::string_view words, double font);
    /// The largest font up to `most` with which a text fits.
    static double fitting(std::string_view words, double pixels, double most);

private:
    std::string x(double pixels) const;
    std::string y(double pixels) const;
    void tick(double x, double y);

    PictureSize size_;
    int objects_ = 0;
    std::string script_;
};

/// Equal within what a drawing can show.
bool same(double a, double b);

/// "350 kg", "2.1 t"
std::string mass_text(double kg);

/// Runs of neighbours that are alike.
template <class Alike>
std::vector<std::vector<std::size_t>> runs_of(const std::vector<std::size_t>& blocks, const Alike& is_alike)
{
    std::vector<std::vector<std::size_t>> runs;
    for (const std::size_t i : blocks) {
        if (runs.empty() || !is_alike(runs.back().back(), i))
            runs.emplace_back();
        runs.back().push_back(i);
    }
    return runs;
}

} // namespace stylobate
