#include "ensemble/estimators/past/agreeing_states.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

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

AgreeingStates::AgreeingStates(const StandingStates& standing, const MeasuredState& measured)
    : standing_(standing), measured_(measured), as_is_(sorted_by(0))
{
    assert(!measured.value.empty() && "something was measured");
    if (measured.mirrored)
        mirrored_ = sorted_by(measured.counterpart.empty() ? 0 : measured.counterpart.front());
}

AgreeingStates::Order AgreeingStates::sorted_by(std::size_t value) const
{
    Order order{value, std::vector<std::size_t>(standing_.cell.size())};
    std::iota(order.states.begin(), order.states.end(), std::size_t{0});
    std::stable_sort(order.states.begin(), order.states.end(), [&](std::size_t a, std::size_t b) {
        return standing_.state(a)[value] < standing_.state(b)[value];
    });
    return order;
}

std::span<const std::size_t> AgreeingStates::between(const Order& order, double from, double to) const
{
    const auto value = [&](std::size_t r) { return standing_.state(r)[order.value]; };
    const auto begin = std::lower_bound(order.states.begin(), order.states.end(), from,
                                        [&](std::size_t r, double limit) { return value(r) < limit; });
    const auto end =
        std::upper_bound(begin, order.states.end(), to, [&](double limit, std::size_t r) { return limit < value(r); });
    return {begin, end};
}

void AgreeingStates::each(const std::vector<double>& seen, const std::function<void(std::size_t)>& f) const
{
    MeasuredState state = measured_;
    state.value = seen;
    // as wide as rounding of the distance needs
    const double reach = state.tolerance.front() * (1 + 1e-9);
    const double from = seen.front() - reach, to = seen.front() + reach;
    for (const std::size_t r : between(as_is_, from, to))
        if (distance(state, standing_.state(r)).agrees())
            f(r);
    if (!state.mirrored)
        return;
    for (const std::size_t r : between(mirrored_, -to, -from)) {
        const double first = standing_.state(r)[0];
        const bool was_seen = first >= from && first <= to;
        if (!was_seen && distance(state, standing_.state(r)).agrees())
            f(r);
    }
}

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
