#pragma once
/// What blocks of several slendernesses do in tests, and which of them the outcomes make most likely.

#include "ensemble/executor.hpp"
#include "ensemble/motion.hpp"
#include "ensemble/outcome.hpp"
#include "ensemble/study.hpp"

#include <vector>

namespace stylobate::measured {

/// Falls of blocks that differ in their slenderness alone.
struct FallTable {
    std::vector<double> slenderness;      ///< in equal ratios
    std::vector<std::vector<char>> falls; ///< (tests x slendernesses)

    /// Share that falls of blocks whose slenderness is spread lognormally.
    /// @param median index into `slenderness`   @param spread sigma of the logarithm; 0: that one alone
    double share(std::size_t test, std::size_t median, double spread) const;
};

/// `count` values from `from` to `to` in equal ratios.
std::vector<double> equal_ratios(double from, double to, int count);

/// Whether a block has fallen. One that was set aside because its energy balance broke when its side hit the ground (a
/// long face, stiffer than the bed that the step is chosen for) lay on its side already.
bool has_fallen(const Outcome& outcome);

/// Whether each of several structures falls under one motion; the first realization of each study.
/// @param studies alike but for their values: the same blocks   @return (studies) 1 for a fall; none in an empty motion
std::vector<char> falls_in(const Motion& motion, const std::vector<Study>& studies, Isa isa);

/// A test ends as it likes with probability `slip`: no model is then infinitely wrong.
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
