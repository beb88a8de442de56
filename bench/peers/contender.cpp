#include "bench/peers/contender.hpp"

#include "bench/peers/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace stylobate::peers {

std::vector<Contender> contenders(const Engine& engine)
{
    std::vector<Contender> all;
    for (std::size_t s = 0; s < engine.settings.size(); ++s) {
        Contender c;
        c.engine = engine.name;
        c.version = engine.version;
        c.planar = engine.planar;
        c.setting = engine.settings[s];
        c.first = s == 0;
        c.customary = engine.customary_step_s;
        for (int k = -8; k <= 28; ++k) // to 1/128 of the customary step
            c.dials.push_back(c.customary * std::pow(2, -0.25 * k));
        c.step_s = [](double step) { return step; };
        c.block = [engine, s](double step, double lean_rad) {
            return BlockRun{engine.make(monolith_scene(lean_rad), s, step), step, engine.ahead_steps};
        };
        c.quarter_period_s = [engine, s](double step) { return quarter_period(engine, s, step); };
        c.overturning_eta = [engine, s](double step) { return overturning_eta(engine, s, step); };
        c.columns = [engine, s](double step, bool shaken, double seconds) {
            return run_columns(engine, s, step, shaken, seconds);
        };
        all.push_back(std::move(c));
    }
    return all;
}

double Errors::worst() const
{
    const double worst = std::max(std::fabs(quarter_period), std::fabs(overturning));
    return std::isfinite(quarter_period) && std::isfinite(overturning) ? worst
                                                                       : std::numeric_limits<double>::infinity();
}

Result scan(const Contender& contender, double seconds, double patience_s)
{
    const double period = exact_quarter_period(), eta = exact_overturning_eta();
    Result result{contender, {}, {}, {}};
    const auto errors_at = [&](double dial) {
        return Errors{dial, contender.quarter_period_s(dial) / period - 1, contender.overturning_eta(dial) / eta - 1};
    };
    const auto timed_at = [&](const Errors& errors) {
        return Timed{errors, contender.step_s(errors.dial), contender.columns(errors.dial, true, seconds),
                     contender.columns(errors.dial, false, seconds)};
    };
    result.customary = timed_at(errors_at(contender.customary));
    std::map<std::size_t, bool> few_stand; // of scanned dials: the few columns that are run at the least
    const auto stand = [&](std::size_t i) {
        const double dial = result.scanned[i].dial;
        if (!few_stand.count(i))
            few_stand[i] = contender.columns(dial, false, 0).moved == 0 && contender.columns(dial, true, 0).moved == 0;
        return few_stand[i];
    };
    std::map<std::size_t, Timed> timed; // of scanned dials from which on columns stand
    const auto reaches = [&](std::size_t i, double target) {
        for (std::size_t finer = i; finer <= i + confirmed_by; ++finer)
            if (!(result.scanned[finer].worst() <= target))
                return false;
        for (std::size_t finer = i; finer <= i + confirmed_by; ++finer)
            if (!stand(finer))
                return false;
        if (!timed.count(i))
            timed[i] = timed_at(result.scanned[i]);
        return timed[i].stands();
    };
    for (const double dial : contender.dials) {
        const double begin = processor_seconds();
        result.scanned.push_back(errors_at(dial));
        const std::size_t n = result.scanned.size();
        bool found = false;
        for (std::size_t t = 0; n > confirmed_by && t < targets.size(); ++t) {
            const std::size_t i = n - 1 - confirmed_by;
            if (!result.reached[t] && reaches(i, targets[t])) {
                result.reached[t] = timed[i];
                found = true;
            }
        }
        if (result.reached.back() || (!found && processor_seconds() - begin > patience_s))
            break;
    }
    return result;
}

const Result* fastest(const std::vector<Result>& results, bool own, std::size_t target)
{
    const Result* best = nullptr;
    for (const Result& r : results)
        if (r.contender.own == own && r.reached[target] &&
            (best == nullptr ||
             r.reached[target]->shaken.realizations_per_second > best->reached[target]->shaken.realizations_per_second))
            best = &r;
    return best;
}

} // namespace stylobate::peers
