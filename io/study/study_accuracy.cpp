#include "io/study/study_accuracy.hpp"

#include "ensemble/sampling/plausible.hpp"
#include "io/keys/contact_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/run_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_tables.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

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
