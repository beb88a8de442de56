#pragma once
/// A check of a study, from what it refuses to what it finds, and its report.

#include "ensemble/model/observer.hpp"
#include "studies/check/law_share.hpp"
#include "studies/check/run_cost.hpp"
#include "studies/check/weak_spots.hpp"
#include "studies/experiment/loaded_study.hpp"
#include "studies/experiment/numerics.hpp"
#include "studies/kinds/kind.hpp"
#include "studies/report/json.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct CheckReport {
    std::string file; ///< of the study
    Study study;
    RunOptions run;
    std::vector<std::string> warnings{};
    std::string notice{}; ///< of the kind; empty: none
    std::string picture{};
    RunSize size{};
    std::optional<Trial> trial{};
    std::optional<RunTime> time{};
    double memory_bytes = 0;
    std::optional<std::uint64_t> counted{}; ///< `counted_trials`
    FreeMotion free{};
    std::vector<WeakSpot> weak{};
    std::vector<std::string> not_looked_for{}; ///< sentences
    std::string why_no_pilot{};
    std::optional<NumericsCheck> pilot{};
    LawShare laws{};

    /// The error of the numerics is shown to be larger than `run.accuracy`.
    bool missed() const;
};

/// Lines, as the program prints them.
std::string check_text(const CheckReport& report);
Json check_json(const CheckReport& report);

/// What a check is asked to spend.
struct CheckPlan {
    /// Realizations that are run twice, 16 to 10 million; 0: none. Not given: the usual number, where the kind of study
    /// allows it.
    std::optional<std::uint64_t> pilot;
    double trial_seconds = 2; ///< of the trial, up to 3600; 0: none
    double law_seconds = 20;  ///< of the pilot under other contact laws, up to 86400; 0: none
    /// Called with each stage that takes time; may be empty.
    std::function<void(const std::string&)> stage{};
    /// Called with the cost of the contact laws before they are run; empty: `stage` is.
    std::function<void(const std::string&)> costs{};
};

class StudyCheck {
public:
    /// Refuses what a run refuses, but for single realizations.
    /// @param file of the study, for messages and texts
    /// @throws InputError also if a part of the study cannot be run twice but is to be, and for a plan out of range
    StudyCheck(LoadedStudy loaded, std::string file, CheckPlan plan, const RunOptions& run);

    StudyCheck(const StudyCheck&) = delete; // the kind refers to what lies here
    StudyCheck& operator=(const StudyCheck&) = delete;

    const Study& study() const { return report_.study; }
    const std::vector<std::string>& warnings() const { return report_.warnings; }

    /// Draws every realization once, as a run does before it begins.
    /// @return whether all were drawn: the observer did not ask to stop   @throws InputError if one cannot be built
    bool draw_realizations(Observer& observer);

    /// @pre `draw_realizations` has drawn all
    /// @return nothing if the observer asked to stop
    std::optional<CheckReport> run(Observer& observer);

private:
    LoadedStudy loaded_;
    CheckPlan plan_;
    CheckReport report_;
    ResultHeader header_;
    std::unique_ptr<Kind> kind_; ///< of the loaded study and the header
    std::uint64_t pilot_ = 0, trajectories_ = 0;
    double drawing_s_ = 0;
};

/// Draws the structure of a study with its dimensions (`plot_structure`). @param file of the study, for the title where
/// the study has none   @throws InputError as `plot_structure`
void draw_study(const Study& study, const std::string& file, const std::filesystem::path& picture);

} // namespace stylobate
