#pragma once
/// A study under all its contact laws: a comparison whose variants are the laws (`contact_laws`), made without being
/// asked for by name, and the band of its probabilities.
///
/// Files beside RESULTS.h5, the results of the study, which stay as they are: RESULTS_law_NAME.h5, the results of each
/// law, and RESULTS_laws.h5, the comparison. Pages, pictures and tables of RESULTS.h5 find the band by that name.

#include "io/store/result_store.hpp"
#include "studies/experiment/contact_laws.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/kinds/law_band.hpp"
#include "studies/results/study_run.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// The band beside the results, if there is one and it is of the same study under the same laws.
/// A file of that name that is no comparison, or that is damaged, is left out. @param study, header of the results
std::optional<LawBand> law_band_beside(const std::string& results, const Study& study, const ResultHeader& header);

class LawRuns {
public:
    /// Looks at the study, its laws and the files that are there, and changes nothing.
    /// @param file of the study, for messages   @param results of the study; need not be there
    /// @throws InputError if the study has no pairs or no law that applies, or if a file is another study's
    LawRuns(const LoadedStudy& base, const std::string& file, std::string results);

    /// "laws: softer (0.58 times the study), ...": what is left to run, and at what cost.
    std::string costs() const;
    /// Whether nothing is left to run: the band is there.
    bool finished() const { return band_.has_value(); }
    /// Of the laws, in their order; none where the band is there.
    const StudyRuns& runs() const { return runs_; }
    /// Writes the comparison where it is not there. @pre the study and all laws are complete
    const LawBand& conclude();

private:
    std::string results_;
    std::vector<ContactLaw> laws_;
    StudyRuns runs_;
    std::vector<std::string> names_; ///< of the laws that are run
    std::vector<double> costs_;
    std::optional<LawBand> band_;
};

} // namespace stylobate
