#include "ensemble/model/structure.hpp"
#include "io/keys/contact_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/run_keys.hpp"
#include "io/keys/structure_keys.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// The tables of all blocks that have a bed of their own.
std::vector<KeyReader> tables_of_beds(const KeyReader& structure)
{
    using namespace structure_keys;
    std::vector<KeyReader> owners = structure.tables(column_list);
    owners.push_back(structure);
    std::vector<KeyReader> beds = structure.tables(epistyles);
    for (const KeyReader& owner : owners) {
        for (KeyReader& drum : owner.tables(drums))
            beds.push_back(std::move(drum));
        beds.push_back(owner.table(capital));
    }
    return beds;
}

/// A mechanism that acts on the base alone, or moves a block.
bool is_supported(Mechanism mechanism)
{
    return mechanism == Mechanism::drum_offset || mechanism == Mechanism::sensor_gain ||
           mechanism == Mechanism::time_offset || mechanism == Mechanism::harmonic_distortion;
}

} // namespace

ContactSpec read_contact(const KeyReader& keys, const StructureSpec& structure, const ChosenContact& chosen)
{
    using namespace contact_keys;
    ContactSpec c;
    c.form = chosen.form ? *chosen.form : keys.read(form);
    const char* word = word_for(contact_form_names, c.form);
    keys.refuse_unused(table, "contact.form", word);
    const KeyUse use{{{"contact.form", word}}};
    keys.read_fields(table, c, chosen.stiffness_n_m2 ? use.without({&normal_stiffness}) : use);
    if (c.form == ContactForm::rigid) {
        c.normal_damping_ratio = c.tangential_damping_ratio = 0;
        return c;
    }
    c.normal_stiffness_n_m2 = chosen.stiffness_n_m2.value_or(c.normal_stiffness_n_m2);
    double widest = 0;
    for (const DrumSpec& drum : structure.columns[0].drums)
        widest = std::max(widest, drum.width_m);
    // as stiff along the bed as across it: K_T is the axial stiffness K_N B of the full bed
    if (!keys.has(tangential_stiffness))
        c.tangential_stiffness_n_m = c.normal_stiffness_n_m2 * widest;
    return c;
}

void refuse_restitution(const KeyReader& top)
{
    const std::string key = structure_keys::bed_restitution.name;
    for (const KeyReader& bed : tables_of_beds(top.table(structure_keys::table)))
        if (bed.has(key))
            bed.refuse(key, "is the restitution of a bed, which only contact.form = \"rigid\" uses",
                       "Remove it, or give contact.form = \"rigid\".");
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
    for (const KeyReader& bed : tables_of_beds(top.table(structure_keys::table)))
        for (const TomlKey* key : std::initializer_list<const TomlKey*>{
                 &structure_keys::bed_normal_stiffness, &structure_keys::bed_tangential_stiffness,
                 &structure_keys::bed_normal_damping, &structure_keys::bed_tangential_damping})
            if (bed.has(*key))
                return RigidObstacle{bed, key->name, "is not used by " + form, "Remove it."};
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
