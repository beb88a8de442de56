#include "io/study_structure.hpp"

#include "io/study_names.hpp"
#include "io/study_ranges.hpp"

#include <fmt/format.h>

#include <limits>

namespace stylobate {

StructureSpec read_structure(const KeyReader& keys)
{
    keys.allow_only({"kind", "blocks", "fixed_blocks", "drum_width_m", "drum_height_m", "depth_m", "drum_mass_kg",
                     "density_kg_m3", "gravity_m_s2"});
    if (keys.has("kind"))
        keys.word_index("kind", {"column"});

    StructureSpec s;
    s.blocks = static_cast<int>(keys.whole("blocks", 1, 200, "Drums of the column, the fixed ones counted."));
    s.fixed_blocks = static_cast<int>(keys.whole_or("fixed_blocks", 0, static_cast<std::uint64_t>(s.blocks - 1), 0,
                                                    "At least one of the drums must be free."));
    s.drum_width_m = keys.number("drum_width_m", length_range);
    s.drum_height_m = keys.number("drum_height_m", length_range);
    s.depth_m = keys.number("depth_m", length_range);
    s.gravity_m_s2 = keys.number_or("gravity_m_s2", gravity_range, s.gravity_m_s2);

    const double volume = s.drum_width_m * s.drum_height_m * s.depth_m;
    if (!(volume >= std::numeric_limits<double>::min()))
        keys.refuse("drum_width_m", "gives a drum without volume", length_range.hint);
    if (keys.has("drum_mass_kg") && keys.has("density_kg_m3"))
        keys.refuse("density_kg_m3", "and drum_mass_kg exclude each other", "Give one of the two.");
    if (keys.has("density_kg_m3")) {
        s.drum_mass_kg = keys.number("density_kg_m3", density_range) * volume;
        if (!mass_range.contains(s.drum_mass_kg))
            keys.refuse("density_kg_m3",
                        fmt::format("gives a mass of {} kg, outside {}", s.drum_mass_kg, mass_range.text()),
                        density_range.hint);
    } else if (keys.has("drum_mass_kg")) {
        s.drum_mass_kg = keys.number("drum_mass_kg", mass_range);
        // the mass of a density at the end of its range may round to just beyond it
        constexpr double slack = 1 + 1e-12;
        const double density = s.drum_mass_kg / volume;
        if (!(density > 0 && density <= density_range.high * slack))
            keys.refuse("drum_mass_kg",
                        fmt::format("makes a density of {:.6g} kg/m3, outside {}", density, density_range.text()),
                        "Masses are in kilograms and lengths in metres: is one in other units?");
    } else {
        keys.missing("drum_mass_kg", "Give the mass of a drum in kilograms, or density_kg_m3.");
    }
    return s;
}

} // namespace stylobate
