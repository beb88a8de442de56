#pragma once
/// Contact parameters, and any other number of a study file, from measured response: how likely they make what was
/// measured, how well they are known, and what was not determined.
///
/// Determined are values of the specimen, with intervals that do not rest on the model's law of normal contact and were
/// tested on specimens of two other laws (docs/calibration.md): the friction, where `judge_friction` determines it; it
/// is then held at that value, otherwise at the study's. The search finds values of this model with its contact law,
/// which predict best: they are effective, and determine nothing of the specimen, however narrow their intervals are.
/// Stiffness and damping of a contact law that the specimen does not have cannot be anything else.
///
/// Evidence is either histories, scored window by window (`window_comparison.hpp`), or outcomes (fell or stood),
/// scored by the share of falls in small ensembles. The search is a scan over the whole range (friction is a cliff:
/// below some value all slides, above another nothing does, and between them there is no slope to follow), then points
/// about the best ones, then a quadratic form through them (`calibration_surface.hpp`), then the profile of every
/// parameter: the best score with that parameter held.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "studies/measured/calibration/fit_keys.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/measured/windows/window_motion.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct CalibrationOptions {
    std::vector<FitKey> keys;       ///< empty: `contact_keys` of the study
    std::vector<ContactForm> forms; ///< empty: the study's
    std::vector<std::size_t> runs;  ///< of the campaign; empty: all
    bool outcomes = false;          ///< use outcomes even where there are histories
    std::size_t scan = 48;          ///< points spread over the whole range
    std::size_t refine = 24;        ///< points of each of the rounds about the best ones
    std::size_t surface = 40;       ///< points of each of two rounds for the quadratic form
    std::size_t profile = 5;        ///< values of each parameter in its profile; 0: none (intervals from the form)
    bool held_out = true;           ///< cross-validation over motions
    std::uint64_t ensemble = 24;    ///< outcomes: realizations of each run
    double window_s = 0;            ///< histories: 0: by the size of the drums
    /// File that keeps what was predicted until the calibration is complete (`calibration_evidence.hpp`); nullopt:
    /// none.
    std::optional<std::filesystem::path> kept;
    std::string kept_key;                          ///< what the measured data are known by
    std::function<void(const std::string&)> stage; ///< called with a description of each stage; may be empty
};

struct ProfilePoint {
    double value = 0;
    double score = 0; ///< best score with the parameter held there, less the best of all [nats]
};

struct FittedParameter {
    std::string key;
    double start = 0; ///< of the study
    double value = 0;
    double low = 0; ///< 95 % interval; at an end of the range where the data give no bound
    double high = 0;
    double from = 0; ///< the range
    double to = 0;
    bool bounded_below = false; ///< the data exclude the lower end of the range
    bool bounded_above = false;
    bool determined = false; ///< a value of the specimen, by no law of normal contact
    bool effective = false;  ///< a value of this model with its contact law; the interval is that of the model's value
    std::string note;        ///< in words: what a value rests on, why it is effective or not determined
    std::vector<ProfilePoint> profile;
};

/// "(0.4 to 0.5, 95 %)", "(of the model's value 1 to 2, 95 %)", or "no interval".
std::string interval_words(const FittedParameter& parameter);

/// Score of one run, in nats, by parameters that it did and did not help to find.
struct RunScore {
    std::string run;
    int motion_id = 0;
    std::size_t units = 0; ///< windows; of outcomes 1
    double nominal = 0;    ///< the study as it was
    double calibrated = 0; ///< by parameters that its motion did not help to find; without held-out motions by all
};

/// The calibration with one contact form.
struct FormCalibration {
    ContactForm form = ContactForm::area;
    std::vector<FittedParameter> parameters;
    std::vector<double> correlation; ///< (parameters x parameters)
    double score = 0;                ///< of the calibrated model, all runs [nats]
    double nominal_score = 0;
    double roughness = 0; ///< of the score from one parameter set to the next [nats]
    std::vector<RunScore> runs;
    PairedGain held_out; ///< calibrated less nominal, on runs left out [nats]
    Study study;         ///< with the calibrated values
};

struct Calibration {
    std::string measured; ///< file
    bool from_outcomes = false;
    std::vector<FormCalibration> forms; ///< in the order asked for
    std::size_t best = 0;               ///< of the forms: by the score on runs left out
    std::vector<std::string> notes;     ///< what could not be used or judged, in words
    /// The measured blocks, those of the best study and those of the start study, in windows chosen by the errors of
    /// the best one; nothing of outcomes.
    std::optional<WindowMotions> motion;
    std::uint64_t parameter_sets = 0;
    std::uint64_t restored_sets = 0; ///< of them, taken from what an interrupted calibration left
    std::uint64_t kept_sets = 0;     ///< held by the file, where the calibration was interrupted
    std::uint64_t simulations = 0;
    std::uint64_t window_simulations = 0;
    std::uint64_t block_steps = 0;
    double seconds = 0;
    bool complete = false; ///< false: the observer stopped it; nothing of the above is to be used
};

/// The study that a campaign is calibrated from where none is given: the specimen, its nominal friction, and a bed of
/// 2e9 N/m3 (stone joints are of the order of 1 to 10 GPa/m).
Study default_study(const Campaign& campaign);

/// Calibrates. Progress is reported in parameter sets of the whole calibration.
///
/// @param start  contacts and mechanisms; its structure is replaced by the specimen's
/// @throws InputError if the campaign has neither histories nor outcomes, or a key cannot be fitted
Calibration calibrate(const Campaign& campaign, const Study& start, const CalibrationOptions& options,
                      const RunOptions& run, Observer& observer);

/// Calibrates from a table of outcomes, which does not describe the specimen.
///
/// @param start the structure too, and the excitation, for whatever the table leaves open (`outcome_tests.hpp`); its
///              perturbations are drawn (none: friction by 5 % from joint to joint, and a specimen's usual tolerances)
/// @throws InputError if a row cannot be used, there is none, or a key cannot be fitted
Calibration calibrate(const OutcomeTable& table, const Study& start, const CalibrationOptions& options,
                      const RunOptions& run, Observer& observer);

} // namespace stylobate
