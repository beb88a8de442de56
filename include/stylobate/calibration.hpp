#pragma once
/// Contact parameters, and other numbers of a study, from measured response.

#include "stylobate/study.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

/// A number of the study file that was fitted or judged (docs/calibration.md). It is *determined* (a value of the
/// specimen, whose interval holds whatever its contact law is), *effective* (a value of this model with its contact
/// form; the interval is that of the model's value) or neither: then the value is the study's, and there is no
/// interval.
struct CalibratedParameter {
    std::string key;  ///< of the study file, with its unit: "contact.friction"
    double start = 0; ///< of the study that the calibration began from
    double value = 0;
    double lower = 0; ///< 95 % interval; an end of the range where the data give no bound
    double upper = 0;
    double range_from = 0; ///< that was searched
    double range_to = 0;
    bool bounded_below = false; ///< the data exclude the lower end of the range
    bool bounded_above = false;
    bool determined = false;
    bool effective = false;
    std::string note; ///< what the value rests on, why it is effective or not determined
};

/// How well a run of the campaign, or a row of the table, is predicted [nats].
struct CalibratedRun {
    std::string run;
    int motion_id = 0;
    std::uint64_t units = 0; ///< windows; of outcomes 1
    double start = 0;        ///< score by the study that the calibration began from
    double calibrated = 0;   ///< by parameters fitted without its motion; without held-out motions by all
};

/// Score of the calibrated study less that of the start, on motions that were left out [nats]. Its 95 % interval is
/// infinite where there are too few of them.
struct HeldOutGain {
    double nats = 0;
    double lower = 0;
    double upper = 0;
};

/// The calibration with one contact form.
struct CalibratedForm {
    std::string form; ///< "area", "two_corner", "points" or "rigid"
    std::vector<CalibratedParameter> parameters;
    double score = 0; ///< of the calibrated study over all runs [nats]
    double start_score = 0;
    std::vector<CalibratedRun> runs;
    std::optional<HeldOutGain> held_out; ///< none: not asked for, or all runs have one motion
};

struct CalibrationOptions {
    /// To begin from: contacts and mechanisms; the structure is the specimen's. None: the specimen, its nominal
    /// friction, a bed of 2e9 N/m3. A table of outcomes needs it, with the structure and the shaking.
    std::optional<Study> study = {};
    std::vector<std::string> forms = {}; ///< contact forms, or "all"; none: the study's
    std::vector<std::string> fit = {};   ///< "KEY" or "KEY=FROM:TO", beside the contact's keys or instead of them
    std::vector<std::string> hold = {};  ///< keys of the contact that keep the study's value
    bool outcomes = false;               ///< use outcomes (fell or stood) even where there are histories
    bool held_out = true;                ///< cross-validation over motions
    int threads = 0;                     ///< 0: as many as the process may use
    std::string simd = "auto";           ///< as `RunOptions::simd`
    /// Keeps the parameter sets that are done, so that a stopped calibration goes on, by this function or by the
    /// program; it is removed when the calibration is complete. Nullopt: they are not kept.
    std::optional<std::filesystem::path> cache = {};
    /// Called with the progress, line by line; may be empty.
    std::function<void(const std::string& line)> tell = {};
    std::function<bool()> go_on = {}; ///< polled about ten times a second; false: stop. May be empty
};

/// A copy is cheap.
class Calibration {
public:
    std::string measured() const;                     ///< the file
    std::string evidence() const;                     ///< "histories" or "outcomes"
    const std::vector<CalibratedForm>& forms() const; ///< in the order asked for
    const CalibratedForm& best() const;               ///< by the score on motions that were left out
    std::vector<std::string> notes() const;           ///< what could not be used or judged
    std::string calibrated_study() const; ///< that of the best form (TOML); comments state values and intervals
    std::uint64_t parameter_sets() const; ///< that were tried
    std::uint64_t restored_sets() const;  ///< of these, from the cache of a calibration that was stopped
    double seconds() const;               ///< that it took
    std::string text() const;             ///< what the command line prints, without the names of its files
    std::string json() const;             ///< `stylobate calibrate --json`, without the names of its files

    /// Writes the results file of the command line, which `stylobate report` takes, whole or not at all. A file that is
    /// there is replaced.
    /// @throws InputError if it cannot be written
    void write(const std::filesystem::path& file) const;

    Calibration(const Calibration&) = default;
    Calibration& operator=(const Calibration&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Calibration(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

/// Fits a study to measured response, as `stylobate calibrate` does.
/// @param measured a campaign (an HDF5 file, or a folder of tables), or a table of outcomes (.csv)
/// @return nothing if `go_on` stopped it
/// @throws InputError if it cannot be read, has too little information, or if a key cannot be fitted or held
std::optional<Calibration> calibrate(const std::filesystem::path& measured, const CalibrationOptions& options = {});

} // namespace stylobate::api
