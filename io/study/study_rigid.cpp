#include "io/study/study_rigid.hpp"

#include "ensemble/model/structure.hpp"
#include "io/keys/contact_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/run_keys.hpp"
#include "io/keys/structure_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

/// @param names of the blocks' key
void refuse_restitution_of(const KeyReader& top, const BedSpec& bed, const char* names)
{
    if (bed.restitution)
        top.table(structure_keys::table)
            .refuse(names, "gives a bed a restitution, which only contact.form = \"rigid\" uses",
                    "Remove it, or give contact.form = \"rigid\".");
}

/// A mechanism that acts on the base alone, or moves a block.
bool is_supported(Mechanism mechanism)
{
    return mechanism == Mechanism::drum_offset || mechanism == Mechanism::sensor_gain ||
           mechanism == Mechanism::time_offset || mechanism == Mechanism::harmonic_distortion;
}

} // namespace

void refuse_restitution(const KeyReader& top, const Study& study)
{
    for (const ColumnSpec& column : study.structure.columns)
        for (const DrumSpec& drum : column.drums)
            refuse_restitution_of(top, drum.bed, "drums");
    for (const EpistyleSpec& epistyle : study.structure.epistyles)
        refuse_restitution_of(top, epistyle.bed, "epistyles");
}

std::optional<RigidObstacle> rigid_obstacle(const KeyReader& top, const StructureSpec& structure)
{
    const std::string form = "contact.form = \"rigid\"";
    const KeyReader mechanisms = top.table(mechanisms_table().name);
    for (const MechanismRule& rule : mechanism_rules())
        if (mechanisms.has(rule.name) && !is_supported(rule.mechanism))
            return RigidObstacle{
                mechanisms, rule.name, "is not available with " + form,
                "The rigid form supports drum_offset, sensor_gain, time_offset and harmonic_distortion. Remove "
                "it, or give contact.form = \"two_corner\" with a high stiffness."};
    const auto stiff = [](const BedSpec& bed) {
        return bed.normal_stiffness_n_m2 || bed.tangential_stiffness_n_m || bed.normal_damping_ratio ||
               bed.tangential_damping_ratio;
    };
    const KeyReader of_structure = top.table(structure_keys::table.name);
    for (const ColumnSpec& column : structure.columns)
        for (const DrumSpec& drum : column.drums)
            if (stiff(drum.bed))
                return RigidObstacle{of_structure, "drums",
                                     "gives a bed a stiffness or damping, which is not used by " + form, "Remove it."};
    for (const EpistyleSpec& epistyle : structure.epistyles)
        if (stiff(epistyle.bed))
            return RigidObstacle{of_structure, "epistyles",
                                 "gives a seat a stiffness or damping, which is not used by " + form, "Remove it."};
    const std::vector<PlacedBlock> blocks = lay_out(structure).blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        for (std::size_t k = i + 1; k < blocks.size(); ++k) {
            const PlacedBlock &a = blocks[i], &b = blocks[k];
            const double beside = std::max(a.left(), b.left()) - std::min(a.right(), b.right());
            const double over = std::max(a.bottom(), b.bottom()) - std::min(a.top(), b.top());
            if (over < -1e-9 && beside < 1e-9)
                return RigidObstacle{
                    top, contact_keys::table.name,
                    fmt::format("form = \"rigid\" has contacts at beds alone, and {} stands against {}", b.name,
                                a.name),
                    "Leave a gap between them, or give contact.form = \"two_corner\"."};
        }
    return std::nullopt;
}

} // namespace stylobate
