/// What the outcome of an ensemble depends on, and on what not.

#include "ensemble/engine/executor.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/tables/markdown.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/stack_vibration.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr double frequency_hz = 3;
constexpr std::uint64_t realizations = 400;

/// SPEC under a harmonic of 3 Hz; friction, widths, offsets, the base's level and the phase differ.
Study shaken_specimen(double K_n, double pga, double step_fraction)
{
    Study study;
    study.realizations = realizations;
    study.structure = equal_column(7, 1, 0.048, 0.029, 0.048, 0.1355);
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

std::uint64_t collapses(double K_n, double pga, double step_fraction = 0.9)
{
    const Experiment experiment(shaken_specimen(K_n, pga, step_fraction));
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
    for (double K : at) {
        const std::uint64_t n = collapses(K, pga);
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
        const auto full = static_cast<double>(collapses(K, pga)),
                   quarter = static_cast<double>(collapses(K, pga, 0.225));
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
                          curves({"K_N [N/m2]", true, 0, 0}, {"collapse probability", false, 0, 1.05},
                                 {{"collapse probability", at, probability, false, low, high},
                                  {"f1", at, first, true, {}, {}, -1, true}},
                                 "top center", {"f1 [Hz]", true, 0, 0})});
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
    };
}

} // namespace stylobate::verification
