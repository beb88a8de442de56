#pragma once
/// What came out of the collapse probabilities, as tables for people (Markdown) and as JSON.

#include "bench/peers/collapse/convergence.hpp"

namespace stylobate::peers {

/// The limits and how they compare with that of rigid blocks; cost at equal error against each scheme's own limit; and
/// all errors.
std::string collapse_markdown(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                              const std::string& processor);

std::string collapse_json(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                          const std::string& processor);

} // namespace stylobate::peers
