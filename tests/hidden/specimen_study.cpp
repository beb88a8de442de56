#include "io/files/toml_document.hpp"
#include "tests/hidden/specimen.hpp"

#include <fmt/format.h>

namespace stylobate::hidden {

namespace {

constexpr double stone_bed_n_m3 = 2e9; ///< stiffness of a dry joint per area: 1 to 10 GPa/m are usual

std::string line(const char* key, double value)
{
    return fmt::format("{} = {}\n", key, toml_number(value));
}

} // namespace

std::string study_text_of(const Planned& planned)
{
    const Specimen& s = planned.specimen;
    const bool frame = planned.kind == SpecimenKind::frame || planned.kind == SpecimenKind::frame_of_drums;
    const bool fixed = s.base_block_half_width_m.has_value();
    const int drums = planned.kind == SpecimenKind::frame            ? 1
                      : planned.kind == SpecimenKind::frame_of_drums ? 2
                                                                     : s.blocks() + (fixed ? 1 : 0);
    std::string text =
        fmt::format("# The specimen of a virtual campaign as planned: {}.\n\n[study]\nkind = \"single\"\n"
                    "seed = 1\n\n[structure]\nkind = \"{}\"\n",
                    s.name, frame ? "colonnade" : "column");
    if (frame)
        text += "columns = 2\n" + line("column_spacing_m", 2 * s.rest_x_m.back() - 2 * s.rest_x_m.front());
    text += fmt::format("blocks = {}\n", drums);
    if (fixed)
        text += "fixed_blocks = 1\n";
    text += line("drum_width_m", 2 * s.half_width_m.front()) + line("drum_height_m", 2 * s.half_height_m.front()) +
            line("depth_m", s.depth_m.front()) + line("drum_mass_kg", s.mass_kg.front());
    if (frame)
        text += line("epistyle_height_m", 2 * s.half_height_m.back()) + line("epistyle_mass_kg", s.mass_kg.back());
    const double stiffness = stone_bed_n_m3 * s.depth_m.front();
    text += "\n[contact]\n" + line("normal_stiffness_n_m2", stiffness) + line("normal_damping_ratio", 0.1) +
            line("tangential_damping_ratio", 0.1) + line("friction", s.friction_nominal.value()) +
            "\n[excitation]\nkind = \"none\"\n" + line("duration_s", planned.band.duration_s);
    return text;
}

} // namespace stylobate::hidden
