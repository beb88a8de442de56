#include "studies/measured/calibration/calibration_evidence.hpp"

#include "ensemble/model/observer.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "studies/measured/windows/window_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace stylobate {

namespace {

class HistoryEvidence : public CalibrationEvidence {
public:
    explicit HistoryEvidence(WindowComparison comparison) : comparison_(std::move(comparison))
    {
        for (const WindowPlace& place : comparison_.windows())
            runs_.push_back(place.run);
    }

    const std::vector<std::size_t>& runs() const override { return runs_; }
    std::size_t candidates() const override { return residuals_.size(); }

    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override
    {
        std::vector<ModelVariant> variants;
        for (const Study& study : candidates)
            variants.push_back({study});
        const std::vector<WindowResiduals> z = comparison_.residuals(variants, options, observer);
        if (z.size() != candidates.size())
            return std::nullopt;
        Predictions all;
        for (const WindowResiduals& windows : z) {
            std::vector<double>& one = all.emplace_back();
            for (const std::vector<double>& window : windows)
                one.insert(one.end(), window.begin(), window.end());
        }
        return all;
    }

    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override
    {
        return comparison_.scores(residuals_[candidate], comparison_.fit_scales(residuals_[candidate], used));
    }

    std::vector<double> scores(std::size_t candidate, std::size_t scales_of) const override
    {
        if (!scales_[scales_of])
            scales_[scales_of] = comparison_.fit_scales(residuals_[scales_of]);
        return comparison_.scores(residuals_[candidate], *scales_[scales_of]);
    }

    SimulationCount cost() const override { return comparison_.cost(); }

    bool take(const Predictions& predictions) override
    {
        std::size_t length = 0;
        for (std::size_t w = 0; w < runs_.size(); ++w)
            length += comparison_.seen(w).size();
        for (const std::vector<double>& all : predictions)
            if (all.size() != length)
                return false;
        for (const std::vector<double>& all : predictions) {
            WindowResiduals z;
            auto at = all.begin();
            for (std::size_t w = 0; w < runs_.size(); ++w) {
                const auto end = at + static_cast<std::ptrdiff_t>(comparison_.seen(w).size());
                z.emplace_back(at, end);
                at = end;
            }
            residuals_.push_back(std::move(z));
        }
        scales_.resize(residuals_.size());
        return true;
    }

private:
    WindowComparison comparison_;
    std::vector<std::size_t> runs_;                             ///< (windows)
    std::vector<WindowResiduals> residuals_;                    ///< (candidates)
    mutable std::vector<std::optional<ResidualScales>> scales_; ///< (candidates) once they were asked for
};

class OutcomeEvidence : public CalibrationEvidence {
public:
    OutcomeEvidence(OutcomeTests tests, std::vector<Perturbation> perturbations, std::uint64_t ensemble)
        : tests_(std::move(tests)), perturbations_(std::move(perturbations)), ensemble_(ensemble)
    {
        for (const OutcomeTest& test : tests_.tests)
            runs_.push_back(test.run);
    }

    const std::vector<std::size_t>& runs() const override { return runs_; }
    std::size_t candidates() const override { return scores_.size(); }

    std::optional<Predictions> predict(const std::vector<Study>& candidates, const RunOptions& options,
                                       Observer& observer) override
    {
        Predictions all;
        StopOnly stop_only(observer);
        for (const Study& candidate : candidates) {
            std::vector<double> share; // of falls, by shaking
            for (const TestShaking& shaking : tests_.shakings) {
                Study study = candidate;
                study.kind = StudyKind::single;
                study.surface.reset();
                study.survival.reset();
                study.realizations = ensemble_;
                study.perturbations = perturbations_;
                study.excitation = shaking.excitation;
                study.outcome.follow = Follow::collapse;
                // the same draws for every candidate: what differs is the parameters' doing
                study.seed = candidate.seed + share.size();
                const Experiment experiment(study,
                                            {.record = shaking.motion ? std::optional(*shaking.motion) : std::nullopt});
                RunPlan plan;
                plan.total = ensemble_;
                std::uint64_t collapsed = 0, valid = 0;
                plan.sink = [&](const Realization& r, const Outcome& o) {
                    collapsed += o.state == State::collapsed;
                    valid += o.state != State::invalid;
                    cost_.block_steps += r.free_blocks() * o.steps;
                };
                const Progress p = run_ensemble(experiment, options, plan, stop_only);
                if (p.done < plan.total)
                    return std::nullopt;
                cost_.simulations += plan.total;
                // the mean of the posterior of Jeffreys' prior: a small ensemble never excludes an outcome
                share.push_back((static_cast<double>(collapsed) + 0.5) / (static_cast<double>(valid) + 1));
            }
            std::vector<double> scores;
            for (const OutcomeTest& test : tests_.tests)
                scores.push_back(std::log(test.collapsed ? share[test.shaking] : 1 - share[test.shaking]));
            all.push_back(std::move(scores));
        }
        return all;
    }

    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>&) const override
    {
        return scores_[candidate];
    }
    std::vector<double> scores(std::size_t candidate, std::size_t) const override { return scores_[candidate]; }
    SimulationCount cost() const override { return cost_; }
    bool take(const Predictions& predictions) override
    {
        for (const std::vector<double>& scores : predictions)
            if (scores.size() != runs_.size())
                return false;
        scores_.insert(scores_.end(), predictions.begin(), predictions.end());
        return true;
    }

private:
    const OutcomeTests tests_;
    const std::vector<Perturbation> perturbations_;
    const std::uint64_t ensemble_;
    std::vector<std::size_t> runs_;           ///< (tests)
    std::vector<std::vector<double>> scores_; ///< (candidates x tests)
    SimulationCount cost_;
};

} // namespace

std::unique_ptr<CalibrationEvidence> history_evidence(const Campaign& campaign, const std::vector<std::size_t>& runs,
                                                      double window_s)
{
    WindowComparison comparison(campaign, {window_s, runs, {}});
    if (comparison.windows().empty())
        return nullptr;
    return std::make_unique<HistoryEvidence>(std::move(comparison));
}

std::vector<Perturbation> tolerances(const Specimen& specimen)
{
    constexpr double friction_cov = 0.05;
    std::vector<Perturbation> perturbations;
    const auto add = [&](Quantity quantity, Per per, double sd, double cov) {
        Perturbation p;
        p.quantity = quantity;
        p.per = per;
        p.sd = sd;
        p.cov = cov;
        if (sd > 0 || cov > 0)
            perturbations.push_back(p);
    };
    add(Quantity::friction, Per::joint, 0, friction_cov);
    add(Quantity::drum_width, Per::block, 0, specimen.width_tolerance);
    add(Quantity::drum_offset, Per::block, specimen.placement_tolerance_m, 0);
    add(Quantity::density, Per::block, 0, specimen.mass_tolerance);
    return perturbations;
}

std::unique_ptr<CalibrationEvidence> outcome_evidence(OutcomeTests tests, std::vector<Perturbation> perturbations,
                                                      std::uint64_t ensemble)
{
    if (tests.tests.empty())
        return nullptr;
    return std::make_unique<OutcomeEvidence>(std::move(tests), std::move(perturbations), ensemble);
}

} // namespace stylobate
