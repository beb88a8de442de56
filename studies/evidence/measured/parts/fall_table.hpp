#pragma once
/// What blocks of several slendernesses do in tests, and which of them the outcomes make most likely.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace stylobate::measured {

/// How realizations ended, and how those are counted whose energy balance broke.
struct Ends {
    std::uint64_t total = 0;
    std::uint64_t fallen = 0;      ///< with those that lay on their side
    std::uint64_t on_its_side = 0; ///< invalid, but turned by more than 1 rad before: counted as fallen
    std::uint64_t set_aside = 0;   ///< invalid otherwise

    void add(const Outcome& outcome);
    void add(const Ends& more);
};

/// Falls of blocks that differ in their slenderness alone.
struct FallTable {
    std::vector<double> slenderness;      ///< in equal ratios
    std::vector<std::vector<char>> falls; ///< (tests x slendernesses); an invalid one off its side counts as standing
    std::vector<Ends> ends;               ///< (tests) over the slendernesses

    /// Share that falls of blocks whose slenderness is spread lognormally.
    /// @param median index into `slenderness`   @param spread sigma of the logarithm; 0: that one alone
    double share(std::size_t test, std::size_t median, double spread) const;
};

/// Simulates every test with every slenderness, on several threads.
/// @param motion, study of a test, of a slenderness
FallTable simulated_falls(const std::vector<double>& slenderness, std::size_t tests,
                          const std::function<Motion(std::size_t)>& motion, const std::function<Study(double)>& study,
                          const RunOptions& run);

/// `count` values from `from` to `to` in equal ratios.
std::vector<double> equal_ratios(double from, double to, int count);

/// Whether a block has fallen. One that was set aside because its energy balance broke when its side hit the ground (a
/// long face, stiffer than the bed that the step is chosen for) lay on its side already.
bool has_fallen(const Outcome& outcome);

/// Whether each of several structures falls under one motion; the first realization of each study.
/// @param studies alike but for their values: the same blocks   @return (studies) 1 for a fall; none in an empty motion
/// @param ends to which how they ended is added
std::vector<char> falls_in(const Motion& motion, const std::vector<Study>& studies, Isa isa, Ends* ends = nullptr);

/// The outcome of a test is random with probability `slip`, so that no model has a likelihood of 0.
inline double with_slip(double share, double slip)
{
    return slip / 2 + (1 - slip) * share;
}

/// Logarithm of the probability of the outcomes [nat].
/// @param fell (tests)   @param use (tests) which are counted   @param median index into the table's slendernesses
double log_likelihood(const FallTable& table, std::size_t median, const std::vector<bool>& fell,
                      const std::vector<bool>& use, double spread, double slip);

struct LikelySlenderness {
    std::size_t median = 0;    ///< index into the table's
    double log_likelihood = 0; ///< [nat]
};
/// The most likely one.
LikelySlenderness likely_slenderness(const FallTable& table, const std::vector<bool>& fell,
                                     const std::vector<bool>& use, double spread, double slip);

/// Slips that are tried.
extern const std::vector<double> slips;

} // namespace stylobate::measured
