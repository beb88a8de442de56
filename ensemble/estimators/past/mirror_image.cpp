#include "ensemble/estimators/past/mirror_image.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

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
