/// The canonical text of a study: every value, in one order, with numbers that read back to the same bits.

#include "io/study_file.hpp"
#include "io/study_names.hpp"
#include "io/toml_document.hpp"

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

std::string inline_table(const std::vector<std::pair<std::string, std::string>>& entries)
{
    std::string out = "{ ";
    for (const auto& [key, value] : entries)
        out += (out.size() > 2 ? ", " : "") + key + " = " + value;
    return out + " }";
}

void write(Writer& out, const StructureSpec& structure)
{
    out.section("structure");
    out.word("kind", "column");
    out.whole("blocks", static_cast<std::uint64_t>(structure.blocks));
    out.whole("fixed_blocks", static_cast<std::uint64_t>(structure.fixed_blocks));
    out.number("drum_width_m", structure.drum_width_m);
    out.number("drum_height_m", structure.drum_height_m);
    out.number("depth_m", structure.depth_m);
    out.number("drum_mass_kg", structure.drum_mass_kg);
    out.number("gravity_m_s2", structure.gravity_m_s2);
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
    out.word("damping", "centroid");
    out.word("damping_per", word_for(damping_per_names, contact.damping_per));
    out.word("form", "area");
    out.number("friction", contact.friction);
}

/// @param in_surface frequency and PGA come from the cells and are not the excitation's
void write(Writer& out, const ExcitationSpec& excitation, bool in_surface)
{
    out.section("excitation");
    out.word("kind", word_for(excitation_kind_names, excitation.kind));
    if (excitation.kind == ExcitationKind::none) {
        out.number("duration_s", excitation.duration_s);
        return;
    }
    if (excitation.kind == ExcitationKind::record) {
        out.word("file", excitation.file);
        if (!excitation.component.empty())
            out.word("component", excitation.component);
        if (!excitation.unit.empty())
            out.word("unit", excitation.unit);
        if (!in_surface) {
            if (excitation.pga_m_s2 > 0)
                out.number("scale_to_pga_m_s2", excitation.pga_m_s2);
            out.number("time_scale", excitation.time_scale);
        }
        out.boolean("baseline", excitation.baseline);
    } else if (!in_surface) {
        out.number("frequency_hz", excitation.frequency_hz);
        out.number("pga_m_s2", excitation.pga_m_s2);
    }
    if (excitation.kind == ExcitationKind::harmonic) {
        out.word("start", word_for(edge_names, excitation.start));
        out.word("end", word_for(edge_names, excitation.end));
        out.number("ramp_cycles", excitation.ramp_cycles);
        out.number("cycles", excitation.cycles);
        out.number("phase_rad", excitation.phase_rad);
    }
    out.number("tail_s", excitation.tail_s);
}

std::string axis(const Axis& axis)
{
    return inline_table({{"from", toml_number(axis.from)},
                         {"to", toml_number(axis.to)},
                         {"count", std::to_string(axis.count)},
                         {"spacing", toml_quoted(word_for(spacing_names, axis.spacing))}});
}

std::string perturbation(const Perturbation& p)
{
    std::vector<std::pair<std::string, std::string>> entries = {
        {"distribution", toml_quoted(word_for(distribution_names, p.distribution))}};
    switch (p.distribution) {
    case DistributionKind::normal:
        entries.emplace_back(p.cov > 0 ? "cov" : sd_key(p.quantity), toml_number(p.cov > 0 ? p.cov : p.sd));
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

} // namespace

std::string study_text(const Study& study)
{
    Writer out;
    out.section("study");
    out.word("kind", word_for(study_kind_names, study.kind));
    out.whole("seed", study.seed);
    out.whole("realizations", study.realizations);
    write(out, study.structure);
    write(out, study.contact);
    write(out, study.excitation, study.surface.has_value());
    if (study.surface) {
        out.section("surface");
        out.line("frequency_hz", axis(study.surface->frequency_hz));
        out.line("pga_m_s2", axis(study.surface->pga_m_s2));
    }
    if (!study.perturbations.empty())
        out.section("perturbation");
    for (const auto& p : study.perturbations)
        out.line(to_string(p.quantity), perturbation(p));
    out.section("initial");
    out.number("tilt_rad", study.initial.tilt_rad);
    out.section("output");
    out.number("trajectory_rate_hz", study.output.trajectory_rate_hz);
    out.section("outcome");
    out.line("collapse", inline_table({{"height_fraction", toml_number(study.outcome.collapse_height_fraction)}}));
    out.number("rocking_threshold_rad", study.outcome.rocking_threshold_rad);
    out.number("sliding_threshold", study.outcome.sliding_threshold);
    out.section("run");
    if (study.run.step_s)
        out.number("step_s", *study.run.step_s);
    else
        out.number("step_fraction", study.run.step_fraction);
    out.boolean("allow_step_above_bound", study.run.allow_step_above_bound);
    out.number("max_invalid_fraction", study.run.max_invalid_fraction);
    return out.text();
}

} // namespace stylobate
