#include "bench/work_precision/page.hpp"

#include "ensemble/planar/structure/step_bound.hpp"
#include "ensemble/run/executor.hpp"
#include "io/plots/figure_file.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/trials.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <limits>
#include <stdexcept>

namespace stylobate::work {

const char* name(ContactForm form)
{
    return form == ContactForm::area ? "area" : form == ContactForm::two_corner ? "two_corner" : "points";
}

const char* name(DampingAt damping)
{
    return damping == DampingAt::centroid ? "centroid" : "ends";
}

void draw(const Report& report, const std::filesystem::path& png)
{
    const verification::PictureAxis cost{"block-steps per simulated second", true, 0, 0};
    write_figures(
        {verification::curves(cost, {"error of the quarter period", true, 0, 0}, report.quarter_period),
         verification::curves(cost, {"error of the overturning amplitude", true, 0, 0}, report.overturning),
         verification::curves(cost, {"collapse probability less that of a fine step", false, 0, 0}, report.collapse)},
        3, "", "", png, {2400, 1000}, 1.8);
}

namespace {

constexpr double lean = 0.5, pulse_rate = 4;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Realization monolith(const Setting& s, double part)
{
    const model::Bed bed{s.K_n, s.xi, 5, false};
    Realization r = model::single(model::mono_stone, bed, 1, 2 * model::mono_stone.width);
    r.initial_tilt_rad = part * model::slenderness(model::mono_stone);
    r.form = s.form;
    r.joints[0].tangential_stiffness_n_m *= s.shear;
    r.joints[0].tangential_damping_n_s_m *= std::sqrt(s.shear); // the same ratio
    if (s.form == ContactForm::area && s.damping == DampingAt::ends)
        r.joints[0].mechanisms.face_damping = 1;
    const StepBound bound = step_bound(r);
    r.step_s = s.step_fraction * (s.basis == StepBasis::structure ? structure_step_bound(r, bound) : bound).dt_s;
    return r;
}

verification::RigidBlock rigid()
{
    return verification::rigid_block(model::mono_stone.width, model::mono_stone.height);
}

/// The specimen under 10 cycles of 3 Hz.
Study shaken_specimen(const Setting& s)
{
    Study study = rocking_column(7);
    study.contact.form = s.form;
    study.contact.damping = s.damping;
    study.run.step_bound = s.basis;
    study.contact.normal_stiffness_n_m2 = s.K_n;
    study.contact.tangential_stiffness_n_m = s.K_n * 0.048 * s.shear;
    study.contact.normal_damping_ratio = study.contact.tangential_damping_ratio = s.xi;
    study.excitation.frequency_hz = 3;
    study.excitation.cycles = 10;
    study.run.step_fraction = s.step_fraction;
    Perturbation width;
    width.quantity = Quantity::drum_width;
    width.per = Per::block;
    width.sd = 2e-4;
    study.perturbations.push_back(width);
    return study;
}

} // namespace

double monolith_cost(const Setting& setting)
{
    return 1 / monolith(setting, 0).step_s;
}

double quarter_period_s(const Setting& setting)
{
    try {
        return verification::upright_time(monolith(setting, lean));
    } catch (const std::runtime_error&) { // it does not come upright in time
        return nothing;
    }
}

double exact_quarter_period_s()
{
    const auto block = rigid();
    return static_cast<double>(verification::quarter_period(block, lean * block.alpha));
}

double overturning_eta(const Setting& setting)
{
    const Realization upright = monolith(setting, 0);
    const double weight = model::gravity * model::mono_stone.width / model::mono_stone.height;
    try {
        return model::least_overturning(
            model::pulse(ExcitationKind::half_sine),
            [&](double eta) {
                Realization r = upright;
                r.frequency_hz = pulse_rate * model::rocking_rate(model::mono_stone) / (2 * model::pi);
                r.pga_m_s2 = eta * weight;
                return r;
            },
            1.5, 4.5, 1e-5);
    } catch (const std::runtime_error&) { // the ends do not bracket it
        return nothing;
    }
}

double exact_overturning_eta()
{
    return verification::half_sine_edge(rigid(), pulse_rate);
}

double Ensemble::probability() const
{
    double sum = 0;
    for (const char fell : collapsed)
        sum += fell;
    return sum / static_cast<double>(collapsed.size());
}

double specimen_cost(const Setting& setting)
{
    Study study = shaken_specimen(setting);
    study.excitation.pga_m_s2 = 1;
    study.perturbations.clear();
    return 6 / Sampler(study, nullptr).realization(0).step_s;
}

Ensemble collapses(const Setting& setting, double pga_m_s2, std::uint64_t realizations)
{
    Study study = shaken_specimen(setting);
    study.realizations = realizations;
    study.excitation.pga_m_s2 = pga_m_s2;

    Ensemble all;
    all.collapsed.resize(realizations);
    double simulated = 0, steps = 0;
    RunPlan plan;
    plan.total = realizations;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        all.collapsed[r.index] = o.state == State::collapsed;
        all.invalid += o.state == State::invalid;
        all.worst_residual = std::max(all.worst_residual, std::fabs(o.energy_residual));
        simulated += o.end_time_s;
        steps += static_cast<double>(o.steps);
    };
    Observer quiet;
    run_ensemble(Experiment(study), {best_isa(), 1}, plan, quiet);
    all.cost = 6 * steps / simulated;
    return all;
}

double steep_place(const Setting& setting)
{
    double low = 1, high = 9, best = 0, least = 1;
    for (int i = 0; i < 10; ++i) {
        const double middle = (low + high) / 2;
        const double excess = collapses(setting, middle, 64).probability() - 0.5;
        if (std::fabs(excess) < least) { // it may not rise everywhere
            least = std::fabs(excess);
            best = middle;
        }
        (excess < 0 ? low : high) = middle;
    }
    return best;
}

std::uint64_t differing(const Ensemble& a, const Ensemble& b)
{
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.collapsed.size(); ++i)
        count += a.collapsed[i] != b.collapsed[i];
    return count;
}

} // namespace stylobate::work
