#include "studies/experiment/conventions.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {

namespace {

const Perturbation* drawn(const Study& study, Quantity quantity)
{
    const auto found = std::ranges::find(study.perturbations, quantity, &Perturbation::quantity);
    return found == study.perturbations.end() ? nullptr : &*found;
}

/// "drawn from 0.05 to 0.5", or "0.1 (drawn: lognormal, sigma_ln 0.7)".
std::string value_text(double nominal, const char* unit, const Perturbation* spread)
{
    const std::string value = fmt::format("{:.3g}{}", nominal, unit);
    if (!spread)
        return value;
    switch (spread->distribution) {
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        return fmt::format("drawn from {:.3g} to {:.3g}{}", spread->from, spread->to, unit);
    case DistributionKind::lognormal:
        return fmt::format("{} (drawn: lognormal, sigma_ln {:.3g})", value, spread->sigma_ln);
    default:
        return spread->cov > 0 ? fmt::format("{} (drawn: normal, cov {:.3g})", value, spread->cov)
                               : fmt::format("{} (drawn: normal, sd {:.3g}{})", value, spread->sd, unit);
    }
}

std::string ratio_words(const Study& study)
{
    const Perturbation* spread = drawn(study, Quantity::damping_ratio);
    return "a ratio " + std::string(spread ? "" : "of ") + value_text(study.contact.normal_damping_ratio, "", spread);
}

std::string contact_words(const Study& study)
{
    const ContactSpec& contact = study.contact;
    if (contact.form == ContactForm::rigid)
        return fmt::format("rigid contacts with restitution {:.3g} ({})", contact.restitution,
                           contact.restitution_law == RestitutionLaw::newton ? "Newton" : "Poisson");
    if (study.structure.spatial())
        return fmt::format("plane faces that press on each other by {}, dashpots {} the contact with {}",
                           value_text(contact.normal_stiffness_n_m3, " N/m³", drawn(study, Quantity::normal_stiffness)),
                           contact.damping == DampingAt::ends ? "at the ends of" : "spread over", ratio_words(study));
    const bool area = contact.form == ContactForm::area;
    const char* form = area                                      ? "contact by area"
                       : contact.form == ContactForm::two_corner ? "contact at two corners"
                                                                 : "contact at points";
    const char* where = !area                                ? "its points"
                        : contact.damping == DampingAt::ends ? "the ends of the contact"
                                                             : "the centroid of the contact";
    const std::string coefficient = contact.normal_damping_n_s_m
                                        ? fmt::format("C_N {:.3g} N s/m", *contact.normal_damping_n_s_m)
                                        : ratio_words(study);
    return fmt::format("{}, K_N {}, dashpots at {} with {}", form,
                       value_text(contact.normal_stiffness_n_m2, " N/m²", drawn(study, Quantity::normal_stiffness)),
                       where, coefficient);
}

/// Start and end of a harmonic and what its ramps take of the cycles.
std::string harmonic_words(const ExcitationSpec& e)
{
    std::string text = fmt::format("harmonic of {:.3g} cycles in all", e.cycles);
    const bool start = e.start == HarmonicEdge::smooth, end = e.end == HarmonicEdge::smooth;
    if (!start)
        text += end ? ", abrupt start" : ", abrupt start and end";
    if (start && end)
        text += fmt::format(", of which the smooth start takes {0:.3g} and the smooth end {0:.3g}", e.ramp_cycles);
    else if (start || end)
        text += fmt::format(", of which the smooth {} takes {:.3g}", start ? "start" : "end", e.ramp_cycles);
    return start && !end ? text + ", abrupt end" : text;
}

std::string shaking_words(const Study& study)
{
    const ExcitationSpec& e = study.excitation;
    switch (e.kind) {
    case ExcitationKind::none:
        return "no shaking";
    case ExcitationKind::harmonic:
        return harmonic_words(e);
    case ExcitationKind::half_sine:
        return "half a sine of acceleration from rest";
    case ExcitationKind::full_sine:
        return "one full sine of acceleration from rest";
    case ExcitationKind::ricker:
        return "Ricker's wavelet from rest";
    case ExcitationKind::pulse:
        return fmt::format("velocity pulse of {} cycles under its bell, from rest",
                           drawn(study, Quantity::pulse_gamma) ? "a drawn number of" : fmt::format("{:.3g}", e.gamma));
    case ExcitationKind::tapered:
        return fmt::format("tapered harmonic of {:.3g} cycles in all, of which each ramp takes {:.3g}", e.cycles,
                           e.ramp_cycles);
    case ExcitationKind::sweep:
        return fmt::format("sine sweep of {:.3g} s with ramps of {:.3g} cycles", e.duration_s, e.ramp_cycles);
    case ExcitationKind::noise:
        return fmt::format("filtered noise of {:.3g} s of rise, {:.3g} s of strong shaking and a decay of {:.3g} s",
                           e.rise_s, e.strong_s, e.decay_s);
    case ExcitationKind::record:
        return e.baseline ? "records with a corrected baseline" : "records as they stand";
    case ExcitationKind::table:
        return "a table of samples as it stands";
    }
    return "";
}

/// Direction and components of the shaking in space.
std::string component_words(const Study& study)
{
    const ExcitationSpec& e = study.excitation;
    if (!study.structure.spatial() || e.kind == ExcitationKind::none)
        return "";
    std::string text = drawn(study, Quantity::direction) ? ", direction drawn"
                       : study.design().direction_deg    ? std::string(", direction of each row")
                                                      : fmt::format(", along {:.4g} degrees from x", e.direction_deg);
    if (study.has_pairs())
        text += e.second_ratio > 0 ? fmt::format(" with {:.3g} of it across", e.second_ratio)
                                   : std::string(" with a second component across");
    if (study.vertical)
        text += ", with its vertical component";
    else if (e.vertical_ratio > 0)
        text += fmt::format(", vertically {:.3g} of it", e.vertical_ratio);
    return text;
}

} // namespace

std::string conventions_text(const Study& study)
{
    return contact_words(study) + "; " + shaking_words(study) + (drawn(study, Quantity::phase) ? ", phase drawn" : "") +
           component_words(study);
}

std::optional<std::string> conventions_text_of(const std::string& study_toml)
{
    try {
        return conventions_text(parse_study(study_toml, "study"));
    } catch (const InputError&) { // of another version
        return std::nullopt;
    }
}

} // namespace stylobate
