#pragma once
/// Pixels of a film: filled polygons and lines, drawn without another library.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

struct FramePoint {
    double x = 0, y = 0; ///< [px], y downwards
};

class Frame {
public:
    Frame(int width, int height, Rgb paper);

    int width() const { return width_; }
    int height() const { return height_; }
    Rgb at(int x, int y) const;
    /// A convex polygon, its corners in either sense; edges are smoothed by four samples a pixel.
    void fill(const std::vector<FramePoint>& corners, Rgb colour);
    void line(FramePoint from, FramePoint to, double width, Rgb colour);

    /// (width x height x 3) row by row from above: red, green, blue.
    const std::string& bytes() const { return bytes_; }

private:
    int width_, height_;
    std::string bytes_;
};

} // namespace stylobate
