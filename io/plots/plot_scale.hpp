#pragma once
/// An axis: its range in values, where these lie in pixels, and its round values.

#include <limits>
#include <string>
#include <vector>

namespace stylobate {

struct PlotScale {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
    bool log = false;
    double first_px = 0; ///< of `from`
    double last_px = 0;  ///< of `to`

    bool holds(double value) const;
    /// Makes the range hold a value; what the axis cannot hold is left out.
    void include(double value);
    bool empty() const { return from > to; }
    double scaled(double value) const;
    /// Room at both ends, a share of the range; and some range where there is none.
    void pad(double share);
    double px(double value) const;

    struct Tic {
        double value;
        std::string text; ///< "": a mark without a number
    };
    /// Round values within the range, with numbers that can be told apart and have at most six letters.
    /// @param most numbers for which there is room
    std::vector<Tic> tics(double most = 7) const;
};

} // namespace stylobate
