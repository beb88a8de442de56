#pragma once
/// The studies of a comparison: where they come from, what is refused, and what their results come to; pairs that are
/// run only where the difference is undecided.

#include "ensemble/model/observer.hpp"
#include "io/store/result_store.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/results/results.hpp"
#include "studies/results/study_run.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Refuses what makes pairs meaningless: another kind, seed, number of realizations, sampling, shaking, axes, motions,
/// gravity, or another definition of the outcomes.
/// @param base, variant headers of their results   @param base_name, variant_name for messages
/// @throws InputError naming the key and both values
void check_comparable(const ResultHeader& base, const std::string& base_name, const ResultHeader& variant,
                      const std::string& variant_name);

/// Refuses a study that no comparison can use: its realizations have no rows, or are chosen by its own outcomes.
/// @throws InputError
void check_can_be_compared(const ResultHeader& header, const std::string& name);

struct StudyFiles {
    std::vector<std::string> files;    ///< the base's, then the variants'; one file: its [variants]
    std::vector<std::string> settings; ///< laid over every study
    std::string folder;                ///< of the results files
};

/// The studies of study files, the base first. Nothing is written.
/// @throws InputError for what is wrong with a study, for one that cannot be compared with the base, for two of one
///         name, and for a results file that is another study's
StudyRuns studies_to_compare(const StudyFiles& asked);
/// The studies of finished results, the base first.
/// @throws InputError also if one is not complete
std::vector<std::unique_ptr<Results>> results_to_compare(const std::vector<std::string>& files);

/// What the results of the studies come to, the base's first.
/// @param names of the studies   @param files their results   @param level of intervals and verdicts
Comparison comparison_of(const std::vector<std::string>& names, const std::vector<std::string>& files, double level);

struct AdaptiveChoice {
    std::uint64_t budget = 0; ///< pairs of each variant, at most
    double margin = 0.05;     ///< a difference that does not matter
};

/// @throws InputError if the study is no surface, or if the budget is too small for every cell's first look
void check_adaptive(const Study& base, const std::string& name, const AdaptiveChoice& choice);

/// Runs the studies round by round (paired_allocation.hpp), by the collapse; their files stay ones to be continued.
/// What a file has more than a round asks for is left out, so that the result depends on the studies and the choice
/// alone.
/// @param names of the studies, the base first   @returns nothing if the observer has asked to stop
std::optional<Comparison> compare_adaptively(const StudyRuns& studies, const std::vector<std::string>& names,
                                             const AdaptiveChoice& choice, double level, const RunOptions& options,
                                             Observer& observer);

} // namespace stylobate
