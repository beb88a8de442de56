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

// Two builds compared pair by pair: what can be said of their speeds on a machine that is shared and noisy.

enum class Verdict {
    faster, ///< surely, and by more than does not matter
    slower, ///< the same
    same,   ///< surely within what does not matter
    open    ///< these pairs do not tell: take more
};

struct Comparison {
    Verdict verdict = Verdict::open;
    double ratio = 1;         ///< median of new over old rates
    double low = 0, high = 0; ///< interval of the median, distribution-free; 0 and infinity where there are too few
    double confidence = 0;    ///< of the interval, exact: at least what was asked for, unless there are too few pairs
    int pairs = 0;
};

/// Judges the ratios of pairs (new rate over old rate), each pair taken at about the same time.
///
/// The interval of the median is between two order statistics, with the binomial's exact coverage: no noise has a
/// normal distribution here. Faster or slower: the interval leaves out 1 and the median is beyond `matters`; the same:
/// the interval lies within 1 -+ `matters`, or leaves 1 out by less than that.
///
/// @param ratios > 0;  @param confidence asked for, in (0, 1);  @param matters smallest relevant relative difference
/// @throws std::invalid_argument for no pair, or a ratio that is not positive and finite
Comparison compare(std::vector<double> ratios, double confidence = 0.95, double matters = 0.01);

const char* to_string(Verdict verdict);

} // namespace stylobate
