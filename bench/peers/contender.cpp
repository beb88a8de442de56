#include "bench/peers/contender.hpp"

#include "bench/peers/overturning.hpp"
#include "bench/peers/rocking.hpp"

#include <cmath>

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

} // namespace stylobate::peers
