#pragma once
/// A drawing in pixels, as SVG.

#include "io/plots/picture_file.hpp"
#include "io/plots/text_width.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Where a text stands beside its point.
enum class TextAt { left, center, right };

/// Shapes of marks. Series that differ in colour differ in shape too.
enum class MarkShape { circle, square, triangle, diamond, wedge, pentagon, cross };
constexpr std::size_t marks = 7;

/// Where a text lies [px].
struct TextBox {
    std::string words;
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// A drawing in pixels: rectangles, lines, marks, texts, dimension lines. Places are in pixels from the upper left
/// corner; what comes later lies above. Colours are "#rrggbb", or of a page "var(--name)" of its style; "": none.
class DrawingSheet {
public:
    /// @param letters height of the type that stands in most texts [px]
    explicit DrawingSheet(PictureSize size, double letters = 13) : size_(size), letters_(letters) {}

    void rectangle(double left, double top, double right, double bottom, std::string_view fill,
                   std::string_view line = {}, double opacity = 1, double width = 1.6);
    /// A rectangle without a line, which scripts may paint anew. @param attributes of its element: "fill=\"#440154\""
    void cell(double left, double top, double right, double bottom, std::string_view attributes);
    /// @param fill and line "": none   @param points of its corners, x and y
    void polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill, std::string_view line = {},
                 double width = 1.6, double opacity = 1);
    /// Lines from point to point; a point that is not finite leaves a gap.
    /// @param width [px]   @param dashes lengths of dashes and gaps [px], "8 5"; "": none
    void path(const std::vector<std::array<double, 2>>& points, std::string_view colour, double width = 2,
              std::string_view dashes = {});
    void line(double x0, double y0, double x1, double y1, std::string_view colour = "#303030", double width = 2);
    /// @param radius [px]
    void mark(MarkShape shape, double x, double y, double radius, std::string_view colour);
    /// @param font height of the type [px]   @param turned upwards, by a right angle, about its point
    /// @param colour "": the page's ink
    void text(std::string_view words, double x, double y, double font, TextAt at = TextAt::center,
              std::string_view colour = "#000000", bool turned = false);
    /// A text that ends at its point and climbs by 35 degrees, for long names below an axis.
    void slanted_text(std::string_view words, double x, double y, double font, std::string_view colour = "#000000");
    /// A text on a white ground, over lines and cells.
    void boxed_text(std::string_view words, double x, double y, double font);
    /// A dimension line below a level or above it: its ends are ticks, its text beside it, turned where it would be
    /// wider than the line. @param above whether the text stands above the line
    void across(double x0, double x1, double y, std::string_view words, bool above = false);
    /// A dimension line on the left: its text on its left.
    /// @param turned along the line
    void along(double x, double y0, double y1, std::string_view words, bool turned = false);

    /// What follows, up to `close`, is one group. @param attributes of its element: "class=\"key\""
    void open(std::string_view attributes);
    /// What follows, up to `close`, is seen within a rectangle only.
    void clip(double left, double top, double right, double bottom);
    void close();

    /// The title and the subtitle at the head of a picture, as large as its width lets them be.
    /// @returns where the room below them begins [px]
    double heading(std::string_view title, std::string_view subtitle);
    /// A picture below a heading. @throws InputError as `write_picture`
    void write(std::string_view title, std::string_view subtitle, const std::filesystem::path& file) const;
    /// A picture as it is. @throws InputError as `write_picture`
    void write(const std::filesystem::path& file) const;

    /// The whole sheet as a document of SVG, and as an element of another document. @param attributes of the element
    std::string svg() const;
    std::string element(std::string_view attributes = {}) const;
    /// For drawings whose height follows from what is on them.
    void set_height(int height) { size_.height = height; }
    /// What is on the sheet, as elements of SVG.
    const std::string& elements() const { return elements_; }
    /// Where the texts on the sheet lie, by `text_width`.
    const std::vector<TextBox>& texts() const { return texts_; }
    PictureSize size() const { return size_; }

    /// The width of a text [px].
    static double width(std::string_view words, double font) { return font * text_width(words); }
    /// The largest font up to `most` with which a text fits [px].
    static double fitting(std::string_view words, double pixels, double most);

private:
    void tick(double x, double y);
    void keep_box(std::string_view words, double x, double y, double font, TextAt at, bool turned);
    void add_text(std::string_view words, double x, double baseline, double font, TextAt at, std::string_view colour,
                  const std::string& more);

    PictureSize size_;
    double letters_;
    std::string elements_;
    std::vector<TextBox> texts_;
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
