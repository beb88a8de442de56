#include "io/measured/campaign_writer.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/file_handle.hpp"
#include "io/files/hdf5.hpp"
#include "io/files/key_reader.hpp"
#include "io/measured/measured_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <system_error>
#include <unistd.h>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

std::string list_text(const std::vector<double>& values)
{
    std::string text;
    for (const double value : values)
        text += (text.empty() ? "" : ", ") + (std::isnan(value) ? "nan" : toml_number(value));
    return "[" + text + "]";
}

std::string whole_list_text(const std::vector<int>& values)
{
    return fmt::format("[{}]", fmt::join(values, ", "));
}

using AddKey = std::function<void(std::string_view key, const std::string& value)>;

void add_laboratory(const Laboratory& laboratory, const AddKey& add)
{
    for (const LaboratoryNumber& number : laboratory_numbers())
        if (const auto& value = laboratory.*number.member)
            add(number.name, toml_number(*value));
    add("may_dismantle", laboratory.may_dismantle ? "true" : "false");
    for (const auto& [kind, cost] : laboratory.cost)
        add(cost_key(kind), toml_number(cost));
}

/// What belongs to tests alone; the tables of dummies and gauges follow.
void add_test(const MeasuredRun& run, const AddKey& add)
{
    if (run.joint)
        add("joint", fmt::format("{}", *run.joint));
    if (!run.present.empty())
        add("present", whole_list_text(run.present));
    if (!run.clamped.empty())
        add("clamped", whole_list_text(run.clamped));
    std::vector<std::string> groups;
    for (const std::vector<int>& group : run.taped)
        groups.push_back(whole_list_text(group));
    if (!groups.empty())
        add("taped", fmt::format("[{}]", fmt::join(groups, ", ")));
    if (run.released_s)
        add("released_s", toml_number(*run.released_s));
}

void add_bodies(const MeasuredRun& run, std::string& text, const AddKey& add)
{
    for (const Dummy& dummy : run.dummies) {
        text += "\n[[run.dummy]]\n";
        add("block", fmt::format("{}", dummy.block));
        for (const DummyNumber& number : dummy_numbers())
            add(number.name, toml_number(dummy.*number.member));
    }
    for (const ForceGauge& gauge : run.forces) {
        text += "\n[[run.force]]\n";
        add("name", toml_quoted(gauge.name));
        add("block", fmt::format("{}", gauge.block));
        for (const GaugeNumber& number : gauge_numbers())
            add(number.name, toml_number(gauge.*number.member));
        add("to", toml_quoted(end_word(gauge)));
        if (gauge.value_n.noise_sd)
            add("noise_n", toml_number(*gauge.value_n.noise_sd));
    }
}

std::string toml_text(const Campaign& campaign)
{
    const Specimen& specimen = campaign.specimen;
    std::string text =
        fmt::format("[campaign]\nformat = \"{}\"\nformat_version = {}\n", measured_format, measured_version);
    const AddKey add = [&](std::string_view key, const std::string& value) {
        text += fmt::format("{} = {}\n", key, value);
    };
    if (!specimen.name.empty())
        add("specimen", toml_quoted(specimen.name));
    add("gravity_m_s2", toml_number(specimen.gravity_m_s2));
    text += "\n[specimen]\n";
    if (specimen.friction_nominal)
        add("friction_nominal", toml_number(*specimen.friction_nominal));
    for (const SpecimenNumber& number : specimen_numbers())
        add(number.name, toml_number(specimen.*number.member));
    if (specimen.base_block_half_width_m)
        add("base_block_half_width_m", toml_number(*specimen.base_block_half_width_m));
    for (const SpecimenList& list : specimen_lists())
        if (!(specimen.*list.member).empty())
            add(list.name, list_text(specimen.*list.member));
    std::string joints;
    for (const auto& [lower, upper] : specimen.joints)
        joints += fmt::format("{}[{}, {}]", joints.empty() ? "" : ", ", lower, upper);
    if (!joints.empty())
        add("joints", "[" + joints + "]");
    text += "\n[laboratory]\n";
    add_laboratory(campaign.laboratory, add);
    for (const MeasuredRun* each : every_run(campaign)) {
        const MeasuredRun& run = *each;
        text += "\n[[run]]\n";
        add("name", toml_quoted(run.name));
        add("kind", toml_quoted(to_string(run.test)));
        add("motion_id", fmt::format("{}", run.motion_id));
        add("repeat", fmt::format("{}", run.repeat));
        if (run.kind)
            add("motion", toml_quoted(*run.kind));
        if (run.rate_hz != 0)
            add("rate_hz", toml_number(run.rate_hz));
        if (run.run_order)
            add("run_order", fmt::format("{}", *run.run_order));
        if (run.collapsed)
            add("collapsed", *run.collapsed ? "true" : "false");
        add("collapse_time_s", toml_number(run.collapse_time_s));
        add("base_source", toml_quoted(to_string(run.base_source)));
        if (run.base_clock)
            add("base_clock", toml_quoted(*run.base_clock));
        for (const SeriesName& series : series_names())
            if (const auto noise = series.in(run).noise_sd)
                add(series.noise_key(), toml_number(*noise));
        add_test(run, add);
        add_bodies(run, text, add);
    }
    return text;
}

std::string csv_text(const MeasuredRun& run, std::size_t blocks)
{
    std::string text = "time_s";
    std::vector<std::pair<const double*, std::size_t>> columns = {{run.time_s.data(), 1}}; // first value, step
    for (const SeriesName& name : series_names()) {
        const Series& series = name.in(run);
        if (series.empty())
            continue;
        if (!name.per_block) {
            text += fmt::format(",{}{}", name.column, name.suffix);
            columns.emplace_back(series.values.data(), 1);
        }
        for (std::size_t block = 0; name.per_block && block < blocks; ++block) {
            text += fmt::format(",{}{}{}", name.column, block, name.suffix);
            columns.emplace_back(series.values.data() + block, blocks);
        }
    }
    for (const ForceGauge& gauge : run.forces)
        if (!gauge.value_n.empty()) {
            text += fmt::format(",force_{}_n", gauge.name);
            columns.emplace_back(gauge.value_n.values.data(), 1);
        }
    text += '\n';
    for (std::size_t i = 0; i < run.time_s.size(); ++i)
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const double value = columns[c].first[i * columns[c].second];
            if (!std::isnan(value))
                fmt::format_to(std::back_inserter(text), "{}", value); // shortest that reads back as the same double
            text += c + 1 < columns.size() ? ',' : '\n';
        }
    return text;
}

void write_file(const fs::path& path, const std::string& text)
{
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

void write_measured_csv(const Campaign& campaign, const fs::path& folder)
{
    const auto fail = [&](const std::error_code& error) {
        if (error)
            throw InputError(folder.string(), 0,
                             fmt::format("cannot be made: {}.\n  Name a new folder whose parent exists and can be "
                                         "written; nothing was written.",
                                         error.message()));
    };
    const fs::path target = folder.filename().empty() ? folder.parent_path() : folder;
    if (fs::exists(target))
        throw InputError(folder.string(), 0, "exists already.\n  Name a new folder; nothing was written.");
    const fs::path making =
        target.parent_path() / fmt::format(".{}.{}.creating", target.filename().string(), ::getpid());
    std::error_code error;
    fs::create_directory(making, error);
    fail(error);
    try {
        fs::create_directory(making / "runs");
        for (const MeasuredRun* run : every_run(campaign))
            write_file(making / "runs" / (run->name + ".csv"), csv_text(*run, block_count(campaign)));
        write_file(making / "campaign.toml", toml_text(campaign));
        fs::rename(making, target, error);
        fail(error);
    } catch (...) {
        fs::remove_all(making, error);
        throw;
    }
}

/// In 32 bits with a sign, as other programs write it.
void write_whole(hid_t object, const std::string& name, int value)
{
    const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const hdf5::Handle attribute(H5Acreate2(object, name.c_str(), H5T_STD_I32LE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                 H5Aclose);
    if (H5Awrite(attribute.id(), H5T_NATIVE_INT, &value) < 0)
        throw hdf5::Error("cannot write the attribute '" + name + "'");
}

void write_whole_list(hid_t group, const std::string& name, const std::vector<int>& values, const hdf5::Dims& dims)
{
    if (!values.empty())
        hdf5::write_array(group, name, std::vector<std::int32_t>(values.begin(), values.end()), dims, "");
}

/// @pre the group has a group `blocks`
void write_test(hid_t group, const MeasuredRun& run)
{
    if (run.joint)
        write_whole(group, "joint", *run.joint);
    if (run.released_s)
        hdf5::write_real(group, "released_s", *run.released_s);
    write_whole_list(group, "blocks/present", run.present, {run.present.size()});
    write_whole_list(group, "clamped", run.clamped, {run.clamped.size()});
    std::size_t widest = 0;
    for (const std::vector<int>& taped : run.taped)
        widest = std::max(widest, taped.size());
    std::vector<int> rows;
    for (std::vector<int> taped : run.taped) {
        taped.resize(widest, -1);
        rows.insert(rows.end(), taped.begin(), taped.end());
    }
    write_whole_list(group, "taped", rows, {run.taped.size(), widest});
    if (!run.dummies.empty()) {
        const hdf5::Handle dummies = hdf5::create_group(group, "dummies");
        std::vector<int> blocks;
        for (const Dummy& dummy : run.dummies)
            blocks.push_back(dummy.block);
        write_whole_list(dummies.id(), "block", blocks, {blocks.size()});
        for (const DummyNumber& number : dummy_numbers()) {
            std::vector<double> values;
            for (const Dummy& dummy : run.dummies)
                values.push_back(dummy.*number.member);
            hdf5::write_array(dummies.id(), number.name, values, {values.size()},
                              number.dimension() == Dimension::mass ? "kg" : "m");
        }
    }
    if (run.forces.empty())
        return;
    const hdf5::Handle forces = hdf5::create_group(group, "force");
    for (const ForceGauge& gauge : run.forces) {
        const hdf5::Handle made = hdf5::create_group(forces.id(), gauge.name);
        write_whole(made.id(), "block", gauge.block);
        for (const GaugeNumber& number : gauge_numbers())
            hdf5::write_real(made.id(), number.name, gauge.*number.member);
        hdf5::write_text(made.id(), "to", end_word(gauge));
        if (gauge.value_n.empty())
            continue;
        hdf5::write_array(made.id(), "value_n", gauge.value_n.values, {gauge.value_n.values.size()}, "N");
        if (gauge.value_n.noise_sd)
            hdf5::write_real(hdf5::open_object(made.id(), "value_n").id(), "noise_sd", *gauge.value_n.noise_sd);
    }
}

void write_laboratory(hid_t file, const Laboratory& laboratory)
{
    const hdf5::Handle group = hdf5::create_group(file, "laboratory");
    for (const LaboratoryNumber& number : laboratory_numbers())
        if (const auto& value = laboratory.*number.member)
            hdf5::write_real(group.id(), number.name, *value);
    write_whole(group.id(), "may_dismantle", laboratory.may_dismantle ? 1 : 0);
    for (const auto& [kind, cost] : laboratory.cost)
        hdf5::write_real(group.id(), cost_key(kind), cost);
}

void write_run(hid_t runs, const MeasuredRun& run, std::size_t blocks)
{
    const hdf5::Handle group = hdf5::create_group(runs, run.name);
    hdf5::write_text(group.id(), "kind", to_string(run.test));
    write_whole(group.id(), "motion_id", run.motion_id);
    write_whole(group.id(), "repeat", run.repeat);
    if (run.kind)
        hdf5::write_text(group.id(), "motion", *run.kind);
    if (run.rate_hz != 0)
        hdf5::write_real(group.id(), "rate_hz", run.rate_hz);
    if (run.run_order)
        write_whole(group.id(), "run_order", *run.run_order);
    if (run.collapsed)
        write_whole(group.id(), "collapsed", *run.collapsed ? 1 : 0);
    hdf5::write_real(group.id(), "collapse_time_s", run.collapse_time_s);
    hdf5::create_group(group.id(), "base");
    hdf5::create_group(group.id(), "blocks");
    write_test(group.id(), run);
    if (run.time_s.empty())
        return;
    hdf5::write_array(group.id(), "time_s", run.time_s, {run.time_s.size()}, "s");
    for (const SeriesName& name : series_names()) {
        const Series& series = name.in(run);
        if (series.empty())
            continue;
        const hdf5::Dims dims = name.per_block ? hdf5::Dims{run.time_s.size(), blocks} : hdf5::Dims{run.time_s.size()};
        hdf5::write_array(group.id(), name.path, series.values, dims, name.unit);
        const hdf5::Handle object = hdf5::open_object(group.id(), name.path);
        if (series.noise_sd)
            hdf5::write_real(object.id(), "noise_sd", *series.noise_sd);
        if (!std::string(name.path).starts_with("base/"))
            continue;
        hdf5::write_text(object.id(), "source", to_string(run.base_source));
        if (run.base_clock)
            hdf5::write_text(object.id(), "clock", *run.base_clock);
    }
}

void write_specimen(hid_t file, const Specimen& specimen)
{
    const hdf5::Handle group = hdf5::create_group(file, "specimen");
    for (const SpecimenNumber& number : specimen_numbers())
        hdf5::write_real(group.id(), number.name, specimen.*number.member);
    if (specimen.friction_nominal)
        hdf5::write_real(group.id(), "friction_nominal", *specimen.friction_nominal);
    if (specimen.base_block_half_width_m)
        hdf5::write_real(group.id(), "base_block_half_width_m", *specimen.base_block_half_width_m);
    for (const SpecimenList& list : specimen_lists())
        if (const std::vector<double>& values = specimen.*list.member; !values.empty())
            hdf5::write_array(group.id(), list.name, values, {values.size()},
                              list.dimension == Dimension::mass ? "kg" : "m");
    std::vector<std::int32_t> joints;
    for (const auto& [lower, upper] : specimen.joints)
        joints.insert(joints.end(), {lower, upper});
    if (!joints.empty())
        hdf5::write_array(group.id(), "joints", joints, {specimen.joints.size(), 2}, "");
}

void write_measured_hdf5(const Campaign& campaign, const fs::path& path)
{
    const fs::path making = path.parent_path() / fmt::format(".{}.{}.creating", path.filename().string(), ::getpid());
    try {
        hdf5::Handle file = hdf5::create_file(making, 0);
        hdf5::write_text(file.id(), "format", measured_format);
        write_whole(file.id(), "format_version", measured_version);
        if (!campaign.specimen.name.empty())
            hdf5::write_text(file.id(), "specimen", campaign.specimen.name);
        hdf5::write_real(file.id(), "gravity_m_s2", campaign.specimen.gravity_m_s2);
        write_specimen(file.id(), campaign.specimen);
        write_laboratory(file.id(), campaign.laboratory);
        {
            const hdf5::Handle runs = hdf5::create_group(file.id(), "runs");
            const std::size_t blocks = block_count(campaign);
            for (const MeasuredRun* run : every_run(campaign))
                write_run(runs.id(), *run, blocks);
        }
        file.close();
        rename_over(making, path);
    } catch (const hdf5::Error& error) {
        std::error_code ignored;
        fs::remove(making, ignored);
        throw InputError(
            path.string(), 0,
            fmt::format("cannot be written: {}.\n  Name a file in a folder that exists, can be written and "
                        "has room; nothing was written.",
                        error.what()));
    }
}

} // namespace

void write_campaign(const Campaign& campaign, const std::filesystem::path& path)
{
    Campaign copy = campaign;
    copy.source = path.string();
    check_shapes(copy);
    if (path.extension() == ".h5" || path.extension() == ".hdf5")
        write_measured_hdf5(copy, path);
    else
        write_measured_csv(copy, path);
}

} // namespace stylobate
