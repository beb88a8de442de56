#pragma once
/// What interventions change: studies run under the same draws and the same shaking.

#include "stylobate/answer.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

struct CompareOptions {
    std::vector<std::string> settings = {};     ///< "KEY=VALUE", of every study file
    std::filesystem::path folder = {};          ///< of the results of study files; "": the working folder
    double level = 0.95;                        ///< of intervals and verdicts, 0.5 to 0.9999
    std::optional<std::uint64_t> adaptive = {}; ///< most pairs of each variant of a surface, run where the difference
                                                ///< is undecided; none: all pairs
    double margin = 0.05;                       ///< adaptive: a difference that does not matter, 0.001 to 0.5
    int threads = 0;                            ///< 0: as many as the process may use
    std::string simd = "auto";                  ///< as `RunOptions::simd`
    std::function<void(const std::string& line)> tell = {}; ///< called with the progress, line by line; may be empty
    std::function<bool()> go_on = {};                       ///< polled about ten times a second; false: stop
};

/// `rows`: one for each variant, limit state and place ("all", or a cell): variant, limit_state, place, verdict; pairs
/// by which study reached the limit state: both, base_only, variant_only, neither; base_probability,
/// variant_probability and difference with their intervals; p and p_adjusted.
class Comparison : public Answer {
public:
    /// @throws InputError if it is no comparison, or if it is damaged
    static Comparison from_file(const std::filesystem::path& file);

private:
    friend struct Inside;
    using Answer::Answer;
};

/// Compares as `stylobate compare` does. The results of study files lie in the folder under the names of the studies;
/// those that are there are continued.
/// @param files study files, the base first (one alone: its [variants]); or finished results of them
/// @return nothing if `go_on` stopped it: what was run is kept
/// @throws InputError for studies that cannot be run or compared
std::optional<Comparison> compare(const std::vector<std::filesystem::path>& files, const CompareOptions& options = {});

} // namespace stylobate::api
