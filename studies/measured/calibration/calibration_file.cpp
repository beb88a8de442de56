#include "studies/measured/calibration/calibration_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"
#include "io/tables/rows.hpp"
#include "io/tables/table_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stylobate {

namespace {

constexpr char format_name[] = "stylobate-calibration";
constexpr std::uint64_t format_version = 4;       // 4: windows in motion
constexpr std::uint64_t least_format_version = 3; // that is read
constexpr char parameter_row[] = "parameter";     ///< column of a profile's points

Table table_of(const StoredForm& form)
{
    const std::size_t n = form.parameters.size();
    Table table(form.name), parameters("parameters"), runs("runs");
    add_record(table, form);
    add_rows(parameters, form.parameters);
    parameters.add("correlation", form.correlation, {n, n});
    add_rows(runs, form.runs);
    Table profile = entries_table("profile", form.parameters, &FittedParameter::profile, parameter_row);
    table.add(std::move(parameters));
    if (profile.shape(parameter_row)[0] > 0)
        table.add(std::move(profile));
    table.add(std::move(runs));
    return table;
}

StoredForm form_of(const Table& table)
{
    StoredForm form;
    form.name = table.name();
    read_record(table, form);
    const Table& parameters = table.table("parameters");
    form.parameters = rows_of<FittedParameter>(parameters, "key");
    form.correlation = parameters.numbers("correlation", {form.parameters.size(), form.parameters.size()});
    if (const Table* profile = find_table(table.tables(), "profile"))
        read_entries(*profile, form.parameters, &FittedParameter::profile, parameter_row);
    form.runs = rows_of<RunScore>(table.table("runs"), "name");
    return form;
}

StoredCalibration stored_from(const Table& table, std::uint64_t version)
{
    StoredCalibration stored;
    read_record(table, stored);
    for (const Table& form : table.table("forms").tables())
        stored.forms.push_back(form_of(form));
    if (std::ranges::find(stored.forms, stored.best_form, &StoredForm::name) == stored.forms.end())
        table.refuse("its best form '" + stored.best_form + "' is not there");
    if (const Table* motion = find_table(table.tables(), "motion")) {
        stored.motion = std::move(items_of<WindowMotions>(*motion, 1, version).front());
        if (const std::optional<std::string> fault = stored.motion->fault())
            table.refuse(*fault);
    }
    return stored;
}

} // namespace

const StoredForm& StoredCalibration::best() const
{
    return *std::ranges::find(forms, best_form, &StoredForm::name);
}

StoredCalibration stored(const Calibration& c)
{
    StoredCalibration whole;
    whole.measured = c.measured;
    whole.evidence = c.from_outcomes ? "outcomes" : "histories";
    whole.best_form = word_for(contact_form_names, c.forms[c.best].form);
    whole.notes = c.notes;
    whole.parameter_sets = c.parameter_sets;
    whole.simulations = c.simulations;
    whole.window_simulations = c.window_simulations;
    whole.block_steps = c.block_steps;
    whole.seconds = c.seconds;
    for (const FormCalibration& form : c.forms)
        whole.forms.push_back({word_for(contact_form_names, form.form), form.study.text, form.score, form.nominal_score,
                               form.roughness, form.held_out, form.parameters, form.correlation, form.runs});
    return whole;
}

StoredCalibration read_calibration(const std::filesystem::path& file)
{
    try {
        const hdf5::Handle open = hdf5::open_file(file, false);
        const hid_t root = open.id();
        if (!hdf5::has_attribute(root, "format") || hdf5::read_any_text(root, "format") != format_name)
            throw InputError(file.string(), 0, "contains no calibration");
        const std::uint64_t version = hdf5::read_number(root, "format_version");
        if (version < least_format_version || version > format_version)
            throw InputError(
                file.string(), 0,
                fmt::format("is a calibration of format version {}; this program reads versions {} to {}. Read it "
                            "with the version that wrote it, or calibrate again.",
                            version, least_format_version, format_version));
        return stored_from(read_content(root, "calibration", file.string()), version);
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("is a damaged calibration: ") + error.what());
    }
}

void write_calibration(const Calibration& calibration, const Study& start, const std::string& code_version,
                       const std::filesystem::path& file)
{
    StoredCalibration whole = stored(calibration);
    whole.code_version = code_version;
    whole.start_toml = start.text.empty() ? study_text(start) : start.text;
    Table table("calibration"), forms("forms");
    add_record(table, whole);
    for (const StoredForm& form : whole.forms)
        forms.add(table_of(form));
    table.add(std::move(forms));
    if (calibration.motion) {
        Table motion("motion");
        add_items<WindowMotions>(motion, {&*calibration.motion});
        table.add(std::move(motion));
    }
    try {
        hdf5::Handle made = hdf5::create_file(file, 0);
        hdf5::write_text(made.id(), "format", format_name);
        hdf5::write_number(made.id(), "format_version", H5T_STD_U32LE, format_version);
        write_content(made.id(), table);
        made.close();
    } catch (const hdf5::Error& error) {
        throw InputError(file.string(), 0, std::string("cannot be written: ") + error.what());
    }
}

} // namespace stylobate
