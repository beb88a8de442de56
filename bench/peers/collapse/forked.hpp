#pragma once
/// Draws on several cores: in processes and not in threads, because not every engine may be used by several threads.

#include "bench/peers/collapse/cell_contender.hpp"

namespace stylobate::peers {

/// The draws begin .. end - 1, in equal parts in `processes` processes (1: in this one).
/// @pre no other thread runs
/// @throws std::runtime_error if a process ends without a result
Draws run_forked(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end,
                 int processes);

} // namespace stylobate::peers
