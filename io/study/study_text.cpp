/// The canonical text of a study: every value, in one order, with numbers that read back to the same bits.

#include "ensemble/model/nominal.hpp"
#include "io/files/toml_document.hpp"
#include "io/keys/contact_keys.hpp"
#include "io/keys/excitation_keys.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/run_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/structure_keys.hpp"
#include "io/keys/survival_keys.hpp"
#include "io/study/study_file.hpp"
#include "io/study/study_mechanisms.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// "key = value" lines under their [table], or the entries of an inline table.
class Entries {
public:
    template <class Key>
    void add(const Key& key, const typename Key::Value& value)
    {
        if constexpr (std::is_enum_v<typename Key::Value>)
            add_text(key, toml_quoted(word_for(key.names, value)));
        else
            add_text(key, toml_text(value));
    }
    template <class Key>
    void add(const Key& key, const std::optional<typename Key::Value>& value)
    {
        if (value)
            add(key, *value);
    }
    /// Left out where it is empty.
    void add_if_named(const TextKey& key, const std::string& value)
    {
        if (!value.empty())
            add_text(key, toml_quoted(value));
    }
    void add(const WholeKey& key, int value) { add_text(key, std::to_string(value)); }
    void add(const ListKey& key, const std::vector<double>& values) { add_text(key, toml_text(values)); }
    void add(const ListKey& key, const std::vector<std::string>& values) { add_text(key, toml_text(values)); }
    void add_text(const TomlKey& key, std::string toml) { add_text(key.name, std::move(toml)); }
    void add_text(std::string key, std::string toml) { entries_.emplace_back(std::move(key), std::move(toml)); }

    /// { key = value, ... }
    std::string inline_table() const
    {
        std::string out = "{ ";
        for (const auto& [key, value] : entries_)
            out += (out.size() > 2 ? ", " : "") + key + " = " + value;
        return out + " }";
    }
    std::string lines() const
    {
        std::string out;
        for (const auto& [key, value] : entries_)
            out += key + " = " + value + "\n";
        return out;
    }

private:
    std::vector<std::pair<std::string, std::string>> entries_;
};

/// An array of many lines, one element on each.
std::string list(const std::vector<std::string>& elements, const std::string& indent)
{
    std::string out = "[";
    for (const std::string& element : elements)
        out += (out.size() > 1 ? ",\n" : "\n") + indent + "    " + element;
    return elements.empty() ? "[]" : out + "\n" + indent + "]";
}

void add(Entries& entries, const BedSpec& bed)
{
    entries.add(structure_keys::bed_friction, bed.friction);
    entries.add(structure_keys::bed_normal_stiffness, bed.normal_stiffness_n_m2);
    entries.add(structure_keys::bed_tangential_stiffness, bed.tangential_stiffness_n_m);
    entries.add(structure_keys::bed_restitution, bed.restitution);
    entries.add(structure_keys::bed_normal_damping, bed.normal_damping_ratio);
    entries.add(structure_keys::bed_tangential_damping, bed.tangential_damping_ratio);
}

Entries entries_of(const DrumSpec& drum)
{
    Entries entries;
    entries.add(structure_keys::width, drum.width_m);
    entries.add(structure_keys::height, drum.height_m);
    entries.add(structure_keys::mass, drum.mass_kg);
    if (drum.offset_m != 0)
        entries.add(structure_keys::offset, drum.offset_m);
    add(entries, drum.bed);
    return entries;
}

/// Equal drums, one upon the other, are one line; a capital is a key of its own.
std::string drums(const std::vector<DrumSpec>& drums, const std::string& indent)
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < drums.size() && !drums[i].capital;) {
        const DrumSpec& drum = drums[i];
        std::size_t count = 1;
        while (i + count < drums.size() && drums[i + count] == drum)
            ++count;
        Entries entries = entries_of(drum);
        if (count > 1)
            entries.add(structure_keys::count, count);
        lines.push_back(entries.inline_table());
        i += count;
    }
    return list(lines, indent);
}

std::string columns(const std::vector<ColumnSpec>& columns)
{
    std::vector<std::string> lines;
    for (const ColumnSpec& column : columns) {
        Entries entries;
        entries.add(structure_keys::x, column.x_m);
        entries.add(structure_keys::fixed_blocks, column.fixed_blocks);
        entries.add_text(structure_keys::drums, drums(column.drums, "    "));
        if (column.drums.back().capital)
            entries.add_text(structure_keys::capital, entries_of(column.drums.back()).inline_table());
        lines.push_back(entries.inline_table());
    }
    return list(lines, "");
}

std::string epistyles(const std::vector<EpistyleSpec>& epistyles)
{
    std::vector<std::string> lines;
    for (const EpistyleSpec& epistyle : epistyles) {
        Entries entries;
        entries.add(structure_keys::first_column, epistyle.first_column);
        entries.add(structure_keys::last_column, epistyle.last_column);
        entries.add(structure_keys::epistyle_x, epistyle.x_m);
        entries.add(structure_keys::length, epistyle.length_m);
        entries.add(structure_keys::own_epistyle_height, epistyle.height_m);
        entries.add(structure_keys::mass, epistyle.mass_kg);
        add(entries, epistyle.bed);
        lines.push_back(entries.inline_table());
    }
    return list(lines, "");
}

/// A column of equal drums in few words; all else block by block.
Entries entries_of(const StructureSpec& structure)
{
    using namespace structure_keys;
    Entries out;
    out.add(kind, structure.kind);
    out.add(depth, structure.depth_m);
    out.add(gravity, structure.gravity_m_s2);
    if (structure.kind == StructureKind::colonnade) {
        out.add_text(column_list, stylobate::columns(structure.columns));
        out.add_text(structure_keys::epistyles, stylobate::epistyles(structure.epistyles));
        return out;
    }
    const ColumnSpec& column = structure.columns[0];
    const DrumSpec& lowest = column.drums[0];
    const int number = static_cast<int>(column.drums.size());
    if (structure == equal_column(number, column.fixed_blocks, lowest.width_m, lowest.height_m, structure.depth_m,
                                  lowest.mass_kg, structure.gravity_m_s2)) {
        out.add(blocks, number);
        out.add(drum_width, lowest.width_m);
        out.add(drum_height, lowest.height_m);
        out.add(drum_mass, lowest.mass_kg);
    } else {
        out.add_text(structure_keys::drums, stylobate::drums(column.drums, ""));
        if (column.drums.back().capital)
            out.add_text(capital, entries_of(column.drums.back()).inline_table());
    }
    out.add(fixed_blocks, column.fixed_blocks);
    return out;
}

Entries entries_of(const ContactSpec& contact)
{
    using namespace contact_keys;
    Entries out;
    if (contact.form == ContactForm::rigid) {
        out.add(form, contact.form);
        out.add(friction, contact.friction);
        out.add(restitution, contact.restitution);
        out.add(restitution_law, contact.restitution_law);
        return out;
    }
    out.add(normal_stiffness, contact.normal_stiffness_n_m2);
    out.add(tangential_stiffness, contact.tangential_stiffness_n_m);
    if (contact.normal_damping_n_s_m)
        out.add(normal_damping, contact.normal_damping_n_s_m);
    else
        out.add(normal_damping_ratio, contact.normal_damping_ratio);
    if (contact.tangential_damping_n_s_m)
        out.add(tangential_damping, contact.tangential_damping_n_s_m);
    else
        out.add(tangential_damping_ratio, contact.tangential_damping_ratio);
    out.add(damping, contact.damping);
    out.add(damping_per, contact.damping_per);
    out.add(form, contact.form);
    out.add(friction, contact.friction);
    return out;
}

/// The word of a tail without a number, with what it comes to.
std::string tail_text(Tail tail, const StructureSpec& structure)
{
    const bool rest = tail == Tail::rest;
    const double parts = 12 * (rest ? rest_tails : 1), usual = nominal_tail_s(structure);
    return fmt::format("{} # {}{:g} / p of each realization; of the structure as given {:.4g} s",
                       toml_quoted(word_for(tail_names, tail)), rest ? "until it lies still, at most " : "", parts,
                       usual * (rest ? rest_tails : 1));
}

/// The keys that the kinds of the excitation and of the study use; a value that was not given is omitted.
Entries entries_of(const ExcitationSpec& e, StudyKind study, const StructureSpec& structure)
{
    using namespace excitation_keys;
    const char* motion = word_for(excitation_kind_names, e.kind);
    const char* of_study = word_for(study_kind_names, study);
    Entries out;
    const auto add = [&](const auto& key, const auto& value) {
        if (key.used_where("excitation.kind", motion) && key.used_where("study.kind", of_study))
            out.add(key, value);
    };
    const auto named = [](const std::string& text) {
        return text.empty() ? std::optional<std::string>() : std::optional(text);
    };
    add(kind, e.kind);
    if (e.kind == ExcitationKind::none)
        add(duration, e.duration_s);
    add(file, e.file);
    add(run, named(e.run));
    add(component, named(e.component));
    add(unit, named(e.unit));
    add(scale_to_pga, e.pga_m_s2 > 0 ? std::optional(e.pga_m_s2) : std::nullopt);
    add(time_scale, e.time_scale);
    add(baseline, e.baseline);
    if (e.band_pass)
        out.add(band_pass, std::vector{e.band_pass->low_hz, e.band_pass->high_hz});
    add(frequency, e.frequency_hz);
    add(pga, e.pga_m_s2);
    add(start, e.start);
    add(end, e.end);
    add(from, e.from_hz);
    add(to, e.to_hz);
    add(spacing, e.spacing);
    if (e.kind == ExcitationKind::sweep)
        add(duration, e.duration_s);
    add(ramp_cycles, e.ramp_cycles);
    add(cycles, e.cycles);
    add(phase, e.phase_rad);
    add(gamma, e.gamma);
    add(pga_of, e.pga_of);
    add(ground_damping, e.ground_damping_ratio);
    add(low_cut, e.low_cut_ratio);
    add(low_cut_damping, e.low_cut_damping_ratio);
    add(rise, e.rise_s);
    add(strong, e.strong_s);
    add(decay, e.decay_s);
    if (e.tail_s)
        add(tail, e.tail_s);
    else if (tail.used_where("excitation.kind", motion)) // each realization has its own
        out.add_text(tail, tail_text(e.tail, structure));
    return out;
}

void add(Entries& entries, const AxisKey& key, const Axis& axis)
{
    entries.add(key.from, axis.from);
    entries.add(key.to, axis.to);
    entries.add(key.count, axis.count);
    entries.add(key.spacing, axis.spacing);
}

Entries entries_of(const SurfaceSpec& surface)
{
    const auto axis = [](const AxisKey& key, const Axis& values) {
        Entries entries;
        add(entries, key, values);
        return entries.inline_table();
    };
    Entries out;
    out.add_text(surface_keys::frequency, axis(surface_keys::frequency, surface.frequency_hz));
    out.add_text(surface_keys::pga, axis(surface_keys::pga, surface.pga_m_s2));
    if (const std::optional<AdaptiveSpec>& adaptive = surface.adaptive) {
        Entries entries;
        entries.add(adaptive_keys::budget, adaptive->budget);
        entries.add(adaptive_keys::minimum, adaptive->minimum);
        entries.add(adaptive_keys::half_width, adaptive->half_width);
        entries.add(adaptive_keys::pooled, adaptive->borrow);
        out.add_text(surface_keys::adaptive, entries.inline_table());
    }
    return out;
}

std::string spread(const SpreadKey& key, const Spread& p)
{
    Entries entries;
    entries.add(key.distribution, p.distribution);
    switch (p.distribution) {
    case DistributionKind::normal:
        if (p.cov > 0)
            entries.add(key.cov, p.cov);
        else
            entries.add(key.sd, p.sd);
        break;
    case DistributionKind::lognormal:
        entries.add(key.sigma_ln, p.sigma_ln);
        break;
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        entries.add(key.from, p.from);
        entries.add(key.to, p.to);
        break;
    }
    entries.add(key.min, p.min);
    entries.add(key.max, p.max);
    entries.add(key.per, p.per);
    return entries.inline_table();
}

Entries entries_of(const FragilitySpec& f)
{
    using namespace fragility_keys;
    Entries out;
    out.add(method, f.method);
    if (f.records.empty()) {
        out.add(motions, f.motions);
    } else {
        std::vector<std::string> lines;
        for (const RecordSpec& record : f.records) {
            Entries entries;
            entries.add(file, record.file);
            entries.add_if_named(component, record.component);
            entries.add_if_named(record_unit, record.unit);
            lines.push_back(entries.inline_table());
        }
        out.add_text(records, list(lines, ""));
    }
    if (f.method == FragilityMethod::cloud) {
        out.add(scale, f.scale);
    } else {
        Entries entries;
        entries.add(measure, f.measure);
        if (f.measure == IntensityMeasure::sa)
            entries.add(period, f.period_s);
        add(entries, intensity, f.intensity);
        out.add_text(intensity, entries.inline_table());
    }
    out.add(shakings, f.shakings);
    out.add(pause, f.pause_s);
    out.add(contacts, f.contacts);
    out.add(twins, f.twins);
    out.add(twin, f.twin_m);
    out.add(peak_limits, f.peak_limits);
    out.add(residual_limits, f.residual_limits);
    out.add(periods, f.periods_s);
    return out;
}

Entries entries_of(const TwinsSpec& spec)
{
    using namespace twins_keys;
    std::vector<double> displacements;
    double ratio = 1;
    bool single = false, other_forms = false;
    for (const Twin& each : spec.kinds) {
        if (each.by == TwinBy::move)
            displacements.push_back(each.size);
        if (each.by == TwinBy::step)
            ratio = each.size;
        single = single || each.by == TwinBy::precision;
        other_forms = other_forms || each.by == TwinBy::form;
    }
    Entries out;
    out.add(moves, displacements);
    out.add(block, spec.block);
    out.add(step_ratio, ratio);
    out.add(precision, single);
    out.add(forms, other_forms);
    out.add(followed, spec.followed);
    out.add(tolerance, spec.tolerance);
    return out;
}

Entries entries_of_study(const Study& study)
{
    using namespace study_keys;
    Entries out;
    out.add(kind, study.kind);
    out.add_if_named(title, study.title); // a study without a title has the text that it always had
    out.add(seed, study.seed);
    if (realizations.used_where("study.kind", word_for(study_kind_names, study.kind)))
        out.add(realizations, study.realizations);
    out.add(sampling, study.sampling);
    out.add(allow, study.allow);
    return out;
}

Entries entries_of(const SensitivitySpec& sensitivity)
{
    Entries out;
    out.add(sensitivity_keys::method, sensitivity.method);
    out.add(sensitivity_keys::samples, sensitivity.samples);
    out.add(sensitivity_keys::inner, sensitivity.inner);
    out.add(sensitivity_keys::factors, sensitivity.factors);
    return out;
}

Entries entries_of(const RareSpec& rare)
{
    Entries out;
    out.add(rare_keys::samples, rare.samples);
    out.add(rare_keys::repeats, rare.repeats);
    return out;
}

std::string text_of(const ObservedState& observed)
{
    using namespace survival_keys;
    Entries entries;
    if (!observed.joints.empty()) {
        std::vector<std::string> numbers;
        for (const int joint : observed.joints)
            numbers.push_back(std::to_string(joint));
        entries.add_text(joints, fmt::format("[{}]", fmt::join(numbers, ", ")));
        entries.add(joint_offset, observed.offset_m);
        entries.add(tolerance, observed.tolerance_m);
    }
    if (!observed.rotation_rad.empty()) {
        entries.add(rotation, observed.rotation_rad);
        entries.add(rotation_tolerance, observed.tolerance_rad);
    }
    entries.add(mirrored, observed.mirrored);
    return entries.inline_table();
}

std::string text_of(const HazardSpec& hazard)
{
    using namespace survival_keys;
    Entries entries;
    if (hazard.k0_per_year > 0) {
        entries.add(k0, hazard.k0_per_year);
        entries.add(k, hazard.k);
    } else { // the points of a file stand in its place
        entries.add(intensities, hazard.intensity_m_s2);
        entries.add(rates, hazard.rate_per_year);
    }
    entries.add(sigma_ln, hazard.sigma_ln);
    return entries.inline_table();
}

Entries entries_of(const SurvivalSpec& survival)
{
    using namespace survival_keys;
    Entries out;
    if (survival.observed)
        out.add_text(observed, text_of(*survival.observed));
    out.add(prior, survival.prior);
    out.add(level, survival.level);
    out.add(events, survival.events);
    out.add(pause, survival.pause_s);
    out.add(monuments, survival.monuments);
    out.add(structure, survival.structure);
    out.add(per_motion, survival.per_motion);
    out.add(built, survival.built);
    out.add(standing, survival.standing);
    out.add(stands_for, survival.stands_for_years);
    if (survival.hazard)
        out.add_text(hazard, text_of(*survival.hazard));
    return out;
}

Entries entries_of(const InitialSpec& initial)
{
    Entries out;
    out.add(initial_keys::tilt, initial.tilt_rad);
    out.add(initial_keys::tilt_from_block, initial.tilt_from_block);
    return out;
}

Entries entries_of_output(const Study& study)
{
    using namespace output_keys;
    Entries out;
    out.add(trajectory_rate, study.output.trajectory_rate_hz);
    out.add(realizations, study.kept);
    if (study.kind == StudyKind::single) {
        const std::optional<std::uint64_t>& kept = study.output.trajectories;
        if (kept && *kept != OutputSpec::all)
            out.add(trajectories, kept);
        else
            out.add_text(trajectories, toml_quoted(kept ? trajectories_all : trajectories_fit));
        out.add(most_mb, study.output.most_mb);
    }
    return out;
}

Entries entries_of(const OutcomeSpec& outcome)
{
    using namespace outcome_keys;
    Entries fallen;
    fallen.add(height_fraction, outcome.collapse_height_fraction);
    Entries out;
    out.add(follow, outcome.follow);
    out.add_text(collapse, fallen.inline_table());
    out.add(rocking_threshold, outcome.rocking_threshold_rad);
    out.add(sliding_threshold, outcome.sliding_threshold);
    return out;
}

Entries entries_of(const RunSpec& run, ContactForm form)
{
    using namespace run_keys;
    Entries out;
    out.add(precision, run.precision);
    const bool bounded = form != ContactForm::rigid; // else the step is chosen by accuracy
    if (run.accuracy)
        out.add(accuracy, run.accuracy);
    else if (run.step_s)
        out.add(step, run.step_s);
    else if (bounded)
        out.add(step_fraction, run.step_fraction);
    if (bounded) {
        out.add(step_bound, run.step_bound);
        out.add(allow_step_above_bound, run.allow_step_above_bound);
    }
    out.add(max_invalid, run.max_invalid_fraction);
    return out;
}

} // namespace

std::string study_text(const Study& study)
{
    std::string text;
    const auto table = [&text](const std::string& name, const Entries& entries) {
        text += (text.empty() ? "[" : "\n[") + name + "]\n" + entries.lines();
    };
    table(study_keys::table.name, entries_of_study(study));
    table(structure_keys::table.name, entries_of(study.structure));
    table(contact_keys::table.name, entries_of(study.contact));
    table(excitation_keys::table.name, entries_of(study.excitation, study.kind, study.structure));
    if (study.surface)
        table(surface_keys::table.name, entries_of(*study.surface));
    if (study.twins)
        table(twins_keys::table.name, entries_of(*study.twins));
    if (study.fragility)
        table(fragility_keys::table.name, entries_of(*study.fragility));
    if (study.sensitivity)
        table(sensitivity_keys::table.name, entries_of(*study.sensitivity));
    if (study.rare)
        table(rare_keys::table.name, entries_of(*study.rare));
    if (study.survival)
        table(survival_keys::table.name, entries_of(*study.survival));
    Entries perturbed;
    for (const auto& p : study.perturbations)
        perturbed.add_text(spread_key(p.quantity), spread(spread_key(p.quantity), p));
    if (!study.perturbations.empty())
        table(perturbation_table().name, perturbed);
    for (std::size_t i = 0; i < study.mechanism_perturbations.size();) {
        const Mechanism mechanism = study.mechanism_perturbations[i].mechanism;
        Entries of_mechanism;
        for (; i < study.mechanism_perturbations.size() && study.mechanism_perturbations[i].mechanism == mechanism;
             ++i) {
            const SpreadKey& key = spread_key(mechanism, study.mechanism_perturbations[i].parameter);
            of_mechanism.add_text(key, spread(key, study.mechanism_perturbations[i]));
        }
        table(perturbation_table().name + "." + perturbed_mechanisms().name + "." + to_string(mechanism), of_mechanism);
    }
    Entries extensions;
    for (const auto& [name, value] : mechanism_entries(study))
        extensions.add_text(name, value);
    if (!study.mechanisms.empty())
        table(mechanisms_table().name, extensions);
    table(initial_keys::table.name, entries_of(study.initial));
    table(output_keys::table.name, entries_of_output(study));
    table(outcome_keys::table.name, entries_of(study.outcome));
    table(run_keys::table.name, entries_of(study.run, study.contact.form));
    return text;
}

} // namespace stylobate
