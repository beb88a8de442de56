#pragma once
/// A study of rare events: subset simulation on the peak displacement of the top, beyond all of which is the collapse,
/// with chains as lanes (ensemble/estimators/rare/subset_simulation.hpp).
///
/// The numbers that a realization is drawn with are the standard normal ones of a chain's point, each by its
/// distribution function; a step of all chains is one batch of the executor. Which point comes next depends on the
/// outcomes before, and these on nothing but (study, seed): so does the whole.

#include "ensemble/engine/executor.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/rare_table.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <functional>
#include <string>
#include <unordered_map>

namespace stylobate {

/// The responses of the realizations that have been run, by index.
class RareOutcomes {
public:
    void add(const ResultRow& row);
    bool has(std::uint64_t index) const { return outcome_.contains(index); }
    State state(std::uint64_t index) const { return at(index).state; }
    const Outcome& at(std::uint64_t index) const { return outcome_.at(index); }

private:
    std::unordered_map<std::uint64_t, Outcome> outcome_;
};

struct RareRun {
    Progress progress;
    bool complete = false;
    RareTable table; ///< once it is complete
};

/// Runs what is left: chains are gone through again by the outcomes that are there.
/// @param outcomes those that are there; the new ones are added
/// @param sink     takes the new rows
RareRun run_rare(const LoadedStudy& loaded, const RunOptions& options, RareOutcomes& outcomes,
                 const std::function<void(const ResultRow&)>& sink, Observer& observer);

/// For the end of a run and the page of a result.
std::vector<std::string> rare_sentences(const RareTable& table);
Json rare_json(const RareTable& table);
void add_rare(HtmlPage& page, const RareTable& table);

} // namespace stylobate
