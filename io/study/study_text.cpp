/// The canonical text of a study: every value, in one order, with numbers that read back to the same bits.

#include "ensemble/model/nominal.hpp"
#include "io/files/toml_document.hpp"
#include "io/study/study_file.hpp"
#include "io/study/study_mechanisms.hpp"
#include "io/study/study_names.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace stylobate {

namespace {

/// Writes sections of "key = value" lines, or the entries of an inline table.
class Writer {
public:
    void section(std::string_view name)
    {
        out_ += out_.empty() ? "[" : "\n[";
        out_ += name;
        out_ += "]\n";
    }
    void line(std::string_view key, const std::string& value)
    {
        out_ += key;
        out_ += " = ";
        out_ += value;
        out_ += '\n';
    }
    void number(std::string_view key, double value) { line(key, toml_number(value)); }
    void number(std::string_view key, const std::optional<double>& value)
    {
        if (value)
            number(key, *value);
    }
    void whole(std::string_view key, std::uint64_t value) { line(key, std::to_string(value)); }
    void word(std::string_view key, std::string_view value) { line(key, toml_quoted(value)); }
    void boolean(std::string_view key, bool value) { line(key, value ? "true" : "false"); }
    const std::string& text() const { return out_; }

private:
    std::string out_;
};

using Entries = std::vector<std::pair<std::string, std::string>>;

std::string inline_table(const Entries& entries)
{
    std::string out = "{ ";
    for (const auto& [key, value] : entries)
        out += (out.size() > 2 ? ", " : "") + key + " = " + value;
    return out + " }";
}

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
    if (bed.friction)
        entries.emplace_back("friction", toml_number(*bed.friction));
    if (bed.normal_stiffness_n_m2)
        entries.emplace_back("normal_stiffness_n_m2", toml_number(*bed.normal_stiffness_n_m2));
    if (bed.tangential_stiffness_n_m)
        entries.emplace_back("tangential_stiffness_n_m", toml_number(*bed.tangential_stiffness_n_m));
}

Entries entries_of(const DrumSpec& drum)
{
    Entries entries = {{"width_m", toml_number(drum.width_m)},
                       {"height_m", toml_number(drum.height_m)},
                       {"mass_kg", toml_number(drum.mass_kg)}};
    if (drum.offset_m != 0)
        entries.emplace_back("offset_m", toml_number(drum.offset_m));
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
            entries.emplace_back("count", std::to_string(count));
        lines.push_back(inline_table(entries));
        i += count;
    }
    return list(lines, indent);
}

std::string columns(const std::vector<ColumnSpec>& columns)
{
    std::vector<std::string> lines;
    for (const ColumnSpec& column : columns) {
        Entries entries = {{"x_m", toml_number(column.x_m)},
                           {"fixed_blocks", std::to_string(column.fixed_blocks)},
                           {"drums", drums(column.drums, "    ")}};
        if (column.drums.back().capital)
            entries.emplace_back("capital", inline_table(entries_of(column.drums.back())));
        lines.push_back(inline_table(entries));
    }
    return list(lines, "");
}

std::string epistyles(const std::vector<EpistyleSpec>& epistyles)
{
    std::vector<std::string> lines;
    for (const EpistyleSpec& epistyle : epistyles) {
        Entries entries = {{"first_column", std::to_string(epistyle.first_column)},
                           {"last_column", std::to_string(epistyle.last_column)},
                           {"x_m", toml_number(epistyle.x_m)},
                           {"length_m", toml_number(epistyle.length_m)},
                           {"height_m", toml_number(epistyle.height_m)},
                           {"mass_kg", toml_number(epistyle.mass_kg)}};
        add(entries, epistyle.bed);
        lines.push_back(inline_table(entries));
    }
    return list(lines, "");
}

/// A column of equal drums in few words; all else block by block.
void write(Writer& out, const StructureSpec& structure)
{
    out.section("structure");
    out.word("kind", word_for(structure_kind_names, structure.kind));
    out.number("depth_m", structure.depth_m);
    out.number("gravity_m_s2", structure.gravity_m_s2);
    if (structure.kind == StructureKind::colonnade) {
        out.line("column_list", columns(structure.columns));
        out.line("epistyles", epistyles(structure.epistyles));
        return;
    }
    const ColumnSpec& column = structure.columns[0];
    const DrumSpec& lowest = column.drums[0];
    const int count = static_cast<int>(column.drums.size());
    if (structure == equal_column(count, column.fixed_blocks, lowest.width_m, lowest.height_m, structure.depth_m,
                                  lowest.mass_kg, structure.gravity_m_s2)) {
        out.whole("blocks", column.drums.size());
        out.number("drum_width_m", lowest.width_m);
        out.number("drum_height_m", lowest.height_m);
        out.number("drum_mass_kg", lowest.mass_kg);
    } else {
        out.line("drums", drums(column.drums, ""));
        if (column.drums.back().capital)
            out.line("capital", inline_table(entries_of(column.drums.back())));
    }
    out.whole("fixed_blocks", static_cast<std::uint64_t>(column.fixed_blocks));
}

void write(Writer& out, const ContactSpec& contact)
{
    out.section("contact");
    out.number("normal_stiffness_n_m2", contact.normal_stiffness_n_m2);
    out.number("tangential_stiffness_n_m", contact.tangential_stiffness_n_m);
    if (contact.normal_damping_n_s_m)
        out.number("normal_damping_n_s_m", *contact.normal_damping_n_s_m);
    else
        out.number("normal_damping_ratio", contact.normal_damping_ratio);
    if (contact.tangential_damping_n_s_m)
        out.number("tangential_damping_n_s_m", *contact.tangential_damping_n_s_m);
    else
        out.number("tangential_damping_ratio", contact.tangential_damping_ratio);
    out.word("damping", word_for(damping_at_names, contact.damping));
    out.word("damping_per", word_for(damping_per_names, contact.damping_per));
    out.word("form", word_for(contact_form_names, contact.form));
    out.number("friction", contact.friction);
}

/// @param kind in a surface frequency and PGA come from the cells, in a fragility study the motions from elsewhere:
/// they
///        are not the excitation's
void write(Writer& out, const ExcitationSpec& excitation, StudyKind kind, const StructureSpec& structure)
{
    const bool in_surface = kind == StudyKind::surface, in_fragility = kind == StudyKind::fragility;
    out.section("excitation");
    out.word("kind", word_for(excitation_kind_names, excitation.kind));
    if (excitation.kind == ExcitationKind::none) {
        out.number("duration_s", excitation.duration_s);
        return;
    }
    const auto is = [&](ExcitationKind asked) { return excitation.kind == asked; };
    if (is(ExcitationKind::record) || is(ExcitationKind::table)) {
        if (!in_fragility)
            out.word("file", excitation.file);
        if (!excitation.run.empty())
            out.word("run", excitation.run);
        if (!excitation.component.empty())
            out.word("component", excitation.component);
        if (!excitation.unit.empty())
            out.word("unit", excitation.unit);
        if (!in_surface) {
            if (excitation.pga_m_s2 > 0 && !in_fragility)
                out.number("scale_to_pga_m_s2", excitation.pga_m_s2);
            out.number("time_scale", excitation.time_scale);
        }
        if (is(ExcitationKind::record))
            out.boolean("baseline", excitation.baseline);
        if (excitation.band_pass)
            out.line("band_pass_hz", fmt::format("[{}, {}]", toml_number(excitation.band_pass->low_hz),
                                                 toml_number(excitation.band_pass->high_hz)));
    } else if (!in_surface) {
        if (!is(ExcitationKind::sweep))
            out.number("frequency_hz", excitation.frequency_hz);
        if (!in_fragility)
            out.number("pga_m_s2", excitation.pga_m_s2);
    }
    if (is(ExcitationKind::harmonic)) {
        out.word("start", word_for(edge_names, excitation.start));
        out.word("end", word_for(edge_names, excitation.end));
    }
    if (is(ExcitationKind::sweep)) {
        out.number("from_hz", excitation.from_hz);
        out.number("to_hz", excitation.to_hz);
        out.word("spacing", word_for(spacing_names, excitation.spacing));
        out.number("duration_s", excitation.duration_s);
    }
    if (is(ExcitationKind::harmonic) || is(ExcitationKind::tapered) || is(ExcitationKind::sweep))
        out.number("ramp_cycles", excitation.ramp_cycles);
    if (is(ExcitationKind::harmonic) || is(ExcitationKind::tapered))
        out.number("cycles", excitation.cycles);
    if (is(ExcitationKind::harmonic) || is(ExcitationKind::tapered) || is(ExcitationKind::pulse))
        out.number("phase_rad", excitation.phase_rad);
    if (is(ExcitationKind::pulse))
        out.number("gamma", excitation.gamma);
    if (is(ExcitationKind::noise)) {
        if (!in_fragility)
            out.word("pga_of", word_for(pga_of_names, excitation.pga_of));
        out.number("ground_damping_ratio", excitation.ground_damping_ratio);
        out.number("low_cut_ratio", excitation.low_cut_ratio);
        out.number("low_cut_damping_ratio", excitation.low_cut_damping_ratio);
        out.number("rise_s", excitation.rise_s);
        out.number("strong_s", excitation.strong_s);
        out.number("decay_s", excitation.decay_s);
    }
    if (excitation.tail_s)
        out.number("tail_s", excitation.tail_s);
    else // each realization has its own
        out.line("tail_s", fmt::format("{} # 12 / p of each realization; of the structure as given {:.4g} s",
                                       toml_quoted(tail_of_structure), nominal_tail_s(structure)));
}

void add_axis(Entries& entries, const Axis& axis)
{
    entries.emplace_back("from", toml_number(axis.from));
    entries.emplace_back("to", toml_number(axis.to));
    entries.emplace_back("count", std::to_string(axis.count));
    entries.emplace_back("spacing", toml_quoted(word_for(spacing_names, axis.spacing)));
}

std::string axis(const Axis& axis)
{
    Entries entries;
    add_axis(entries, axis);
    return inline_table(entries);
}

/// @param sd the key of a standard deviation
std::string spread(const Spread& p, const std::string& sd)
{
    Entries entries = {{"distribution", toml_quoted(word_for(distribution_names, p.distribution))}};
    switch (p.distribution) {
    case DistributionKind::normal:
        entries.emplace_back(p.cov > 0 ? "cov" : sd, toml_number(p.cov > 0 ? p.cov : p.sd));
        break;
    case DistributionKind::lognormal:
        entries.emplace_back("sigma_ln", toml_number(p.sigma_ln));
        break;
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        entries.emplace_back("from", toml_number(p.from));
        entries.emplace_back("to", toml_number(p.to));
        break;
    }
    if (p.min)
        entries.emplace_back("min", toml_number(*p.min));
    if (p.max)
        entries.emplace_back("max", toml_number(*p.max));
    entries.emplace_back("per", toml_quoted(word_for(per_names, p.per)));
    return inline_table(entries);
}

std::string numbers(const std::vector<double>& values)
{
    std::string text;
    for (const double value : values)
        text += (text.empty() ? "" : ", ") + toml_number(value);
    return "[" + text + "]";
}

std::string words(const std::vector<std::string>& values)
{
    std::string text;
    for (const std::string& value : values)
        text += (text.empty() ? "" : ", ") + toml_quoted(value);
    return "[" + text + "]";
}

void write(Writer& out, const FragilitySpec& f)
{
    out.section("fragility");
    out.word("method", word_for(fragility_method_names, f.method));
    if (f.records.empty()) {
        out.whole("motions", static_cast<std::uint64_t>(f.motions));
    } else {
        std::vector<std::string> lines;
        for (const RecordSpec& record : f.records) {
            Entries entries = {{"file", toml_quoted(record.file)}};
            if (!record.component.empty())
                entries.emplace_back("component", toml_quoted(record.component));
            if (!record.unit.empty())
                entries.emplace_back("unit", toml_quoted(record.unit));
            lines.push_back(inline_table(entries));
        }
        out.line("records", list(lines, ""));
    }
    if (f.method == FragilityMethod::cloud) {
        out.number("scale", f.scale);
    } else {
        Entries entries = {{"measure", toml_quoted(word_for(intensity_measure_names, f.measure))}};
        if (f.measure == IntensityMeasure::sa)
            entries.emplace_back("period_s", toml_number(f.period_s));
        add_axis(entries, f.intensity);
        out.line("intensity", inline_table(entries));
    }
    out.whole("shakings", static_cast<std::uint64_t>(f.shakings));
    out.number("pause_s", f.pause_s);
    out.whole("contacts", static_cast<std::uint64_t>(f.contacts));
    out.whole("twins", static_cast<std::uint64_t>(f.twins));
    out.number("twin_m", f.twin_m);
    out.line("peak_limits", numbers(f.peak_limits));
    out.line("residual_limits", numbers(f.residual_limits));
    out.line("periods_s", numbers(f.periods_s));
}

void write(Writer& out, const TwinsSpec& twins)
{
    out.section("twins");
    std::vector<double> moves;
    double step_ratio = 1;
    bool precision = false, forms = false;
    for (const Twin& kind : twins.kinds) {
        if (kind.by == TwinBy::move)
            moves.push_back(kind.size);
        if (kind.by == TwinBy::step)
            step_ratio = kind.size;
        precision = precision || kind.by == TwinBy::precision;
        forms = forms || kind.by == TwinBy::form;
    }
    out.line("moves_m", numbers(moves));
    out.whole("block", static_cast<std::uint64_t>(twins.block));
    out.number("step_ratio", step_ratio);
    out.boolean("precision", precision);
    out.boolean("forms", forms);
    out.whole("followed", twins.followed);
    out.number("tolerance", twins.tolerance);
}

/// What every study has at its end: start, output, outcome, run.
void write_end(Writer& out, const Study& study)
{
    out.section("initial");
    out.number("tilt_rad", study.initial.tilt_rad);
    out.whole("tilt_from_block", static_cast<std::uint64_t>(study.initial.tilt_from_block));
    out.section("output");
    out.number("trajectory_rate_hz", study.output.trajectory_rate_hz);
    out.word("realizations", word_for(kept_realizations_names, study.kept));
    if (study.kind == StudyKind::single) {
        const std::optional<std::uint64_t>& kept = study.output.trajectories;
        if (kept && *kept != OutputSpec::all)
            out.whole("trajectories", *kept);
        else
            out.word("trajectories", kept ? trajectories_all : trajectories_fit);
        out.number("most_mb", study.output.most_mb);
    }
    out.section("outcome");
    out.word("follow", word_for(follow_names, study.outcome.follow));
    out.line("collapse", inline_table({{"height_fraction", toml_number(study.outcome.collapse_height_fraction)}}));
    out.number("rocking_threshold_rad", study.outcome.rocking_threshold_rad);
    out.number("sliding_threshold", study.outcome.sliding_threshold);
    out.section("run");
    out.word("precision", word_for(precision_names, study.run.precision));
    if (study.run.step_s)
        out.number("step_s", *study.run.step_s);
    else
        out.number("step_fraction", study.run.step_fraction);
    out.word("step_bound", word_for(step_basis_names, study.run.step_bound));
    out.boolean("allow_step_above_bound", study.run.allow_step_above_bound);
    out.number("max_invalid_fraction", study.run.max_invalid_fraction);
}

} // namespace

std::string study_text(const Study& study)
{
    Writer out;
    out.section("study");
    out.word("kind", word_for(study_kind_names, study.kind));
    if (!study.title.empty()) // a study without a title has the text that it always had
        out.word("title", study.title);
    out.whole("seed", study.seed);
    if (!study.sensitivity && !study.rare)
        out.whole("realizations", study.realizations);
    out.word("sampling", word_for(sampling_names, study.sampling));
    out.line("allow", words(study.allow));
    write(out, study.structure);
    write(out, study.contact);
    write(out, study.excitation, study.kind, study.structure);
    if (study.surface) {
        out.section("surface");
        out.line("frequency_hz", axis(study.surface->frequency_hz));
        out.line("pga_m_s2", axis(study.surface->pga_m_s2));
        if (const std::optional<AdaptiveSpec>& adaptive = study.surface->adaptive)
            out.line("adaptive", inline_table({{"budget", std::to_string(adaptive->budget)},
                                               {"minimum", std::to_string(adaptive->minimum)},
                                               {"half_width", toml_number(adaptive->half_width)},
                                               {"borrow", adaptive->borrow ? "true" : "false"}}));
    }
    if (study.twins)
        write(out, *study.twins);
    if (study.fragility)
        write(out, *study.fragility);
    if (const std::optional<SensitivitySpec>& sensitivity = study.sensitivity) {
        out.section("sensitivity");
        out.word("method", word_for(sensitivity_method_names, sensitivity->method));
        out.whole("samples", sensitivity->samples);
        out.whole("inner", sensitivity->inner);
        out.line("factors", words(sensitivity->factors));
    }
    if (study.rare) {
        out.section("rare");
        out.whole("samples", study.rare->samples);
        out.whole("repeats", study.rare->repeats);
    }
    if (!study.perturbations.empty())
        out.section("perturbation");
    for (const auto& p : study.perturbations)
        out.line(to_string(p.quantity), spread(p, sd_key(p.quantity)));
    const MechanismRule* last = nullptr;
    for (const auto& p : study.mechanism_perturbations) {
        const MechanismRule& rule = rule_of(p.mechanism);
        if (&rule != last)
            out.section(std::string("perturbation.mechanisms.") + rule.name);
        last = &rule;
        const MechanismParameter& parameter = rule.parameters[p.parameter];
        out.line(parameter.key(), spread(p, std::string("sd") + parameter.suffix));
    }
    if (!study.mechanisms.empty())
        out.section("mechanisms");
    for (const auto& [name, value] : mechanism_entries(study))
        out.line(name, value);
    write_end(out, study);
    return out.text();
}

} // namespace stylobate
