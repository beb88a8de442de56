#pragma once
/// Comparisons of studies, and searches for the best values of a study, from their files to the answer.

#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/search/search.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct ComparisonRequest {
    std::vector<std::string> files;          ///< study files or finished results, the base first; one study file: its
                                             ///< [variants]
    std::vector<std::string> settings{};     ///< of the study files
    std::string folder{};                    ///< of the results of study files
    std::optional<std::string> output{};     ///< file of the comparison; none: it is not written
    double level = interval_level;           ///< of intervals and verdicts
    std::optional<std::uint64_t> adaptive{}; ///< pairs of each variant at most, where they are needed; none: all
    double margin = 0.05;                    ///< of an adaptive comparison: a difference that does not matter
    bool force = false;                      ///< replace the comparison of other studies
};

struct ComparisonEnd {
    std::optional<Comparison> comparison; ///< none: the observer has asked to stop, and the results are kept
    std::uint64_t done = 0, total = 0;    ///< realizations of all studies that are kept then
    std::optional<std::string> invalid{}; ///< `too_many_invalid` of the studies
};

/// Whether the files are study files; else they are results.
/// @throws InputError if they are of different kinds, or of a kind that cannot be compared
bool are_study_files(const std::vector<std::string>& files);

/// Runs study files, or continues their results, and compares them; or compares finished results.
/// @throws InputError if they cannot be run or compared, before anything is written
ComparisonEnd compare_files(const ComparisonRequest& request, const Machine& machine, WorkObserver& observer);

struct SearchRequest {
    std::string study; ///< file with [optimise]
    std::vector<std::string> settings{};
    std::optional<std::string> picture{};
    double level = interval_level;
    bool force = false; ///< replace a picture that is there
};

struct SearchEnd {
    std::optional<SearchResult> result; ///< none: the observer has asked to stop, and what was run is kept
    std::optional<std::string> invalid; ///< `too_many_invalid` of what was run
};

/// @throws InputError if the study cannot be searched, before anything is run
SearchEnd search_study_file(const SearchRequest& request, const Machine& machine, WorkObserver& observer);

} // namespace stylobate
