#pragma once
/// What Google Benchmark writes, as far as it is read again here.

#include <map>
#include <string>
#include <vector>

namespace stylobate {

/// One run of one benchmark, repetitions one by one, without aggregates.
struct Measured {
    std::string name;                       ///< "BM_Step/avx512/7"
    std::map<std::string, double> counters; ///< by name: "block_steps_per_second"
    double rate() const;                    ///< the counter that benchmarks are compared by; 0 where there is none
};

struct ResultsFile {
    std::string processor, commit; ///< "" where the file does not say
    std::string date;              ///< ISO 8601
    std::vector<Measured> runs;
    /// The best value of a counter over the repetitions of a benchmark: what the neighbours on a shared machine took
    /// least of. 0 where there is none.
    double best(const std::string& name, const std::string& counter) const;
};

/// @throws std::runtime_error with the file's name and what is wrong with it
ResultsFile read_results(const std::string& path);

} // namespace stylobate
