#pragma once
/// How often limit states are reached at a site, how likely that is over years, and what interventions change of it.

#include "stylobate/answer.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

struct RiskOptions {
    std::optional<std::string> site = {};        ///< of several in the hazard: "LON,LAT" or its number from 0
    std::optional<std::string> limit_state = {}; ///< one of the study; nullopt: all
    std::vector<double> years = {50, 100};       ///< for the probabilities
    double level = 0.9;                          ///< of the intervals
    double most_outside = 0.25;             ///< largest share of a frequency from outside of the intensities of study
                                            ///< or hazard
    std::uint64_t sequences = 0;            ///< histories of the last of the years, with the damage carried along
    std::optional<double> threshold = {};   ///< their weakest earthquake, in the SI unit of the measure; none: by the
                                            ///< results
    std::optional<double> pause_s = {};     ///< rest between them; none: until the structure rests
    std::uint64_t seed = 1;                 ///< of the histories
    std::vector<std::string> settings = {}; ///< only the present path of a record: "excitation.file=PATH"
    int threads = 0;                        ///< 0: as many as the process may use
    std::string simd = "auto";              ///< as `RunOptions::simd`
    std::function<void(const std::string& line)> tell = {}; ///< called with the progress, line by line; may be empty
    std::function<bool()> go_on = {};                       ///< polled about ten times a second; false: stop
};

/// `rows` of a study: one for each limit state: limit_state, meaning, determined (0: only bounds hold), and with their
/// intervals annual_frequency [1/year] and probability_50_years for each of the years.
///
/// `rows` of a comparison: one for each variant and limit state: variant, limit_state, meaning, verdict; the numbers
/// above as base_NAME and variant_NAME; and annual_frequency_change, annual_frequency_ratio and
/// probability_50_years_change.
class Risk : public Answer {
public:
    /// @throws InputError if it is no risk estimate, or if it is damaged
    static Risk from_file(const std::filesystem::path& file);

private:
    friend struct Inside;
    using Answer::Answer;
};

/// Estimates the risk as `stylobate risk` does.
/// @param file results of a fragility study, or a comparison of fragility studies
/// @param hazard files of hazard curves (CSV, OpenQuake's CSV or NRML), or a power law such as
///        "k0=1e-4,k=2.5,measure=pga_g,sigma_ln=0.5"
/// @return nothing if `go_on` stopped it
/// @throws InputError if the file has no risk, or if the hazard cannot be read
std::optional<Risk> risk(const std::filesystem::path& file, const std::vector<std::string>& hazard,
                         const RiskOptions& options = {});

} // namespace stylobate::api
