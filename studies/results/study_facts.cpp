#include "studies/results/study_facts.hpp"

#include "ensemble/model/collapse_criterion.hpp"
#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/structure.hpp"
#include "io/files/suggest.hpp"
#include "io/keys/words.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {
namespace {

/// "0.048 m", or "0.044 m to 0.052 m".
std::string span_text(const std::vector<double>& values, const char* unit)
{
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *least == *most ? fmt::format("{:.4g} {}", *least, unit)
                           : fmt::format("{:.4g} {} to {:.4g} {}", *least, unit, *most, unit);
}

/// Number and sizes of the blocks of a kind; nullopt without any.
std::optional<std::string> blocks_text(const std::vector<PlacedBlock>& blocks, const char* noun)
{
    std::vector<double> width, height, mass;
    std::size_t fixed = 0;
    for (const PlacedBlock& block : blocks)
        if (block.name.starts_with(noun)) {
            width.push_back(block.width_m);
            height.push_back(block.height_m);
            mass.push_back(block.mass_kg);
            fixed += block.fixed;
        }
    if (width.empty())
        return std::nullopt;
    return fmt::format("{}{}: width {}, height {}, mass {}", counted(width.size(), noun),
                       fixed > 0 ? fmt::format(" ({} fixed)", fixed) : "", span_text(width, "m"),
                       span_text(height, "m"), span_text(mass, "kg"));
}

std::string structure_text(const Study& study, const Layout& layout)
{
    std::string text = counted(study.structure.columns.size(), "column");
    for (const std::optional<std::string>& part :
         {blocks_text(layout.blocks, "drum"), blocks_text(layout.blocks, "capital"),
          blocks_text(layout.blocks, "epistyle")})
        if (part)
            text += "; " + *part;
    if (study.structure.spatial())
        return text + "; in space";
    return text + fmt::format("; depth {:.4g} m", study.structure.depth_m);
}

std::string contact_text(const ContactSpec& contact)
{
    if (contact.form == ContactForm::rigid)
        return fmt::format("rigid contacts, friction {:.3g}, restitution {:.3g}", contact.friction,
                           contact.restitution);
    if (contact.normal_stiffness_n_m3 > 0)
        return fmt::format("friction {:.3g}, stiffness {:.3g} N/m³, tangentially {:.3g} N/m³, damping ratio {:.3g}, "
                           "tangentially {:.3g}",
                           contact.friction, contact.normal_stiffness_n_m3, contact.tangential_stiffness_n_m3,
                           contact.normal_damping_ratio, contact.tangential_damping_ratio);
    std::string text =
        fmt::format("{} contacts, friction {:.3g}, K_N {:.3g} N/m² (for the whole depth), K_T {:.3g} N/m",
                    word_for(contact_form_names, contact.form), contact.friction, contact.normal_stiffness_n_m2,
                    contact.tangential_stiffness_n_m);
    text += contact.normal_damping_n_s_m ? fmt::format(", C_N {:.3g} N s/m", *contact.normal_damping_n_s_m)
                                         : fmt::format(", normal damping ratio {:.3g}", contact.normal_damping_ratio);
    return text + (contact.tangential_damping_n_s_m
                       ? fmt::format(", C_T {:.3g} N s/m", *contact.tangential_damping_n_s_m)
                       : fmt::format(", tangential damping ratio {:.3g}", contact.tangential_damping_ratio));
}

/// `unit` with a blank before it, or nothing.
std::string axis_text(const Axis& axis, const char* unit)
{
    return axis.count == 1 ? fmt::format("{:.4g}{}", axis.from, unit)
                           : fmt::format("{} from {:.4g} to {:.4g}{}", axis.count, axis.from, axis.to, unit);
}

const char* excitation_name(ExcitationKind kind)
{
    switch (kind) {
    case ExcitationKind::none:
        return "none: the base is at rest";
    case ExcitationKind::harmonic:
        return "harmonic";
    case ExcitationKind::half_sine:
        return "half sine of acceleration";
    case ExcitationKind::full_sine:
        return "full sine of acceleration";
    case ExcitationKind::ricker:
        return "Ricker's wavelet";
    case ExcitationKind::pulse:
        return "velocity pulse (Mavroeidis and Papageorgiou)";
    case ExcitationKind::tapered:
        return "harmonic of tapered acceleration";
    case ExcitationKind::sweep:
        return "sine sweep";
    case ExcitationKind::noise:
        return "synthetic earthquakes (filtered noise)";
    case ExcitationKind::record:
        return "record";
    case ExcitationKind::table:
        return "table of samples";
    }
    return "";
}

/// "peak ground velocity [m/s]"
std::string measure_words(const MotionSetSpec& motions)
{
    return describe_measure(measure_name(motions.measure, motions.period_s));
}

/// @param one of all realizations; null: all of them
std::string excitation_text(const Study& study, const ResultRow* one)
{
    const ExcitationSpec& e = study.excitation;
    std::string text = excitation_name(e.kind);
    const StudyDesign design = study.design();
    if (const MotionSetSpec* f = design.motions; f && one) {
        const std::uint64_t stripes = design.columns;
        text += fmt::format(": motion {} (counted from 0) of {}", one->cell / stripes, f->motions);
        if (f->method == FragilityMethod::stripes)
            text += fmt::format(", {} {:.4g}", measure_words(*f),
                                f->intensity.value(static_cast<int>(one->cell % stripes)));
        return text;
    } else if (f) {
        text += fmt::format(": {} motions", f->motions);
        if (e.frequency_hz > 0)
            text += fmt::format(" about {:.4g} Hz", e.frequency_hz);
        return text + (f->method == FragilityMethod::cloud
                           ? fmt::format(", each scaled by {:.4g}", f->scale)
                           : "; " + measure_words(*f) + ": " + axis_text(f->intensity, ""));
    }
    if (e.kind == ExcitationKind::record || e.kind == ExcitationKind::table)
        text += " " + e.file + (e.component ? ", component " + *e.component : "");
    if (e.kind == ExcitationKind::harmonic || e.kind == ExcitationKind::tapered)
        text += fmt::format(", {:.3g} cycles", e.cycles);
    if (one) {
        if (one->frequency_hz > 0)
            text += fmt::format(", {:.4g} Hz", one->frequency_hz);
        return e.kind == ExcitationKind::none ? text : text + fmt::format(", PGA {:.4g} m/s²", one->pga_m_s2);
    }
    if (design.frequency_hz)
        text += "; frequency: " + axis_text(*design.frequency_hz, " Hz");
    else if (e.frequency_hz > 0)
        text += fmt::format(", {:.4g} Hz", e.frequency_hz);
    if (design.direction_deg)
        text += "; direction: " + axis_text(*design.direction_deg, "°");
    if (design.pga_m_s2)
        text += "; PGA: " + axis_text(*design.pga_m_s2, " m/s²");
    else if (e.pga_m_s2 > 0)
        text += fmt::format(", PGA {:.4g} m/s²", e.pga_m_s2);
    else if (e.kind == ExcitationKind::record)
        text += ", PGA as recorded";
    else if (e.kind == ExcitationKind::table)
        text += ", PGA as in the table";
    if (study.surface && study.surface->adaptive)
        text += fmt::format("; adaptive, ± {} with at most {} realizations", study.surface->adaptive->half_width,
                            study.surface->adaptive->budget);
    return text;
}

} // namespace

std::vector<std::pair<std::string, std::string>> study_facts(const Study& study, const ResultRow* one,
                                                             const std::vector<std::string>& inputs)
{
    const Layout layout = lay_out(study.structure);
    std::string perturbed;
    for (const Perturbation& p : study.perturbations)
        perturbed += (perturbed.empty() ? "" : ", ") + std::string(to_string(p.quantity));
    std::replace(perturbed.begin(), perturbed.end(), '_', ' ');
    std::string drawn;
    for (std::size_t i = 0; one && i < std::min(inputs.size(), one->inputs.size()); ++i)
        drawn += fmt::format("{}{} {:.4g}", drawn.empty() ? "" : ", ", inputs[i], one->inputs[i]);
    std::string mechanisms;
    for (std::size_t i = 0; i < study.mechanisms.size(); ++i)
        if (const Mechanism m = study.mechanisms[i].mechanism; i == 0 || study.mechanisms[i - 1].mechanism != m)
            mechanisms += fmt::format("{}{} ({})", i == 0 ? "" : ", ", to_string(m), rule_of(m).says);
    std::vector<std::pair<std::string, std::string>> facts{
        {"Structure", structure_text(study, layout)},
        {"Contact", contact_text(study.contact)},
        {"Excitation", excitation_text(study, one)},
        {"Mechanisms", mechanisms.empty() ? "none: the baseline" : mechanisms},
        one ? std::pair<std::string, std::string>{"Drawn in this realization", drawn.empty() ? "nothing" : drawn}
            : std::pair<std::string, std::string>{"Randomized", perturbed.empty() ? "nothing" : perturbed},
        {"Collapse", collapse_criterion(study.outcome)},
        {"Followed", followed_until(study.outcome)}};
    std::string chosen;
    for (const NumericsChoice& choice : study.chosen)
        chosen += fmt::format("{}{} = {} ({})", chosen.empty() ? "" : "; ", choice.key, choice.value, choice.reason);
    if (!chosen.empty())
        facts.emplace_back("Chosen by run.accuracy", chosen);
    return facts;
}

} // namespace stylobate
