#pragma once
/// The studies of a comparison: where they come from, what is refused, and what their results come to.

#include "ensemble/model/observer.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/results/results.hpp"
#include "studies/results/study_run.hpp"

#include <memory>
#include <string>
#include <vector>

namespace stylobate {

struct StudyFiles {
    std::vector<std::string> files;    ///< the base's, then the variants'; one file: its [variants]
    std::vector<std::string> settings; ///< laid over every study
    std::string folder;                ///< of the results files
};

/// The studies of study files, the base first. Nothing is written.
/// @throws InputError for what is wrong with a study, for one that cannot be compared with the base, for two of one
///         name, and for a results file that is another study's
StudyRuns studies_to_compare(const StudyFiles& asked);
/// The same of finished results.
/// @throws InputError also if one is not complete
std::vector<std::unique_ptr<Results>> results_to_compare(const std::vector<std::string>& files);

/// What the results of the studies come to, the base's first.
/// @param names of the studies   @param files their results   @param level of intervals and verdicts
Comparison comparison_of(const std::vector<std::string>& names, const std::vector<std::string>& files, double level);

/// Adds a variant to a comparison with the base: its name, results file and study, and what else differs.
/// @param found of the pairs   @param file of its results
void add_variant(Comparison& comparison, VariantComparison found, const std::string& name, const std::string& file,
                 const ResultHeader& base, const ResultHeader& variant);

/// A comparison with the base and without variants. @param file of its results
Comparison comparison_facts(const Study& base, const ResultHeader& header, const std::string& name,
                            const std::string& file, double level);

} // namespace stylobate
