#include "studies/measured/calibration/calibration_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/hdf5.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"
#include "studies/measured/windows/field_table.hpp"
#include "studies/measured/windows/window_motion_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stylobate {

namespace {

constexpr char format_name[] = "stylobate-calibration";
constexpr std::uint64_t format_version = 4;       // 4: windows in motion
constexpr std::uint64_t least_format_version = 3; // that is read

void write_form(hid_t parent, const FormCalibration& form)
{
    const char* name = word_for(contact_form_names, form.form);
    const hdf5::Handle group = hdf5::create_group(parent, name);
    const std::size_t n = form.parameters.size();
    hdf5::write_text(group.id(), "study_toml", form.study.text);
    hdf5::write_real(group.id(), "score", form.score);
    hdf5::write_real(group.id(), "nominal_score", form.nominal_score);
    hdf5::write_real(group.id(), "roughness", form.roughness);
    hdf5::write_real(group.id(), "held_out_gain", form.held_out.total);
    hdf5::write_number(group.id(), "held_out_groups", H5T_STD_U64LE, form.held_out.groups);
    hdf5::write_real(group.id(), "held_out_low", form.held_out.low);
    hdf5::write_real(group.id(), "held_out_high", form.held_out.high);

    std::vector<std::string> keys, notes;
    std::vector<std::int32_t> determined, effective, of;
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
        effective.push_back(p.effective);
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
    hdf5::write_array(group.id(), "parameters/effective", effective, {n}, "");
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

/// A list of the file that says how long it is.
std::vector<double> doubles(hid_t group, const std::string& path)
{
    return hdf5::read_doubles(group, path, hdf5::dims_of(group, path));
}

std::vector<FittedParameter> read_parameters(hid_t group)
{
    const hdf5::Dims n = hdf5::dims_of(group, "parameters/key");
    if (n.size() != 1)
        throw hdf5::Error("its parameters are no list");
    std::vector<FittedParameter> parameters(n[0]);
    const auto take = [&](const char* name, double FittedParameter::*member) {
        const std::vector<double> values = hdf5::read_doubles(group, std::string("parameters/") + name, n);
        for (std::size_t i = 0; i < values.size(); ++i)
            parameters[i].*member = values[i];
    };
    take("start", &FittedParameter::start);
    take("value", &FittedParameter::value);
    take("low", &FittedParameter::low);
    take("high", &FittedParameter::high);
    take("range_low", &FittedParameter::from);
    take("range_high", &FittedParameter::to);
    const std::vector<std::string> keys = hdf5::read_texts(group, "parameters/key", n);
    const std::vector<std::string> notes = hdf5::read_texts(group, "parameters/note", n);
    const std::vector<std::int32_t> determined = hdf5::read_integers(group, "parameters/determined", n);
    const std::vector<std::int32_t> effective = hdf5::read_integers(group, "parameters/effective", n);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        parameters[i].key = keys[i];
        parameters[i].note = notes[i];
        parameters[i].determined = determined[i] != 0;
        parameters[i].effective = effective[i] != 0;
    }
    if (hdf5::exists(group, "profile")) {
        const hdf5::Dims m = hdf5::dims_of(group, "profile/parameter");
        const std::vector<std::int32_t> of = hdf5::read_integers(group, "profile/parameter", m);
        const std::vector<double> value = hdf5::read_doubles(group, "profile/value", m);
        const std::vector<double> score = hdf5::read_doubles(group, "profile/score", m);
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (of[i] < 0 || static_cast<std::size_t>(of[i]) >= parameters.size())
                throw hdf5::Error("a profile is of no parameter");
            parameters[static_cast<std::size_t>(of[i])].profile.push_back({value[i], score[i]});
        }
    }
    return parameters;
}

std::vector<RunScore> read_runs(hid_t group)
{
    const hdf5::Dims n = hdf5::dims_of(group, "runs/name");
    const std::vector<std::string> names = hdf5::read_texts(group, "runs/name", n);
    const std::vector<std::int32_t> motions = hdf5::read_integers(group, "runs/motion_id", n);
    const std::vector<std::uint64_t> units = hdf5::read_counts(group, "runs/units", n);
    const std::vector<double> nominal = hdf5::read_doubles(group, "runs/nominal_score", n);
    const std::vector<double> calibrated = hdf5::read_doubles(group, "runs/calibrated_score", n);
    std::vector<RunScore> runs;
    for (std::size_t i = 0; i < names.size(); ++i)
        runs.push_back({names[i], motions[i], units[i], nominal[i], calibrated[i]});
    return runs;
}

StoredForm read_form(hid_t forms, const std::string& name)
{
    const hdf5::Handle group = hdf5::open_group(forms, name);
    StoredForm form;
    form.name = name;
    form.study_toml = hdf5::read_text(group.id(), "study_toml");
    form.score = hdf5::read_any_number(group.id(), "score");
    form.nominal_score = hdf5::read_any_number(group.id(), "nominal_score");
    form.roughness = hdf5::read_any_number(group.id(), "roughness");
    form.held_out.total = hdf5::read_any_number(group.id(), "held_out_gain");
    form.held_out.groups = hdf5::read_number(group.id(), "held_out_groups");
    form.held_out.low = hdf5::read_any_number(group.id(), "held_out_low");
    form.held_out.high = hdf5::read_any_number(group.id(), "held_out_high");
    form.parameters = read_parameters(group.id());
    form.correlation = doubles(group.id(), "parameters/correlation");
    if (form.correlation.size() != form.parameters.size() * form.parameters.size())
        throw hdf5::Error("its correlations are not a square of its parameters");
    form.runs = read_runs(group.id());
    return form;
}

} // namespace

const StoredForm& StoredCalibration::best() const
{
    return *std::find_if(forms.begin(), forms.end(), [&](const StoredForm& form) { return form.name == best_form; });
}

StoredCalibration read_calibration(const std::filesystem::path& file)
{
    try {
        const hdf5::Handle open = hdf5::open_file(file, false);
        const hid_t root = open.id();
        if (!hdf5::has_attribute(root, "format") || hdf5::read_any_text(root, "format") != format_name)
            throw InputError(file.string(), 0, "contains no calibration");
        if (const std::uint64_t version = hdf5::read_number(root, "format_version");
            version < least_format_version || version > format_version)
            throw InputError(
                file.string(), 0,
                fmt::format("is a calibration of format version {}; this program reads versions {} to {}. Read it "
                            "with the version that wrote it, or calibrate again.",
                            version, least_format_version, format_version));
        StoredCalibration stored;
        stored.measured = hdf5::read_text(root, "measured");
        stored.evidence = hdf5::read_text(root, "evidence");
        stored.best_form = hdf5::read_text(root, "best_form");
        stored.code_version = hdf5::read_text(root, "code_version");
        stored.start_toml = hdf5::read_text(root, "start_toml");
        stored.notes = hdf5::read_texts(root, "notes", hdf5::dims_of(root, "notes"));
        stored.parameter_sets = hdf5::read_number(root, "parameter_sets");
        stored.simulations = hdf5::read_number(root, "simulations");
        stored.window_simulations = hdf5::read_number(root, "window_simulations");
        stored.block_steps = hdf5::read_number(root, "block_steps");
        stored.seconds = hdf5::read_any_number(root, "seconds");
        const hdf5::Handle forms = hdf5::open_group(root, "forms");
        for (const std::string& name : hdf5::names_in(forms.id()))
            stored.forms.push_back(read_form(forms.id(), name));
        if (std::none_of(stored.forms.begin(), stored.forms.end(),
                         [&](const StoredForm& form) { return form.name == stored.best_form; }))
            throw hdf5::Error("its best form '" + stored.best_form + "' is not there");
        if (hdf5::exists(root, "motion")) {
            const hdf5::Handle motion = hdf5::open_group(root, "motion");
            stored.motion = std::move(read_table<WindowMotions>(motion.id(), 1, format_version).front());
            if (const std::string fault = stored.motion->fault(); !fault.empty())
                throw hdf5::Error(fault);
        }
        return stored;
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
                         word_for(contact_form_names, calibration.forms[calibration.best].form));
        hdf5::write_number(made.id(), "parameter_sets", H5T_STD_U64LE, calibration.parameter_sets);
        hdf5::write_number(made.id(), "simulations", H5T_STD_U64LE, calibration.simulations);
        hdf5::write_number(made.id(), "window_simulations", H5T_STD_U64LE, calibration.window_simulations);
        hdf5::write_number(made.id(), "block_steps", H5T_STD_U64LE, calibration.block_steps);
        hdf5::write_real(made.id(), "seconds", calibration.seconds);
        hdf5::write_texts(made.id(), "notes", calibration.notes);
        const hdf5::Handle forms = hdf5::create_group(made.id(), "forms");
        for (const FormCalibration& form : calibration.forms)
            write_form(forms.id(), form);
        if (calibration.motion) {
            const hdf5::Handle motion = hdf5::create_group(made.id(), "motion");
            write_table<WindowMotions>(motion.id(), {&*calibration.motion});
        }
        made.close();
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    }
}

} // namespace stylobate
