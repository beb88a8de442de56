#include "io/study/study_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/files/key_reader.hpp"
#include "io/files/suggest.hpp"
#include "io/study/study_axis.hpp"
#include "io/study/study_excitation.hpp"
#include "io/study/study_fragility.hpp"
#include "io/study/study_mechanisms.hpp"
#include "io/study/study_names.hpp"
#include "io/study/study_perturbations.hpp"
#include "io/study/study_ranges.hpp"
#include "io/study/study_sensitivity.hpp"
#include "io/study/study_structure.hpp"
#include "io/study/study_twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

namespace stylobate {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;
constexpr std::size_t most_title_bytes = 200;
constexpr std::uint64_t most_realizations = 1'000'000'000;

/// A dashpot's ratio or its coefficient.
void read_damping(const KeyReader& keys, const std::string& direction, double& ratio,
                  std::optional<double>& coefficient)
{
    const std::string ratio_key = direction + "_damping_ratio";
    const std::string coefficient_key = direction + "_damping_n_s_m";
    if (keys.has(ratio_key) && keys.has(coefficient_key))
        keys.refuse(coefficient_key, "and " + ratio_key + " exclude each other", "Give one of the two.");
    ratio = keys.number_or(ratio_key, damping_ratio_range, ratio);
    coefficient = keys.maybe_number(coefficient_key, damping_range);
}

ContactSpec read_contact(const KeyReader& keys, const StructureSpec& structure)
{
    keys.allow_only({"normal_stiffness_n_m2", "tangential_stiffness_n_m", "normal_damping_ratio",
                     "normal_damping_n_s_m", "tangential_damping_ratio", "tangential_damping_n_s_m", "damping",
                     "damping_per", "form", "friction"});

    ContactSpec c;
    c.normal_stiffness_n_m2 = keys.number("normal_stiffness_n_m2", normal_stiffness_range);
    double widest = 0;
    for (const DrumSpec& drum : structure.columns[0].drums)
        widest = std::max(widest, drum.width_m);
    // as stiff along the bed as across it: K_T is the axial stiffness K_N B of the full bed
    c.tangential_stiffness_n_m =
        keys.number_or("tangential_stiffness_n_m", tangential_stiffness_range, c.normal_stiffness_n_m2 * widest);
    read_damping(keys, "normal", c.normal_damping_ratio, c.normal_damping_n_s_m);
    read_damping(keys, "tangential", c.tangential_damping_ratio, c.tangential_damping_n_s_m);
    c.form = keys.choice_or("form", contact_form_names, c.form);
    c.damping = keys.choice_or("damping", damping_at_names, c.damping);
    c.damping_per = keys.choice_or("damping_per", damping_per_names, c.damping_per);
    c.friction = keys.number("friction", friction_range);
    return c;
}

/// @param most realizations of one cell
AdaptiveSpec read_adaptive(const KeyReader& keys, std::uint64_t cells, std::uint64_t most)
{
    keys.allow_only({"budget", "minimum", "half_width", "borrow"});
    AdaptiveSpec adaptive;
    adaptive.minimum = keys.whole_or("minimum", 1, most, std::min(adaptive.minimum, most),
                                     "Realizations of each cell; at most study.realizations.");
    adaptive.budget = keys.whole(
        "budget", adaptive.minimum * cells, most_realizations,
        fmt::format("Realizations of the whole surface: {} cells have at least {} each.", cells, adaptive.minimum));
    adaptive.half_width = keys.number_or(
        "half_width", {0.01, 0.25, false, "Half the width of the 95 % interval of each cell's probability.", 0.01},
        adaptive.half_width);
    adaptive.borrow = keys.boolean_or("borrow", adaptive.borrow);
    return adaptive;
}

/// @param most realizations of one cell
SurfaceSpec read_surface(const KeyReader& keys, std::uint64_t most)
{
    keys.allow_only({"frequency_hz", "pga_m_s2", "adaptive"});
    SurfaceSpec surface;
    surface.frequency_hz = read_axis(keys, "frequency_hz", frequency_range);
    surface.pga_m_s2 = read_axis(keys, "pga_m_s2", acceleration_range);
    if (keys.has("adaptive"))
        surface.adaptive = read_adaptive(keys.table("adaptive"), static_cast<std::uint64_t>(surface.cells()), most);
    return surface;
}

/// @param structure must be read: from where it may be leaned
InitialSpec read_initial(const KeyReader& keys, const StructureSpec& structure)
{
    keys.allow_only({"tilt_rad", "tilt_from_block"});
    InitialSpec initial;
    initial.tilt_rad = keys.number_or("tilt_rad", initial_tilt_range, initial.tilt_rad);
    std::size_t fewest = structure.columns[0].drums.size();
    for (const ColumnSpec& column : structure.columns)
        fewest = std::min(fewest, column.drums.size());
    initial.tilt_from_block = static_cast<int>(
        keys.whole_or("tilt_from_block", 0, fewest - 1, 0, "A block of each column, counted from 0, from the bottom."));
    return initial;
}

/// @param kind decides how long a realization is followed unless the study says it
OutcomeSpec read_outcome(const KeyReader& keys, StructureKind kind)
{
    keys.allow_only({"follow", "collapse", "rocking_threshold_rad", "sliding_threshold"});
    OutcomeSpec o;
    o.follow =
        keys.choice_or("follow", follow_names, kind == StructureKind::colonnade ? Follow::rest : Follow::collapse);
    const KeyReader collapse = keys.table("collapse");
    collapse.allow_only({"height_fraction"});
    o.collapse_height_fraction = collapse.number_or(
        "height_fraction", {0.01, 0.99, false, "A fraction of the rest height.", 0.01}, o.collapse_height_fraction);
    o.rocking_threshold_rad = keys.number_or("rocking_threshold_rad", {0, 1.5, true, "Angles are in radians.", degree},
                                             o.rocking_threshold_rad);
    o.sliding_threshold =
        keys.number_or("sliding_threshold", {0, 100, true, "A fraction of the drum's width.", 0}, o.sliding_threshold);
    return o;
}

/// How many trajectories a single study keeps; others keep none.
void read_trajectories(const KeyReader& keys, StudyKind kind, OutputSpec& output)
{
    if (kind != StudyKind::single) {
        for (const char* key : {"trajectories", "most_mb"})
            if (keys.has(key))
                keys.refuse(key, fmt::format("is not used by study.kind = \"{}\"", word_for(study_kind_names, kind)),
                            "Remove it: only single studies keep trajectories. `stylobate replay` computes that of any "
                            "realization.");
        return;
    }
    output.most_mb = keys.number_or("most_mb", {0, 1e6, true, "The trajectories of a results file, in 1e6 bytes.", 0},
                                    output.most_mb);
    if (const TomlValue* kept = keys.find("trajectories"); kept && kept->type == TomlValue::Type::string) {
        if (keys.word_index("trajectories", {trajectories_fit, trajectories_all}) == 1)
            output.trajectories = OutputSpec::all;
    } else if (kept) {
        output.trajectories = keys.whole(
            "trajectories", 0, most_realizations,
            "The number of realizations, from the first; or \"all\", or \"fit\": as many as fit into most_mb.");
    }
}

/// The checks that the study is meant to fail, in the order of the checks.
std::vector<std::string> read_allow(const KeyReader& keys)
{
    std::vector<std::string> allow;
    const TomlValue* list = keys.find("allow");
    if (!list)
        return allow;
    const std::vector<std::string> known = check_names();
    std::string names;
    for (const std::string& name : known)
        names += (names.empty() ? "" : ", ") + toml_quoted(name);
    const std::string todo = fmt::format("Give names of checks: allow = [\"{}\"]. They are {}.", known.front(), names);
    if (list->type != TomlValue::Type::array)
        keys.refuse("allow", fmt::format("is {}, not a list", list->type_name()), todo);
    for (const TomlValue& entry : list->entries)
        if (entry.type != TomlValue::Type::string || std::find(known.begin(), known.end(), entry.text) == known.end()) {
            const std::string meant = nearest_word(entry.text, known);
            keys.refuse("allow", fmt::format("contains {}, which is not a check", entry.shown()),
                        meant.empty() ? todo : fmt::format("Did you mean {}?", toml_quoted(meant)));
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
    keys.allow_only({"trajectory_rate_hz", "realizations", "trajectories", "most_mb"});
    OutputSpec& output = study.output;
    output.trajectory_rate_hz =
        keys.number_or("trajectory_rate_hz", {0, 1e6, true, "Samples per second.", 0}, usual_trajectory_rate_hz(study));
    read_trajectories(keys, study.kind, output);
    study.kept = keys.choice_or("realizations", kept_realizations_names, study.kept);
    const auto refuse = [&](const std::string& why) {
        keys.refuse("realizations", "= \"none\" is not available with " + why,
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
        keys.refuse("precision", "is not available with " + why,
                    std::string("Single precision supports only the paper's model: remove ") + what +
                        ", or give precision = \"double\".");
    };
    if (!study.mechanisms.empty())
        refuse(fmt::format("mechanisms.{}", to_string(study.mechanisms.front().mechanism)), "it");
    if (study.contact.form != ContactForm::area)
        refuse(fmt::format("contact.form = \"{}\"", word_for(contact_form_names, study.contact.form)), "it");
    if (study.contact.damping != DampingAt::centroid)
        refuse("contact.damping = \"ends\"", "it");
}

/// What belongs to one base motion does not go with many.
void check_mechanisms_of_fragility(const KeyReader& keys, const Study& study)
{
    for (const char* name : {"harmonic_distortion", "time_offset"})
        if (keys.has(name))
            keys.refuse(name, "is a measured table's, and is not used by study.kind = \"fragility\"", "Remove it.");
    if (study.vertical)
        keys.refuse("vertical_motion", "is one record, and study.kind = \"fragility\" has many motions",
                    "Give vertical_motion = { ratio = ... }, or remove it.");
}

RunSpec read_run(const KeyReader& keys)
{
    keys.allow_only(
        {"precision", "step_fraction", "step_bound", "step_s", "allow_step_above_bound", "max_invalid_fraction"});
    RunSpec r;
    r.precision = keys.choice_or("precision", precision_names, r.precision);
    if (keys.has("step_fraction") && keys.has("step_s"))
        keys.refuse("step_s", "and step_fraction exclude each other", "Give one of the two.");
    r.allow_step_above_bound = keys.boolean_or("allow_step_above_bound", r.allow_step_above_bound);
    const Range stable{
        1e-6, 1, false,
        "It is a fraction of the largest safe step; a value above 1 needs run.allow_step_above_bound = true.", 0};
    const Range meant{1e-6, 100, false, stable.hint, 0};
    r.step_bound = keys.choice_or("step_bound", step_basis_names, r.step_bound);
    r.step_fraction = keys.number_or("step_fraction", r.allow_step_above_bound ? meant : stable, r.step_fraction);
    r.step_s = keys.maybe_number("step_s", {1e-12, 1, false, "Times are in seconds.", 1e-3});
    r.max_invalid_fraction = keys.number_or(
        "max_invalid_fraction", {0, 1, false, "A fraction of all realizations.", 0.01}, r.max_invalid_fraction);
    return r;
}

/// Refuses the table of another kind of study.
void check_tables(const KeyReader& top, StudyKind of_study)
{
    for (const auto& [table, kind] : {std::pair{"surface", StudyKind::surface},
                                      {"fragility", StudyKind::fragility},
                                      {"sensitivity", StudyKind::sensitivity},
                                      {"rare", StudyKind::rare}})
        if (of_study != kind && top.has(table))
            top.refuse(table, fmt::format("is not used by study.kind = \"{}\"", word_for(study_kind_names, of_study)),
                       fmt::format("Remove [{}], or give study.kind = \"{}\".", table, table));
}

/// How many realizations. @param keys of [study]
std::uint64_t read_realizations(const KeyReader& keys, const Study& study)
{
    const auto refuse = [&](const char* kind, const char* instead) {
        if (keys.has("realizations"))
            keys.refuse("realizations", fmt::format("is not used by study.kind = \"{}\"", kind),
                        fmt::format("Give {} instead.", instead));
    };
    switch (study.kind) {
    case StudyKind::surface:
        return keys.whole("realizations", 1, most_realizations, "The number in each cell.");
    case StudyKind::fragility:
        return keys.whole("realizations", 1, most_realizations, "Structures under each motion in each stripe.");
    case StudyKind::sensitivity:
        refuse("sensitivity", "sensitivity.samples and sensitivity.inner");
        break;
    case StudyKind::rare:
        refuse("rare", "rare.samples and rare.repeats");
        break;
    case StudyKind::single:
        break;
    }
    return keys.whole_or("realizations", 1, most_realizations, study.realizations);
}

/// @param folder beside which the study's files are looked for
Study read_tree(const TomlValue& root, const std::filesystem::path& folder)
{
    const KeyReader top(&root, "", root.place);
    top.allow_only({"study", "structure", "contact", "excitation", "surface", "twins", "fragility", "sensitivity",
                    "rare", "perturbation", "mechanisms", "initial", "output", "outcome", "run",
                    "claim"}); // [claim] is for stylobate_claims, which reads it itself

    Study study;
    const KeyReader keys = top.table("study");
    keys.allow_only({"kind", "title", "seed", "realizations", "sampling", "allow"});
    study.kind = keys.choice("kind", study_kind_names);
    study.title = keys.text_or_empty("title");
    if (study.title.size() > most_title_bytes || study.title.find('\n') != std::string::npos)
        keys.refuse("title", "is not a valid line of text",
                    fmt::format("At most {} bytes, on one line.", most_title_bytes));
    const bool is_surface = study.kind == StudyKind::surface, is_fragility = study.kind == StudyKind::fragility;
    study.seed = keys.whole_or("seed", 0, std::numeric_limits<std::int64_t>::max(), study.seed);
    const bool is_sensitivity = study.kind == StudyKind::sensitivity, is_rare = study.kind == StudyKind::rare;
    study.realizations = read_realizations(keys, study);
    study.sampling = keys.choice_or("sampling", sampling_names, study.sampling);
    study.allow = read_allow(keys);
    if (is_rare && study.sampling != Sampling::independent)
        keys.refuse("sampling", "is not for study.kind = \"rare\"", "Remove it: chains use their own random numbers.");

    study.structure = read_structure(top.table("structure"));
    study.contact = read_contact(top.table("contact"), study.structure);
    study.excitation = read_excitation(top.table("excitation"), study.kind);
    if (is_surface) {
        if (!top.has("surface"))
            top.missing("surface", "study.kind = \"surface\" needs the axes frequency_hz and pga_m_s2 in [surface].");
        study.surface = read_surface(top.table("surface"), study.realizations);
        check_axes(top.table("surface"), study.excitation, *study.surface);
    }
    if (is_fragility) {
        if (!top.has("fragility"))
            top.missing("fragility", "study.kind = \"fragility\" needs its motions and intensities in [fragility].");
        study.fragility = read_fragility(top.table("fragility"), keys, study.excitation, study.realizations);
        list_records(top.table("fragility"), folder, *study.fragility);
        if (study.sampling != Sampling::independent)
            keys.refuse("sampling", "is not used by study.kind = \"fragility\"", "Remove it.");
    }
    if (study.cells() > most_realizations / study.realizations)
        keys.refuse("realizations",
                    fmt::format("in each of {} cells is {:.0f} in all, more than {}", study.cells(),
                                static_cast<double>(study.cells()) * static_cast<double>(study.realizations),
                                most_realizations),
                    "Give fewer realizations or fewer cells.");
    check_tables(top, study.kind);
    read_mechanisms(top.table("mechanisms"), study);
    read_perturbations(top.table("perturbation"), study);
    if (is_fragility)
        check_mechanisms_of_fragility(top.table("mechanisms"), study);
    if (is_sensitivity)
        study.sensitivity = read_sensitivity(top.table("sensitivity"), study, most_realizations);

    if (is_rare)
        study.rare = read_rare(top.table("rare"), study);

    study.initial = read_initial(top.table("initial"), study.structure);
    read_output(top.table("output"), study);
    study.outcome = read_outcome(top.table("outcome"), study.structure.kind);
    study.run = read_run(top.table("run"));
    if (study.run.precision == Precision::single)
        check_precision(top.table("run"), study);
    if (top.has("twins")) {
        study.twins = read_twins(top.table("twins"), study);
        if (study.total() > most_realizations)
            keys.refuse("realizations",
                        fmt::format("and {} replicas of each give {}, more than {}", study.twins->kinds.size(),
                                    study.total(), most_realizations),
                        "Give fewer realizations, cells or replicas.");
    }
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
    return text;
}

} // namespace

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides)
{
    const TomlValue root = read_toml(read_text(file), file.string(), overrides);
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
        for (std::size_t i = 0; i < study.fragility->records.size(); ++i)
            find_beside(study.fragility->records[i].file, tables[i]);
    }
    if (study.vertical)
        find_beside(study.vertical->file, *root.find("mechanisms")->find("vertical_motion"));
    study.text = study_text(study);
    return study;
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

} // namespace stylobate
