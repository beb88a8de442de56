#pragma once
/// Risk estimates, of one structure and of a comparison, in words, as JSON, as pages and as pictures; and what they
/// come to, for a reader who decides about a monument.

#include "studies/decisions/risk/risk.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// For a terminal: what stands on the page too, without its pictures and the study.
std::string risk_text(const Risk& risk);

/// Sections of the page and of the text for a terminal: the answer with its grounds, conventions and what the model
/// leaves out; the table of limit states; which intensities contribute to the principal one; histories, and notes.
/// @{
void add_answer(const Risk& risk, Document& page);
void add_result(const Risk& risk, Document& page);
void add_parts(const Risk& risk, Document& page);
void add_notes(const Risk& risk, Document& page);
/// @}

/// All of it but the fragility's points.
Json risk_json(const Risk& risk);

/// "0.31 % (0.22 to 0.45)" of a probability or a share.
std::string percent_text(double value, const Limits& limits);

/// The probability over years that a frequency gives, with its interval.
std::string over_text(const RiskNumber& frequency, double years);

/// What every risk estimate assumes.
inline constexpr char as_new_text[] = "Each earthquake meets the structure as new; years are of a Poisson process.";

/// "hazard.csv at 23.7,37.9".
std::string hazard_text(const HazardModel& hazard);

/// "9e-05 to 0.02", or "at least 9e-05" where there is no upper one.
std::string bounds_text(const Limits& bounds);

/// "3.1e-05 (2.1e-05 to 4.4e-05)".
std::string frequency_text(const RiskNumber& number);

/// "In 100 years the limit state 'a block falls' is reached with a probability of 3.55 % (1.31 to 9.84; 90 % interval),
/// on average once in 2770 years. By the mean hazard, the mean over its fractiles, the probability is 4.02 %." Of the
/// principal limit state; where it is not determined, between which bounds.
std::string risk_answer(const Risk& risk);

/// Which intensities contribute, what makes the interval wide, and what would narrow it.
std::string risk_grounds(const Risk& risk);

/// For a terminal: what stands on the page too, without its figures.
std::string risk_text(const RiskChange& change);
Json risk_json(const RiskChange& change);

/// "In 100 years the limit state 'a block falls' is reached with a probability of 11 % (5 to 24) in column and of 8 %
/// (4 to 18) with dowels: a change of -3 (-6 to -1) percentage points, 90 % interval. The risk is lower."
std::string risk_change_answer(const RiskChange& change, const VariantChange& variant);

/// @param file of the estimate, for its name   @param title instead of the comparison's; nullopt: that one
Document risk_page(const RiskChange& change, const std::string& file, const std::optional<std::string>& title);

/// What `plot_risk` draws, as figures of the page: the same values.
void add_change_figures(const RiskChange& change, Document& page);

/// Shares of the stripes of base and variants, and the change of the probability over the last of the years.
/// @param state a limit state; nullopt: the principal one   @throws InputError if it is none, or is not determined
void plot_risk(const RiskChange& change, const std::optional<std::string>& state,
               const std::optional<std::string>& title, const std::filesystem::path& picture);

/// @param file of the estimate, for its name   @param title instead of the study's; nullopt: that one
Document risk_page(const Risk& risk, const std::string& file, const std::optional<std::string>& title);

/// @param state a limit state; nullopt: the principal one   @throws InputError if it is none, or if it cannot be drawn
void plot_risk(const Risk& risk, const std::optional<std::string>& state, const std::optional<std::string>& title,
               const std::filesystem::path& picture);

} // namespace stylobate
