#include "ensemble/model/input_error.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/records/record.hpp"
#include "io/records/record_pair.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>

namespace stylobate {

namespace {

Range range_of(IntensityMeasure measure)
{
    switch (measure) {
    case IntensityMeasure::pga:
    case IntensityMeasure::sa:
        return acceleration_range;
    case IntensityMeasure::pgv:
        return {0, 100, true, "Velocities are in m/s.", from_velocities};
    case IntensityMeasure::pgd:
        return {0, 100, true, "Displacements are in metres.", from_lengths};
    case IntensityMeasure::arias:
        return {0, 1000, true, "Arias intensities are in m/s.", from_velocities};
    case IntensityMeasure::cav:
        return {0, 10000, true, "Cumulative absolute velocities are in m/s.", from_velocities};
    }
    return {};
}

void check_ascending(const KeyReader& keys, const ListKey& key, const std::vector<double>& values)
{
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1]))
            keys.refuse(key.name,
                        fmt::format("is not in ascending order: {:g} comes before {:g}", values[i - 1], values[i]),
                        "Give the slightest first: a structure that reaches a limit has reached those before it.");
}

/// "AT2" of "RSN1_X.at2": how files of one kind end.
std::string ending(const std::filesystem::path& file)
{
    std::string all = file.extension().string();
    for (char& c : all)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return all.empty() ? all : all.substr(1);
}

/// The files of a folder by what is in them.
struct ReadFolder {
    struct Refused {
        std::filesystem::path file;
        std::string why;
    };
    struct Component {
        std::string file;
        std::optional<std::string> name; ///< nullopt where the file has only one
        bool vertical = false;
    };
    std::vector<Component> components;
    std::vector<Refused> refused;
};

ReadFolder read_folder(const std::vector<std::filesystem::path>& files, const std::optional<std::string>& unit,
                       PgaRange pga)
{
    ReadFolder folder;
    for (const std::filesystem::path& file : files)
        try {
            const std::vector<Record> records = read_records(file, unit, pga);
            for (const Record& record : records)
                folder.components.push_back({record.file,
                                             records.size() > 1 ? std::optional(record.component) : std::nullopt,
                                             record.direction == Direction::vertical});
        } catch (const InputError& error) {
            folder.refused.push_back({file, error.what()});
        }
    return folder;
}

/// What is no record at all, and what no file of the same ending is, is left out: a download has velocities,
/// displacements and tables beside the accelerations. A file that cannot be read among others of its ending that can
/// is an error.
void check_refused(const std::string& pattern, const ReadFolder& folder)
{
    std::set<std::string> read;
    for (const ReadFolder::Component& component : folder.components)
        read.insert(ending(component.file));
    for (const ReadFolder::Refused& refused : folder.refused) {
        const std::string of_file = ending(refused.file);
        if (folder.components.empty())
            throw InputError(refused.why + "\n  No file of fragility.folder can be read as a record of accelerations.");
        if (read.contains(of_file) && record_format(refused.file)) {
            std::string others;
            for (const std::string& each : read)
                others += (others.empty() ? "" : ", ") + each;
            throw InputError(fmt::format("{}\n  Other files *.{} of fragility.folder were read: correct or remove this "
                                         "one, or leave it out by fragility.pattern "
                                         "(now \"{}\").",
                                         refused.why, of_file, pattern));
        }
    }
}

/// Of a record; none where it has no such table.
std::optional<ComponentSpec> read_component(const KeyReader& record, const TableKey& key)
{
    if (!record.has(key))
        return std::nullopt;
    ComponentSpec component;
    record.table(key).read_fields(key, component);
    component.unit = acceleration_unit(component.unit);
    return component;
}

/// The horizontal components of a folder as pairs: each one that is not part of a pair yet is the first of one.
/// @throws InputError for one that no other belongs to
std::vector<RecordSpec> pairs_of(const std::vector<ReadFolder::Component>& components,
                                 const std::optional<std::string>& unit, PgaRange pga)
{
    std::vector<RecordSpec> pairs;
    std::vector<bool> taken(components.size());
    std::vector<std::optional<InputError>> refused(components.size());
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (taken[i] || components[i].vertical)
            continue;
        try {
            const Record first = read_record(components[i].file, components[i].name, unit, pga);
            const Record second = other_component(first, {"fragility.folder", {}, Direction::horizontal, unit}, pga);
            const auto other = std::ranges::find_if(components, [&](const ReadFolder::Component& each) {
                return each.file == second.file && (!each.name || each.name == second.component);
            });
            if (other != components.end())
                taken[static_cast<std::size_t>(other - components.begin())] = true;
            taken[i] = true;
            pairs.push_back(
                {components[i].file, components[i].name, unit, ComponentSpec{second.file, second.component, unit}});
        } catch (const InputError& error) { // it may be the second one of a shorter component
            refused[i] = error;
        }
    }
    for (std::size_t i = 0; i < components.size(); ++i)
        if (!taken[i] && refused[i])
            throw InputError(*refused[i]);
    return pairs;
}

} // namespace

FragilitySpec read_fragility(const KeyReader& keys, const KeyReader& study, const ExcitationSpec& excitation,
                             std::uint64_t structures)
{
    using namespace fragility_keys;
    FragilitySpec f;
    f.method = keys.read(method);
    const char* motion = word_for(excitation_kind_names, excitation.kind);
    keys.refuse_unused(table, "excitation.kind", motion);
    if (excitation.kind == ExcitationKind::record) {
        for (const KeyReader& each : keys.tables(records)) {
            RecordSpec& record = f.records.emplace_back();
            each.read_fields(records, record);
            record.unit = acceleration_unit(record.unit);
            record.second = read_component(each, second);
            record.vertical = read_component(each, vertical);
        }
        if (f.records.empty() == !keys.has(folder))
            keys.refuse_all(f.records.empty()
                                ? "fragility has no motions: give records = [{ file = \"...\" }, ...], or "
                                  "folder = \"...\""
                                : "fragility.records and fragility.folder exclude each other: give one");
        for (const TextKey* each : {&pattern, &unit})
            if (keys.has(*each) && !keys.has(folder))
                keys.refuse(each->name, "applies to the files of a folder, and no folder is given",
                            "Give fragility.folder.");
        f.motions = static_cast<int>(f.records.size()); // those of a folder are listed later
    } else if (f.method == FragilityMethod::cloud) {
        keys.refuse("method", "uses recorded motions, and these are synthetic",
                    "Give method = \"stripes\", or excitation.kind = \"record\".");
    }
    // ranges that are narrower than those of the keys
    keys.read_up_to(contacts, structures);
    keys.read_up_to(twins, structures);
    const KeyUse use{{{"excitation.kind", motion}, {"fragility.method", word_for(fragility_method_names, f.method)}}};
    keys.read_fields<MotionSetSpec>(table, f, use);
    keys.read_fields(table, f, use);
    check_ascending(keys, periods, f.periods_s);
    if (f.method == FragilityMethod::stripes) {
        if (keys.has(scale))
            keys.refuse("scale", "is not used by method = \"stripes\"", "Remove it, or give method = \"cloud\".");
        if (!keys.has(intensity))
            keys.missing("intensity", "Give it as { measure = \"pga\", from = ..., to = ..., count = ..., spacing = "
                                      "\"log\" }: motions are scaled to each of these.");
        const KeyReader axis = keys.table(intensity);
        f.measure = axis.read(measure);
        if (f.measure == IntensityMeasure::sa)
            f.period_s = axis.read(period);
        else if (axis.has(period))
            axis.refuse(period.name, "is not used by this measure", "Remove it, or give measure = \"sa\".");
        f.intensity = read_axis(keys, intensity, range_of(f.measure));
    } else if (keys.has(intensity)) {
        keys.refuse("intensity", "is not used by method = \"cloud\"", "Remove it, or give method = \"stripes\".");
    }
    const auto group = static_cast<std::uint64_t>(f.contacts) * static_cast<std::uint64_t>(f.twins);
    if (structures % group != 0) {
        const std::uint64_t below = structures / group * group;
        study.refuse("realizations", fmt::format("is no multiple of fragility.contacts x twins = {}", group),
                     below > 0 ? fmt::format("Give {} or {}.", below, below + group) : fmt::format("Give {}.", group));
    }
    check_ascending(keys, peak_limits, f.peak_limits);
    check_ascending(keys, residual_limits, f.residual_limits);
    return f;
}

void list_records(const KeyReader& keys, const std::filesystem::path& beside, PgaRange pga, bool pairs,
                  FragilitySpec& fragility)
{
    if (!keys.has(fragility_keys::folder))
        return;
    namespace fs = std::filesystem;
    fs::path folder = keys.read(fragility_keys::folder);
    std::error_code error;
    if (folder.is_relative() && fs::is_directory(beside / folder, error))
        folder = beside / folder;
    folder = fs::absolute(folder).lexically_normal();
    if (!fs::is_directory(folder, error))
        keys.refuse("folder", "is not a folder", "Give the folder in which the records are.");
    const std::string pattern = keys.read_or(fragility_keys::pattern, "*");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.is_regular_file(error) && fnmatch(pattern.c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0)
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty())
        keys.refuse("folder", fmt::format("has no file \"{}\"", pattern), "Check fragility.pattern.");
    const auto unit = acceleration_unit(keys.maybe(fragility_keys::unit));
    const ReadFolder read = read_folder(files, unit, pga);
    check_refused(pattern, read);
    for (const ReadFolder::Refused& refused : read.refused)
        fragility.left_out.push_back(refused.file.filename().string());
    for (const ReadFolder::Component& component : read.components) {
        if (component.vertical)
            fragility.left_out.push_back(fmt::format("{}{} (vertical)", fs::path(component.file).filename().string(),
                                                     component.name ? " " + *component.name : ""));
        else if (!pairs)
            fragility.records.push_back({component.file, component.name, unit});
    }
    if (pairs)
        fragility.records = pairs_of(read.components, unit, pga);
    fragility.motions = static_cast<int>(fragility.records.size());
    if (fragility.records.empty())
        keys.refuse("folder", "has no horizontal component", "Give a folder with horizontal components of records.");
}

} // namespace stylobate
