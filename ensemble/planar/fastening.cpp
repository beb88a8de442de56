#include "ensemble/planar/fastening.hpp"

#include <algorithm>
#include <limits>

namespace stylobate {
namespace {

/// Of the highest fixed drum of a column, or of the base.
double ground_under(const Layout& layout, const PlacedBlock& drum)
{
    double ground_m = 0;
    for (const PlacedBlock& below : layout.blocks)
        if (below.fixed && below.role == BlockRole::drum && below.column == drum.column)
            ground_m = std::max(ground_m, below.top());
    return ground_m;
}

BlockMechanisms rod_of(const MechanismSpec& spec)
{
    BlockMechanisms rod;
    const auto parameters = rule_of(spec.mechanism).parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        rod.**std::get_if<double BlockMechanisms::*>(&parameters[i].member) = spec.values[i];
    return rod;
}

Fastening fastening(const MechanismSpec& spec, const Layout& layout, std::size_t place)
{
    const PlacedBlock& block = layout.blocks[place];
    Fastening made;
    made.at.block = place;
    if (spec.mechanism == Mechanism::rod) {
        made.rod = rod_of(spec);
        made.at.y_m = made.rod.rod_height_m - block.height_m / 2;
    } else if (spec.mechanism == Mechanism::tendon) {
        made.at.y_m = block.height_m / 2;
        made.other = FastenedPoint{std::nullopt, block.x_m(), ground_under(layout, block)};
    } else { // a clamp, long enough to be seen on both blocks
        const auto beside = static_cast<std::size_t>(right_neighbour(layout, static_cast<int>(place)));
        const PlacedBlock& right = layout.blocks[beside];
        const double inside = std::min({block.height_m, block.width_m, right.width_m}) / 4;
        const double height = spec.values[4];
        made.at.x_m = block.width_m / 2 - inside;
        made.at.y_m = height;
        made.other = FastenedPoint{beside, inside - right.width_m / 2, block.y_m + height - right.y_m};
    }
    return made;
}

} // namespace

std::optional<FastenedLine> line_of(const Fastening& fastening, const std::vector<Rectangle>& blocks,
                                    const Rectangle& start, double time_s, double base_m)
{
    const FastenedPoint& at = fastening.at;
    const Rectangle& held = blocks[*at.block];
    if (!held.is_finite())
        return std::nullopt;
    Rectangle::Corner from = held.place(at.x_m, at.y_m);
    if (!fastening.other) {
        const double end_m = start.place(at.x_m, at.y_m).x + fastening.rod.rod_end_m(time_s, base_m);
        const bool right = fastening.from_the_right();
        if (fastening.only_pushes())
            from.x = right ? std::max(from.x, end_m) : std::min(from.x, end_m);
        const double far = std::numeric_limits<double>::infinity();
        return FastenedLine{from, {right ? far : -far, from.y}};
    }
    const FastenedPoint& other = *fastening.other;
    if (!other.block)
        return FastenedLine{from, {other.x_m, other.y_m}};
    const Rectangle& beside = blocks[*other.block];
    return beside.is_finite() ? std::optional(FastenedLine{from, beside.place(other.x_m, other.y_m)}) : std::nullopt;
}

std::vector<Fastening> fastenings(const std::vector<MechanismSpec>& mechanisms, double friction, const Layout& layout)
{
    std::vector<Fastening> made;
    for (const MechanismSpec& spec : mechanisms) {
        const Mechanism is = spec.mechanism;
        if ((is == Mechanism::tendon || is == Mechanism::clamp || is == Mechanism::rod) && acts(spec, friction))
            for (const int place : spec.places.empty() ? usual_places(rule_of(is), layout) : spec.places)
                made.push_back(fastening(spec, layout, static_cast<std::size_t>(place)));
    }
    return made;
}

} // namespace stylobate
