#include "studies/diagnosis/calibration_file.hpp"

#include "ensemble/input_error.hpp"
#include "io/hdf5.hpp"
#include "io/study_file.hpp"
#include "io/study_names.hpp"

namespace stylobate {

namespace {

constexpr char format_name[] = "stylobate-calibration";
constexpr std::uint64_t format_version = 1;

void write_form(hid_t parent, const FormCalibration& form)
{
    const char* name = contact_form_names[static_cast<std::size_t>(form.form)].word;
    const hdf5::Handle group = hdf5::create_group(parent, name);
    const std::size_t n = form.parameters.size();
    hdf5::write_text(group.id(), "study_toml", form.study.text);
    hdf5::write_real(group.id(), "score", form.score);
    hdf5::write_real(group.id(), "nominal_score", form.nominal_score);
    hdf5::write_real(group.id(), "roughness", form.roughness);
    hdf5::write_real(group.id(), "held_out_gain", form.held_out.total);
    hdf5::write_real(group.id(), "held_out_low", form.held_out.low);
    hdf5::write_real(group.id(), "held_out_high", form.held_out.high);

    std::vector<std::string> keys, notes;
    std::vector<std::int32_t> determined, of;
    std::vector<double> profile_value, profile_score;
    const auto column = [&](double FittedParameter::*member) {
        std::vector<double> values;
        for (const FittedParameter& p : form.parameters)
            values.push_back(p.*member);
        return values;
    };
    for (std::size_t i = 0; i < n; ++i) {
        const FittedParameter& p = form.parameters[i];
        keys.push_back(p.key);
        notes.push_back(p.note);
        determined.push_back(p.determined);
        for (const ProfilePoint& point : p.profile) {
            of.push_back(static_cast<std::int32_t>(i));
            profile_value.push_back(point.value);
            profile_score.push_back(point.score);
        }
    }
    hdf5::create_group(group.id(), "parameters");
    hdf5::write_texts(group.id(), "parameters/key", keys);
    hdf5::write_array(group.id(), "parameters/start", column(&FittedParameter::start), {n}, "");
    hdf5::write_array(group.id(), "parameters/value", column(&FittedParameter::value), {n}, "");
    hdf5::write_array(group.id(), "parameters/low", column(&FittedParameter::low), {n}, "");
    hdf5::write_array(group.id(), "parameters/high", column(&FittedParameter::high), {n}, "");
    hdf5::write_array(group.id(), "parameters/range_low", column(&FittedParameter::from), {n}, "");
    hdf5::write_array(group.id(), "parameters/range_high", column(&FittedParameter::to), {n}, "");
    hdf5::write_array(group.id(), "parameters/determined", determined, {n}, "");
    hdf5::write_texts(group.id(), "parameters/note", notes);
    hdf5::write_array(group.id(), "parameters/correlation", form.correlation, {n, n}, "");
    if (!of.empty()) {
        hdf5::create_group(group.id(), "profile");
        hdf5::write_array(group.id(), "profile/parameter", of, {of.size()}, "");
        hdf5::write_array(group.id(), "profile/value", profile_value, {of.size()}, "");
        hdf5::write_array(group.id(), "profile/score", profile_score, {of.size()}, "nat");
    }

    const std::size_t runs = form.runs.size();
    std::vector<std::string> names;
    std::vector<std::int32_t> motions;
    std::vector<std::uint64_t> units;
    std::vector<double> nominal, calibrated;
    for (const RunScore& run : form.runs) {
        names.push_back(run.run);
        motions.push_back(run.motion_id);
        units.push_back(run.units);
        nominal.push_back(run.nominal);
        calibrated.push_back(run.calibrated);
    }
    hdf5::create_group(group.id(), "runs");
    hdf5::write_texts(group.id(), "runs/name", names);
    hdf5::write_array(group.id(), "runs/motion_id", motions, {runs}, "");
    hdf5::write_array(group.id(), "runs/units", units, {runs}, "");
    hdf5::write_array(group.id(), "runs/nominal_score", nominal, {runs}, "nat");
    hdf5::write_array(group.id(), "runs/calibrated_score", calibrated, {runs}, "nat");
}

} // namespace

std::optional<CalibrationSummary> read_calibration_summary(const std::filesystem::path& file)
{
    hdf5::Handle open;
    try {
        open = hdf5::open_file(file, false);
        if (!hdf5::has_attribute(open.id(), "format") || hdf5::read_any_text(open.id(), "format") != format_name)
            return std::nullopt;
    } catch (const hdf5::Error&) {
        return std::nullopt; // no HDF5 at all: somebody else's to say what it is
    }
    try {
        CalibrationSummary summary;
        summary.measured = hdf5::read_text(open.id(), "measured");
        summary.evidence = hdf5::read_text(open.id(), "evidence");
        summary.best_form = hdf5::read_text(open.id(), "best_form");
        summary.code_version = hdf5::read_text(open.id(), "code_version");
        summary.parameter_sets = hdf5::read_number(open.id(), "parameter_sets");
        const std::string place = "forms/" + summary.best_form + "/parameters/";
        const hdf5::Dims dims = hdf5::dims_of(open.id(), place + "key");
        summary.keys = hdf5::read_texts(open.id(), place + "key", dims);
        summary.value = hdf5::read_doubles(open.id(), place + "value", dims);
        summary.low = hdf5::read_doubles(open.id(), place + "low", dims);
        summary.high = hdf5::read_doubles(open.id(), place + "high", dims);
        return summary;
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("is a damaged calibration: ") + error.what());
    }
}

void write_calibration(const Calibration& calibration, const Study& start, const std::string& code_version,
                       const std::filesystem::path& file)
{
    try {
        hdf5::Handle made = hdf5::create_file(file, 0);
        hdf5::write_text(made.id(), "format", format_name);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format_version);
        hdf5::write_text(made.id(), "code_version", code_version);
        hdf5::write_text(made.id(), "measured", calibration.measured);
        hdf5::write_text(made.id(), "evidence", calibration.from_outcomes ? "outcomes" : "histories");
        hdf5::write_text(made.id(), "start_toml", start.text.empty() ? study_text(start) : start.text);
        hdf5::write_text(made.id(), "best_form",
                         contact_form_names[static_cast<std::size_t>(calibration.forms[calibration.best].form)].word);
        hdf5::write_number(made.id(), "parameter_sets", H5T_STD_U64LE, calibration.parameter_sets);
        hdf5::write_number(made.id(), "simulations", H5T_STD_U64LE, calibration.simulations);
        hdf5::write_number(made.id(), "window_simulations", H5T_STD_U64LE, calibration.window_simulations);
        hdf5::write_number(made.id(), "block_steps", H5T_STD_U64LE, calibration.block_steps);
        const hdf5::Handle forms = hdf5::create_group(made.id(), "forms");
        for (const FormCalibration& form : calibration.forms)
            write_form(forms.id(), form);
        made.close();
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    }
}

} // namespace stylobate
