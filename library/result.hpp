#pragma once
/// What a `Result` holds, made from the rows of a run or of a file.

#include "ensemble/numerics/run_order.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/kind_tables.hpp"
#include "library/inside.hpp"
#include "studies/experiment/limit_state.hpp"
#include "studies/kinds/surface/surface_kind.hpp"
#include "stylobate/result.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

struct Result::Data {
    /// @param name of the results in messages
    Data(inner::ResultHeader header, inner::Study study, std::string name);

    /// Of a run that was stopped, before its rows are added: of these count those that were begun first and have all
    /// ended; none of them is missing because it takes long.
    /// @param has whether a realization is there
    void count_the_first(const std::function<bool(std::uint64_t index)>& has);
    /// Counts a realization; without its own outcome where the study keeps none.
    void add(const inner::ResultRow& row);
    /// Takes the counts of a study that keeps no rows instead.
    void add(const inner::Tally& tally);
    /// The last step. @param surface of the collapse, as the kind of study has it   @param found the kind's tables
    void finish(std::optional<inner::SurfaceTable> surface = {}, const std::vector<inner::Table>& found = {});

    inner::ResultHeader header;
    inner::Study study;
    std::string name; ///< in messages
    bool complete = true;
    std::uint64_t done = 0, invalid = 0;
    inner::LimitCounts limits;
    std::vector<Outcome> outcomes;             ///< by index
    std::vector<inner::SurfaceTable> surfaces; ///< of each limit state; empty for other kinds
    inner::RareTable rare;
    inner::FragilityTable fragility;
    std::vector<Table> tables;

    bool is_adaptive() const { return study.surface && study.surface->adaptive; }

private:
    bool counts(std::uint64_t index) const;

    std::vector<inner::SurfaceCounts> counts_; ///< of each limit state
    std::optional<inner::RunOrder> order_;     ///< of a run that was stopped
    std::uint64_t places_ = 0;                 ///< of it, that count
    std::uint64_t trials_ = 0;                 ///< realizations below count; perturbed replicas are no further trials
};

// From the engine's rows and tables to the plain data of the public headers.

Outcome outcome_of(const stylobate::ResultRow& row);
Share share_of(const stylobate::Share& share);
Surface surface_of(const stylobate::SurfaceTable& table, const std::string& limit_state);
Fragility fragility_of(const stylobate::FragilityTable& table);

} // namespace stylobate::api
