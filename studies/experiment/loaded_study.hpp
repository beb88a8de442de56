#pragma once
/// An experiment read from files: from a study file or from results; and the header of its results.

#include "ensemble/experiment.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/store/result_store.hpp"

#include <string>
#include <vector>

namespace stylobate {

struct Record;

/// The motions of a study, read from its files or drawn.
/// @param record what is in the file of an excitation of kind "record"; null: that file is read
/// @throws InputError if a file cannot be read or drives nothing
Motions motions_of(const Study& study, const Record* record = nullptr);

class LoadedStudy {
public:
    explicit LoadedStudy(Experiment experiment);

    /// From a study file and the settings of the command line.
    /// @throws InputError for whatever is wrong with the study or its record
    static LoadedStudy from_file(const std::string& file, const std::vector<std::string>& settings);

    /// One of the [variants] of a study file. @throws InputError as above, and if there is no such variant
    static LoadedStudy from_variant(const std::string& file, const std::string& variant,
                                    const std::vector<std::string>& settings);

    /// From the study inside a results file. `settings` may only give the present path of the record.
    /// @throws InputError as above, and if the record is not the one that the results were made with
    /// @param study as parsed from its text
    static LoadedStudy from_results(const Study& study, const ResultHeader& header, const std::string& file,
                                    const std::vector<std::string>& settings);

    const Experiment& experiment() const { return experiment_; }
    const Study& study() const { return experiment_.study(); }
    const Motion* record() const { return experiment_.record(); }
    const Sampler& sampler() const { return experiment_.sampler(); }

    /// What a results file of this study begins with. Its text of the study ends with a comment that identifies the
    /// record by its samples, so that another record under the same name is another study.
    ResultHeader result_header() const;

    /// What of the study can hardly be meant, and what it does not allow itself (plausible.hpp).
    std::vector<Implausibility> implausibilities() const;
    /// The implausibilities as sentences, for a verb that runs the study.
    /// @param file its name in messages   @throws InputError with the reason if it is too far from what can be meant
    std::vector<std::string> warnings(const std::string& file) const;

private:
    /// All of the header but its warnings.
    ResultHeader plain_header() const;

    Experiment experiment_;
    MotionTable motions_; ///< of a set of motions
    std::string text_;    ///< of the study, and what identifies its motions
};

/// The names of the blocks of a study but the ground, in layout order.
std::vector<std::string> block_names(const Study& study);

/// The study of results is fixed: all that may be set is where its record lies now. For verbs that may not even need
/// it.
/// @throws InputError for any other setting, and if the study has no record
void check_settings(const Study& study, const std::string& file, const std::vector<std::string>& settings);

/// One more than the last realization that a result may be asked for: of an adaptive surface any of its study, run or
/// not.
std::uint64_t realizations_end(const ResultHeader& header, const Study& study);

} // namespace stylobate
