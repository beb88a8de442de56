#include "io/study/study_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/model/nominal.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/files/csv_fields.hpp"
#include "io/files/key_reader.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_keys.hpp"
#include "io/keys/study_tables.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

namespace stylobate {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;
constexpr std::size_t most_title_bytes = 200;
constexpr std::size_t longest_name = 60;
constexpr std::size_t most_searched_keys = 3; ///< that a search chooses

/// What a file's name may have, and what the files of a comparison are called.
bool is_name(const std::string& name)
{
    return !name.empty() && name.size() <= longest_name && name != "comparison" &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
                      c == '-';
           });
}

void lay(TomlValue& root, const std::string& above, const TomlValue& table, const std::string& why)
{
    for (const TomlValue& value : table.entries) {
        const std::string key = above.empty() ? value.key : above + "." + value.key;
        if (value.type == TomlValue::Type::table && value.key.find('.') == std::string::npos)
            lay(root, key, value, why);
        else
            apply_value(root, key, value, why);
    }
}

SearchedKey read_searched(const KeyReader& keys, const std::string& name)
{
    using namespace optimise_keys;
    keys.allow_only(any.names());
    SearchedKey key{name, keys.read(from), keys.read(to), keys.read(spacing)};
    if (!(key.from < key.to))
        keys.refuse(to.name, fmt::format("is not above from = {:g}", key.from), "Give from < to.");
    if (key.spacing == Spacing::log && !(key.from > 0))
        keys.refuse(from.name, "is not above 0, as spacing = \"log\" needs", "Give spacing = \"linear\".");
    if (const double ratio = key.to / key.from; key.spacing == Spacing::log && !(ratio > 1 && std::isfinite(ratio)))
        keys.refuse(to.name, fmt::format("is {:g} times from = {:g}", ratio, key.from),
                    "Give limits whose ratio is above 1 and finite.");
    return key;
}

/// Names of the variants, in the order of their characters. Each is a part of a file's name.
/// @throws InputError if a name is none, or if a variant is no table
std::vector<std::string> variant_names(const KeyReader& top)
{
    const TomlValue* table = top.find(variants_keys::table.name);
    if (!table)
        return {};
    if (table->type != TomlValue::Type::table)
        top.refuse(table->key, "is not a table", "Give [variants] with a table for each variant.");
    const KeyReader keys = top.table(variants_keys::table.name);
    std::vector<std::string> names;
    for (const TomlValue& variant : table->entries) {
        if (!is_name(variant.key))
            keys.refuse(variant.key, "has a name that no results file can have",
                        fmt::format("Name it with at most {} letters, digits, _ and -; \"comparison\" is taken.",
                                    longest_name));
        if (variant.type != TomlValue::Type::table)
            keys.refuse(variant.key, "is not a table",
                        "Give " + variant.key + " = { \"KEY\" = VALUE }, such as { \"contact.friction\" = 0.4 }.");
        names.push_back(variant.key);
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Lays a variant over the study: a key with dots, or any value but a table, replaces what is there; a table under a
/// key without dots is laid over it key by key.
/// @throws InputError if there is no such variant, with those that there are
void apply_variant(TomlValue& root, const std::string& name, const std::string& file)
{
    const TomlValue* table = root.find(variants_keys::table.name);
    const TomlValue* variant = table ? table->find(name) : nullptr;
    if (!variant) {
        std::vector<std::string> names;
        if (table)
            for (const TomlValue& each : table->entries)
                names.push_back(each.key);
        throw InputError(file, 0,
                         fmt::format("[variants] has no '{}'; it has {}.", name,
                                     names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "))));
    }
    const TomlValue overrides = *variant; // the tree that it lies in changes
    for (const char* own : {"variants", "optimise"})
        for (const TomlValue& value : overrides.entries)
            if (value.key == own || value.key.starts_with(std::string(own) + "."))
                throw InputError(value.place.source, value.place.line,
                                 fmt::format("variants.{}: {} is no key of a variant.\n  A variant changes the study.",
                                             name, value.key));
    lay(root, "", overrides, "variants." + name);
}

/// @throws InputError for what is wrong with it; nothing if there is no [optimise]
std::optional<OptimiseSpec> read_optimise(const KeyReader& top)
{
    const TomlValue* table = top.find(optimise_keys::table.name);
    if (!table)
        return std::nullopt;
    const KeyReader keys = top.table(optimise_keys::table.name);
    OptimiseSpec spec;
    spec.minimise = keys.read_or(optimise_keys::minimise, spec.minimise);
    spec.hazard = keys.maybe(optimise_keys::hazard);
    spec.budget = keys.read(optimise_keys::budget);
    for (const TomlValue& value : table->entries)
        if (value.key != optimise_keys::minimise.name && value.key != optimise_keys::hazard.name &&
            value.key != optimise_keys::budget.name) {
            if (value.type != TomlValue::Type::table)
                keys.refuse(value.key, "is not a table",
                            "Give \"KEY\" = { from = ..., to = ... }; the other keys are minimise, hazard and budget.");
            if (std::ranges::any_of(value.entries, [](const auto& e) { return e.type == TomlValue::Type::table; }))
                keys.refuse(value.key, "contains tables",
                            "A key with dots stands in quotes: \"contact.friction\" = { from = ..., to = ... }.");
            spec.keys.push_back(read_searched(keys.table(value.key), value.key));
        }
    if (spec.keys.empty() || spec.keys.size() > most_searched_keys)
        top.refuse(table->key, fmt::format("has {} keys of the study to choose", spec.keys.size()),
                   "Give one to three, each as \"KEY\" = { from = ..., to = ... }.");
    std::sort(spec.keys.begin(), spec.keys.end(),
              [](const SearchedKey& a, const SearchedKey& b) { return a.key < b.key; });
    return spec;
}

/// @param structure must be read: from where it may be leaned
InitialSpec read_initial(const KeyReader& keys, const StructureSpec& structure)
{
    std::size_t fewest = structure.columns[0].drums.size();
    for (const ColumnSpec& column : structure.columns)
        fewest = std::min(fewest, column.drums.size());
    keys.read_up_to(initial_keys::tilt_from_block, fewest - 1);
    InitialSpec initial;
    keys.read_fields(initial_keys::table, initial);
    return initial;
}

/// @param structure decides how long a realization is followed unless the study gives it
OutcomeSpec read_outcome(const KeyReader& keys, const StructureSpec& structure)
{
    using namespace outcome_keys;
    OutcomeSpec o;
    o.follow = structure.kind == StructureKind::colonnade && !structure.spatial() ? Follow::rest : Follow::collapse;
    keys.read_fields(table, o);
    keys.table(collapse).read_fields(collapse, o);
    return o;
}

/// How many trajectories a single study keeps; others keep none.
void read_trajectories(const KeyReader& keys, StudyKind kind, OutputSpec& output)
{
    if (kind != StudyKind::single)
        return keys.refuse_unused(output_keys::table, "study.kind", word_for(study_kind_names, kind),
                                  "Remove it: only single studies keep trajectories. `stylobate replay` computes that "
                                  "of any realization.");
    const WholeKey& key = output_keys::trajectories;
    if (const TomlValue* kept = keys.find(key.name); kept && kept->type == TomlValue::Type::string) {
        if (key.words[keys.word_index(key.name, key.words)] == trajectories_all)
            output.trajectories = OutputSpec::all;
    } else if (kept) {
        output.trajectories = keys.read(key);
    }
}

/// The checks that the study is meant to fail, in the order of the checks.
std::vector<std::string> read_allow(const KeyReader& keys)
{
    std::vector<std::string> allow;
    const TomlValue* list = keys.find(study_keys::allow.name);
    if (!list)
        return allow;
    const std::vector<std::string> known = check_names();
    std::string names;
    for (const std::string& name : known)
        names += (names.empty() ? "" : ", ") + toml_quoted(name);
    const std::string todo = fmt::format("Give names of checks: allow = [\"{}\"]. They are {}.", known.front(), names);
    if (list->type != TomlValue::Type::array)
        keys.refuse(study_keys::allow.name, fmt::format("is {}, not a list", list->type_name()), todo);
    for (const TomlValue& entry : list->entries)
        if (entry.type != TomlValue::Type::string || std::find(known.begin(), known.end(), entry.text) == known.end()) {
            const auto meant = nearest_word(entry.text, known);
            keys.refuse(study_keys::allow.name, fmt::format("contains {}, which is not a check", entry.shown()),
                        meant ? fmt::format("Did you mean {}?", toml_quoted(*meant)) : todo);
        }
    for (const std::string& name : known)
        if (std::any_of(list->entries.begin(), list->entries.end(),
                        [&](const TomlValue& entry) { return entry.text == name; }))
            allow.push_back(name);
    return allow;
}

/// @param study its kind, structure, excitation and surface must be read
void read_output(const KeyReader& keys, Study& study)
{
    OutputSpec& output = study.output;
    output.trajectory_rate_hz = std::min(usual_trajectory_rate_hz(study), output_keys::trajectory_rate.range.high);
    keys.read_fields(output_keys::table, output, key_use(study));
    read_trajectories(keys, study.kind, output);
    keys.read_fields(output_keys::table, study);
    const auto refuse = [&](const std::string& why) {
        keys.refuse(output_keys::realizations.name, "= \"none\" is not available with " + why,
                    "Only a surface with equal numbers of realizations in each cell can omit their rows. Give "
                    "realizations = \"all\", or omit it.");
    };
    if (study.kept == KeptRealizations::none && study.kind != StudyKind::surface)
        refuse(fmt::format("study.kind = \"{}\"", word_for(study_kind_names, study.kind)));
    if (study.kept == KeptRealizations::none && study.surface->adaptive)
        refuse("surface.adaptive");
}

/// Single precision knows the paper's model alone.
void check_precision(const KeyReader& keys, const Study& study)
{
    const auto refuse = [&](const std::string& why, const char* what) {
        keys.refuse(run_keys::precision.name, "is not available with " + why,
                    std::string("Single precision supports only the paper's model and rigid columns: remove ") + what +
                        ", or give precision = \"double\".");
    };
    if (!study.mechanisms.empty())
        refuse(fmt::format("mechanisms.{}", to_string(study.mechanisms.front().mechanism)), "it");
    if (study.contact.form == ContactForm::rigid && study.structure.kind == StructureKind::colonnade)
        refuse("rigid contacts and epistyles, whose loops need double precision", "the epistyles");
    if (study.contact.form != ContactForm::area && study.contact.form != ContactForm::rigid)
        refuse(fmt::format("contact.form = \"{}\"", word_for(contact_form_names, study.contact.form)), "it");
    if (study.contact.damping != DampingAt::centroid)
        refuse("contact.damping = \"ends\"", "it");
}

/// A measure of pairs where there are none. @param keys of [fragility]
void check_pairs(const KeyReader& keys, const Study& study)
{
    if (keys.read(fragility_keys::of_pair) != OfPair::geometric_mean && !study.has_pairs())
        keys.refuse(fragility_keys::of_pair.name, "needs a second component, and there is none",
                    "Give excitation.second (of synthetic motions excitation.second_ratio), or remove it.");
}

/// The motions of a fragility study and how strong they are. @param folder of the study
void read_motions(const KeyReader& top, const std::filesystem::path& folder, Study& study)
{
    const KeyReader keys = top.table(study_keys::table);
    if (!top.has("fragility"))
        top.missing("fragility", "study.kind = \"fragility\" needs its motions and intensities in [fragility].");
    const KeyReader fragility = top.table(fragility_keys::table);
    study.fragility = read_fragility(fragility, keys, study.excitation, study.realizations);
    list_records(fragility, folder, pga_range(study), study.excitation.second.has_value(), *study.fragility);
    check_pairs(fragility, study);
    if (study.sampling != Sampling::independent)
        keys.refuse("sampling", "is not used by study.kind = \"fragility\"", "Remove it.");
}

/// What belongs to one base motion does not go with many.
void check_mechanisms_of_fragility(const KeyReader& keys, const Study& study)
{
    for (const char* name : {"harmonic_distortion", "time_offset"})
        if (keys.has(name))
            keys.refuse(name, "is a measured table's, and is not used by study.kind = \"fragility\"", "Remove it.");
    if (study.vertical && !study.structure.spatial())
        keys.refuse("vertical_motion", "is one record, and study.kind = \"fragility\" has many motions",
                    "Give vertical_motion = { ratio = ... }, or remove it.");
}

RunSpec read_run(const KeyReader& keys, const KeyUse& use)
{
    using namespace run_keys;
    keys.refuse_unused(table, "contact.form", use.kinds.at("contact.form"));
    RunSpec r;
    keys.read_fields(table, r, use.without({&step_fraction}));
    r.step_fraction = keys.read_within(step_fraction, r.allow_step_above_bound ? any_step : stable_step);
    return r;
}

/// Refuses the table of another kind of study, and what is wrong with those that are not the study's own.
void check_tables(const KeyReader& top, StudyKind of_study)
{
    variant_names(top);
    read_optimise(top);
    const char* word = word_for(study_kind_names, of_study);
    for (const TomlKey* table : study_file_keys().keys)
        if (!table->used_where("study.kind", word) && top.has(*table))
            top.refuse(table->name, fmt::format("is not used by study.kind = \"{}\"", word),
                       fmt::format("Remove [{}], or give study.kind = \"{}\".", table->name,
                                   table->used.front().values.front()));
}

/// How many realizations. @param keys of [study]
std::uint64_t read_realizations(const KeyReader& keys, const Study& study)
{
    const WholeKey& key = study_keys::realizations;
    const auto refuse = [&](const char* kind, const char* instead) {
        if (keys.has(key))
            keys.refuse(key.name, fmt::format("is not used by study.kind = \"{}\"", kind),
                        fmt::format("Give {} instead.", instead));
    };
    switch (study.kind) {
    case StudyKind::surface:
    case StudyKind::survival:
        return keys.whole(key.name, key.low, key.high, "The number in each cell.");
    case StudyKind::fragility:
        return keys.whole(key.name, key.low, key.high, "Structures under each motion in each stripe.");
    case StudyKind::sensitivity:
        refuse("sensitivity", "sensitivity.samples and sensitivity.inner");
        break;
    case StudyKind::rare:
        refuse("rare", "rare.samples and rare.repeats");
        break;
    case StudyKind::single:
        break;
    }
    return keys.read_or(key, study.realizations);
}

/// What a study has beside its axes: the state of a structure, or perturbed replicas.
void read_beside_surface(const KeyReader& top, Study& study, const std::filesystem::path& folder)
{
    const KeyReader keys = top.table(study_keys::table);
    if (study.kind == StudyKind::survival) {
        study.survival = read_survival(top, study, folder);
        if (study.total() > most_realizations)
            keys.refuse("realizations",
                        fmt::format("with up to {} events are {} in all, more than {}", study.events(), study.total(),
                                    most_realizations),
                        "Give fewer realizations, cells or events.");
    }
    if (top.has("twins")) {
        study.replicas = read_replicas(top.table(twins_keys::table), study);
        if (study.total() > most_realizations)
            keys.refuse("realizations",
                        fmt::format("and {} replicas of each give {}, more than {}", study.replicas->kinds.size(),
                                    study.total(), most_realizations),
                        "Give fewer realizations, cells or replicas.");
    }
}

/// @param folder beside which the study's files are looked for
Study read_tree(const TomlValue& root, const std::filesystem::path& folder)
{
    const KeyReader top(&root, "", root.place);
    std::vector<std::string> tables = study_file_keys().names();
    tables.emplace_back("claim"); // for stylobate_claims, which reads it itself
    top.allow_only(tables);

    Study study;
    const KeyReader keys = top.table(study_keys::table);
    keys.read_fields(study_keys::table, study, KeyUse{}.without({&study_keys::realizations}));
    if (study.title && (study.title->size() > most_title_bytes || study.title->find('\n') != std::string::npos))
        keys.refuse("title", "is not a valid line of text",
                    fmt::format("At most {} bytes, on one line.", most_title_bytes));
    const bool is_fragility = study.kind == StudyKind::fragility;
    const bool is_sensitivity = study.kind == StudyKind::sensitivity, is_rare = study.kind == StudyKind::rare;
    study.realizations = read_realizations(keys, study);
    study.allow = read_allow(keys);
    if (is_rare && study.sampling != Sampling::independent)
        keys.refuse("sampling", "is not for study.kind = \"rare\"", "Remove it: chains use their own random numbers.");

    study.structure.dimensions =
        static_cast<int>(top.table(structure_keys::table.name).read(structure_keys::dimensions));
    refuse_other_model(top, study);
    study.structure = read_structure(top.table(structure_keys::table));
    study.outcome = read_outcome(top.table(outcome_keys::table), study.structure);
    study.contact = read_contact(top.table(contact_keys::table), study.structure, choose_contact(top, study));
    study.excitation = read_excitation(top, study.kind, study.structure);
    study.vertical = read_vertical(top.table(excitation_keys::table), study.kind, study.excitation);
    if (has_axes(study.kind)) {
        if (!top.has("surface"))
            top.missing("surface", fmt::format("study.kind = \"{}\" needs the axes frequency_hz and pga_m_s2 in "
                                               "[surface].",
                                               word_for(study_kind_names, study.kind)));
        study.surface = read_surface(top.table(surface_keys::table), study.realizations);
        check_axes(top.table(surface_keys::table), study.excitation, *study.surface);
    }
    if (is_fragility)
        read_motions(top, folder, study);
    if (study.cells() > most_realizations / study.realizations)
        keys.refuse("realizations",
                    fmt::format("in each of {} cells is {:.0f} in all, more than {}", study.cells(),
                                static_cast<double>(study.cells()) * static_cast<double>(study.realizations),
                                most_realizations),
                    "Give fewer realizations or fewer cells.");
    check_tables(top, study.kind);
    read_mechanisms(top.table(mechanisms_table()), study);
    read_perturbations(top.table(perturbation_table()), study);
    check_direction(top, study);
    if (is_fragility)
        check_mechanisms_of_fragility(top.table(mechanisms_table()), study);
    if (is_sensitivity)
        study.sensitivity = read_sensitivity(top.table(sensitivity_keys::table), study);

    if (is_rare)
        study.rare = read_rare(top.table(rare_keys::table), study);

    study.initial = read_initial(top.table(initial_keys::table), study.structure);
    read_output(top.table(output_keys::table), study);
    study.run = read_run(top.table(run_keys::table), key_use(study));
    if (study.contact.form == ContactForm::rigid) {
        if (const auto obstacle = rigid_obstacle(top, study.structure))
            obstacle->refuse();
    } else {
        refuse_restitution(top);
    }
    choose_steps(top.table(run_keys::table), study);
    if (study.run.precision == Precision::single)
        check_precision(top.table(run_keys::table), study);
    read_beside_surface(top, study, folder);
    if (study.design().residuals && !top.table(excitation_keys::table).has(excitation_keys::tail))
        study.excitation.tail = Tail::rest;
    return study;
}

TomlValue read_toml(const std::string& text, const std::string& name, const std::vector<std::string>& overrides)
{
    TomlValue root = parse_toml(text, name);
    for (const auto& setting : overrides)
        apply_setting(root, setting);
    return root;
}

std::string read_text(const std::filesystem::path& file)
{
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw InputError(file.string(), 0, "is a folder.\n  Give a study file.");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::string text(largest_file + 1, '\0');
    if (in)
        in.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!in.is_open() || in.bad())
        throw InputError(file.string(), 0,
                         fmt::format("cannot be read: {}.\n  Check the path and its permissions.",
                                     errno != 0 ? std::strerror(errno) : "unknown error"));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > largest_file)
        throw InputError(file.string(), 0, "is larger than 1 MiB.\n  Is this a study file?");
    if (const auto reason = unreadable_encoding(text))
        throw InputError(file.string(), 0, *reason);
    return text;
}

/// The study of a tree that was read from a file.
Study study_of(const TomlValue& root, const std::filesystem::path& file)
{
    Study study = read_tree(root, std::filesystem::absolute(file).parent_path());
    // beside the study, if it is there; absolute, so that the study means the same from any folder
    const auto find_beside = [&](std::string& named, const TomlValue& table) {
        std::error_code error;
        const auto beside = std::filesystem::absolute(file, error).parent_path() / named;
        if (!error && !table.find("file")->place.command_line && std::filesystem::path(named).is_relative() &&
            std::filesystem::exists(beside, error))
            named = beside.lexically_normal().string();
    };
    if (!study.excitation.file.empty())
        find_beside(study.excitation.file, *root.find("excitation"));
    if (study.fragility && root.find("fragility")->find("records") != nullptr) {
        const auto& tables = root.find("fragility")->find("records")->entries;
        for (std::size_t i = 0; i < study.fragility->records.size(); ++i) {
            RecordSpec& record = study.fragility->records[i];
            find_beside(record.file, tables[i]);
            if (record.second && record.second->file)
                find_beside(*record.second->file, *tables[i].find("second"));
            if (record.vertical && record.vertical->file)
                find_beside(*record.vertical->file, *tables[i].find("vertical"));
        }
    }
    if (study.excitation.second && study.excitation.second->file)
        find_beside(*study.excitation.second->file, *root.find("excitation")->find("second"));
    if (study.vertical && study.vertical->file)
        find_beside(*study.vertical->file, study.structure.spatial()
                                               ? *root.find("excitation")->find("vertical")
                                               : *root.find("mechanisms")->find("vertical_motion"));
    study.text = study_text(study);
    return study;
}

} // namespace

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    return study_of(read_toml(read_text(file), file.string(), overrides), file);
}

Study read_variant(const std::filesystem::path& file, const std::string& variant,
                   const std::vector<std::string>& overrides)
{
    TomlValue root = read_toml(read_text(file), file.string(), overrides);
    apply_variant(root, variant, file.string());
    return study_of(root, file);
}

std::vector<std::string> read_variant_names(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides)
{
    const TomlValue root = read_toml(read_text(file), file.string(), overrides);
    return variant_names(KeyReader(&root, "", root.place));
}

std::optional<OptimiseSpec> read_optimisation(const std::filesystem::path& file,
                                              const std::vector<std::string>& overrides)
{
    const TomlValue root = read_toml(read_text(file), file.string(), overrides);
    std::optional<OptimiseSpec> spec = read_optimise(KeyReader(&root, "", root.place));
    if (spec && spec->hazard) { // beside the study file, unless it is a power law
        std::error_code none;
        const auto beside = std::filesystem::absolute(file, none).parent_path() / *spec->hazard;
        if (spec->hazard->find('=') == std::string::npos || std::filesystem::exists(beside, none))
            spec->hazard = beside.lexically_normal().string();
    }
    return spec;
}

Study parse_study(const std::string& text, const std::string& name, const std::vector<std::string>& overrides)
{
    Study study = read_tree(read_toml(text, name, overrides), {});
    study.text = study_text(study);
    return study;
}

void demand_double(const Study& study, const std::string& file, const std::string& what)
{
    if (study.run.precision == Precision::single)
        throw InputError(file, 0,
                         fmt::format("run.precision = \"single\" supports only the paper's model, and {} compares "
                                     "extensions of it.\n  Give precision = \"double\", or omit it.",
                                     what));
}

void demand_plane(const Study& study, const std::string& file, const std::string& what)
{
    if (study.structure.spatial())
        throw InputError(file, 0,
                         fmt::format("structure.dimensions = 3 is not available for {}, which compares poses in the "
                                     "plane.\n  Give a study with structure.dimensions = 2.",
                                     what));
}

double SearchedKey::value(double place) const
{
    if (place <= 0)
        return from;
    if (place >= 1)
        return to;
    return spacing == Spacing::log ? from * std::pow(to / from, place) : from + (to - from) * place;
}

double SearchedKey::place(double value) const
{
    return spacing == Spacing::log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
}

} // namespace stylobate
