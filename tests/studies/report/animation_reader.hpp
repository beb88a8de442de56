#pragma once
/// Animations of a page, read back by another reader than that of the page.

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace stylobate {

inline std::vector<unsigned> decoded_base64(const std::string& base64)
{
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned> bytes;
    unsigned bits = 0, held = 0;
    for (const char c : base64) {
        if (c == '=')
            break;
        bits = bits << 6 | static_cast<unsigned>(letters.find(c));
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(bits >> held & 255);
        }
    }
    return bytes;
}

/// What the header of animation.hpp and player.js say, step by step.
struct ReadBack {
    std::vector<std::array<double, 2>> half_size_px;
    std::vector<std::vector<double>> x_px, y_px, theta_rad; ///< (blocks)(samples)
    std::vector<double> base_px;
};

/// @param data base64   @param quantum_px of the drawing
inline ReadBack read_back(const std::string& data, std::size_t samples, std::size_t blocks, double quantum_px = 0.1)
{
    const std::vector<unsigned> bytes = decoded_base64(data);
    std::size_t at = 0;
    const auto number = [&] {
        std::uint64_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            const unsigned byte = bytes.at(at++);
            value |= static_cast<std::uint64_t>(byte & 127) << shift;
            if (byte < 128)
                return value;
        }
    };
    const auto signed_of = [](std::uint64_t code) {
        const double half = static_cast<double>(code) / 2;
        return code % 2 == 0 ? half : -(half + 0.5);
    };
    const auto series = [&] {
        std::vector<double> values{signed_of(number())};
        while (values.size() < samples) {
            const std::uint64_t code = number();
            if (code != 0) {
                values.push_back(values.back() + signed_of(code));
                continue;
            }
            for (std::uint64_t run = number(); run > 0; --run)
                values.push_back(values.back());
        }
        if (values.size() != samples)
            throw std::runtime_error("a run is too long");
        return values;
    };
    const auto scaled = [](std::vector<double> values, double by) {
        for (double& v : values)
            v *= by;
        return values;
    };
    ReadBack back;
    for (std::size_t b = 0; b < blocks; ++b) {
        const auto width = static_cast<double>(number());
        back.half_size_px.push_back({quantum_px * width, quantum_px * static_cast<double>(number())});
    }
    for (std::size_t b = 0; b < blocks; ++b) {
        back.x_px.push_back(scaled(series(), quantum_px));
        back.y_px.push_back(scaled(series(), quantum_px));
        back.theta_rad.push_back(
            scaled(series(), quantum_px / std::hypot(back.half_size_px[b][0], back.half_size_px[b][1])));
    }
    back.base_px = scaled(series(), quantum_px);
    if (at != bytes.size())
        throw std::runtime_error("something is left");
    return back;
}

} // namespace stylobate
