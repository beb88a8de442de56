/// What a choice of the numerics changes in the collapse probability of different studies, on the same draws, and what
/// it costs beside the study as it stands: tables for docs/rigid_limit.md and docs/work_precision.md.
///
///   stylobate_accuracy_studies rigid [--accuracy A]    rigid contacts for an accuracy, less steps ten times shorter
///   stylobate_accuracy_studies compliant               steps of the usual length, less ten times shorter ones
///   stylobate_accuracy_studies tangential              K_T as a part of K_N B, less K_T = K_N B
///   stylobate_accuracy_studies precision               single precision, less double
///   stylobate_accuracy_studies bound                   the step bound of the structure, less that of the blocks
///   stylobate_accuracy_studies stiffness               two corners, less those ten times as stiff
///   stylobate_accuracy_studies limit                   the limit of contact by area, extrapolated from three softer
///                                                      runs, less contacts 256 times as stiff
///       [--draws N] [--study NAME] [--inputs FOLDER]

#include "bench/mean.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/run/executor.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/table.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/workflow/bench/scenes.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

using namespace stylobate;

namespace {

/// A study of `studies/inputs`, at one frequency and at the strength at which about half of its realizations fall.
struct Place {
    const char* name;
    const char* file;
    double frequency_hz;               ///< of a surface
    double weakest, strongest;         ///< PGA [m/s2], of a fragility study PGV [m/s]
    std::vector<std::string> settings; ///< beside these
};

const std::vector<Place>& places()
{
    static const std::vector<Place> all{
        {"monolith", "small_scale_monolith", 3, 2.8, 12, {}},
        {"two_drums",
         "small_scale_column",
         4,
         3,
         16,
         {"structure.blocks=3", "structure.drum_height_m=0.087", "structure.drum_mass_kg=0.4065"}},
        {"six_drums", "small_scale_column", 4, 1.5, 16, {}},
        {"six_drums_fast", "small_scale_column", 6, 1.5, 25, {}},
        {"six_drums_low_friction",
         "small_scale_column",
         4,
         1.5,
         25,
         {"contact.friction=0.3", "perturbation.friction.min=0.2"}},
        {"doric_column", "doric_column", 1, 1, 16, {}},
        {"small_colonnade", "small_scale_colonnade_drums", 3, 2, 25, {"outcome.follow=\"collapse\""}},
        {"large_colonnade", "full_scale_colonnade_two", 0.8, 1, 16, {"outcome.follow=\"collapse\""}},
        {"pulse", "near_fault_pulse", 0.7, 1, 25, {}},
        {"earthquake", "synthetic_earthquake", 2, 1, 25, {}},
        {"fragility", "fragility_column", 0, 0.1, 6, {}},
    };
    return all;
}

using Change = std::function<void(Study&)>;

struct Variant {
    std::string name;
    Change change;
};

struct Question {
    std::vector<Variant> variants;
    Variant reference;
    Change scanned; ///< the study in which the strength is looked for
};

Question question(const std::string& name, double accuracy)
{
    if (name == "rigid")
        return {{{"as asked", [=](Study& s) { make_rigid(s, accuracy); }}},
                {"ten times finer", [=](Study& s) { make_rigid(s, accuracy / 10); }},
                [](Study& s) { make_rigid(s, 0.1); }};
    const Change as_it_stands = [](Study&) {};
    if (name == "compliant")
        return {{{"0.9 of the bound", as_it_stands}, {"0.45", [](Study& s) { s.run.step_fraction /= 2; }}},
                {"0.09", [](Study& s) { s.run.step_fraction /= 10; }},
                as_it_stands};
    const auto tangential = [](double part) {
        return [part](Study& s) { s.contact.tangential_stiffness_n_m *= part; };
    };
    if (name == "tangential")
        return {{{"1/3", tangential(1.0 / 3)}, {"1/5", tangential(0.2)}}, {"1", as_it_stands}, as_it_stands};
    if (name == "precision")
        return {{{"single", [](Study& s) { s.run.precision = Precision::single; }}},
                {"double", as_it_stands},
                as_it_stands};
    const Change ends = [](Study& s) { s.contact.damping = DampingAt::ends; };
    if (name == "bound")
        return {{{"structure",
                  [](Study& s) {
                      s.contact.damping = DampingAt::ends;
                      s.run.step_bound = StepBasis::structure;
                  }}},
                {"block", ends},
                ends};
    const auto corners = [](double part) {
        return [part](Study& s) {
            s.contact.form = ContactForm::two_corner;
            s.contact.normal_stiffness_n_m2 *= part;
            s.contact.tangential_stiffness_n_m *= part / 5;
        };
    };
    return {{{"0.1 K_N", corners(0.1)}, {"K_N", corners(1)}}, {"10 K_N", corners(10)}, corners(1)};
}

Study study_of(const Place& place, const std::string& inputs, double strength, std::uint64_t draws)
{
    std::vector<std::string> settings = place.settings;
    const std::string axis = fmt::format("from = {0}, to = {0}, count = 1", strength);
    if (place.frequency_hz > 0) {
        settings.push_back(
            fmt::format("surface.frequency_hz={{ from = {0}, to = {0}, count = 1 }}", place.frequency_hz));
        settings.push_back(fmt::format("surface.pga_m_s2={{ {} }}", axis));
        settings.push_back(fmt::format("study.realizations={}", draws));
    } else {
        settings.push_back(fmt::format("fragility.intensity={{ measure = \"pgv\", {} }}", axis));
        settings.emplace_back("fragility.contacts=1");
        settings.emplace_back("fragility.twins=1");
        settings.emplace_back("study.realizations=8");
        settings.push_back(fmt::format("fragility.motions={}", draws / 8));
    }
    return read_study(fmt::format("{}/{}.toml", inputs, place.file), settings);
}

struct Answer {
    Fallen fallen; ///< (draws)
    double probability = 0;
    double seconds = 0; ///< of processor time for each realization
    double step_s = 0;  ///< mean
};

Answer run(const Study& study)
{
    Answer out;
    out.fallen.resize(study.total());
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization& r, const Outcome& o) {
        out.fallen[r.index] = o.state == State::invalid ? -1 : o.state == State::collapsed;
        out.step_s += r.step_s / static_cast<double>(study.total());
    };
    Observer quiet;
    const Experiment experiment(study, motions_of(study));
    const std::clock_t begin = std::clock();
    run_ensemble(experiment, {best_isa(), 1}, plan, quiet);
    out.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(study.total());
    out.probability = share_of(out.fallen).value();
    return out;
}

/// The strength at which half of 256 realizations fall, by eight halvings.
double strength_of(const Place& place, const std::string& inputs, const Change& scanned)
{
    double low = place.weakest, high = place.strongest;
    for (int i = 0; i < 8; ++i) {
        const double middle = (low + high) / 2;
        Study study = study_of(place, inputs, middle, 256);
        scanned(study);
        (run(study).probability < 0.5 ? low : high) = middle;
    }
    return std::round((low + high) / 2 * 100) / 100;
}

/// How much larger the share of `a` is than that of `b`, and its standard error by the pairs.
std::string difference(const Answer& a, const Answer& b)
{
    const Mean d = paired_difference(a.fallen, b.fallen);
    return fmt::format("{:+.4f} ± {:.4f}", d.value(), d.error());
}

/// The limit of probabilities a, b, c at K_N / 4, K_N and 4 K_N, less that of `far`, of the same draws.
/// @param exponent of the error over K_N; 0: by Aitken's formula, whose linear part the standard error is of
std::string extrapolated(const std::array<const Answer*, 3>& of, const Answer& far, double exponent)
{
    const double b = of[1]->probability - of[0]->probability, c = of[2]->probability - of[1]->probability;
    // the limit is c + part x (c - b)
    const double part = exponent > 0 ? 1 / (std::pow(4, exponent) - 1) : c / (b - c);
    // of Aitken's formula the derivatives by a, b and c
    const double d = b - c;
    const std::array<double, 3> weight =
        exponent > 0 ? std::array<double, 3>{0, -part, 1 + part}
                     : std::array<double, 3>{c * c / (d * d), -2 * b * c / (d * d), b * b / (d * d)};
    Mean mean;
    for (std::size_t i = 0; i < far.fallen.size(); ++i) {
        if (std::min({of[0]->fallen[i], of[1]->fallen[i], of[2]->fallen[i], far.fallen[i]}) < 0)
            continue;
        double one = -far.fallen[i];
        for (std::size_t k = 0; k < 3; ++k)
            one += weight[k] * of[k]->fallen[i];
        mean.add(one);
    }
    return fmt::format("{:+.4f} ± {:.4f}", of[2]->probability + part * c - far.probability, mean.error());
}

/// Three stiffnesses 4 times apart, their limit by several formulas, and one 256 times as stiff.
void answer_limit(const Place& place, const std::string& inputs, std::uint64_t draws)
{
    const double strength = strength_of(place, inputs, [](Study&) {});
    const auto stiffer = [&](double times) {
        Study study = study_of(place, inputs, strength, draws);
        study.contact.normal_stiffness_n_m2 *= times;
        study.contact.tangential_stiffness_n_m *= times;
        return run(study);
    };
    const Answer soft = stiffer(0.25), middle = stiffer(1), stiff = stiffer(4), far = stiffer(256);
    std::string row = fmt::format("{} | {:g}", place.name, strength);
    for (const Answer* a : {&soft, &middle, &stiff})
        row += " | " + difference(*a, far);
    for (const double exponent : {0.4, 0.5, 0.0})
        row += " | " + extrapolated({&soft, &middle, &stiff}, far, exponent);
    row += fmt::format(" | {:.3f} | {:.3g}", far.probability,
                       (soft.seconds + middle.seconds + stiff.seconds) / far.seconds);
    fmt::print("{}", markdown_row("{}", row));
    std::fflush(stdout);
}

void answer(const std::string& asked, double accuracy, const Place& place, const std::string& inputs,
            std::uint64_t draws)
{
    const Question q = question(asked, accuracy);
    const double strength = strength_of(place, inputs, q.scanned);
    const auto changed = [&](const Change& change) {
        Study study = study_of(place, inputs, strength, draws);
        change(study);
        return run(study);
    };
    const Answer usual = changed([](Study&) {}), reference = changed(q.reference.change);
    for (const Variant& variant : q.variants) {
        const Answer a = changed(variant.change);
        fmt::print("{}", markdown_row("{} | {:g} | {} | 1/{:.0f} | {:.4f} | {} | {:.3g} | {:.3g}", place.name, strength,
                                      variant.name, 1 / a.step_s, a.probability, difference(a, reference),
                                      1e3 * a.seconds, a.seconds / usual.seconds));
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("What a choice of the numerics changes in collapse probabilities, and what it costs");
    std::string asked, only, inputs = "studies/inputs";
    double accuracy = 0.05;
    std::uint64_t draws = 2048;
    app.add_option("QUESTION", asked, "which choice")
        ->required()
        ->check(CLI::IsMember({"rigid", "compliant", "tangential", "precision", "bound", "stiffness", "limit"}));
    app.add_option("--accuracy", accuracy, "of rigid contacts")->check(CLI::Range(0.001, 0.2));
    app.add_option("--draws", draws, "realizations of each")->check(CLI::Range(64, 1000000));
    app.add_option("--study", only, "one alone");
    app.add_option("--inputs", inputs, "folder of the studies")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    const bool limit = asked == "limit";
    try {
        fmt::print("{} draws each, {}; less: {}\n\n{}", draws, processor(),
                   limit ? "256 K_N" : question(asked, accuracy).reference.name,
                   markdown_head(limit ? "study | strength | K_N / 4 | K_N | 4 K_N | K_N, 4 K_N: exponent 0.4 | "
                                         "exponent 0.5 | all three: Aitken | probability at 256 K_N | part of its time"
                                       : "study | strength | numerics | step [s] | probability | difference | ms a "
                                         "realization | of the study as it stands"));
        for (const Place& place : places())
            if (only.empty() || place.name == only)
                limit ? answer_limit(place, inputs, draws) : answer(asked, accuracy, place, inputs, draws);
    } catch (const InputError& e) {
        fmt::print(stderr, "stylobate_accuracy_studies: {}\n", e.what());
        return 2;
    }
    return 0;
}
