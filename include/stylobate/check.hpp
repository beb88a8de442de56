#pragma once
/// Before a run: the realizations, costs and weak spots of a study.

#include "stylobate/experiment.hpp"
#include "stylobate/study.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

/// Lower and upper end.
struct Range {
    double lower = 0;
    double upper = 0;
};

/// A choice that is allowed and plausible, but makes the answer imprecise or dependent on the numerics.
/// docs/check.md lists them with their reasons and sources.
struct WeakSpot {
    std::string name;   ///< "wide_interval"
    std::string text;   ///< what and why, with its figures and their source
    std::string remedy; ///< a sentence
};

/// A key that the study does not give and that `run.accuracy` has chosen.
struct ChosenKey {
    std::string key; ///< "run.step_s"
    std::string value;
    std::string reason;
};

/// Time of the run, from the trial.
struct RunTime {
    double seconds = 0;   ///< elapsed, on an idle machine
    Range range_s;        ///< in which it lies (docs/check.md)
    bool at_most = false; ///< of a study that chooses its realizations: only the upper end of the range means something
    double processor_s = 0; ///< of all threads
    double block_steps = 0; ///< free blocks times steps, of all realizations
    Range steps;            ///< of a realization of the trial
};

/// The fair sample of realizations that was run for the time.
struct Trial {
    std::uint64_t realizations = 0;
    std::uint64_t valid = 0;
    std::uint64_t collapsed = 0; ///< of the valid ones
    bool whole = false;          ///< all realizations of the study were run
    double seconds = 0;          ///< elapsed
};

/// A part of the study that was run twice on the same draws, the second time with finer numerics.
struct Pilot {
    std::uint64_t realizations = 0;    ///< valid in both runs
    std::uint64_t collapsed = 0;       ///< with the numerics of the study
    std::uint64_t collapsed_finer = 0; ///< with the finer ones
    double difference = 0;             ///< of the collapse probability: the study's less that of the finer numerics
    double standard_error = 0;         ///< of it
    bool accuracy_missed = false;      ///< `run.accuracy` is shown not to be reached
};

struct CheckOptions {
    /// Realizations that are run twice, 16 to 10,000,000; 0: none. The command line takes 1024 where the kind of study
    /// allows it (not rare, sensitivity, or surface.adaptive).
    std::uint64_t pilot = 0;
    double trial_seconds = 2;  ///< of the trial, up to 3600; 0: none, and no time is estimated
    double law_seconds = 20;   ///< most, of the pilot under other contact laws, up to 86400; 0: none
    int threads = 0;           ///< of the run to be estimated; 0: as many as the process may use
    std::string simd = "auto"; ///< as `RunOptions::simd`
    std::function<void(const std::string& line)> tell = {}; ///< called with each stage, as a line of text; may be empty
    std::function<bool()> go_on = {}; ///< polled about ten times a second; false: stop. May be empty
};

/// What is known of a study before its run. A copy is cheap.
class Check {
public:
    std::string kind() const;           ///< of the study: "surface"
    std::string form() const;           ///< of its contacts: "area"
    std::uint64_t realizations() const; ///< or the most that it can take:
    bool at_most() const;               ///< of an adaptive surface and of rare events; so are memory and file
    std::uint64_t cells() const;
    int blocks() const;      ///< of one structure, without the ground
    int free_blocks() const; ///< of these, those that can move
    Range step_s() const;
    Range longest_steps() const;         ///< of a realization that runs to the time limit
    std::optional<Trial> trial() const;  ///< none: not asked for
    std::optional<RunTime> time() const; ///< none: no trial, or its first realizations did not end in time
    double memory_bytes() const; ///< resident, of this process if it ran the study: what it has held so far and more
    double file_bytes() const;   ///< of the complete results file; while it is finished it is there twice
    std::vector<ChosenKey> chosen() const;
    std::vector<WeakSpot> weak_spots() const;
    std::optional<Pilot> pilot() const;
    std::vector<std::string> warnings() const; ///< implausible values, and how to allow them
    std::string text() const;                  ///< what the command line prints
    std::string json() const;                  ///< `stylobate check --json`

    /// Draws the structure to scale with its dimensions, nothing drawn at random: .png, .svg or .pdf. A
    /// file that is there is replaced.
    /// @throws InputError for another ending, if librsvg is missing (of .png and .pdf), or if the file cannot be
    /// written
    void draw(const std::filesystem::path& picture) const;

    Check(const Check&) = default;
    Check& operator=(const Check&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Check(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

/// Checks a study as `stylobate check` does. The time is measured by the processor time of this process: what its other
/// threads compute meanwhile is counted too.
/// @return nothing if `go_on` stopped it
/// @throws InputError for what `run` refuses, and for options out of range
std::optional<Check> check(const Experiment& experiment, const CheckOptions& options = {});

/// Checks a study with the excitation that it names.
std::optional<Check> check(const Study& study, const CheckOptions& options = {});

} // namespace stylobate::api
