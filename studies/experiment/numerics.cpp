#include "studies/experiment/numerics.hpp"

#include "ensemble/model/outcome.hpp"
#include "ensemble/planar/structure/scales.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

std::vector<std::uint64_t> spread_evenly(std::uint64_t count, std::uint64_t total)
{
    count = std::min(count, total);
    std::vector<std::uint64_t> indices;
    for (std::uint64_t i = 0; i < count; ++i) // (in this order the product does not overflow)
        indices.push_back(total / count * i + total % count * i / count);
    return indices;
}

PartRun run_part(const Experiment& experiment, const RunOptions& options, std::vector<std::uint64_t> indices,
                 Observer& observer)
{
    PartRun out;
    out.indices = std::move(indices);
    out.collapsed.resize(out.indices.size());
    RunPlan plan;
    plan.total = out.indices.size();
    plan.indices = out.indices;
    plan.sink = [&](const Realization& r, const Outcome& o) {
        const auto at = std::lower_bound(out.indices.begin(), out.indices.end(), r.index) - out.indices.begin();
        if (o.state != State::invalid)
            out.collapsed[static_cast<std::size_t>(at)] = o.state == State::collapsed;
        out.step_s += r.step_s;
    };
    const auto begin = std::chrono::steady_clock::now();
    run_ensemble(experiment, options, plan, observer);
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return out;
}

PairedCollapses paired_collapses(const PartRun& first, const PartRun& second)
{
    PairedCollapses out;
    for (std::size_t i = 0; i < second.indices.size(); ++i) {
        const auto at = std::lower_bound(first.indices.begin(), first.indices.end(), second.indices[i]);
        const std::optional<bool>& one = first.collapsed[static_cast<std::size_t>(at - first.indices.begin())];
        const std::optional<bool>& other = second.collapsed[i];
        if (!one || !other)
            continue;
        ++out.realizations;
        out.first += *one;
        out.second += *other;
        out.differ += *one != *other;
    }
    if (out.realizations == 0)
        return out;
    const auto n = static_cast<double>(out.realizations);
    out.difference = (static_cast<double>(out.first) - static_cast<double>(out.second)) / n;
    // of pairs; if none differs, only an upper bound of one in n follows
    out.sd = std::sqrt(std::max(static_cast<double>(out.differ), 1.0) - n * out.difference * out.difference) / n;
    return out;
}

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

NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, const PartRun& plain,
                             Observer& observer)
{
    const Experiment fine(finer(experiment.study()), experiment.motions());
    const PartRun of_fine = run_part(fine, options, plain.indices, observer);
    if (observer.stop_requested())
        return {};
    const PairedCollapses pairs = paired_collapses(plain, of_fine);
    return {.realizations = pairs.realizations,
            .collapsed = pairs.first,
            .finer = pairs.second,
            .difference = pairs.difference,
            .sd = pairs.sd,
            .step_s = plain.step_s / static_cast<double>(plain.indices.size()),
            .seconds = plain.seconds,
            .finer_seconds = of_fine.seconds};
}

NumericsCheck check_numerics(const Experiment& experiment, const RunOptions& options, std::uint64_t pilot,
                             Observer& observer)
{
    const PartRun plain = run_part(experiment, options, spread_evenly(pilot, experiment.study().total()), observer);
    return observer.stop_requested() ? NumericsCheck{} : check_numerics(experiment, options, plain, observer);
}

} // namespace stylobate
