/// `stylobate check`.

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/interval.hpp"
#include "io/keys/words.hpp"
#include "studies/app/command.hpp"
#include "studies/app/console.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/numerics.hpp"
#include "studies/report/json.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stylobate {

namespace {

/// Whether a realization is drawn by its index alone.
bool has_pilot(const Study& study)
{
    return study.kind == StudyKind::single || study.kind == StudyKind::fragility ||
           (study.kind == StudyKind::surface && !study.surface->adaptive);
}

std::string numerics_text(const Study& study, double step_s)
{
    return fmt::format("contact.form = \"{}\", steps of {:.3g} s (1/{:.0f})",
                       word_for(contact_form_names, study.contact.form), step_s, 1 / step_s);
}

/// What the second run of the pilot is.
std::string finer_text(const Study& study)
{
    std::string text = study.contact.form == ContactForm::rigid ? "steps a quarter as long" : "steps half as long";
    if (study.chose("run.precision"))
        text += ", in double precision";
    if (study.chose("run.step_bound"))
        text += ", by the bound of the blocks";
    if (study.chose("contact.normal_stiffness_n_m2"))
        text += ", ten times the stiffness";
    return text;
}

Json choices_of(const Study& study)
{
    Json all = Json::list();
    for (const NumericsChoice& choice : study.chosen)
        all.item(
            Json::object().member("key", choice.key).member("value", choice.value).member("reason", choice.reason));
    return all;
}

} // namespace

int check_command(const CommonOptions& options, const std::string& file, std::uint64_t pilot)
{
    const LoadedStudy loaded = LoadedStudy::from_file(file, options.set);
    const Study& study = loaded.study();
    const std::vector<std::string> warnings = loaded.warnings(file);
    if (!has_pilot(study))
        throw InputError(fmt::format("{}: `check` runs a part of a study twice, and those of study.kind = \"{}\"{} are "
                                     "chosen by what others did.\n  Check the same structure and shaking as a surface.",
                                     file, word_for(study_kind_names, study.kind),
                                     study.kind == StudyKind::surface ? " with surface.adaptive" : ""));
    Console console(options.quiet);
    for (const std::string& warning : warnings)
        console.warn(warning);
    const NumericsCheck check = check_numerics(loaded.experiment(), options.run_options(), pilot, console);
    if (console.stop_requested()) {
        fmt::print(stderr, "Interrupted; nothing is known of the numerics.\n");
        return exit_interrupted;
    }
    const auto n = static_cast<double>(check.realizations);
    const double share = n > 0 ? static_cast<double>(check.collapsed) / n : 0;
    const double per_s = check.seconds > 0 ? n / check.seconds : 0;
    const double wanted = study.run.accuracy.value_or(0);
    // the error is shown to be too large, or not
    const bool missed = wanted > 0 && std::fabs(check.difference) - 2 * check.sd > wanted;
    if (options.json) {
        fmt::print("{}\n", Json::object()
                               .member("form", word_for(contact_form_names, study.contact.form))
                               .member("mean_step_s", check.step_s)
                               .member("chosen", choices_of(study))
                               .member("realizations", study.total())
                               .member("pilot", check.realizations)
                               .member("collapse_probability", share)
                               .member("error_of_the_numerics", check.difference)
                               .member("its_standard_error", check.sd)
                               .member("realizations_per_second", per_s)
                               .member("accuracy_missed", missed)
                               .text());
        return missed ? exit_invalid : exit_done;
    }
    fmt::print("{}: {} realizations; {}\n", file, study.total(), numerics_text(study, check.step_s));
    for (const NumericsChoice& choice : study.chosen)
        fmt::print("chosen: {} = {}: {}\n", choice.key, choice.value, choice.reason);
    fmt::print("pilot: {} of them, {:.3g} of these collapsed; with {} {:.3g}\n", check.realizations, share,
               finer_text(study), n > 0 ? static_cast<double>(check.finer) / n : 0);
    fmt::print("error of the numerics: {:+.4f} ± {:.4f} of the collapse probability (difference of the two, and its "
               "standard error)\n",
               check.difference, check.sd);
    if (per_s > 0)
        fmt::print("about {:.3g} s for all realizations with these threads; the finer ones {:.2g} times that\n",
                   static_cast<double>(study.total()) / per_s, check.finer_seconds / check.seconds);
    if (missed)
        fmt::print("run.accuracy = {:g} is not reached: give a smaller one.\n", wanted);
    else if (wanted > 0 && check.sd > wanted)
        fmt::print("The pilot is too small to see an error of {:g}: --pilot {:.0f} would.\n", wanted,
                   n * std::pow(check.sd / wanted, 2) * 4);
    return missed ? exit_invalid : exit_done;
}

} // namespace stylobate
