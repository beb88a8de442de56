#include "studies/evidence/measured/boulders/boulder_model.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/study/study_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace stylobate::measured {

namespace {

constexpr double gravity = 9.81;

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
    const double alpha = std::atan(model.slenderness);
    study.initial.tilt_rad = 0.5 * alpha;
    const Realization r = Sampler(study, nullptr).realization(0);
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    double lowest = 0;
    while (!set.outcome(0)) {
        for (int k = 0; k < chunk_steps; ++k) {
            set.advance(k, k + 1);
            const double now = set.snapshot(0).theta_rad[0];
            if (lowest < -1e-3 * alpha && now > lowest) {
                const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
                return std::sqrt(energy(-lowest) / energy(r.initial_tilt_rad));
            }
            lowest = std::min(lowest, now);
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

} // namespace stylobate::measured
