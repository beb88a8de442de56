#pragma once
/// A calibration as an HDF5 file; `io/FORMAT.md` describes its content.

#include "ensemble/model/fields.hpp"
#include "studies/measured/calibration/calibration.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// One contact form of a calibration, as it lies in the file.
struct StoredForm {
    std::string name;       ///< "area"
    std::string study_toml; ///< with the calibrated values
    double score = 0;       ///< of the calibrated model, all runs [nats]
    double nominal_score = 0;
    double roughness = 0;
    PairedGain held_out; ///< of no groups where no motion was left out
    std::vector<FittedParameter> parameters;
    std::vector<double> correlation; ///< (parameters x parameters)
    std::vector<RunScore> runs;
};

/// A calibration, as it lies in the file.
struct StoredCalibration {
    std::string measured;  ///< the file that it began from
    std::string evidence;  ///< "histories" or "outcomes"
    std::string best_form; ///< name of one of the forms
    std::string code_version;
    std::string start_toml;              ///< the study that it began from
    std::vector<std::string> notes;      ///< what could not be used or judged
    std::optional<WindowMotions> motion; ///< nothing of outcomes, and in files of format version 3
    std::uint64_t parameter_sets = 0, simulations = 0, window_simulations = 0, block_steps = 0;
    double seconds = 0;            ///< that it took
    std::vector<StoredForm> forms; ///< by name; never empty

    const StoredForm& best() const;
};

/// All of a calibration but its start study, the version of the program, and the windows in motion.
StoredCalibration stored(const Calibration& calibration);

/// @throws InputError if the file is none, of another format version, or damaged
StoredCalibration read_calibration(const std::filesystem::path& file);

/// Writes a calibration over a file.
/// @param start the study that it began from   @throws InputError if it cannot be written
void write_calibration(const Calibration& calibration, const Study& start, const std::string& code_version,
                       const std::filesystem::path& file);

// ---- fields, in the file and in JSON --------------------------------------------------------------------------------

template <class F>
void visit_fields(std::type_identity<ProfilePoint>, F&& f)
{
    f("value", &ProfilePoint::value);
    f("score", &ProfilePoint::score, {.unit = "nat"});
}

template <class F>
void visit_fields(std::type_identity<FittedParameter>, F&& f)
{
    f("key", &FittedParameter::key);
    f("start", &FittedParameter::start);
    f("value", &FittedParameter::value);
    f("low", &FittedParameter::low);
    f("high", &FittedParameter::high);
    f("range_low", &FittedParameter::from);
    f("range_high", &FittedParameter::to);
    f("determined", &FittedParameter::determined);
    f("effective", &FittedParameter::effective);
    f("note", &FittedParameter::note);
}

template <class F>
void visit_fields(std::type_identity<RunScore>, F&& f)
{
    f("name", &RunScore::run);
    f("motion_id", &RunScore::motion_id);
    f("units", &RunScore::units);
    f("nominal_score", &RunScore::nominal, {.unit = "nat"});
    f("calibrated_score", &RunScore::calibrated, {.unit = "nat"});
}

template <class F>
void visit_fields(std::type_identity<StoredForm>, F&& f)
{
    f("study_toml", &StoredForm::study_toml);
    f("score", &StoredForm::score);
    f("nominal_score", &StoredForm::nominal_score);
    f("roughness", &StoredForm::roughness);
    f("held_out_gain", within(&StoredForm::held_out, &PairedGain::total));
    f("held_out_groups", within(&StoredForm::held_out, &PairedGain::groups));
    f("held_out_low", within(&StoredForm::held_out, &PairedGain::low));
    f("held_out_high", within(&StoredForm::held_out, &PairedGain::high));
}

template <class F>
void visit_fields(std::type_identity<StoredCalibration>, F&& f)
{
    f("code_version", &StoredCalibration::code_version);
    f("measured", &StoredCalibration::measured);
    f("evidence", &StoredCalibration::evidence);
    f("start_toml", &StoredCalibration::start_toml);
    f("best_form", &StoredCalibration::best_form);
    f("parameter_sets", &StoredCalibration::parameter_sets);
    f("simulations", &StoredCalibration::simulations);
    f("window_simulations", &StoredCalibration::window_simulations);
    f("block_steps", &StoredCalibration::block_steps);
    f("seconds", &StoredCalibration::seconds);
    f("notes", &StoredCalibration::notes);
}

} // namespace stylobate
