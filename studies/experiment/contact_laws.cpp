#include "studies/experiment/contact_laws.hpp"

#include "ensemble/experiment.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stylobate {

namespace {

constexpr double stiffness_factor = 3;

/// Processor time of a block-step, relative to contact by area with its dashpot at the centroid: small_scale_column
/// under each form, one core of an AMD EPYC (Zen 5) with AVX-512.
double cost_of_step(const ContactSpec& contact)
{
    switch (contact.form) {
    case ContactForm::two_corner:
        return 0.7;
    case ContactForm::points:
        return 0.95;
    case ContactForm::rigid:
        return 4.4;
    default:
        return contact.damping == DampingAt::ends ? 2.1 : 1;
    }
}

/// Steps of a realization that runs to the time limit, the mean over some of the study.
double mean_steps(const Experiment& experiment)
{
    constexpr std::uint64_t looked_at = 64;
    const std::uint64_t total = experiment.study().originals(), count = std::min(looked_at, total);
    double sum = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const Realization r = experiment.sampler().realization(total / count * i);
        sum += longest_s(experiment, r) / r.step_s;
    }
    return sum / static_cast<double>(count);
}

double cost_of(const Experiment& experiment)
{
    return mean_steps(experiment) * cost_of_step(experiment.study().contact);
}

/// Every bed of the structure that may have values of its own.
template <class F>
void for_each_bed(StructureSpec& structure, const F& f)
{
    for (ColumnSpec& column : structure.columns)
        for (DrumSpec& drum : column.drums)
            f(drum.bed);
    for (EpistyleSpec& epistyle : structure.epistyles)
        f(epistyle.bed);
}

Study scaled(Study study, double factor)
{
    const auto scale = [factor](std::optional<double>& value) {
        if (value)
            *value *= factor;
    };
    study.contact.normal_stiffness_n_m2 *= factor;
    study.contact.tangential_stiffness_n_m *= factor;
    study.contact.normal_stiffness_n_m3 *= factor;
    study.contact.tangential_stiffness_n_m3 *= factor;
    for_each_bed(study.structure, [&](BedSpec& bed) {
        scale(bed.normal_stiffness_n_m2);
        scale(bed.tangential_stiffness_n_m);
        scale(bed.normal_stiffness_n_m3);
        scale(bed.tangential_stiffness_n_m3);
    });
    for (Perturbation& spread : study.perturbations)
        if (spread.quantity == Quantity::normal_stiffness || spread.quantity == Quantity::tangential_stiffness) {
            spread.sd *= factor; // cov and sigma_ln are relative
            spread.from *= factor;
            spread.to *= factor;
            scale(spread.min);
            scale(spread.max);
        }
    if (study.run.step_s && factor > 1) // the same part of the largest safe step
        *study.run.step_s /= std::sqrt(factor);
    return study;
}

/// The steps of a form that is not the study's are chosen as usual.
void choose_usual_steps(RunSpec& run)
{
    run.step_s.reset();
    run.step_fraction = RunSpec{}.step_fraction;
    run.step_bound = RunSpec{}.step_bound;
    run.allow_step_above_bound = false;
}

bool is_compliant(const Perturbation& spread)
{
    return spread.quantity == Quantity::normal_stiffness || spread.quantity == Quantity::tangential_stiffness ||
           spread.quantity == Quantity::damping_ratio;
}

Study rigid(Study study)
{
    ContactSpec& contact = study.contact;
    contact = {.form = ContactForm::rigid,
               .normal_damping_ratio = 0,
               .tangential_damping_ratio = 0,
               .normal_damping_n_s_m = {},
               .tangential_damping_n_s_m = {},
               .friction = contact.friction};
    std::erase_if(study.perturbations, is_compliant);
    choose_usual_steps(study.run);
    return study;
}

Study damped_elsewhere(Study study)
{
    study.contact.damping = study.contact.damping == DampingAt::ends ? DampingAt::centroid : DampingAt::ends;
    study.run.precision = Precision::double_; // single precision has no dashpots at the ends
    choose_usual_steps(study.run);
    return study;
}

/// The first line of a message about the study called "law", without that name and a line.
std::string reason_of(const InputError& error)
{
    std::string text = error.what();
    text = text.substr(0, text.find('\n'));
    if (text.starts_with("law"))
        text = text.substr(std::min(text.size(), text.find(": ") + 2));
    while (text.ends_with('.'))
        text.pop_back();
    return text;
}

/// Checks the study under the law as one that a user gives.
void complete(ContactLaw& law, const Study& under)
{
    Study study = under.without_replicas();
    study.output.trajectories = 0;
    study.chosen.clear();
    try {
        study = parse_study(study_text(study), "law");
        for (const Implausibility& one : implausibilities(study))
            if (one.refused)
                throw InputError(one.text);
        law.study = std::move(study);
    } catch (const InputError& error) {
        law.why_not = reason_of(error);
    }
}

} // namespace

std::vector<ContactLaw> contact_laws(const Study& study)
{
    const bool stiff = study.contact.form != ContactForm::rigid, ends = study.contact.damping == DampingAt::ends;
    const std::string no_stiffness = "the contacts of the study are rigid: they have no stiffness and no dashpot";

    ContactLaw softer{.name = "softer", .words = "a third of the normal and the tangential stiffness"};
    ContactLaw stiffer{.name = "stiffer", .words = "three times the normal and the tangential stiffness"};
    ContactLaw hard{.name = "rigid", .words = "rigid contacts"};
    const bool spatial = study.structure.spatial();
    ContactLaw damped{.name = !ends     ? "ends"
                              : spatial ? "spread"
                                        : "centroid",
                      .words = !ends     ? "the normal dashpots at the ends of the contact"
                               : spatial ? "the normal dashpots spread over the contact"
                                         : "the normal dashpots at the centroid of the contact"};
    if (!stiff) {
        softer.why_not = stiffer.why_not = damped.why_not = no_stiffness;
        hard.why_not = "it is the law of the study";
        return {softer, stiffer, hard, damped};
    }
    complete(softer, scaled(study, 1 / stiffness_factor));
    complete(stiffer, scaled(study, stiffness_factor));
    if (spatial) {
        hard.why_not = "structures in space have no rigid contacts";
        complete(damped, damped_elsewhere(study));
        return {softer, stiffer, hard, damped};
    }
    const bool spread = std::ranges::any_of(study.perturbations, is_compliant);
    if (spread && study.sampling == Sampling::sobol) {
        hard.why_not = "without the spreads of stiffness and damping the points of study.sampling = \"sobol\" are "
                       "others, so that the draws are not those of the study";
    } else {
        complete(hard, rigid(study));
        if (spread)
            hard.note = "The spreads of stiffness and damping are left out: rigid contacts have neither.";
    }
    if (study.contact.form == ContactForm::area)
        complete(damped, damped_elsewhere(study));
    else
        damped.why_not = "contact.damping changes contact.form = \"area\" alone; the other forms have their dashpots "
                         "at the points of contact";
    return {softer, stiffer, hard, damped};
}

double law_cost(const Experiment& study, const Experiment& law)
{
    return cost_of(law) / cost_of(study);
}

std::vector<std::string> laws_left_out(const std::vector<ContactLaw>& laws)
{
    std::vector<std::string> all;
    for (const ContactLaw& law : laws)
        if (!law.study)
            all.push_back(fmt::format("{} ({}): does not apply; {}.", law.name, law.words, law.why_not));
    return all;
}

std::string study_text_of(const std::string& result_text, bool motions)
{
    std::istringstream text(result_text);
    std::string study;
    for (std::string line; std::getline(text, line);)
        if ((motions || !line.starts_with("# ")) && !line.starts_with("title = "))
            study += line + '\n';
    return study;
}

} // namespace stylobate
