#pragma once
/// A surface with twins in words, as JSON, as a section of a page, as tables and as pictures.

#include "studies/kinds/replicas/twins.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace stylobate {

/// Lines for a terminal.
std::string twins_text(const Twins& twins);
Json twins_json(const Twins& twins);

/// The section of a result's page. @param verdicts, growth put these pictures into the page
void twins_section(const Twins& twins, HtmlPage& page, const std::function<void()>& verdicts,
                   const std::function<void()>& growth);

/// `twins.csv`: each cell and kind.
std::string twins_csv(const Twins& twins);
/// `predictability.csv`: each cell and followed move.
std::string predictability_csv(const Twins& twins);

/// Predictability of the verdict, a map for each kind of twin.
void plot_discordance(const Twins& twins, const std::string& title, const std::filesystem::path& png);
/// Exponents and horizons. @throws InputError if no pair was followed
void plot_growth(const Twins& twins, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate
