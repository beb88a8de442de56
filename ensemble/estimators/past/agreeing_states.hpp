#pragma once
/// Which simulated states agree with one that is given: of states sorted by their first value only those near it are
/// compared, so that thousands of simulated monuments can be judged by all realizations.

#include "ensemble/estimators/past/final_state.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace stylobate {

/// The realizations that stand.
struct StandingStates {
    std::vector<std::size_t> cell; ///< of each
    std::vector<double> value;     ///< (realizations x values) of the states

    std::size_t width() const { return cell.empty() ? 0 : value.size() / cell.size(); }
    std::span<const double> state(std::size_t r) const { return std::span(value).subspan(r * width(), width()); }
};

class AgreeingStates {
public:
    /// @param measured whose tolerances and counterparts hold for all that is looked for
    /// @pre at least one value is measured; both outlive this object
    AgreeingStates(const StandingStates& standing, const MeasuredState& measured);

    /// Calls f(r) once for each state that agrees with these values, or whose mirror image does.
    /// @param seen (measured values)
    void each(const std::vector<double>& seen, const std::function<void(std::size_t r)>& f) const;

private:
    /// States in the order of one of their values.
    struct Order {
        std::size_t value = 0;
        std::vector<std::size_t> states;
    };
    Order sorted_by(std::size_t value) const;
    std::span<const std::size_t> between(const Order& order, double from, double to) const;

    const StandingStates& standing_;
    MeasuredState measured_;
    Order as_is_, mirrored_;
};

} // namespace stylobate
