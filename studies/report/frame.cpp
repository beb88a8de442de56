#include "studies/report/frame.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

Frame::Frame(int width, int height, Rgb paper) : width_(width), height_(height)
{
    bytes_.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int i = 0; i < width * height; ++i)
        for (const std::uint8_t part : {paper.r, paper.g, paper.b})
            bytes_ += static_cast<char>(part);
}

Rgb Frame::at(int x, int y) const
{
    const auto i = 3 * static_cast<std::size_t>(y * width_ + x);
    const auto part = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes_[i + k]); };
    return {part(0), part(1), part(2)};
}

void Frame::fill(const std::vector<FramePoint>& corners, Rgb colour)
{
    if (corners.size() < 3)
        return;
    double left = width_, right = 0, top = height_, bottom = 0, area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const FramePoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
        left = std::min(left, a.x);
        right = std::max(right, a.x);
        top = std::min(top, a.y);
        bottom = std::max(bottom, a.y);
        area += a.x * b.y - b.x * a.y;
    }
    const double sense = area < 0 ? -1 : 1;
    const auto inside = [&](double x, double y) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const FramePoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
            if (sense * ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) < 0)
                return false;
        }
        return true;
    };
    constexpr std::array<double, 2> within{0.25, 0.75};
    const auto pixel = [](double value, int most) { return static_cast<int>(std::clamp(value, 0.0, most * 1.0)); };
    for (int y = pixel(std::floor(top), height_); y < pixel(std::ceil(bottom), height_); ++y)
        for (int x = pixel(std::floor(left), width_); x < pixel(std::ceil(right), width_); ++x) {
            int covered = 0;
            for (const double dy : within)
                for (const double dx : within)
                    covered += inside(x + dx, y + dy);
            if (covered == 0)
                continue;
            const Rgb before = at(x, y);
            const auto i = 3 * static_cast<std::size_t>(y * width_ + x);
            const auto mixed = [&](int old, int part) {
                return static_cast<char>((old * (4 - covered) + part * covered + 2) / 4);
            };
            bytes_[i] = mixed(before.r, colour.r);
            bytes_[i + 1] = mixed(before.g, colour.g);
            bytes_[i + 2] = mixed(before.b, colour.b);
        }
}

void Frame::line(FramePoint from, FramePoint to, double width, Rgb colour)
{
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length == 0)
        return;
    const double nx = -(to.y - from.y) / length * width / 2, ny = (to.x - from.x) / length * width / 2;
    fill({{from.x + nx, from.y + ny}, {to.x + nx, to.y + ny}, {to.x - nx, to.y - ny}, {from.x - nx, from.y - ny}},
         colour);
}

} // namespace stylobate
