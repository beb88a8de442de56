#pragma once
/// The speed of this machine, measured with the engine itself: the rows of the table of speeds, and whole ensembles of
/// other structures. It writes no file.

#include "studies/report/json.hpp"
#include "studies/workflow/bench/speed_row.hpp"
#include "studies/workflow/machine_facts.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// One rate, measured several times.
struct Repeats {
    std::vector<double> values;

    double median() const;
    double lowest() const;
    double best() const;
};

/// An ensemble, by the number of threads.
struct EnsembleSpeed {
    int threads = 0;
    std::uint64_t realizations = 0; ///< of each repeat
    Repeats per_s{};                ///< realizations [1/s]
    Repeats block_steps_per_s{};
};

/// One instruction set. The specimen is the seven-drum column; steps are those of one thread.
struct IsaSpeed {
    Isa isa = Isa::scalar;
    Repeats peak{};     ///< multiply-adds on registers [operations/s]
    Repeats steps{};    ///< of the kernel alone [block-steps/s]
    Repeats with_all{}; ///< with base motion and termination checks
    std::vector<EnsembleSpeed> surface{};

    double of_the_peak() const;
};

struct StructureSpeed {
    std::string name;
    std::vector<EnsembleSpeed> surface{};
};

struct BenchRequest {
    double seconds = 45; ///< for all of it, about: every rate is measured once at least
};

struct BenchReport {
    MachineFacts machine; ///< before the measurement
    int threads = 1;      ///< all that are measured
    double seconds = 0;   ///< that it took
    std::vector<IsaSpeed> sets{};
    std::vector<StructureSpeed> structures{}; ///< with the last one of the sets

    /// Rows of the table of speeds: the best of the repeats, as there.
    std::vector<SpeedRow> rows() const;
};

/// Measures the instruction sets that the machine has, or the one that is asked for.
/// @returns nothing if the observer has asked to stop
/// @throws InputError for seconds out of their range, and if the machine lacks the instruction set
std::optional<BenchReport> run_bench(const BenchRequest& request, const Machine& machine, WorkObserver& observer);

std::string bench_text(const BenchReport& report);
/// The rows as a table in Markdown, with the head of that in README.md.
std::string bench_markdown(const BenchReport& report);
Json bench_json(const BenchReport& report);

} // namespace stylobate
