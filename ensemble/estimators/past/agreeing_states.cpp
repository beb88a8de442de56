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
    return std::span(order.states)
        .subspan(static_cast<std::size_t>(begin - order.states.begin()), static_cast<std::size_t>(end - begin));
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

std::optional<MirrorImage> mirror_image(const Layout& layout)
{
    constexpr double alike = 1e-6;
    double from = layout.blocks.front().axis_m, to = from, size = 0;
    for (const PlacedBlock& block : layout.blocks) {
        from = std::min(from, block.axis_m);
        to = std::max(to, block.axis_m);
        size = std::max({size, block.width_m, block.height_m, block.y_m});
    }
    size += to - from;
    const auto place = [&](double a, double b) { return std::abs(a - b) <= alike * size; };
    const auto mirrors = [&](const PlacedBlock& a, const PlacedBlock& b) {
        return a.role == b.role && a.fixed == b.fixed && place(a.axis_m - from, to - b.axis_m) && place(a.y_m, b.y_m) &&
               place(a.width_m, b.width_m) && place(a.height_m, b.height_m) &&
               std::abs(a.mass_kg - b.mass_kg) <= alike * a.mass_kg;
    };
    MirrorImage image;
    for (const PlacedBlock& block : layout.blocks) {
        const auto other = std::find_if(layout.blocks.begin(), layout.blocks.end(),
                                        [&](const PlacedBlock& b) { return mirrors(block, b); });
        if (other == layout.blocks.end())
            return std::nullopt;
        image.blocks.push_back(static_cast<std::size_t>(other - layout.blocks.begin()));
    }
    const auto in_place = [&](int block) {
        return block < 0 ? block : static_cast<int>(image.blocks[static_cast<std::size_t>(block)]);
    };
    for (const PlacedBed& bed : layout.beds) {
        const auto other = std::find_if(layout.beds.begin(), layout.beds.end(), [&](const PlacedBed& b) {
            return b.lower == in_place(bed.lower) && b.upper == in_place(bed.upper);
        });
        if (other == layout.beds.end())
            return std::nullopt;
        image.beds.push_back(static_cast<std::size_t>(other - layout.beds.begin()));
    }
    return image;
}

} // namespace stylobate
