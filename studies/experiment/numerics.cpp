#include "studies/experiment/numerics.hpp"

#include "ensemble/model/outcome.hpp"
#include "ensemble/statics/rigid_step.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

namespace stylobate {

namespace {

struct PilotRun {
    std::vector<std::optional<bool>> collapsed; ///< (pilot) none: invalid
    double step_s = 0;                          ///< sum
    double seconds = 0;
};

PilotRun run_pilot(const Experiment& experiment, const RunOptions& options, const std::vector<std::uint64_t>& indices,
                   Observer& observer)
{
    PilotRun out;
    out.collapsed.resize(indices.size());
    RunPlan plan;
    plan.total = indices.size();
    plan.indices = indices;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        const auto at = std::lower_bound(indices.begin(), indices.end(), r.index) - indices.begin();
        if (o.state != State::invalid)
            out.collapsed[static_cast<std::size_t>(at)] = o.state == State::collapsed;
        out.step_s += r.step_s;
    };
    const auto begin = std::chrono::steady_clock::now();
    run_ensemble(experiment, options, plan, observer);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return out;
}

} // namespace

Study finer(Study study)
{
    const bool rigid = study.contact.form == ContactForm::rigid;
    const double parts = rigid ? 4 : 2;
    if (study.run.step_s)
        study.run.step_s = *study.run.step_s / parts;
    else if (rigid)
        study.run.accuracy = study.run.accuracy.value_or(usual_accuracy) / parts;
    else
        study.run.step_fraction /= parts;
    if (study.chose("run.precision"))
        study.run.precision = Precision::double_;
    if (study.chose("run.step_bound"))
        study.run.step_bound = StepBasis::block;
    if (study.chose("contact.normal_stiffness_n_m2")) {
        study.contact.normal_stiffness_n_m2 *= 10;
        study.contact.tangential_stiffness_n_m *= 10;
    }
    return study;
}

NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, std::uint64_t pilot,
                             Observer& observer)
{
    const std::uint64_t total = experiment.study().total(), count = std::min(pilot, total);
    std::vector<std::uint64_t> indices;
    for (std::uint64_t i = 0; i < count; ++i) // (in this order the product does not overflow)
        indices.push_back(total / count * i + total % count * i / count);
    const PilotRun plain = run_pilot(experiment, options, indices, observer);
    if (observer.stop_requested())
        return {};
    const Experiment fine(finer(experiment.study()), experiment.motions());
    const PilotRun of_fine = run_pilot(fine, options, indices, observer);

    NumericsCheck out;
    out.step_s = plain.step_s / static_cast<double>(count);
    out.seconds = plain.seconds;
    out.finer_seconds = of_fine.seconds;
    double alone = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (!plain.collapsed[i] || !of_fine.collapsed[i])
            continue;
        ++out.realizations;
        out.collapsed += *plain.collapsed[i];
        out.finer += *of_fine.collapsed[i];
        alone += *plain.collapsed[i] != *of_fine.collapsed[i];
    }
    if (out.realizations == 0)
        return out;
    const auto n = static_cast<double>(out.realizations);
    out.difference = (static_cast<double>(out.collapsed) - static_cast<double>(out.finer)) / n;
    // of pairs; if none differs, only an upper bound of one in n follows
    out.sd = std::sqrt(std::max(alone, 1.0) - n * out.difference * out.difference) / n;
    return out;
}

} // namespace stylobate
