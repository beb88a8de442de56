#pragma once
/// What drums in space do in every engine, as tables for people (Markdown) and as JSON.

#include "bench/peers/space/space_trials.hpp"

#include <string>
#include <vector>

namespace stylobate::peers {

/// An error, or a way as a part of its length, up to which a trial counts as passed.
inline constexpr double space_target = 0.01;

/// A contender at one dial.
struct SpaceResult {
    SpaceContender contender;
    double dial = 0;
    double step_s = 0;                       ///< of the column
    double cost_s = 0;                       ///< processor time for one simulated second of the column
    std::vector<std::vector<double>> errors; ///< (trials, their columns)
};

/// A contender at all of its dials.
std::vector<SpaceResult> run_in_space(const SpaceContender& contender);

/// Whether all errors of a trial are within the target.
bool passes(const SpaceResult& result, std::size_t trial);

/// The cheapest result of an engine that passes all of these trials; null: none.
const SpaceResult* cheapest(const std::vector<SpaceResult>& results, const std::string& engine,
                            const std::vector<std::size_t>& trials);

/// What each engine passes, at which cost; then all errors.
std::string space_markdown(const std::vector<SpaceResult>& results, const std::string& processor);
std::string space_json(const std::vector<SpaceResult>& results, const std::string& processor);

} // namespace stylobate::peers
