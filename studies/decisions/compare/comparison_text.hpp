#pragma once
/// A comparison as lines for a terminal, as JSON, as a table of all its places, as a page and as pictures; and what it
/// comes to, for a reader who decides about a monument: the answer, what it depends on, and what would change it.

#include "io/tables/table.hpp"
#include "studies/decisions/compare/comparison.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// For a terminal: what stands on the page too, without its pictures, definitions and studies.
std::string comparison_text(const Comparison& comparison);
Json comparison_json(const Comparison& comparison);
/// A row for each variant, limit state and cell, and for all cells together.
Table comparison_rows(const Comparison& comparison);

/// "undecided: -0.7 to +4.0 percentage points", "better".
std::string verdict_text(const LimitComparison& limit, const PlaceComparison& place);
/// The interval of a difference: "-0.7 to +4.0 percentage points".
std::string points_text(const PlaceComparison& place);
/// "0.231 (0.205 to 0.259)"
std::string share_text(const Share& share);
/// "-0.0430 (-0.0600 to -0.0270)"
std::string difference_text(const PlaceComparison& place);
/// "1.20 (1.12 to 1.29; steps x 1.1)", "at least 3.1 (2.9 to 3.3; steps x 1.1)", "not in this range" where no intensity
/// separates the two.
std::string capacity_text(const CapacityRatio& ratio);

/// What names of cells mean: "Benjamini-Hochberg, false names at most 5 %".
std::string adjustment_text(const Comparison& comparison);
/// How draws and motions are common by construction, in a sentence.
std::string common_text(const Comparison& comparison);

/// "With dowels the probability of collapse is 0.231 instead of 0.274 over the 64 cells of the study: a
/// difference of -0.043 [-0.060, -0.027] at 95 %. It helps." Of the first limit state.
std::string answer_text(const Comparison& comparison, const VariantComparison& variant);

/// Where it harms, with the number of cells and the worst one; nullopt where no cell is named.
std::optional<std::string> harm_text(const Comparison& comparison, const VariantComparison& variant);

/// What would change the answer: the other sign, or no difference shown, in a third of a quantity; cells in which it
/// harms though it helps over all, or the other way round; what more pairs would decide. At least one sentence.
std::vector<std::string> what_would_change_it(const Comparison& comparison, const VariantComparison& variant);

/// "Comparison with A column".
std::string comparison_title(const Comparison& comparison);

/// Sections of the page and of the text for a terminal: the answers, with conventions and what the model leaves out;
/// the differences by thirds of each drawn quantity, and what would change the answer; all limit states with their
/// discordant pairs, and capacities; cells that are named, at most `most` in each direction; common draws and notes.
/// @pre each variant has a limit state
/// @{
void add_answer(const Comparison& comparison, Document& page);
void add_dependence(const Comparison& comparison, Document& page);
void add_changes(const Comparison& comparison, Document& page);
void add_named(const Comparison& comparison, Document& page, std::size_t most);
void add_common(const Comparison& comparison, Document& page);
/// @}

/// For a reader who decides: the answer in a sentence with its interval, the structure, what the answer depends on and
/// what would change it; then what changes, where it harms, what is common, the studies and the commands. Where the map
/// cannot be drawn the page has a message.
/// @param file for names   @param title nullopt: by the base
/// @param warnings receives a line for a picture that could not be drawn
Document comparison_page(const Comparison& comparison, const std::string& file, const std::optional<std::string>& title,
                         std::vector<std::string>& warnings);

/// Of a surface: maps of the difference, one for each variant, with the cells that are named worse or better in full
/// colours, and the lines of the base's probability. Of a fragility study: the shares of base and variants by stripe.
/// @param limit name of the limit state; nullopt: the first one
/// @param title nullopt: by the comparison
/// @throws InputError if there is no such limit state, if there is nothing to draw (one cell), and as the plots do
void comparison_picture(const Comparison& comparison, const std::optional<std::string>& limit,
                        const std::optional<std::string>& title, const std::filesystem::path& file);

/// The limit state of that name in each variant. @param limit nullopt: the first one
/// @throws InputError with those that there are
const LimitComparison& limit_of(const VariantComparison& variant, const std::optional<std::string>& limit);

} // namespace stylobate
