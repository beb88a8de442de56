#pragma once
/// The values of one to three numbers of a study for which a limit state is least probable, or least frequent over a
/// hazard.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/search/search_objective.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct SearchedPoint {
    std::vector<double> value; ///< (keys)
    Share share;               ///< of the limit state
    RiskNumber frequency;      ///< of the limit state, by a hazard [1/year]
    std::string results;       ///< its results file
};

/// How valid a run of a search is.
struct SearchedRun {
    std::string results;
    std::uint64_t invalid = 0, total = 0; ///< realizations
};

/// The surface along one key, through the best place.
struct SearchSlice {
    std::vector<double> x, value, lower, upper; ///< limits as of the answer, but for the choice of the place
};

/// The surface over two keys, at the candidates.
struct SearchMap {
    std::vector<double> place;              ///< along either key, from 0 to 1
    std::vector<std::vector<double>> value; ///< (first key)(second key)
    std::vector<std::vector<char>> flat;    ///< whether it is not shown to be worse
};

struct SearchResult {
    OptimiseSpec asked;
    int dimensions = 2; ///< of the structure
    double level = interval_level;
    std::uint64_t realizations = 0;         ///< of all points and the base together
    std::vector<SearchedPoint> points;      ///< in the order in which they were run
    std::vector<SearchedRun> runs;          ///< the base, and the points
    std::vector<double> best;               ///< (keys) the lowest place of the response surface
    double value = 0, lower = 0, upper = 1; ///< probability there, or with a hazard the frequency [1/year]
    std::vector<double> flat_from, flat_to; ///< (keys) range of the places that are not shown to be worse
    std::vector<SearchSlice> slices;        ///< (keys), of one or three
    SearchMap map;                          ///< of two keys
    bool at_the_end = false;                ///< of the budget; else no improvement is expected any more
    Share base;                             ///< of the study as it stands
    std::size_t best_point = 0;             ///< of those that were run, by the surface
    PlaceComparison change;                 ///< of that point against the base
    // with a hazard
    RiskNumber base_frequency;
    ChangeNumber frequency_change;      ///< of that point against the base
    double unseen = 0;                  ///< of that point (`FrequencyEstimate::unseen`), in no interval [1/year]
    std::optional<std::string> outside; ///< why its frequency is not determined; nullopt: it is
    bool is_frequency() const { return asked.hazard.has_value(); }
};

struct SearchFiles {
    std::string study;
    std::vector<std::string> settings;
    std::string folder; ///< of the points' results
};

/// Looks at everything that can be refused; nothing is written.
/// @throws InputError if the study has no [optimise], cannot be compared, has no such limit state, if a key cannot take
///         its values, or if the budget does not hold the first points
void check_search(const SearchFiles& files);

/// Runs the base, the first points, and then one point after the other where the response surface expects most
/// (ensemble/estimators/search/search_answer.hpp), each into a results file of its own that is named by its study. A
/// search that was interrupted takes the same points again, and finds their files.
/// @returns nothing if the observer has asked to stop
std::optional<SearchResult> search(const SearchFiles& files, double level, const RunOptions& options,
                                   Observer& observer);

std::string search_text(const SearchResult& result);
/// Of one key the surface with its interval, the range that is not shown to be worse, and the points; of two keys a map
/// of the surface with the set that is not shown to be worse, and the points; of three keys slices with their
/// intervals.
void plot_search(const SearchResult& result, const std::filesystem::path& picture);
Json search_json(const SearchResult& result);

} // namespace stylobate
