#pragma once
/// What `stylobate diagnose --json` printed about one campaign, as far as it is scored.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate::hidden {

struct SaidCause {
    std::string name, place, parameter;
    double probability = 0;
    double size = 0, low = 0, high = 0; ///< NaN where nothing was said
};

struct DiagnosisSummary {
    std::string verdict; ///< "none", "named" or "unexplained"
    std::vector<SaidCause> causes;
    std::vector<std::string> indistinguishable;
    double seconds = 0;
};

/// @throws InputError with `name` if the text is no such object
DiagnosisSummary parse_diagnosis(std::string_view text, const std::string& name);
DiagnosisSummary read_diagnosis(const std::filesystem::path& file);

} // namespace stylobate::hidden
