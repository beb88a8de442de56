/// The canonical text of a study: every value, in one order, with numbers that read back to the same bits.

#include "ensemble/model/nominal.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_keys.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// "key = value" lines under their [table], or the entries of an inline table.
class Entries {
public:
    /// In the order in which they are added.
    Entries() = default;
    /// In the order of the table's keys.
    explicit Entries(const TableKey& table) : order_(table.names()) {}

    void add_text(const std::string& key, std::string toml)
    {
        const auto after = std::find_if(entries_.begin(), entries_.end(),
                                        [&](const auto& entry) { return place(key) < place(entry.first); });
        entries_.emplace(after, key, std::move(toml));
    }
    /// Left out where there is none.
    template <class Key, class Value>
    void add(const Key& key, const Value& value)
    {
        if (std::optional<std::string> toml = key_text(key, value))
            add_text(key.name, std::move(*toml));
    }
    /// The members of a structure that keys of the table fill, without those in whose place others stand.
    template <class S>
    Entries& add_fields(const TableKey& table, const S& from, const KeyUse& use = {})
    {
        std::set<std::string> replaced;
        for (const TomlKey* key : table.keys)
            if (key->field.of == typeid(S) && use.of(*key))
                if (std::optional<std::string> toml = key->field.text(*key, &from)) {
                    add_text(key->name, std::move(*toml));
                    replaced.insert(key->excludes.begin(), key->excludes.end());
                }
        std::erase_if(entries_, [&](const auto& entry) { return replaced.contains(entry.first); });
        return *this;
    }
    /// Where both are there.
    void move_before(const TomlKey& key, const TomlKey& other)
    {
        const auto named = [&](const TomlKey& which) {
            return std::find_if(entries_.begin(), entries_.end(),
                                [&](const auto& entry) { return entry.first == which.name; });
        };
        const auto from = named(key), to = named(other);
        if (from != entries_.end() && to != entries_.end())
            from < to ? std::rotate(from, from + 1, to) : std::rotate(to, from, from + 1);
    }

    /// { key = value, ... }
    std::string inline_table() const
    {
        if (entries_.empty())
            return "{}";
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
    std::ptrdiff_t place(const std::string& key) const
    {
        return std::find(order_.begin(), order_.end(), key) - order_.begin();
    }

    std::vector<std::string> order_;
    std::vector<std::pair<std::string, std::string>> entries_;
};

/// { key = value, ... } of a structure.
template <class S>
std::string inline_fields(const TableKey& table, const S& from, const KeyUse& use = {})
{
    return Entries().add_fields(table, from, use).inline_table();
}

/// An array of many lines, one element on each.
std::string list(const std::vector<std::string>& elements, const std::string& indent = {})
{
    std::string out = "[";
    for (const std::string& element : elements)
        out += (out.size() > 1 ? ",\n" : "\n") + indent + "    " + element;
    return elements.empty() ? "[]" : out + "\n" + indent + "]";
}

Entries entries_of(const DrumSpec& drum, const KeyUse& use)
{
    using namespace structure_keys;
    Entries out;
    KeyUse of_drum = drum.offset_m != 0 ? use : use.without({&offset});
    if (drum.offset_z_m == 0)
        of_drum = of_drum.without({&offset_z});
    if (drum.shape != Shape::rectangle)
        of_drum = of_drum.without({&own_depth});
    if (drum.top_width_m == drum.width_m)
        of_drum = of_drum.without({&own_top_width});
    out.add_fields(drums, drum, of_drum);
    if (drum.echinus_height_m > 0) {
        out.add(echinus_height, drum.echinus_height_m);
        out.add(echinus_width, drum.echinus_width_m);
    }
    return out.add_fields(drums, drum.bed, use);
}

/// Equal drums, one upon the other, are one line; a capital is a key of its own.
void add_drums(Entries& out, const std::vector<DrumSpec>& drums, const KeyUse& use, const std::string& indent = {})
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < drums.size() && !drums[i].capital;) {
        std::size_t count = 1;
        while (i + count < drums.size() && drums[i + count] == drums[i])
            ++count;
        Entries entries = entries_of(drums[i], use);
        if (count > 1)
            entries.add(structure_keys::count, count);
        lines.push_back(entries.inline_table());
        i += count;
    }
    out.add_text(structure_keys::drums.name, list(lines, indent));
    if (drums.back().capital)
        out.add_text(structure_keys::capital.name, entries_of(drums.back(), use).inline_table());
}

std::string columns(const std::vector<ColumnSpec>& columns, const KeyUse& use)
{
    std::vector<std::string> lines;
    for (const ColumnSpec& column : columns) {
        Entries entries;
        entries.add_fields(structure_keys::column_list, column, use);
        add_drums(entries, column.drums, use, "    ");
        lines.push_back(entries.inline_table());
    }
    return list(lines);
}

std::string epistyles(const std::vector<EpistyleSpec>& epistyles, const KeyUse& use)
{
    std::vector<std::string> lines;
    for (const EpistyleSpec& epistyle : epistyles) {
        Entries entries;
        entries.add_fields(structure_keys::epistyles, epistyle, use);
        entries.add(structure_keys::mass, epistyle.mass_kg);
        lines.push_back(entries.add_fields(structure_keys::epistyles, epistyle.bed, use).inline_table());
    }
    return list(lines);
}

/// A column of equal drums in few words; all else block by block.
Entries entries_of(const StructureSpec& structure, const KeyUse& use)
{
    using namespace structure_keys;
    Entries out;
    out.add_fields(table, structure, structure.spatial() ? use : use.without({&dimensions}));
    if (structure.kind == StructureKind::colonnade) {
        out.add_text(column_list.name, stylobate::columns(structure.columns, use));
        out.add_text(structure_keys::epistyles.name, stylobate::epistyles(structure.epistyles, use));
        return out;
    }
    const ColumnSpec& column = structure.columns[0];
    const DrumSpec& lowest = column.drums[0];
    const int number = static_cast<int>(column.drums.size());
    if (structure == equal_column(number, column.fixed_blocks, lowest.width_m, lowest.height_m, structure.depth_m,
                                  lowest.mass_kg, structure.gravity_m_s2)) {
        out.add(blocks, number);
        out.add_fields(table, lowest, use);
    } else {
        add_drums(out, column.drums, use);
    }
    return out.add_fields(table, column, use);
}

/// A tail without a number, with what it comes to.
std::string tail_text(Tail tail, const StructureSpec& structure)
{
    const bool rest = tail == Tail::rest;
    const double parts = 12 * (rest ? rest_tails : 1), usual = nominal_tail_s(structure);
    return fmt::format("{} # {}{:g} / p of each realization; of the structure as given {:.4g} s",
                       toml_quoted(word_for(tail_names, tail)), rest ? "until it lies still, at most " : "", parts,
                       usual * (rest ? rest_tails : 1));
}

/// The keys that the kinds of the excitation and of the study use.
Entries entries_of_excitation(const Study& study, const KeyUse& use)
{
    using namespace excitation_keys;
    const ExcitationSpec& e = study.excitation;
    KeyUse given = e.pga_m_s2 > 0 ? use : use.without({&scale_to_pga}); // 0: as recorded
    if (!e.has_second())
        given = given.without({&second_phase, &second_correlation, &pga_of_pair});
    const bool recorded_vertical = study.structure.spatial() && study.vertical;
    if (recorded_vertical)
        given = given.without({&vertical_ratio});
    Entries out(table);
    out.add_fields(table, e, given);
    if (e.second)
        out.add_text(second.name, inline_fields(second, *e.second));
    if (recorded_vertical)
        out.add_text(vertical.name, inline_fields(vertical, static_cast<const ComponentSpec&>(*study.vertical)));
    if (e.band_pass)
        out.add(band_pass, std::vector{e.band_pass->low_hz, e.band_pass->high_hz});
    if (e.tail_s)
        out.add(tail, e.tail_s);
    else if (use.of(tail)) // each realization has its own
        out.add_text(tail.name, tail_text(e.tail, study.structure));
    for (const TomlKey* key : {&duration, &ramp_cycles}) // of a sweep
        if (e.kind == ExcitationKind::sweep)
            out.move_before(*key, tail);
    return out;
}

Entries entries_of(const SurfaceSpec& surface)
{
    using namespace surface_keys;
    Entries out;
    const AxisKey& rows = surface.direction_deg ? direction : frequency;
    out.add_text(rows.name, inline_fields(rows, surface.rows()));
    out.add_text(pga.name, inline_fields(pga, surface.pga_m_s2));
    if (surface.adaptive)
        out.add_text(adaptive.name, inline_fields(adaptive, *surface.adaptive));
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

Entries entries_of(const FragilitySpec& f, bool pairs, const KeyUse& use)
{
    using namespace fragility_keys;
    Entries out(table);
    const KeyUse of_motions = f.records.empty() ? use : use.without({&motions});
    out.add_fields<MotionSetSpec>(table, f, pairs ? of_motions : of_motions.without({&of_pair}));
    out.add_fields(table, f, use);
    std::vector<std::string> lines;
    for (const RecordSpec& record : f.records) {
        Entries entries(records);
        entries.add_fields(records, record);
        if (record.second)
            entries.add_text(second.name, inline_fields(second, *record.second));
        if (record.vertical)
            entries.add_text(vertical.name, inline_fields(vertical, *record.vertical));
        lines.push_back(entries.inline_table());
    }
    if (!lines.empty())
        out.add_text(records.name, list(lines));
    if (f.method == FragilityMethod::stripes) {
        Entries axis(intensity);
        axis.add_fields<MotionSetSpec>(intensity, f, f.measure == IntensityMeasure::sa ? use : use.without({&period}));
        out.add_text(intensity.name, axis.add_fields(intensity, f.intensity).inline_table());
    }
    return out;
}

Entries entries_of(const ReplicasSpec& spec)
{
    using namespace twins_keys;
    std::vector<double> displacements;
    double ratio = 1;
    bool single = false, other_forms = false;
    for (const Replica& each : spec.kinds) {
        if (each.by == ReplicaBy::move)
            displacements.push_back(each.size);
        if (each.by == ReplicaBy::step)
            ratio = each.size;
        single = single || each.by == ReplicaBy::precision;
        other_forms = other_forms || each.by == ReplicaBy::form;
    }
    Entries out(table);
    out.add_fields(table, spec);
    out.add(moves, displacements);
    out.add(step_ratio, ratio);
    out.add(precision, single);
    out.add(forms, other_forms);
    return out;
}

Entries entries_of_study(const Study& study, const KeyUse& use)
{
    using namespace study_keys;
    Entries out(table);
    out.add_fields(table, study, use.of(realizations) ? KeyUse{} : KeyUse{}.without({&realizations}));
    if (study.allow.empty())
        out.add_text(allow.name, "[]");
    return out;
}

Entries entries_of(const SurvivalSpec& survival)
{
    using namespace survival_keys;
    Entries out(table);
    out.add_fields(table, survival);
    KeyUse measured;
    if (survival.observed && survival.observed->joints.empty())
        measured = measured.without({&tolerance});
    if (survival.observed && survival.observed->rotation_rad.empty())
        measured = measured.without({&rotation_tolerance});
    if (survival.observed)
        out.add_text(observed.name, inline_fields(observed, *survival.observed, measured));
    if (survival.hazard) // the points of a file stand in its place
        out.add_text(hazard.name,
                     inline_fields(hazard, *survival.hazard,
                                   survival.hazard->k0_per_year > 0 ? KeyUse{} : KeyUse{}.without({&k0, &k})));
    return out;
}

Entries entries_of_output(const Study& study, const KeyUse& use)
{
    using namespace output_keys;
    Entries out(table);
    out.add_fields(table, study.output, use).add_fields(table, study, use);
    const std::optional<std::uint64_t>& kept = study.output.trajectories;
    if (kept && *kept != OutputSpec::all && use.of(trajectories))
        out.add(trajectories, kept);
    else if (use.of(trajectories))
        out.add_text(trajectories.name, toml_quoted(kept ? trajectories_all : trajectories_fit));
    return out;
}

Entries entries_of(const OutcomeSpec& outcome)
{
    using namespace outcome_keys;
    Entries out(table);
    out.add_fields(table, outcome);
    out.add_text(collapse.name, inline_fields(collapse, outcome));
    return out;
}

Entries entries_of(const RunSpec& run, const KeyUse& use)
{
    using namespace run_keys;
    Entries out(table);
    out.add_fields(table, run, use);
    out.move_before(step, step_bound);
    return out;
}

std::string text_of(const MechanismSpec& spec, const Study& study)
{
    const MechanismKey& key = mechanism_key(spec.mechanism);
    Entries out;
    if (spec.places.size() == 1)
        out.add(*key.place, spec.places.front());
    else if (!spec.places.empty())
        out.add(*key.places, spec.places);
    if (spec.mechanism == Mechanism::vertical_motion && study.vertical)
        return out.add_fields<ComponentSpec>(key, *study.vertical).add_fields(key, *study.vertical).inline_table();
    const std::span<const MechanismParameter> rule = rule_of(spec.mechanism).parameters;
    for (std::size_t i = 0; i < key.parameters.size(); ++i)
        if (key_use(study).of(key.parameters[i]) &&
            (rule[i].role != ParameterRole::extra || spec.values[i] != rule[i].neutral))
            out.add(key.parameters[i], spec.values[i]);
    return out.inline_table();
}

Entries entries_of_mechanisms(const Study& study)
{
    Entries out;
    for (std::size_t i = 0; i < study.mechanisms.size();) {
        const Mechanism mechanism = study.mechanisms[i].mechanism;
        std::vector<std::string> values;
        for (; i < study.mechanisms.size() && study.mechanisms[i].mechanism == mechanism; ++i)
            values.push_back(text_of(study.mechanisms[i], study));
        out.add_text(to_string(mechanism), values.size() == 1 ? values.front() : list(values));
    }
    return out;
}

} // namespace

std::string study_text(const Study& study)
{
    const KeyUse use = key_use(study);
    std::string text;
    const auto table = [&text](const std::string& name, const Entries& entries) {
        text += (text.empty() ? "[" : "\n[") + name + "]\n" + entries.lines();
    };
    const auto fields = [&](const TableKey& key, const auto& from) {
        table(key.name, Entries(key).add_fields(key, from, use));
    };
    table(study_keys::table.name, entries_of_study(study, use));
    table(structure_keys::table.name, entries_of(study.structure, use));
    // in space the default is no word: spread over the contact
    const bool is_default = study.structure.spatial() && study.contact.damping == DampingAt::centroid;
    table(contact_keys::table.name, Entries(contact_keys::table)
                                        .add_fields(contact_keys::table, study.contact,
                                                    is_default ? use.without({&contact_keys::damping}) : use));
    table(excitation_keys::table.name, entries_of_excitation(study, use));
    if (study.surface)
        table(surface_keys::table.name, entries_of(*study.surface));
    if (study.replicas)
        table(twins_keys::table.name, entries_of(*study.replicas));
    if (study.fragility)
        table(fragility_keys::table.name, entries_of(*study.fragility, study.has_pairs(), use));
    if (study.sensitivity)
        fields(sensitivity_keys::table, *study.sensitivity);
    if (study.rare)
        fields(rare_keys::table, *study.rare);
    if (study.survival)
        table(survival_keys::table.name, entries_of(*study.survival));
    Entries perturbed;
    for (const Perturbation& p : study.perturbations)
        perturbed.add_text(spread_key(p.quantity).name, spread(spread_key(p.quantity), p));
    if (!study.perturbations.empty())
        table(perturbation_table().name, perturbed);
    for (std::size_t i = 0; i < study.mechanism_perturbations.size();) {
        const Mechanism mechanism = study.mechanism_perturbations[i].mechanism;
        Entries of_mechanism;
        for (; i < study.mechanism_perturbations.size() && study.mechanism_perturbations[i].mechanism == mechanism;
             ++i) {
            const SpreadKey& key = spread_key(mechanism, study.mechanism_perturbations[i].parameter);
            of_mechanism.add_text(key.name, spread(key, study.mechanism_perturbations[i]));
        }
        table(perturbation_table().name + "." + perturbed_mechanisms().name + "." + to_string(mechanism), of_mechanism);
    }
    if (!study.mechanisms.empty())
        table(mechanisms_table().name, entries_of_mechanisms(study));
    table(initial_keys::table.name,
          Entries(initial_keys::table)
              .add_fields(initial_keys::table, study.initial,
                          study.initial.lift_m != 0 ? use : use.without({&initial_keys::lift})));
    table(output_keys::table.name, entries_of_output(study, use));
    table(outcome_keys::table.name, entries_of(study.outcome));
    table(run_keys::table.name, entries_of(study.run, use));
    return text;
}

} // namespace stylobate
