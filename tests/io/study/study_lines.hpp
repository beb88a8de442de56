#pragma once
/// A study by its lines, for tests of messages that name one.

#include <map>
#include <string>

namespace stylobate {

/// A study whose lines are numbered, so that a test can say which one is wrong.
using Lines = std::map<int, std::string>;

inline Lines surface_lines()
{
    return {{1, "[study]"},
            {2, "kind = \"surface\""},
            {3, "realizations = 8"},
            {4, "[structure]"},
            {5, "blocks = 7"},
            {6, "fixed_blocks = 1"},
            {7, "drum_width_m = 0.048"},
            {8, "drum_height_m = 0.029"},
            {9, "depth_m = 0.048"},
            {10, "drum_mass_kg = 0.1355"},
            {11, "[contact]"},
            {12, "normal_stiffness_n_m2 = 1e8"},
            {13, "friction = 0.68"},
            {14, "[excitation]"},
            {15, "kind = \"harmonic\""},
            {16, "cycles = 8"},
            {17, "[surface]"},
            {18, "frequency_hz = { from = 0.5, to = 8, count = 5, spacing = \"log\" }"},
            {19, "pga_m_s2 = { from = 1, to = 9, count = 3 }"},
            {20, "[perturbation]"},
            {21, "friction = { distribution = \"normal\", cov = 0.10, min = 0.3 }"}};
}

inline std::string joined(const Lines& lines)
{
    std::string text;
    for (const auto& [number, line] : lines)
        text += line + '\n';
    return text;
}

} // namespace stylobate
