#include "ensemble/estimators/past/final_state.hpp"

#include <cassert>
#include <cmath>

namespace stylobate {

namespace {

/// @param value of a number, as it is seen
template <class Value>
StateDistance one_sided(const MeasuredState& measured, Value&& value)
{
    StateDistance most;
    for (std::size_t i = 0; i < measured.value.size(); ++i) {
        const double d = std::fabs(value(i) - measured.value[i]) / measured.tolerance[i];
        if (d > most.value || i == 0)
            most = {d, i, value(i)};
    }
    return most;
}

} // namespace

StateDistance mirror_distance(const MeasuredState& measured, std::span<const double> state)
{
    assert(state.size() >= measured.value.size() && "a value for each that was measured");
    return one_sided(measured,
                     [&](std::size_t i) { return -state[measured.counterpart.empty() ? i : measured.counterpart[i]]; });
}

StateDistance distance(const MeasuredState& measured, std::span<const double> state)
{
    assert(state.size() >= measured.value.size() && "a value for each that was measured");
    const StateDistance as_is = one_sided(measured, [&](std::size_t i) { return state[i]; });
    if (!measured.mirrored)
        return as_is;
    const StateDistance mirrored = mirror_distance(measured, state);
    return mirrored.value < as_is.value ? mirrored : as_is;
}

} // namespace stylobate
