#pragma once
/// A risk estimate in words and as JSON.

#include "studies/decisions/risk/risk.hpp"
#include "studies/report/json.hpp"

#include <string>

namespace stylobate {

/// Lines for a terminal: each limit state with its frequency and probabilities, where the principal one's frequency
/// comes from, and what a reader must know.
std::string risk_text(const Risk& risk);

/// All of it but the fragility's points.
Json risk_json(const Risk& risk);

/// "0.31 % (0.22 to 0.45)" of a probability or a share.
std::string percent_text(double value, const Limits& limits);

/// The same of the probability over years that a frequency gives.
std::string over_text(const RiskNumber& frequency, double years);

/// Head of the column of the mean hazard, "in 100 years, mean hazard", and a limit state's probability there, "4.83 %";
/// a dash without fractiles.
std::string mean_hazard_head(const Risk& risk);
std::string mean_hazard_text(const Risk& risk, const StateRisk& state);

/// "hazard.csv at 23.7,37.9".
std::string hazard_text(const HazardModel& hazard);

/// "9e-05 to 0.02", or "at least 9e-05" where there is no upper one.
std::string bounds_text(const Limits& bounds);

/// "3.1e-05 (2.1e-05 to 4.4e-05)".
std::string frequency_text(const RiskNumber& number);

/// Why a state has its form of the fragility, and what the other one would give.
std::string form_text(const Risk& risk, const StateRisk& state);

/// "from 0.5 to 0.6", "below 0.5", "above 3".
std::string range_text(const FrequencyPart& part);

} // namespace stylobate
