#include "io/study/study_parts.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/motion/noise_duration.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_keys.hpp"
#include "io/keys/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// @param ramps that must fit into the cycles
void check_ramps(const KeyReader& keys, int ramps, const ExcitationSpec& e, double cycles)
{
    if (ramps * e.ramp_cycles <= cycles)
        return;
    const auto what = fmt::format("does not fit: {} of {} cycles each in {} cycles",
                                  ramps == 2 ? "two ramps" : "a ramp", e.ramp_cycles, cycles);
    const char* todo = e.kind == ExcitationKind::harmonic
                           ? "Give more cycles or shorter ramps, or start or end = \"abrupt\"."
                       : e.kind == ExcitationKind::sweep ? "Give a longer duration_s or shorter ramps."
                                                         : "Give more cycles or shorter ramps.";
    for (const char* key : {"ramp_cycles", "cycles", "duration_s"})
        if (keys.has(key))
            keys.refuse(key, what, todo);
}

void check_sweep(const KeyReader& keys, const ExcitationSpec& e)
{
    if (e.from_hz == e.to_hz)
        keys.refuse("to_hz", "is from_hz too", "Give two frequencies, or excitation.kind = \"harmonic\".");
    const double cycles =
        e.duration_s *
        (e.spacing == Spacing::log ? (e.to_hz - e.from_hz) / std::log(e.to_hz / e.from_hz) : (e.from_hz + e.to_hz) / 2);
    if (cycles > motion_cycles_range.high)
        keys.refuse("duration_s",
                    fmt::format("makes {:.0f} cycles, more than {:.0f}", cycles, motion_cycles_range.high),
                    "Give a shorter sweep or lower frequencies.");
    if (cycles < motion_cycles_range.low)
        keys.refuse("duration_s", fmt::format("makes {:.2g} cycles, less than {}", cycles, motion_cycles_range.low),
                    "Give a longer sweep or higher frequencies.");
    check_ramps(keys, 2, e, cycles);
}

void check_noise(const KeyReader& keys, const ExcitationSpec& e)
{
    if (const double planned = e.rise_s + e.strong_s + noise_decays * e.decay_s; planned < shortest_noise_s)
        for (const TomlKey* key : std::initializer_list<const TomlKey*>{
                 &excitation_keys::strong, &excitation_keys::decay, &excitation_keys::rise})
            if (keys.has(*key))
                keys.refuse(key->name,
                            fmt::format("gives noise of {:.3g} s (rise_s + strong_s + {} decay_s), shorter than {} s",
                                        planned, noise_decays, shortest_noise_s),
                            "It has too few samples to be a motion: give a longer strong_s, rise_s or decay_s.");
}

void read_filter(const KeyReader& keys, ExcitationSpec& e)
{
    if (const auto corners = keys.maybe_interval(excitation_keys::band_pass.name, excitation_keys::band_pass.range)) {
        if (!e.baseline)
            keys.refuse("band_pass_hz", "is not used by excitation.baseline = false",
                        "The filter is a part of the correction: remove it, or give baseline = true.");
        e.band_pass = BandPass{(*corners)[0], (*corners)[1]};
    }
}

/// Of a fragility study: motions of which there can be many.
void check_fragility_source(const KeyReader& keys, const ExcitationSpec& e)
{
    const bool sine = e.kind == ExcitationKind::harmonic || e.kind == ExcitationKind::half_sine ||
                      e.kind == ExcitationKind::full_sine;
    if (sine || e.kind == ExcitationKind::table)
        keys.refuse("kind", "is no ground motion of a fragility study",
                    "Give \"record\", with fragility.records or fragility.folder, or \"pulse\", \"noise\", "
                    "\"ricker\", \"tapered\" or \"sweep\".");
    keys.refuse_unused(excitation_keys::table, "study.kind", "fragility",
                       "Remove it: the motions and their intensities are given by [fragility].");
}

/// A number, or one of the words.
void read_tail(const KeyReader& keys, ExcitationSpec& e)
{
    const TomlValue* tail = keys.find(excitation_keys::tail.name);
    if (tail == nullptr)
        return;
    if (const auto* word = std::ranges::find_if(
            tail_names,
            [&](const auto& name) { return tail->type == TomlValue::Type::string && tail->text == name.word; });
        word != tail_names.end())
        e.tail = word->value;
    else
        e.tail_s = keys.maybe(excitation_keys::tail);
}

/// A component beside the first one. @param key its table
ComponentSpec read_component(const KeyReader& keys, const TableKey& key, ExcitationKind kind, StudyKind study)
{
    using namespace excitation_keys;
    const KeyReader table = keys.table(key);
    for (const TextKey* each : {&component_keys::file, &component_keys::component, &component_keys::unit})
        if (study == StudyKind::fragility && table.has(*each))
            table.refuse(each->name, "belongs to one record, and a fragility study has many",
                         fmt::format("Give {0} = {{}}: every record then has its own; or give {0} in "
                                     "fragility.records.",
                                     key.name));
    ComponentSpec component;
    table.read_fields(key, component);
    component.unit = acceleration_unit(component.unit);
    if (kind != ExcitationKind::table)
        return component;
    for (const TextKey* each : {&component_keys::component, &component_keys::unit})
        if (table.has(*each))
            table.refuse(each->name, "is not used by excitation.kind = \"table\"",
                         "Remove it: the names of a table's columns have its unit.");
    if (!component.file)
        table.missing(component_keys::file.name,
                      "A table of samples has one component: give the file of the other one.");
    return component;
}

void read_second(const KeyReader& keys, StudyKind study, ExcitationSpec& e)
{
    using namespace excitation_keys;
    if (keys.has(second))
        e.second = read_component(keys, second, e.kind, study);
    const bool recorded = e.kind == ExcitationKind::record || e.kind == ExcitationKind::table;
    for (const TomlKey* key : std::initializer_list<const TomlKey*>{&second_phase, &second_correlation, &pga_of_pair})
        if (!e.has_second() && keys.has(*key))
            keys.refuse(key->name, "needs a second component, and there is none",
                        recorded ? "Give excitation.second, or remove it."
                                 : "Give excitation.second_ratio, or remove it.");
}

} // namespace

std::optional<VerticalSpec> read_vertical(const KeyReader& keys, StudyKind study, const ExcitationSpec& excitation)
{
    using namespace excitation_keys;
    if (!keys.has(vertical))
        return std::nullopt;
    const ComponentSpec component = read_component(keys, vertical, excitation.kind, study);
    return VerticalSpec{component, excitation.baseline};
}

void check_direction(const KeyReader& top, const Study& study)
{
    const KeyReader keys = top.table(excitation_keys::table);
    for (const Perturbation& perturbation : study.perturbations)
        if (perturbation.quantity == Quantity::direction && perturbation.distribution == DistributionKind::uniform &&
            study.excitation.direction_deg != 0) // 0 is in every canonical text
            keys.refuse(excitation_keys::direction.name,
                        "and perturbation.direction, which draws the direction uniformly, give it twice",
                        "Give one of the two.");
}

std::optional<std::string> acceleration_unit(std::optional<std::string> word)
{
    if (word == "gal")
        word = "cm/s2"; // one name for one unit, so that equal studies have equal texts
    return word;
}

ExcitationSpec read_excitation(const KeyReader& top, StudyKind study, const StructureSpec& structure)
{
    using namespace excitation_keys;
    const KeyReader keys = top.table(table);
    ExcitationSpec e;
    e.kind = keys.read(kind);
    const char *motion = word_for(excitation_kind_names, e.kind), *of_study = word_for(study_kind_names, study);
    keys.refuse_unused(table, "excitation.kind", motion);
    if (study != StudyKind::single && e.kind == ExcitationKind::none)
        keys.refuse("kind", fmt::format("has no motion, but study.kind is \"{}\"", of_study),
                    "Give another excitation, or study.kind = \"single\".");
    if (study == StudyKind::fragility)
        check_fragility_source(keys, e);
    KeyUse use{{{"excitation.kind", motion}, {"study.kind", of_study}, {model_key, dimensions_word(structure)}}};
    if (has_axes(study)) {
        add_rows(use, top.table(surface_keys::table.name).has(surface_keys::direction));
        for (const char* kind : {"study.kind", "surface.frequency_hz", "surface.direction_deg"})
            keys.refuse_unused(table, kind, use.kinds.at(kind), "Remove it: it is given by an axis of [surface].");
    }
    if (use.of(file) && !keys.has(file))
        keys.missing(file.name, fmt::format("Name {} here, or on the command line: --set excitation.file=PATH",
                                            e.kind == ExcitationKind::record ? "the record" : "the table of samples"));
    // ranges that are narrower than those of the keys
    if (e.kind == ExcitationKind::noise && use.of(frequency))
        keys.read_within(frequency, noise_frequency_range);
    if (e.kind == ExcitationKind::tapered)
        keys.read_within(ramp_cycles, taper_range);
    keys.read_fields(table, e, use);
    e.unit = acceleration_unit(e.unit);
    if (study == StudyKind::fragility && e.kind != ExcitationKind::record)
        e.pga_m_s2 = 1; // scaled later
    if (e.kind == ExcitationKind::harmonic)
        check_ramps(keys, (e.start == HarmonicEdge::smooth ? 1 : 0) + (e.end == HarmonicEdge::smooth ? 1 : 0), e,
                    e.cycles);
    if (e.kind == ExcitationKind::tapered)
        check_ramps(keys, 2, e, e.cycles);
    if (e.kind == ExcitationKind::sweep)
        check_sweep(keys, e);
    if (e.kind == ExcitationKind::noise)
        check_noise(keys, e);
    read_filter(keys, e);
    read_tail(keys, e);
    if (structure.spatial())
        read_second(keys, study, e);
    return e;
}

void check_axes(const KeyReader& surface, const ExcitationSpec& excitation, const SurfaceSpec& axes)
{
    const Axis& frequency = axes.frequency_hz;
    if (excitation.kind != ExcitationKind::noise || axes.direction_deg ||
        (noise_frequency_range.contains(frequency.from) && noise_frequency_range.contains(frequency.to)))
        return;
    surface.refuse(
        "frequency_hz",
        fmt::format("is outside {}, which excitation.kind = \"noise\" can have", noise_frequency_range.text()),
        noise_frequency_range.hint);
}

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
    const KeyUse use{{{"contact.form", word}, {model_key, dimensions_word(structure)}}};
    keys.read_fields(table, c, chosen.stiffness_n_m2 ? use.without({&normal_stiffness}) : use);
    if (structure.spatial()) {
        if (!keys.has(area_tangential_stiffness)) // as stiff along the bed as across it
            c.tangential_stiffness_n_m3 = c.normal_stiffness_n_m3;
        return c;
    }
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
    const KeyReader start = top.table(initial_keys::table);
    if (start.has(initial_keys::lift))
        return RigidObstacle{start, initial_keys::lift.name, "is not available with " + form,
                             "Remove it, or give contact.form = \"two_corner\" with a high stiffness."};
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

namespace {

/// Two corners reach this: between a stiffness of `two_corner_sinkage` and ten times that, collapse probabilities of
/// eleven studies differ by less. They do not go to a limit evenly, so that no stiffness is known for a smaller error.
constexpr double two_corner_accuracy = 0.1;
/// The usual part of the safe step reaches this, half of it what is smaller.
constexpr double usual_step_accuracy = 0.02;
/// Single precision, and the step bound of the structure, change collapse probabilities by less than this.
constexpr double single_accuracy = 0.02, structure_accuracy = 0.05;

/// Mechanisms that define how a contact yields: with them a stiffness is a property of the structure.
constexpr Mechanism of_compliance[] = {Mechanism::hertz, Mechanism::rate_damping, Mechanism::face_damping};

void choose(Study& study, const TableKey& table, const TomlKey& key, std::string value, std::string reason)
{
    study.chosen.push_back({table.name + "." + key.name, std::move(value), std::move(reason)});
}

/// K_N with which the beds of a structure are pressed in by `two_corner_sinkage`, up to two digits.
double stiff_enough_n_m2(Study study)
{
    study.contact.normal_stiffness_n_m2 = 1;
    const double K_n = largest_sinkage_part(study) / two_corner_sinkage;
    const double digit = std::pow(10, std::floor(std::log10(K_n)) - 1);
    return std::ceil(K_n / digit - 1e-9) * digit;
}

/// What a stiffness that is chosen makes meaningless.
void refuse_compliance(const KeyReader& top, const std::string& why)
{
    const std::string todo = "Give contact.normal_stiffness_n_m2, or remove run.accuracy.";
    const KeyReader mechanisms = top.table(mechanisms_table().name), spreads = top.table(perturbation_table().name);
    for (const Mechanism mechanism : of_compliance)
        if (mechanisms.has(to_string(mechanism)))
            mechanisms.refuse(to_string(mechanism),
                              "defines how contacts yield, so that run.accuracy cannot choose their stiffness", todo);
    for (const Quantity quantity : {Quantity::normal_stiffness, Quantity::tangential_stiffness})
        if (spreads.has(spread_key(quantity).name))
            spreads.refuse(spread_key(quantity).name, "is about a stiffness that the study does not give", todo);
    const double accuracy = top.table(run_keys::table.name).read(run_keys::accuracy);
    if (accuracy < two_corner_accuracy)
        top.table(run_keys::table.name)
            .refuse(run_keys::accuracy.name,
                    fmt::format("is not reached by any stiffness that run.accuracy could choose, down from {:g}",
                                two_corner_accuracy),
                    fmt::format("The contacts must yield: {}. {}", why, todo));
}

} // namespace

double largest_sinkage_part(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const std::vector<double> sinkage = static_sinkage_m(study);
    double largest = 0;
    for (std::size_t i = 0; i < sinkage.size(); ++i) {
        const PlacedBlock& upper = layout.blocks[static_cast<std::size_t>(layout.beds[i].upper)];
        largest = std::max(largest, sinkage[i] / std::min(upper.width_m, upper.height_m));
    }
    return largest;
}

ChosenContact choose_contact(const KeyReader& top, Study& study)
{
    using namespace contact_keys;
    const KeyReader keys = top.table(table.name), run = top.table(run_keys::table.name);
    const auto given = keys.maybe(form);
    if (!run.has(run_keys::accuracy) || keys.has(normal_stiffness) || given == ContactForm::rigid)
        return {};
    const std::optional<RigidObstacle> obstacle = rigid_obstacle(top, study.structure);
    if (!given && !obstacle) {
        choose(study, table, form, "\"rigid\"", "no stiffness is given, and the study has nothing that must yield");
        return {ContactForm::rigid, {}};
    }
    if (given && given != ContactForm::two_corner)
        keys.missing(normal_stiffness.name,
                     fmt::format("run.accuracy chooses none for contact.form = \"{}\", whose error falls slowly with "
                                 "it. Give one, or form = \"two_corner\", or leave out the form.",
                                 word_for(contact_form_names, *given)));
    const std::string why = given ? "contact.form is given" : fmt::format("{} {}", obstacle->key, obstacle->what);
    refuse_compliance(top, why);
    if (!given)
        choose(study, table, form, "\"two_corner\"", why);
    const double K_n = stiff_enough_n_m2(study);
    choose(study, table, normal_stiffness, fmt::format("{:g}", K_n),
           fmt::format("presses blocks into their beds by at most {:g} of their size", two_corner_sinkage));
    return {ContactForm::two_corner, K_n};
}

void choose_steps(const KeyReader& keys, Study& study)
{
    using namespace run_keys;
    RunSpec& run = study.run;
    if (!run.accuracy)
        return;
    const bool column = study.structure.kind == StructureKind::column && study.outcome.follow == Follow::collapse;
    const auto choose_single = [&](const char* reason) {
        if (keys.has(precision) || !study.mechanisms.empty() || !column || *run.accuracy < single_accuracy)
            return;
        run.precision = Precision::single;
        choose(study, table, precision, "\"single\"", reason);
    };
    if (study.contact.form == ContactForm::rigid)
        return choose_single("0.6 times the processor time, at far less error than the accuracy");
    if (*run.accuracy < usual_step_accuracy) {
        run.step_fraction /= 2;
        choose(study, table, step_fraction, fmt::format("{:g}", run.step_fraction),
               fmt::format("steps of {:g} change probabilities by up to {:g}", 2 * run.step_fraction,
                           usual_step_accuracy));
    }
    const bool area = study.contact.form == ContactForm::area;
    if (!keys.has(step_bound) && area && study.contact.damping == DampingAt::ends &&
        *run.accuracy >= structure_accuracy) {
        run.step_bound = StepBasis::structure;
        choose(study, table, step_bound, "\"structure\"", "a longer step, at no more error than the accuracy");
    }
    if (area && study.contact.damping == DampingAt::centroid)
        choose_single("up to twice as fast, at far less error than the accuracy");
}

} // namespace stylobate
