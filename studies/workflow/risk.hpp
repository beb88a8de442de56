#pragma once
/// Risk over years: of a fragility study, or of what the variants of a comparison change.

#include "io/tables/table.hpp"
#include "studies/decisions/risk/risk.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"
#include "studies/workflow/workflow.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stylobate {

/// An estimate of one study, or of a comparison.
using AnyRisk = std::variant<Risk, RiskChange>;

struct RiskRequest {
    std::string file;                    ///< results of a fragility study, or a comparison
    std::vector<std::string> hazard{};   ///< files, or a power law
    std::optional<std::string> site{};   ///< of several in the hazard; nullopt: there is one
    std::vector<std::string> settings{}; ///< only the present path of the study's record
    std::optional<std::string> state{};  ///< one limit state; nullopt: all
    std::vector<double> years{};         ///< none: 50 and 100
    double level = 0.9;                  ///< of intervals
    double most_outside = 0.25;          ///< largest share of a frequency from outside of the ranges of runs and hazard
    std::uint64_t sequences = 0;         ///< simulated histories with the damage carried along
    std::optional<double> threshold{};   ///< of their earthquakes [SI unit of the measure]; none: by the results
    std::optional<double> pause_s{};     ///< of rest between earthquakes; none: as long as the structure needs
    std::uint64_t seed = 1;              ///< of the histories
    std::optional<std::string> output{}; ///< file of the estimate; none: it is not written
    bool force = false;                  ///< replace a file that is there
};

/// @returns nothing if the observer has asked to stop: nothing was written
/// @throws InputError if the file has no risk, or if the hazard cannot be read
std::optional<AnyRisk> estimate_risk(const RiskRequest& request, const Machine& machine, WorkObserver& observer);

/// @name Of either estimate.
/// @{
AnyRisk read_any_risk(const std::filesystem::path& file);
void write_risk(const AnyRisk& risk, const std::filesystem::path& file);
std::vector<Table> tables_of(const AnyRisk& risk);
std::vector<std::pair<std::string, std::string>> risk_csv(const AnyRisk& risk);
std::string risk_text(const AnyRisk& risk);
Json risk_json(const AnyRisk& risk);
Document risk_page(const AnyRisk& risk, const std::string& file, const std::optional<std::string>& title);
/// @param state nullopt: the principal one   @param title nullopt: the usual one
void plot_risk(const AnyRisk& risk, const std::optional<std::string>& state, const std::optional<std::string>& title,
               const std::filesystem::path& picture);
/// A row for each limit state, of a comparison for each of each variant: annual frequencies and probabilities over
/// the years, with their intervals.
Table risk_rows(const AnyRisk& risk);
/// @}

} // namespace stylobate
