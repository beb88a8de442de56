#pragma once
/// A surface with replicas in words, as JSON, as a section of a page, as tables and as pictures.

#include "studies/kinds/replicas/replicas.hpp"
#include "studies/report/html.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace stylobate {

/// Lines for a terminal.
std::string replicas_text(const Replicas& replicas);
Json replicas_json(const Replicas& replicas);

/// The section of a result's page. @param verdicts, growth put these pictures into the page
void replicas_section(const Replicas& replicas, HtmlPage& page, const std::function<void()>& verdicts,
                      const std::function<void()>& growth);

/// `replicas.csv`: each cell and kind.
std::string replicas_csv(const Replicas& replicas);
/// `predictability.csv`: each cell and followed move.
std::string predictability_csv(const Replicas& replicas);

/// Predictability of the verdict, a map for each kind of replica.
void plot_discordance(const Replicas& replicas, const std::string& title, const std::filesystem::path& png);
/// Exponents and horizons. @throws InputError if no pair was followed
void plot_growth(const Replicas& replicas, const std::string& title, const std::filesystem::path& png);

} // namespace stylobate
