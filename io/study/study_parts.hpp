#pragma once
/// The sections of a study file, each read by a file of its own. All throw InputError, which names the key.

#include "ensemble/model/study.hpp"
#include "io/keys/spread_key.hpp"
#include "io/records/record.hpp"
#include "io/study/study_accuracy.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

StructureSpec read_structure(const KeyReader& keys);

/// @param chosen by an accuracy
ContactSpec read_contact(const KeyReader& keys, const StructureSpec& structure, const ChosenContact& chosen);

/// What needs a contact that yields, or what the step of the rigid form leaves out. (Keys that only other forms use
/// are refused where they are read.)
struct RigidObstacle {
    KeyReader where; ///< the table of the key
    std::string key, what, todo;

    [[noreturn]] void refuse() const { where.refuse(key, what, todo); }
};
/// The first one of a study; none: its contacts may be rigid.
/// @param top of the file
std::optional<RigidObstacle> rigid_obstacle(const KeyReader& top, const StructureSpec& structure);
/// Refuses the restitution of a bed with contacts that yield.
/// @param top of the file
void refuse_restitution(const KeyReader& top);

/// @param study in a surface frequency and PGA come from its axes; in a fragility study the records and how strong they
///        are from [fragility]
ExcitationSpec read_excitation(const KeyReader& keys, StudyKind study);
/// Refuses axes that the excitation cannot follow.
void check_axes(const KeyReader& surface, const ExcitationSpec& excitation, const SurfaceSpec& axes);
/// One name for a unit of acceleration that has several.
std::string acceleration_unit(const std::string& word);

/// An axis: { from, to, count, spacing }.
/// @param table which has the axis   @param range of its values, where this study allows others than the key
Axis read_axis(const KeyReader& table, const AxisKey& key, const Range& range);
/// @param most realizations of one cell
SurfaceSpec read_surface(const KeyReader& keys, std::uint64_t most);

/// @param keys       the table [fragility]
/// @param study      the table [study], for the number of structures
/// @param excitation as read; a "record" one needs records here, any other a number of motions
FragilitySpec read_fragility(const KeyReader& keys, const KeyReader& study, const ExcitationSpec& excitation,
                             std::uint64_t structures);
/// Fills in the records of a folder: every horizontal component of every file that its pattern names, by name. Files
/// without accelerations and vertical components are listed in `FragilitySpec::left_out`.
/// @param beside a relative folder is looked for here first, then in the working folder
/// @param pga    as of `read_records`
void list_records(const KeyReader& keys, const std::filesystem::path& beside, PgaRange pga, FragilitySpec& fragility);

/// @param study with its perturbations
FactorDesign read_sensitivity(const KeyReader& keys, const Study& study);
/// @param study with its perturbations and its excitation
RareSpec read_rare(const KeyReader& keys, const Study& study);
/// @param study all else of it
ReplicasSpec read_replicas(const KeyReader& keys, const Study& study);
/// @param top    the whole file
/// @param study  all else of it
/// @param beside the study's folder: a hazard curve is looked for there, and then in the working folder
SurvivalSpec read_survival(const KeyReader& top, const Study& study, const std::filesystem::path& beside);

/// Reads [mechanisms] into `study.mechanisms` and `study.vertical`: each mechanism a table, or an array of tables where
/// it acts at several places with different values. Places with the same values become one entry.
/// @param study with its structure, contact and excitation filled in
void read_mechanisms(const KeyReader& section, Study& study);
/// Reads [perturbation] into `study.perturbations` and `study.mechanism_perturbations`.
/// @param study with all that has nominal values
void read_perturbations(const KeyReader& section, Study& study);

} // namespace stylobate
