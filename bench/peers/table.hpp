#pragma once
/// What was found, as a table for people (Markdown) and as JSON.

#include "bench/peers/collapse/convergence.hpp"
#include "bench/peers/contender.hpp"
#include "studies/report/json.hpp"

#include <string>

namespace stylobate::peers {

/// Each engine's customary setting, and at each target its fastest one (of Stylobate all contact forms); then the
/// ratios.
std::string markdown(const std::vector<Result>& results, const std::string& processor);

/// All settings with all that was measured.
std::string json(const std::vector<Result>& results, const std::string& processor);

// ---- parts of such tables ----

/// Three digits, without an exponent; a dash for 0.
std::string rate_text(double rate);
/// Of `targets`, as "0.2 %".
std::string target_text(std::size_t target);
/// The engine, of others with its version.
std::string engine_text(const Contender& contender);
/// Member of the JSON for its dial, with the unit.
std::string dial_key(const Contender& contender);
Json json_of(const Columns& columns);
/// Begins what a test found: what ran, and where.
Json json_head(const std::string& processor);

// What came out of the collapse probabilities, as tables for people (Markdown) and as JSON.

/// The limits and how they compare with that of rigid blocks; cost at equal error against each scheme's own limit; and
/// all errors.
std::string collapse_markdown(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                              const std::string& processor);

std::string collapse_json(const std::vector<CollapseScan>& scans, const std::vector<Cell>& cells,
                          const std::string& processor);

} // namespace stylobate::peers
