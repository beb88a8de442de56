#pragma once
/// How often the intervals of `stylobate calibrate` hold the friction that a campaign was made with.

#include "tests/hidden/score/answer.hpp"
#include "tests/hidden/score/score.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate::hidden {

/// What `stylobate calibrate --json` printed of the friction.
struct SaidFriction {
    bool determined = false;
    double value = 0, low = 0, high = 0;
};

/// @throws InputError with `name` if the text is no such object
SaidFriction parse_calibration(std::string_view text, const std::string& name);
SaidFriction read_calibration(const std::filesystem::path& file);

/// Campaigns of one law, or of one kind of specimen.
struct CoverageRow {
    std::string of;
    int campaigns = 0;
    Share held;                        ///< intervals that hold the truth, of the campaigns that have one
    std::vector<double> relative_half; ///< (intervals) half their width over their value
    std::vector<double> error;         ///< (intervals) ln(value / truth)
};

/// One row for all, one for each law, one for each kind of specimen.
/// @param said (answers); nothing: not calibrated, counts nowhere
std::vector<CoverageRow> coverage(const std::vector<Answer>& answers,
                                  const std::vector<std::optional<SaidFriction>>& said);

/// The table, in Markdown.
std::string markdown(const std::vector<CoverageRow>& rows);

} // namespace stylobate::hidden
