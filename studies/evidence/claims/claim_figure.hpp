#pragma once
/// The figures of a claim file, drawn by gnuplot: curves with intervals.

#include "studies/evidence/claims/estimate.hpp"

#include <filesystem>

namespace stylobate::claims {

/// One curve: points in order; where a number is unknown or beyond its axis there is none.
struct Curve {
    std::string label;
    struct Point {
        double x = 0;
        Estimate y;
    };
    std::vector<Point> points;
};

/// The curves of a figure: one for each variant and measure, and for each value of the coordinate that is not drawn
/// where the window holds several.
std::vector<Curve> curves_of(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples);

/// @throws InputError as `run_gnuplot`
void draw_figure(const ClaimFile& file, const Figure& figure, const std::vector<Curve>& curves,
                 const std::filesystem::path& png);

} // namespace stylobate::claims
