#pragma once
/// Test (d): who computes collapse probabilities, each on the same draws of the same cells (bench/rocking_cells.hpp).

#include "bench/peers/engine.hpp"
#include "bench/rocking_cells.hpp"
#include "ensemble/realization/realization.hpp"

#include <cstdint>

namespace stylobate::peers {

/// What became of consecutive draws.
struct Draws {
    std::vector<char> collapsed; ///< (draws) 1: collapsed
    double simulated_s = 0;      ///< in all; one that collapses is over
    double processor_s = 0;
};

/// One model in one setting of its solver, whose only dial is the step. Levels halve it.
struct CellContender {
    std::string engine, version, setting;
    bool own = false;   ///< Stylobate
    bool rigid = false; ///< of Stylobate the form of rigid blocks
    int levels = 0;     ///< as many steps as may be tried
    std::function<double(const Cell& cell, int level)> step_s;
    std::function<Draws(const Cell& cell, int level, std::uint64_t begin, std::uint64_t end)> run;
};

/// An engine: the setting with which the impacts of a block converge fastest (test (c)), or all.
std::vector<CellContender> cell_contenders(const Engine& engine, bool all_settings);

/// Rigid blocks at the same steps as the engines; compliant contacts of given stiffness and damping ratio, whose first
/// step is that of a study.
std::vector<CellContender> own_cell_contenders();

/// Steps [s] of rigid blocks: 1/120, halved; longer ones resolve no period of 6 Hz.
double halved_step(int level);

/// One draw in an engine: whether it collapses by the criterion of this project's own realizations (`LimitStates`).
/// @return collapsed, and the simulated time [s]
struct DrawEnd {
    bool collapsed = false;
    double time_s = 0;
};
DrawEnd run_draw(const Engine& engine, std::size_t setting, double step_s, const Study& study, const Realization& draw);

} // namespace stylobate::peers
