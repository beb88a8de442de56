#pragma once
/// What every workflow is given: where it computes, and who observes it.

#include "ensemble/model/observer.hpp"
#include "ensemble/run/executor.hpp"
#include "kernels/isa.hpp"
#include "studies/report/json.hpp"

#include <string>

namespace stylobate {

/// Where a workflow computes.
struct Machine {
    int threads = 0;             ///< 0: as many as the process may use
    std::string simd = "auto";   ///< "auto", or an instruction set
    std::string backend = "cpu"; ///< "cpu" or "cuda"
    Ranks* ranks = nullptr;      ///< the processes that compute together; null: this one is alone

    /// @throws InputError if the instruction set is unknown, or if this machine lacks it
    Isa isa() const;
    int thread_count() const;
    /// @throws InputError as `isa`, or if the backend has no device here
    RunOptions run_options() const;
    bool leads() const { return !ranks || ranks->leads(); }
};

/// Observes a workflow, and may stop it.
class WorkObserver : public Observer {
public:
    /// Nothing is refused any more: from here on a request to stop leaves what can be continued, or nothing at all.
    virtual void begin() {}
    /// A line for the user: a cost, a choice, what was left out.
    virtual void note(const std::string&) {}
    /// The stage that begins, where the workflow has several.
    virtual void stage(const std::string&) {}
    /// Progress of work that is not counted in realizations. @param unit what is counted: "parameter sets"
    /// @param line it in words
    virtual void counted(const char* /*unit*/, const std::string& /*line*/, const Progress&) {}
};

/// "340 of 1000 realizations, 52/s, 13 s left, 12.0 % collapsed (9.1 to 15.4)".
std::string progress_line(const Progress& progress);

/// Adds the numbers of that line to an object, with units in their names; null where the line has none.
Json& add_progress(Json& json, const Progress& progress);

} // namespace stylobate
