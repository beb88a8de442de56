#pragma once
/// A picture of shares with their intervals over an intensity, several series beside each other.

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

struct ShareSeries {
    std::string name;
    std::vector<double> x, share, lower, upper; ///< as many of each
};

struct SharePicture {
    std::string title, subtitle;
    std::string x_label, y_label;
    std::vector<ShareSeries> series; ///< at most seven
};

/// Points with error bars, joined by lines; series are moved a little apart where they share their x.
/// @throws InputError if there is no point, if there are too many series, if gnuplot is missing or fails, or if the
///         picture cannot be written
void plot_shares(const SharePicture& picture, const std::filesystem::path& png);

} // namespace stylobate
