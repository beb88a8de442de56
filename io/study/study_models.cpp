/// Which keys and kinds the model of a study has: the plane or space.

#include "io/keys/study_keys.hpp"
#include "io/keys/study_tables.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <string_view>

namespace stylobate {
namespace {

/// What a key of the other model is replaced by.
struct Counterpart {
    std::string_view key;
    const char* todo;
};

constexpr Counterpart of_planar_keys[] = {
    {"contact.normal_stiffness_n_m2",
     "Give normal_stiffness_n_m3, the stiffness per area of the bed: K_N over the depth."},
    {"contact.tangential_stiffness_n_m", "Give tangential_stiffness_n_m3, the stiffness per area of the bed."},
    {"normal_stiffness_n_m2", "Give normal_stiffness_n_m3, the stiffness per area of the bed."},
    {"tangential_stiffness_n_m", "Give tangential_stiffness_n_m3, the stiffness per area of the bed."},
    {"normal_damping_n_s_m", "Give normal_damping_ratio."},
    {"tangential_damping_n_s_m", "Give tangential_damping_ratio."},
    {"contact.damping_per", "Remove it: in space the dashpot is spread over the contact."},
    {"contact.form", "Remove it: in space plane faces press on each other by the depth of their overlap."},
    {"structure.depth_m",
     "Remove it: round and square drums are as deep as they are wide. Those of shape = \"rectangle\" have "
     "drum_depth_m, and epistyles epistyle_width_m."},
    {"mechanisms.vertical_motion", "Give excitation.vertical_ratio or excitation.vertical."},
    {"run.precision", "Remove it: in space steps are computed in double precision."},
    {"run.step_bound", "Remove it: in space the safe step is that of each block held by its neighbours."},
    {"sd_n_m2", "Give cov, or a lognormal distribution."},
    {"sd_n_m", "Give cov, or a lognormal distribution."},
    {"force_n_m", "Give strength_pa, the adhesion per area of the bed."}};
constexpr Counterpart of_spatial_keys[] = {
    {"contact.normal_stiffness_n_m3",
     "Give normal_stiffness_n_m2, K_N for the whole depth, or structure.dimensions = 3."},
    {"contact.tangential_stiffness_n_m3",
     "Give tangential_stiffness_n_m, K_T for the whole depth, or structure.dimensions = 3."},
    {"structure.drum_depth_m", "Give depth_m, the depth of all blocks, or structure.dimensions = 3."},
    {"strength_pa", "Give force_n_m, the adhesion per length of the bed, or structure.dimensions = 3."}};

std::string advice(const std::string& path, const std::string& name, bool spatial)
{
    const auto in = [&](const auto& counterparts) -> std::optional<std::string> {
        for (const Counterpart& each : counterparts)
            if (each.key == path || each.key == name)
                return each.todo;
        return std::nullopt;
    };
    const auto found = spatial ? in(of_planar_keys) : in(of_spatial_keys);
    return found.value_or(fmt::format("Remove it, or give {} = {}.", model_key, spatial ? 2 : 3));
}

void refuse_in_table(const KeyReader& keys, const TomlKey& table, const std::string& above, bool spatial)
{
    for (const TomlKey* key : table.keys) {
        const TomlValue* value = keys.find(key->name);
        if (value == nullptr)
            continue;
        const std::string path = above.empty() ? key->name : above + "." + key->name;
        if (!key->used_where(model_key, spatial ? "3" : "2"))
            keys.refuse(key->name, fmt::format("is not used by {} = {}", model_key, spatial ? 3 : 2),
                        advice(path, key->name, spatial));
        if (value->type == TomlValue::Type::table)
            refuse_in_table(keys.table(key->name), *key, path, spatial);
        else if (value->type == TomlValue::Type::array && !key->keys.empty())
            for (const KeyReader& each : keys.tables(key->name))
                refuse_in_table(each, *key, path, spatial);
    }
}

} // namespace

void refuse_other_model(const KeyReader& top, const Study& study)
{
    const bool spatial = study.structure.spatial();
    refuse_in_table(top, study_file_keys(), "", spatial);
    if (spatial && study.kind == StudyKind::survival)
        top.table(study_keys::table.name)
            .refuse(study_keys::kind.name, fmt::format("is not available with {} = 3", model_key),
                    fmt::format("Give another kind, or {} = 2.", model_key));
    const KeyReader contact = top.table(contact_keys::table.name);
    if (spatial && contact.has(contact_keys::damping) && contact.read(contact_keys::damping) == DampingAt::centroid)
        contact.refuse(contact_keys::damping.name, fmt::format("is not available with {} = 3", model_key),
                       "Give \"ends\", or remove it: in space the dashpot is spread over the contact.");
    const KeyReader outcome = top.table(outcome_keys::table.name);
    if (spatial && outcome.has(outcome_keys::follow) && outcome.read(outcome_keys::follow) == Follow::rest)
        outcome.refuse(outcome_keys::follow.name, fmt::format("is not available with {} = 3", model_key),
                       "In space a realization is followed until a block has fallen: give follow = \"collapse\", or "
                       "omit it.");
}

} // namespace stylobate
