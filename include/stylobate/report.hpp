#pragma once
/// One self-contained page (HTML) of any file.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

struct ReportOptions {
    std::optional<std::string> title = {};      ///< nullopt: by the study or the file
    std::optional<std::uint64_t> animate = {};  ///< N that fell and N that stood, of each cell that has both; none: one
    std::optional<double> animate_mb = {};      ///< of all animations together [1e6 bytes]; none: 3
    std::optional<double> animate_seconds = {}; ///< for running realizations again; none: 120
    std::vector<std::string> settings = {};     ///< only the present path of a record: "excitation.file=PATH"
    int threads = 0;                            ///< 0: as many as the process may use
    std::string simd = "auto";                  ///< as `RunOptions::simd`
    std::function<void(const std::string& line)> tell = {}; ///< called with the progress, line by line; may be empty
    std::function<bool()> go_on = {};                       ///< polled about ten times a second; false: stop
};

struct Page {
    std::string html;
    std::vector<std::string> warnings; ///< what could not be shown

    /// Writes it, whole or not at all. @throws InputError if it cannot be written
    void write(const std::filesystem::path& file) const;
};

/// Makes the page of `stylobate report`.
/// @param file results, a comparison, a diagnosis, a calibration or a risk estimate
/// @return nothing if `go_on` stopped it
/// @throws InputError if the file has no page, is not complete, or has not what the options ask for
std::optional<Page> report(const std::filesystem::path& file, const ReportOptions& options = {});

} // namespace stylobate::api
