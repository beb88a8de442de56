#include "studies/evidence/measured/boulders/boulder_model.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace stylobate::measured {

namespace {

constexpr double gravity = 9.81;

std::vector<bool> fell(const std::vector<BoulderTest>& tests, std::size_t boulder)
{
    std::vector<bool> falls;
    for (const BoulderTest& test : tests)
        falls.push_back(test.fell[boulder]);
    return falls;
}

} // namespace

double BoulderModel::rocking_rate_rad_s() const
{
    return std::sqrt(0.75 * gravity / (0.5 * height_m * std::hypot(1, slenderness)));
}

Study boulder_study(const BoulderModel& model, std::uint64_t realizations)
{
    Study study;
    const double width = model.slenderness * model.height_m;
    study.realizations = realizations;
    study.structure = equal_column(1, 0, width, model.height_m, boulder_depth_m, boulder_mass_kg);
    study.contact.normal_stiffness_n_m2 = model.normal_stiffness_n_m2;
    study.contact.tangential_stiffness_n_m = model.normal_stiffness_n_m2 * width;
    study.contact.normal_damping_ratio = model.damping_ratio;
    study.contact.tangential_damping_ratio = model.damping_ratio;
    study.contact.damping = model.ends ? DampingAt::ends : DampingAt::centroid;
    study.contact.friction = boulder_friction;
    study.excitation.kind = ExcitationKind::table;
    study.excitation.file = "motion.csv"; // what --set excitation.file replaces
    if (model.eccentricity_m != 0) {
        MechanismSpec eccentricity = neutral_spec(Mechanism::eccentricity, boulder_friction);
        eccentricity.values[0] = model.eccentricity_m;
        study.mechanisms.push_back(eccentricity);
    }
    if (model.slenderness_spread > 0) {
        Perturbation width_spread;
        width_spread.quantity = Quantity::drum_width;
        width_spread.distribution = DistributionKind::lognormal;
        width_spread.sigma_ln = model.slenderness_spread;
        study.perturbations.push_back(width_spread);
    }
    // beyond balance, but well before its side hits the ground
    study.outcome.collapse_height_fraction = 0.85;
    study.text = study_text(study);
    return study;
}

Ends ensemble_ends(const Study& study, const Motion& motion, const RunOptions& run)
{
    Ends ends;
    if (motion.empty())
        return ends;
    const Experiment experiment(study, {.record = motion});
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization&, const Outcome& outcome) { ends.add(outcome); };
    Observer nobody;
    run_ensemble(experiment, run, plan, nobody);
    if (ends.set_aside == ends.total)
        throw InputError(fmt::format("{}: every realization is invalid", motion.source));
    return ends;
}

double restitution(const BoulderModel& model)
{
    Study study = boulder_study(model);
    study.excitation = {};
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = 20 / model.rocking_rate_rad_s();
    study.initial.tilt_rad = 0.5 * std::atan(model.slenderness);
    return verification::impact_restitution(Sampler(study, nullptr).realization(0), study.contact, 0);
}

BoulderTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run)
{
    const auto study = [&](double slenderness) {
        BoulderModel model = variant;
        model.slenderness = slenderness;
        return boulder_study(model);
    };
    const auto motion = [&](std::size_t i) { return tests[i].motion; };
    return {variant, simulated_falls(equal_ratios(0.1, 0.45, 24), tests.size(), motion, study, run)};
}

BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const BoulderTable& table : tables)
        for (const double spread : spreads)
            for (const double slip : slips) {
                BoulderFit now;
                now.slip = slip;
                for (std::size_t s = 0; s < boulders; ++s) {
                    const LikelySlenderness likely = likely_slenderness(table.falls, fell(tests, s), use, spread, slip);
                    now.model[s] = table.variant;
                    now.model[s].slenderness = table.falls.slenderness[likely.median];
                    now.model[s].slenderness_spread = spread;
                    now.log_likelihood += likely.log_likelihood;
                }
                if (now.log_likelihood > best.log_likelihood)
                    best = now;
            }
    return best;
}

} // namespace stylobate::measured
