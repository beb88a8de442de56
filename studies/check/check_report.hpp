#pragma once
/// What a check of a study has found: as data, as text, as JSON, and the drawing of the structure.

#include "studies/check/law_share.hpp"
#include "studies/check/run_cost.hpp"
#include "studies/check/weak_spots.hpp"
#include "studies/experiment/numerics.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct CheckReport {
    std::string file; ///< of the study
    Study study;
    RunOptions run;
    std::vector<std::string> warnings{};
    std::optional<std::string> notice{};  ///< of the kind
    std::optional<std::string> picture{}; ///< file of the drawing
    RunSize size{};
    std::optional<Trial> trial{};
    std::optional<RunTime> time{};
    double memory_bytes = 0;
    std::optional<std::uint64_t> counted{}; ///< `counted_trials`
    FreeMotion free{};
    std::vector<WeakSpot> weak{};
    std::vector<std::string> not_looked_for{}; ///< sentences
    std::optional<std::string> why_no_pilot{}; ///< nullopt: there is a pilot
    std::optional<NumericsCheck> pilot{};
    LawShare laws{};

    /// The error of the numerics is shown to be larger than `run.accuracy`.
    bool missed() const;
};

/// Lines, as the program prints them.
std::string check_text(const CheckReport& report);
Json check_json(const CheckReport& report);

/// Draws the structure of a study with its dimensions (`plot_structure`). @param file of the study, for the title where
/// the study has none   @throws InputError as `plot_structure`
void draw_study(const Study& study, const std::string& file, const std::filesystem::path& picture);

} // namespace stylobate
