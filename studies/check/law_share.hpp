#pragma once
/// What the contact law of a study changes in its collapse probability: a part of the realizations is run again on the
/// same draws under other laws (`contact_laws`), as the pilot runs it with finer numerics.

#include "studies/experiment/contact_laws.hpp"
#include "studies/experiment/numerics.hpp"
#include "studies/kinds/law_band.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace stylobate {

/// One law beside that of the study.
struct LawResult {
    std::string name, words;
    std::optional<std::string> note;
    PairedCollapses pairs; ///< first: under this law; second: under that of the study
    double seconds = 0;
    double probability() const { return static_cast<double>(pairs.first) / static_cast<double>(pairs.realizations); }
};

struct LawShare {
    std::optional<std::string> why_none{}; ///< a sentence; nullopt: it was measured
    std::vector<std::string> left_out{};   ///< sentences: laws that do not apply
    std::uint64_t realizations = 0;        ///< that are run under each law
    double estimated_s = 0;                ///< of all laws together, before they are run
    double whole_run = 0;                  ///< processor time of the whole study under all laws, relative to the study
    std::uint64_t base_valid = 0, base_collapsed = 0; ///< of these realizations, under the law of the study
    std::vector<LawResult> laws{};

    bool measured() const { return !why_none; }
    double base_probability() const { return static_cast<double>(base_collapsed) / static_cast<double>(base_valid); }
    /// "as given" and the laws, and the probability of each.
    std::vector<std::string> names() const;
    LawBand::Place probabilities() const;
};

/// Realizations that are run under each law, at least.
inline constexpr std::uint64_t least_law_realizations = 16;

/// @param plain part of the study that has been run; all of it is run again, or as much as fits into the time by the
///        speed at which it was run
/// @param seconds for all laws together
/// @param tell receives the costs before anything is run; may be empty
/// @return what had been measured when the observer asked to stop
LawShare measure_law_share(const Experiment& study, const RunOptions& options, const PartRun& plain, double seconds,
                           const std::function<void(const std::string&)>& tell, Observer& observer);

/// Lines for a terminal.
/// @param numerics null: not measured   @param file of the study, for the command that runs the whole of it
std::string law_share_text(const LawShare& share, const NumericsCheck* numerics, const std::string& file);
Json law_share_json(const LawShare& share);

} // namespace stylobate
