/// What the outcome of an ensemble depends on, and on what not.

#include "ensemble/numerics/interval.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/stack_vibration.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr double frequency_hz = 3;
constexpr std::uint64_t realizations = 400;

/// Free blocks of 48 mm under a harmonic of 3 Hz; friction, widths, offsets, the base's level and the phase differ.
Study shaken_column(int free_blocks, const model::Stone& stone, double K_n, double pga, double step_fraction = 0.9)
{
    Study study;
    study.realizations = realizations;
    study.structure = equal_column(free_blocks + 1, 1, stone.width, stone.height, 0.048, stone.mass);
    study.contact.normal_stiffness_n_m2 = K_n;
    study.contact.tangential_stiffness_n_m = K_n * 0.048;
    study.contact.friction = 0.68;
    study.excitation.kind = ExcitationKind::harmonic;
    study.excitation.frequency_hz = frequency_hz;
    study.excitation.pga_m_s2 = pga;
    study.run.step_fraction = step_fraction;
    const auto normal = [](Quantity quantity, Per per, double sd, double cov) {
        Perturbation p;
        p.quantity = quantity;
        p.per = per;
        p.sd = sd;
        p.cov = cov;
        return p;
    };
    study.perturbations = {
        normal(Quantity::friction, Per::joint, 0, 0.1), normal(Quantity::drum_width, Per::block, 0.0002, 0),
        normal(Quantity::drum_offset, Per::block, 0.00024, 0), normal(Quantity::tilt, Per::structure, 0.0017453, 0)};
    study.perturbations[0].min = 0.36;
    study.perturbations[0].max = 0.84;
    Perturbation phase;
    phase.quantity = Quantity::phase;
    phase.distribution = DistributionKind::uniform;
    phase.to = 2 * model::pi;
    study.perturbations.push_back(phase);
    return study;
}

std::uint64_t collapses(const Study& study)
{
    const Experiment experiment(study);
    RunPlan plan;
    plan.total = realizations;
    plan.sink = [](const Realization&, const Outcome&) {};
    Observer silent;
    const Progress end = run_ensemble(experiment, {best_isa(), 1}, plan, silent);
    if (end.invalid > 0)
        throw std::runtime_error("some realizations are invalid");
    return end.collapsed;
}

Finding contact_stiffness()
{
    Finding f;
    constexpr double pga = 2.15; // below the 2.706 at which a rigid column opens
    const std::vector<double> at{3e6, 1e7, 3e7, 1e8, 3e8, 1e9, 3e9};
    std::vector<double> probability, low, high, first, share;
    std::string table =
        markdown_head("K_N [N/m2] | collapse probability (95 %) | f1 [Hz] | f / f1 | static capacity of MONO [m/s2]");
    const auto collapsed = [](double K, double step_fraction = 0.9) {
        return collapses(shaken_column(6, model::spec_drum, K, pga, step_fraction));
    };
    for (double K : at) {
        const std::uint64_t n = collapsed(K);
        const BinomialInterval interval = jeffreys(realizations, n, 0.95);
        probability.push_back(static_cast<double>(n) / realizations);
        low.push_back(interval.lower);
        high.push_back(interval.upper);
        first.push_back(frequencies_hz(model::spec({K, 0, 1}, 1)).front());
        const double h = 0.5 * model::mono_stone.height, b = 0.5 * model::mono_stone.width;
        const double t = std::pow(std::sqrt(2 * model::mono_stone.mass * model::gravity / K) / (6 * h), 2.0 / 3);
        share.push_back(model::gravity * (b / h - 3 * t));
        table +=
            fmt::format("| {:.0e} | {:.3f} ({:.3f} to {:.3f}) | {:.2f} | {:.3f} | {:.3f} |\n", K, probability.back(),
                        interval.lower, interval.upper, first.back(), frequency_hz / first.back(), share.back());
    }
    f.at_least("collapse probability at K_N = 3e6 N/m2: lower end of its interval, above the upper end at 3e9",
               high.back(), low.front());
    for (const double K : {1e7, 1e8}) {
        const auto full = static_cast<double>(collapsed(K)), quarter = static_cast<double>(collapsed(K, 0.225));
        const double p = 0.5 * (full + quarter) / realizations;
        // two draws of the same probability, independent at the worst (the same realizations: less)
        f.equals(fmt::format("K_N = {:g} N/m2: collapse probability with a quarter of the step", K),
                 full / realizations, quarter / realizations,
                 1.96 * std::sqrt(2 * std::max(p * (1 - p), 1.0 / realizations) / realizations));
    }
    f.remarks.push_back(table);
    f.remarks.emplace_back(
        "The result depends on the contact stiffness and not on the time step, so it is due to the compliance of the "
        "model and not to the integration. 2.15 m/s2 is below 2.706 m/s2, the acceleration at which a rigid column "
        "opens. With compliant beds the joints begin to open at a third of that value (see Uplift). The stiffness "
        "controls the further opening, the capacity of the column, and the ratio of the shaking frequency to its first "
        "frequency (the columns at the right).");
    f.pictures.push_back({"contact_stiffness",
                          fmt::format("Collapse probability of SPEC at {} m/s2 and {} Hz over the "
                                      "contact stiffness, with its first frequency",
                                      pga, frequency_hz),
                          {curves({"K_N [N/m2]", true, 0, 0}, {"collapse probability", false, 0, 1.05},
                                  {{std::nullopt, at, probability, false, low, high}}),
                           curves({"K_N [N/m2]", true, 0, 0}, {"first frequency [Hz]", true, 0, 0},
                                  {{std::nullopt, at, first, true}})}});
    return f;
}

/// One contact law for MONO.
struct ImpactLaw {
    const char* words;
    ContactForm form = ContactForm::area;
    DampingAt damping = DampingAt::centroid;
    double xi = 0;
};

const std::vector<ImpactLaw> impact_laws{
    {"area, dashpots at the centroid", ContactForm::area, DampingAt::centroid, 0.1},
    {"area, dashpots at the centroid", ContactForm::area, DampingAt::centroid, 0.4},
    {"area, dashpots at the ends", ContactForm::area, DampingAt::ends, 0.1},
    {"area, dashpots at the ends", ContactForm::area, DampingAt::ends, 0.5},
    {"two corners", ContactForm::two_corner, DampingAt::centroid, 0.1},
    {"two corners", ContactForm::two_corner, DampingAt::centroid, 0.5},
    {"rigid", ContactForm::rigid, DampingAt::centroid, 0},
};

Study monolith_study(const ImpactLaw& law, double pga)
{
    Study study = shaken_column(1, model::mono_stone, law.form == ContactForm::rigid ? 0 : 1e9, pga);
    study.contact.form = law.form;
    study.contact.damping = law.damping;
    study.contact.normal_damping_ratio = study.contact.tangential_damping_ratio = law.xi;
    if (law.form == ContactForm::rigid)
        study.run.step_s = 1.0 / 3840;
    return study;
}

/// Part of the energy that the first impact takes, from half the slenderness, nothing drawn.
double first_loss(const ImpactLaw& law)
{
    Study study = monolith_study(law, 0);
    study.perturbations.clear();
    study.initial.tilt_rad = 0.5 * model::slenderness(model::mono_stone);
    study.initial.tilt_from_block = 1;
    const double e = impact_restitution(Experiment(study).sampler().realization(0), study.contact);
    return 1 - e * e;
}

Finding impact_loss()
{
    Finding f;
    const double e = static_cast<double>(housner_restitution(rigid_block(0.048L, 0.174L).alpha));
    const std::vector<double> amplitudes{2.8, 3.1, 3.4};
    std::string head = "contact, K_N = 1e9 N/m2 | damping ratio | energy that the first impact takes";
    for (const double pga : amplitudes)
        head += fmt::format(" | collapse at {:g} m/s2 (95 %)", pga);
    std::string table = markdown_head(head);
    std::vector<double> loss;
    std::vector<std::vector<BinomialInterval>> intervals; // (laws) of the amplitudes
    for (const ImpactLaw& law : impact_laws) {
        loss.push_back(first_loss(law));
        intervals.emplace_back();
        std::string row = fmt::format("{} | {:g} | {:.3f}", law.words, law.xi, loss.back());
        for (const double pga : amplitudes) {
            const std::uint64_t n = collapses(monolith_study(law, pga));
            intervals.back().push_back(jeffreys(realizations, n, 0.95));
            row += fmt::format(" | {:.3f} ({:.3f} to {:.3f})", static_cast<double>(n) / realizations,
                               intervals.back().back().lower, intervals.back().back().upper);
        }
        table += markdown_row("{}", row);
    }
    f.equals("rigid: energy that the first impact takes, 1 - e2 of Housner", 1 - e * e, loss.back(), 0.002);
    f.at_most("area, dashpots at the centroid: energy that it takes, half of Housner's", 0.5 * (1 - e * e),
              std::max(loss[0], loss[1]));
    for (std::size_t k = 0; k < amplitudes.size(); ++k)
        f.at_least(fmt::format("area, dashpots at the centroid, ratio 0.1, {:g} m/s2: lower end of the interval of the "
                               "probability, above the upper end of rigid contacts",
                               amplitudes[k]),
                   intervals.back()[k].upper, intervals.front()[k].lower);
    f.remarks.push_back(table);
    f.remarks.emplace_back(
        "The contact by area is above rigid contacts in every column. Two properties differ, and the table does not "
        "separate them everywhere: the loss at an impact, and the compliance, which lowers the static capacity by 4 % "
        "at this K_N (see StiffnessEffect). Two corners with a damping ratio of 0.5 have nearly the capacity and the "
        "loss of rigid contacts. `stylobate check` and `run --laws` measure the band over contact laws in a study "
        "([check.md](check.md#the-contact-law)).");
    return f;
}

} // namespace

Cases sensitivity_cases()
{
    return {
        {"ContactStiffness", "Dependence of the outcome on parameters",
         fmt::format(
             "Collapse probability of SPEC with imperfections under 3 Hz and 2.15 m/s2, {} realizations for each "
             "contact stiffness.",
             realizations),
         "none for the probability itself. The check is that the result is a property of the model: the stiffness "
         "changes the probability beyond its interval, and a quarter of the step does not. f1 (eigenvalues) and the "
         "static capacity (closed form) are given for comparison.",
         "1.96 standard errors of the difference of two proportions.", contact_stiffness, Duration::slow},
        {"ImpactLoss", "Dependence of the outcome on parameters",
         fmt::format(
             "Energy that the first impact of MONO takes under several contacts, released from half its "
             "slenderness; and its collapse probability with imperfections under 10 cycles of 3 Hz with ramps of "
             "2 cycles, {} realizations for each contact and amplitude.",
             realizations),
         "1 - e2 of Housner for rigid contacts; none for the probabilities. The checks are that contact by area takes "
         "less than half of that energy, and that its collapse probability is above that of rigid contacts.",
         "the time of an impact within a step of 1/3840 s; intervals of 95 %.", impact_loss, Duration::slow},
    };
}

} // namespace stylobate::verification
