#pragma once
/// Who takes part: an engine in one setting of its solver, with one dial that makes it more accurate and slower. Of the
/// others and of Stylobate's rigid blocks the dial is the time step; of its compliant contacts, whose error is that of
/// the compliance, it is K_N.

#include "bench/peers/column.hpp"

namespace stylobate::peers {

/// The monolith in motion.
struct BlockRun {
    std::unique_ptr<World> world; ///< bodies: ground, monolith
    double step_s = 0;
    double ahead_steps = 0; ///< of its clock (`Engine::ahead_steps`)
};

struct Contender {
    std::string engine, version, planar, setting;
    bool own = false;          ///< Stylobate
    bool compliant = false;    ///< its dial is K_N
    bool first = true;         ///< the engine's customary setting
    std::vector<double> dials; ///< coarse to fine, each about 2^(-1/4) as fast as the one before
    double customary = 0;      ///< one of them
    std::function<double(double dial)> step_s;
    std::function<BlockRun(double dial, double lean_rad)> block; ///< leaned and let go, on ground at rest
    std::function<double(double dial)> quarter_period_s;
    std::function<double(double dial)> overturning_eta;
    std::function<Columns(double dial, bool shaken, double seconds)> columns;
};

/// An engine in all of its settings.
std::vector<Contender> contenders(const Engine& engine);

/// Stylobate in all contact forms, one thread, widest instruction set.
std::vector<Contender> own_contenders();

} // namespace stylobate::peers
