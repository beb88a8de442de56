#pragma once
/// The sections of a study file, each read by a file of its own. All throw InputError, which names the key.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"
#include "io/keys/spread_key.hpp"
#include "io/records/record.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

// What `run.accuracy` chooses of the numerics where a study gives nothing, while the study is read. Each choice is
// noted in `Study::chosen` with its reason; where no choice is known to reach the accuracy, the study is refused.
//
// The figures are measured: `docs/rigid_limit.md` (rigid contacts and their steps) and `docs/work_precision.md` (the
// others), both with `bench/accuracy_studies.cpp`.

/// The weight on a bed over K_N B, as a part of the smaller side of the block above. Between this and a tenth of it,
/// that is ten times the stiffness, collapse probabilities of eleven studies with contacts at two corners differ by
/// less than 0.1.
inline constexpr double two_corner_sinkage = 1e-5;

/// The largest such part of a study's beds.
double largest_sinkage_part(const Study& study);

/// What is chosen of the contacts before they are read.
struct ChosenContact {
    std::optional<ContactForm> form;      ///< none: as given
    std::optional<double> stiffness_n_m2; ///< K_N; none: as given, or none of rigid contacts
};

/// Form and K_N of a study with an accuracy and without K_N.
/// @param top of the file   @param study its structure and outcome must be read
/// @throws InputError where the accuracy cannot be reached, with the reason
ChosenContact choose_contact(const KeyReader& top, Study& study);

/// The steps and the precision of contacts that yield; `run.accuracy` must be read. Nothing without an accuracy.
void choose_steps(const KeyReader& keys_of_run, Study& study);

/// Refuses the keys of a file that the model of the study does not use, kinds that the model does not have, and values
/// that it has not.
/// @param top of the file   @param study its kind and the number of its dimensions must be read
void refuse_other_model(const KeyReader& top, const Study& study);

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

/// @param top   of the file; what the axes of [surface] give is refused in [excitation]
/// @param study in a fragility study the records and how strong they are come from [fragility]
ExcitationSpec read_excitation(const KeyReader& top, StudyKind study, const StructureSpec& structure);
/// The vertical component of a record or table in space; none where the study has none.
std::optional<VerticalSpec> read_vertical(const KeyReader& keys, StudyKind study, const ExcitationSpec& excitation);
/// Refuses a direction that is given twice: by [excitation] and by what replaces it.
/// @param top of the file
void check_direction(const KeyReader& top, const Study& study);
/// Refuses axes that the excitation cannot follow.
void check_axes(const KeyReader& surface, const ExcitationSpec& excitation, const SurfaceSpec& axes);
/// One name for a unit of acceleration that has several.
std::optional<std::string> acceleration_unit(std::optional<std::string> word);

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
/// @param pairs  the horizontal components are put together in pairs (`other_component`)
void list_records(const KeyReader& keys, const std::filesystem::path& beside, PgaRange pga, bool pairs,
                  FragilitySpec& fragility);

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
