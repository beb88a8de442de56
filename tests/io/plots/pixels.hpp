#pragma once
/// A picture decoded: its pixels, and where its colours are.

#include "tests/io/store/export_cases.hpp"

#include <array>
#include <map>
#include <vector>
#include <zlib.h>

namespace stylobate {

struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t colours = 0;
    std::map<std::uint32_t, std::size_t> count; ///< of each 0xRRGGBB
    std::vector<std::uint32_t> colour;          ///< 0xRRGGBB (height x width), from the top
};

/// Decodes a PNG with 8 bits per channel, RGB or RGBA, not interlaced.
inline Pixels decode(const std::filesystem::path& file)
{
    const std::string bytes = read_file(file);
    Pixels pixels;
    if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        ADD_FAILURE() << file << " is no PNG";
        return pixels;
    }
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
        return value;
    };
    std::string packed;
    std::size_t channels = 0;
    for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + number(at)) {
        const std::string kind = bytes.substr(at + 4, 4);
        if (kind == "IHDR") {
            pixels.width = number(at + 8);
            pixels.height = number(at + 12);
            EXPECT_EQ(bytes[at + 16], 8);
            channels = bytes[at + 17] == 2 ? 3 : 4;
            EXPECT_EQ(bytes[at + 20], 0);
        } else if (kind == "IDAT") {
            packed += bytes.substr(at + 8, number(at));
        }
    }
    const std::size_t stride = pixels.width * channels;
    std::vector<unsigned char> raw((stride + 1) * pixels.height);
    uLongf length = raw.size();
    EXPECT_EQ(uncompress(raw.data(), &length, reinterpret_cast<const Bytef*>(packed.data()), packed.size()), Z_OK);
    EXPECT_EQ(length, raw.size());
    std::vector<unsigned char> above(stride, 0);
    std::vector<unsigned char> row(stride, 0);
    for (std::size_t y = 0; y < pixels.height; ++y) {
        const unsigned char* line = raw.data() + y * (stride + 1);
        for (std::size_t k = 0; k < stride; ++k) {
            const int a = k < channels ? 0 : row[k - channels];
            const int b = above[k];
            const int c = k < channels ? 0 : above[k - channels];
            const int p = a + b - c;
            const int paeth = std::abs(p - a) <= std::abs(p - b) && std::abs(p - a) <= std::abs(p - c) ? a
                              : std::abs(p - b) <= std::abs(p - c)                                     ? b
                                                                                                       : c;
            const std::array<int, 5> predicted{0, a, b, (a + b) / 2, paeth};
            row[k] = static_cast<unsigned char>(line[k + 1] + predicted.at(line[0]));
        }
        for (std::size_t k = 0; k < stride; k += channels)
            pixels.colour.push_back(static_cast<std::uint32_t>(row[k] << 16 | row[k + 1] << 8 | row[k + 2]));
        above = row;
    }
    for (const std::uint32_t colour : pixels.colour)
        ++pixels.count[colour];
    pixels.colours = pixels.count.size();
    return pixels;
}

inline bool similar(std::uint32_t a, std::uint32_t b, int tolerance)
{
    for (const int shift : {0, 8, 16})
        if (std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)) > tolerance)
            return false;
    return true;
}

/// Share of the picture in colours within `tolerance` of one.
inline double share(const Pixels& pixels, std::uint32_t colour, int tolerance)
{
    std::size_t sum = 0;
    for (const auto& [found, count] : pixels.count)
        sum += similar(found, colour, tolerance) ? count : 0;
    return static_cast<double>(sum) / (static_cast<double>(pixels.width) * static_cast<double>(pixels.height));
}

/// Where one colour is in a picture, in pixels.
struct Extent {
    double left = 1e9;
    double right = 0;
    double top = 1e9;
    double bottom = 0;
    double lowest_x = 0; ///< where it reaches lowest
    double area = 0;
};

inline Extent extent(const Pixels& pixels, std::uint32_t colour)
{
    Extent e;
    for (std::size_t k = 0; k < pixels.colour.size(); ++k) {
        if (!similar(pixels.colour[k], colour, 3))
            continue;
        const auto x = static_cast<double>(k % pixels.width);
        const auto row = k / pixels.width;
        const auto y = static_cast<double>(row);
        e.left = std::min(e.left, x);
        e.right = std::max(e.right, x + 1);
        e.top = std::min(e.top, y);
        if (y + 1 > e.bottom)
            e.lowest_x = x;
        e.bottom = std::max(e.bottom, y + 1);
        e.area += 1;
    }
    return e;
}

} // namespace stylobate
