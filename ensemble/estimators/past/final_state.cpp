#include "ensemble/estimators/past/final_state.hpp"

#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

StateDistance one_sided(const MeasuredState& measured, std::span<const double> state, double sign)
{
    StateDistance most;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const double d = std::fabs(sign * state[i] - measured.value[i]) / measured.tolerance[i];
        if (d > most.value)
            most = {d, i};
    }
    return most;
}

} // namespace

StateDistance distance(const MeasuredState& measured, std::span<const double> state)
{
    assert(state.size() == measured.value.size() && "a value for each that was measured");
    const StateDistance as_is = one_sided(measured, state, 1);
    if (!measured.mirrored)
        return as_is;
    const StateDistance mirrored = one_sided(measured, state, -1);
    return mirrored.value < as_is.value ? mirrored : as_is;
}

} // namespace stylobate
