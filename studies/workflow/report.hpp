#pragma once
/// The page of any file: of a result, a comparison, a diagnosis, a calibration or a risk estimate.

#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct PageRequest {
    std::string file;
    std::optional<std::string> output{};     ///< .html, .md or .json; none: the page, not written
    std::optional<std::string> title{};      ///< nullopt: by the study or the file
    std::optional<std::string> web{};        ///< address of the page that computes studies in the browser, to be linked
    std::vector<std::string> settings{};     ///< only the present path of the study's record
    std::optional<std::uint64_t> animate{};  ///< N that fell and N that stood, of each cell
    std::optional<double> animate_mb{};      ///< of all animations together [1e6 bytes]
    std::optional<double> animate_seconds{}; ///< for running them again
    bool force = false;                      ///< replace a page that is there
};

/// A page with all that it needs in it, or the same document as Markdown or JSON; and what could not be shown.
struct MadePage {
    std::string text;
    std::vector<std::string> warnings;
};

/// @returns nothing if the observer has asked to stop: nothing was written
/// @throws InputError if the file has no page, or if a request does not apply to it
std::optional<MadePage> make_page(const PageRequest& request, const Machine& machine, WorkObserver& observer);

} // namespace stylobate
