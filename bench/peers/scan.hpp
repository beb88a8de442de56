#pragma once
/// Finds where each contender is as accurate as wanted, and times it there.

#include "bench/peers/contender.hpp"

#include <array>
#include <optional>

namespace stylobate::peers {

/// Both tests' errors must be as small as this, at a dial and at the next four finer ones (a factor of two): an error
/// that passes through zero on its way is no accuracy.
inline constexpr std::array targets{0.01, 0.002};
inline constexpr std::size_t confirmed_by = 4;

/// Relative errors against the rigid block, of the two tests; NaN where a test has no result.
struct Errors {
    double dial = 0;
    double quarter_period = 0, overturning = 0;
    /// The larger of the two; infinity where one has no result.
    double worst() const;
};

/// A contender at one dial.
struct Timed {
    Errors errors;
    double step_s = 0;
    Columns shaken, resting;
    /// No shaken column collapsed, and each at rest has stood where it was put.
    bool stands() const { return shaken.collapsed == 0 && resting.moved == 0; }
};

struct Result {
    Contender contender;
    std::vector<Errors> scanned; ///< coarse to fine, as far as was needed
    Timed customary;
    /// The coarsest dial within each target at which columns stand; none: there is none with this setting.
    std::array<std::optional<Timed>, targets.size()> reached;
};

/// @param seconds for each timing, about
/// @param patience_s a dial that takes longer than this and reaches nothing ends the scan
Result scan(const Contender& contender, double seconds, double patience_s);

/// The fastest at a target, of Stylobate or of the others; null: none.
const Result* fastest(const std::vector<Result>& results, bool own, std::size_t target);

} // namespace stylobate::peers
