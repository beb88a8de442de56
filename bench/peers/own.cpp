/// Stylobate among the others: the library as a study uses it, its step at 0.9 of each realization's safe bound.

#include "bench/peers/contender.hpp"
#include "bench/peers/rocking.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/trials.hpp"
#include "studies/version.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate::peers {

namespace {

constexpr double customary_stiffness = 1e8;
constexpr double customary_step_s = 1.0 / 240; // of programs of rigid bodies

/// The monolith in a contact form, at the step that a study would take; rigid, at the step of the dial.
Realization block(ContactForm form, double dial, double lean)
{
    const bool rigid = form == ContactForm::rigid;
    Realization r = verification::leaned_block(model::mono_stone, rigid ? customary_stiffness : dial, lean, 1);
    r.form = form;
    r.step_s = rigid ? dial : RunSpec{}.step_fraction * step_bound(r).dt_s;
    return r;
}

/// One realization in the engine, on ground at rest.
class OwnWorld final : public World {
public:
    explicit OwnWorld(Realization r)
        : realization_(std::move(r)), study_(model::still(column_seconds)),
          set_(study_, nullptr, kernels(Isa::scalar), realization_)
    {
        set_.load(0, realization_);
    }
    void step(double) override
    {
        set_.advance(done_ % chunk_steps, done_ % chunk_steps + 1);
        ++done_;
    }
    Pose pose(std::size_t body) const override
    {
        const Snapshot now = set_.snapshot(0);
        return {now.x_m[body], now.y_m[body], now.theta_rad[body]};
    }

private:
    Realization realization_;
    Study study_;
    LaneSet set_;
    int done_ = 0;
};

double eta_of(ContactForm form, double dial)
{
    const Realization upright = block(form, dial, 0);
    const double weight = model::gravity * Monolith::width_m / Monolith::height_m;
    try {
        return model::least_overturning(
            model::pulse(ExcitationKind::half_sine),
            [&](double eta) {
                Realization r = upright;
                r.frequency_hz = pulse_rate * model::rocking_rate(model::mono_stone) / (2 * model::pi);
                r.pga_m_s2 = eta * weight;
                return r;
            },
            eta_low, eta_high, eta_tolerance);
    } catch (const std::runtime_error&) { // the ends do not bracket it
        return std::numeric_limits<double>::quiet_NaN();
    }
}

double upright_s(ContactForm form, double dial)
{
    try {
        return verification::upright_time(block(form, dial, Monolith::lean));
    } catch (const std::runtime_error&) { // it does not come upright in time
        return std::numeric_limits<double>::quiet_NaN();
    }
}

Study study_of(ContactForm form, double dial, bool shaken)
{
    if (form != ContactForm::rigid) {
        Study study = column_study(shaken, dial);
        study.contact.form = form;
        return study;
    }
    Study study = column_study(shaken);
    const double friction = study.contact.friction;
    study.contact = {};
    study.contact.form = form;
    study.contact.friction = friction;
    study.run.step_s = dial;
    return study;
}

Columns run_own(ContactForm form, double dial, bool shaken, double seconds)
{
    const Study study = study_of(form, dial, shaken);
    const Experiment experiment(study);
    const RunOptions options{best_isa(), 1};
    Columns columns;
    double spent = 0;
    RunPlan plan;
    const double lanes = kernels(options.isa).lanes;
    plan.total = static_cast<std::uint64_t>(lanes);
    for (int run = 0; run < 3 || spent < seconds; ++run) {
        columns.count = columns.collapsed = columns.moved = 0;
        double simulated = 0;
        plan.sink = [&](const Realization& r, const Outcome& o) {
            ++columns.count;
            const bool fell = o.state == State::collapsed || o.state == State::invalid;
            columns.collapsed += fell;
            // of what still moves at the end the residual is not known: it is at most the largest displacement
            const double off_m = std::isnan(o.residual_top_displacement_m) ? o.peak_top_displacement_m
                                                                           : std::fabs(o.residual_top_displacement_m);
            columns.moved += fell || off_m > 0.02 * r.blocks.back().half_width_m;
            simulated += o.end_time_s;
        };
        Observer quiet;
        const double begin = processor_seconds();
        run_ensemble(experiment, options, plan, quiet);
        const double took = processor_seconds() - begin;
        spent += took;
        columns.realizations_per_second = std::max(columns.realizations_per_second, simulated / column_seconds / took);
        if (run == 0) // it says how many registers fill a quarter of the time
            plan.total = static_cast<std::uint64_t>(
                lanes * std::clamp(std::floor(seconds / 4 / took), 1.0, most_columns / lanes));
    }
    return columns;
}

} // namespace

std::vector<Contender> own_contenders()
{
    std::vector<Contender> all;
    for (const auto& [form, name] : {std::pair{ContactForm::area, "contact by area (as published)"},
                                     {ContactForm::two_corner, "contact at two corners"},
                                     {ContactForm::points, "contact at five points"},
                                     {ContactForm::rigid, "rigid blocks"}}) {
        Contender c;
        c.engine = "Stylobate";
        c.version = code_version();
        c.planar = "planar by itself";
        c.setting = name;
        c.own = true;
        c.first = form == ContactForm::area;
        c.compliant = form != ContactForm::rigid;
        c.customary = c.compliant ? customary_stiffness : customary_step_s;
        // of compliant contacts the step goes with 1 / sqrt(K_N)
        for (int k = -12; k < 40; ++k)
            c.dials.push_back(c.customary * std::pow(2, c.compliant ? 0.5 * k : -0.25 * k));

        const ContactForm f = form;
        c.step_s = [f](double K_n) { return Experiment(study_of(f, K_n, true)).sampler().realization(0).step_s; };
        c.block = [f](double K_n, double lean_rad) {
            Realization r = block(f, K_n, lean_rad / model::slenderness(model::mono_stone));
            const double step_s = r.step_s;
            return BlockRun{std::make_unique<OwnWorld>(std::move(r)), step_s, 0};
        };
        c.quarter_period_s = [f](double K_n) { return upright_s(f, K_n); };
        c.overturning_eta = [f](double K_n) { return eta_of(f, K_n); };
        c.columns = [f](double K_n, bool shaken, double seconds) { return run_own(f, K_n, shaken, seconds); };
        all.push_back(std::move(c));
    }
    return all;
}

} // namespace stylobate::peers
