#pragma once
/// Where a run puts its realizations: the rows of a results file, or its counts where the study keeps no rows.

#include "ensemble/numerics/run_order.hpp"
#include "io/store/result_store.hpp"
#include "studies/kinds/kind.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace stylobate {

/// By itself it keeps nothing: of a process that gives its rows to another one.
class RunStore {
public:
    virtual ~RunStore() = default;

    /// How a realization ended that is there already.
    virtual std::optional<State> state(std::uint64_t) const { return std::nullopt; }
    /// Where there are no rows: what is counted, by its place in the order of the run; else null.
    virtual const DoneSet* counted() const { return nullptr; }
    /// Gives the kind what is there: all rows, or the counts.
    virtual void give_to(Kind&) const {}
    /// All rows that are there; none of counts.
    virtual void for_each_row(const std::function<void(const ResultRow&)>&) const {}
    virtual void add(const ResultRow&) {}
    /// Whether it keeps trajectories; else no realization is followed for one.
    virtual bool keeps_trajectories() const { return true; }
    virtual void add(const Trajectory&) {}
    /// Takes what another file of the study has. @pre none of it is there already
    virtual void add(const ResultReader& other);
    /// All is there: the file becomes complete, with what the kind makes of it.
    virtual void finish(const Kind&) {}
    /// Keeps what is there for another run.
    virtual void flush() {}
};

/// @param found whether the file is there and is to be continued
/// @throws InputError as `ResultWriter` and `TallyWriter` do
std::unique_ptr<RunStore> open_store(const std::string& file, const ResultHeader& header, bool found);

} // namespace stylobate
